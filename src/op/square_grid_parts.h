/* A grid that is interpolated in two passes: blocks of lines along v, then panels of columns along u. */
#ifndef PIA_OP_SQUARE_GRID_PARTS_H
#define PIA_OP_SQUARE_GRID_PARTS_H

#include "square_grid.h"

enum {
    PIA_GRID_UNIT = 8,       /* numbers that belong together whatever the vectors are: points a step, lanes of sums */
    PIA_GRID_MOST_DIM = 8,   /* components */
    PIA_GRID_MOST_LINES = 32 /* of a block */
};

/* One direction: its matrix and Crout's factors, row i over the columns i - lower .. i + upper, zeros outside. Where a row is narrow,
 * one entry on either side of the diagonal is all, as in most rows of a cubic with knots at its parameters.
 *
 * A closed direction is cut open, with `margin` rows of the other end again at both ends: the inverse decays exponentially away from
 * its diagonal, as in windows.h, so that what is between the margins is known to rounding, and the errors tell where it is not. */
typedef struct pia_grid_side {
    pia_index n, margin;                         /* 0: of an open direction; else a multiple of PIA_GRID_UNIT */
    int lower, upper;                            /* at least 1 */
    double *entry;                               /* [n x (lower + 1 + upper)] */
    double *factor;                              /* rows -margin .. n + margin - 1 of as many, pivots inverted */
    unsigned char *narrow_entry, *narrow_factor; /* of the same rows */
} pia_grid_side;

/* A panel shows `width` numbers of every line and `halo` numbers on both sides, as many as the rows of v may ask for: the equations of
 * these are solved again, so that a panel measures its errors alone. */
typedef struct pia_square_grid {
    const pia_grid_side *u, *v;
    int dim;
    pia_index halo, width, panels;
    const double *points; /* [u x v x dim] */
    const double *across; /* [(lower + 1 + upper) of v x panels x width] the entries of v, one for each number */
    const double *counts; /* [panels x width] 1: the first number of a point, 0: others, and those past the last */
    const double *shift;  /* [width + 2 halo] the first point, again and again, so that surfaces far from the origin lose nothing */
    const double *back;   /* [width] the same, less the origin of the targets */
    double *along;        /* [u x stride] solved along v */
    pia_index stride;
    double *next; /* [u x v x dim] control points */
} pia_square_grid;

/* The row of the data that is met at row i, which may lie in a margin. */
static inline pia_index pia_grid_turn(const pia_grid_side *a, pia_index i)
{
    pia_index at = i % a->n;
    return at < 0 ? at + a->n : at;
}

/* Lines of a block: several vectors, whose chains of operations overlap; fewer where a point has several numbers. */
static inline pia_index pia_grid_lines(int dim)
{
    return dim == 1 ? PIA_GRID_MOST_LINES : dim <= 3 ? PIA_GRID_MOST_LINES / 2 : PIA_GRID_UNIT;
}

/* Numbers that a block or a panel needs as room. */
pia_index pia_grid_room(const pia_square_grid *g);

/* With vectors of four, and of eight where the processor has them: the bits are the same. */
typedef struct pia_grid_solver {
    /* along = points A_v^-1, for the lines of the block that begins with `line`. */
    void (*lines)(const pia_square_grid *g, pia_index line, double *room);
    /* next = A_u^-1 along, for the columns of a panel; joins its errors. */
    void (*panel)(const pia_square_grid *g, pia_index panel, double *room, pia_step_errors *errors);
} pia_grid_solver;

extern const pia_grid_solver pia_grid_by_four, pia_grid_by_eight;

/* pia_square_grid_step with one of them. */
pia_status pia_square_grid_step_with(const pia_grid_solver *solver, const pia_op *op, const pia_targets *targets, double *next,
                                     pia_survey *survey, pia_step_errors *out);

#endif
