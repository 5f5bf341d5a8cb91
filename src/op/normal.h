/* The normal form H x = b of weighted least squares, H = A'WA, b = A'W(Q - origin), accumulated in one pass over the data; after that
 * an iteration costs O(cols (2 degree + 1)^directions dim), however many points there are. In the space of unknowns; frozen ones are
 * zero in products and solutions. */
#ifndef PIA_OP_NORMAL_H
#define PIA_OP_NORMAL_H

#include "op.h"

struct pia_energy;
struct pia_survey;
typedef struct pia_normal pia_normal;

typedef struct pia_normal_class {
    const char *name;
    void (*multiply)(const pia_normal *normal, const double *x, int dim, double *y); /* y = H x */
    pia_status (*factor)(pia_normal *normal);                                        /* before solve, and after every change */
    void (*solve)(const pia_normal *normal, double *b, int dim);                     /* b := H^-1 b */
    int sides; /* right-hand sides that solve takes together at the least cost each; 0: as many as points have components */
    void (*solve_along)(const pia_normal *normal, int direction, double *b,
                        pia_index width); /* b [unknowns of direction x width] := G^-1 b, H = Gu (x) Gv; NULL: H is no product */
    void (*sweep)(const pia_normal *normal, double *x, int dim); /* one symmetric Gauss-Seidel sweep for H x = b;
                                                                    NULL: the rows of H are not at hand */
    pia_status (*correct)(pia_normal *normal, const pia_targets *targets, const double *x, double *d); /* of a delicate form: d takes x
                                                                                        to the minimiser, from the rows themselves, and
                                                                                        solve is as exact from then on */
    pia_status (*approximate)(pia_normal *normal);                      /* before precondition, and after every change; NULL: factor */
    void (*precondition)(const pia_normal *normal, double *b, int dim); /* b := M^-1 b, M close to H; NULL: solve */
    /* x := H^-1 b, at once and nearly to rounding, where nothing is frozen; else *done = 0. NULL: there is no way. */
    pia_status (*leap)(const pia_normal *normal, int dim, double *x, int *done);
    /* Sum of squares of b - H x where nothing is frozen; r receives it, NULL: unwanted. NULL: by multiply. */
    double (*residual)(const pia_normal *normal, const double *x, int dim, double *r);
    void (*refresh)(pia_normal *normal, const pia_targets *targets, pia_index first_row, pia_index last_row);
    void (*close)(pia_normal *normal);
} pia_normal_class;

struct pia_normal {
    const pia_normal_class *class;
    const pia_op *op;
    double *right;             /* b [cols x dim] */
    double *diagonal;          /* of H [cols] */
    double *column_sum;        /* sum over rows of w N_c [cols] */
    pia_index weak;            /* unknowns that the data do not hold, known after factor: solutions are 0 or small there */
    int delicate;              /* 1, known after factor: H has lost digits that the rows still have, and `correct` is there */
    struct pia_energy *energy; /* added to H, see energy.h; NULL: none */
    double pull;               /* pull (P - start)^2 is added to the squares; 0: none */
    const double *start;       /* [cols x dim], borrowed */
    void *state;
};

/* Banded for curves; a Kronecker product for full grids without weights and frozen control points; a stencil for other surfaces.
 * Errors: PIA_E_MEMORY, PIA_E_SIZE; PIA_E_UNAVAILABLE when this operator has no normal form. */
pia_status pia_normal_open(pia_op *op, const pia_targets *targets, pia_normal **out);
/* The same with more than the data in it. */
typedef struct pia_addition {
    double fairing;      /* strength of the fairing energy beside the data (energy.h); 0: none */
    double pull;         /* weight of |P - start|^2; 0: none */
    const double *start; /* [cols x dim] relative to the targets' origin, borrowed; NULL without pull */
    /* Of a curve, or a grid that is a Kronecker product, whose rows nobody has checked yet: called with what the pass over them has
     * found, before the targets' origin is used; anything but PIA_OK ends it. NULL: they are good. */
    pia_status (*look)(void *owner, const struct pia_survey *survey);
    void *owner;
} pia_addition;
pia_status pia_normal_open_with(pia_op *op, const pia_targets *targets, const pia_addition *addition, pia_normal **out);
void pia_normal_close(pia_normal *normal);

/* Points or weights of rows first_row .. last_row have changed, their parameters have not: sums again, from the data, what these rows
 * touch. Gives the same bits as a normal form opened anew. */
void pia_normal_refresh(pia_normal *normal, const pia_targets *targets, pia_index first_row, pia_index last_row);

/* For the classes, when all else is in the sums: the pull in `right`, `diagonal` and `column_sum`; H is theirs. */
void pia_normal_add_pull(pia_normal *normal, int dim);
/* Unknowns from .. to - 1: right-hand sides relative to the first point become relative to the origin. */
void pia_normal_move(pia_normal *normal, const pia_targets *targets, pia_index from, pia_index to);
/* For pia_normal_open: the normal forms of its operators, whose arrays are allocated and whose state is to be made. */
pia_status pia_normal_curve_open(pia_normal *normal, const pia_targets *targets, const pia_addition *addition);
pia_status pia_normal_grid_open(pia_normal *normal, const pia_targets *targets, const pia_addition *addition);
pia_status pia_normal_stencil_open(pia_normal *normal, const pia_targets *targets);

#endif
