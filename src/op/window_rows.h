/* Inside a window: the rows that take part in a fit of it, and the conditions that it is to meet. */
#ifndef PIA_OP_WINDOW_ROWS_H
#define PIA_OP_WINDOW_ROWS_H

#include "window.h"

/* Rows, as arrays in the draft's work space. */
typedef struct pia_rows {
    pia_index count, room;
    double *value;      /* [room x (degree + 1)] basis values */
    double *target;     /* [room x dim] */
    double *inverse;    /* [room] inverse tolerance */
    double *weight;     /* [room] Lawson's */
    double *difference; /* [room x dim] to the curve as judged last */
    int *first;         /* [room] index of the first control point */
} pia_rows;

static inline __attribute__((always_inline)) void pia_row_difference(const pia_rows *r, pia_index k, const double *points, int p,
                                                                     int dim, double *difference)
{
    const double *value = r->value + k * (p + 1), *point = points + (pia_index)r->first[k] * dim;
    for (int d = 0; d < dim; d++) {
        double sum = 0;
        for (int i = 0; i <= p; i++) sum += value[i] * point[i * dim + d];
        difference[d] = r->target[k * dim + d] - sum;
    }
}

/* The curve on one span as Taylor polynomial in x = (t - middle) * scale, x in [-1, 1]: of degrees at which these keep their digits. */
enum { PIA_PIECE_DEGREE = 7 };
typedef struct pia_piece {
    double middle, scale, coefficient[(PIA_PIECE_DEGREE + 1) * PIA_MAX_DIM];
} pia_piece;
pia_piece pia_window_piece(const pia_window *window, int span, int degree, int dim);

/* Adds places of gaps, in the spans whose rows are begin[s] .. begin[s + 1] - 1, where the curve swings out more than it may. Returns
 * the largest ratio to that. */
double pia_window_look_between(const pia_draft *draft, const pia_window *window, const pia_index *begin, pia_rows *rows);
/* Adds all places of the gaps that got knots. */
void pia_window_fill_gaps(const pia_draft *draft, const pia_window *window, pia_rows *rows);

/* Conditions that moving control points touch, scaled to absolute sum 1. */
typedef struct pia_held {
    int count;
    int first[PIA_WINDOW_FREE];                           /* index of the first control point */
    double value[PIA_WINDOW_FREE * (PIA_MAX_DEGREE + 1)]; /* [count x (degree + 1)] */
    double right[PIA_WINDOW_FREE * PIA_MAX_DIM];          /* [count x dim] */
} pia_held;

/* The conditions of a window. Returns 0 when they are more than its unknowns. */
int pia_window_hold(const pia_draft *draft, const pia_window *window, pia_held *held);
/* Moves the control points to the weighted least-squares fit of the rows: of a cyclic window; and of any window such that the
 * conditions are met. The latter returns 0, and moves nothing, when they cannot be. */
void pia_window_correct_cyclic(pia_window *w, const pia_rows *r, int p, int dim);
int pia_window_correct_held(pia_window *w, const pia_rows *r, const pia_held *held, int p, int dim, int cyclic);
/* Whether the control points meet the conditions. */
int pia_window_holds(const pia_window *w, const pia_held *held, int p, int dim);

#endif
