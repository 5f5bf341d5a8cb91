/* The normal form H x = b of weighted least squares, H = A'WA, b = A'W(Q - origin), accumulated in one pass over the data; after that
 * an iteration costs O(cols (2 degree + 1)^directions dim), however many points there are. In the space of unknowns; frozen ones are
 * zero in products and solutions. */
#ifndef PIA_OP_NORMAL_H
#define PIA_OP_NORMAL_H

#include "op.h"

typedef struct pia_normal pia_normal;

typedef struct pia_normal_class {
    const char *name;
    void (*multiply)(const pia_normal *normal, const double *x, int dim, double *y); /* y = H x */
    pia_status (*factor)(pia_normal *normal);                                        /* once before solve */
    void (*solve)(const pia_normal *normal, double *b, int dim);                     /* b := H^-1 b */
    void (*close)(pia_normal *normal);
} pia_normal_class;

struct pia_normal {
    const pia_normal_class *class;
    const pia_op *op;
    double *right;      /* b [cols x dim] */
    double *diagonal;   /* of H [cols] */
    double *column_sum; /* sum over rows of w N_c [cols] */
    pia_index weak;     /* unknowns the factorisation had to decouple */
    void *state;
};

/* Errors: PIA_E_MEMORY; PIA_E_UNAVAILABLE when this operator has no cheap normal form (a grid with holes). */
pia_status pia_normal_open(pia_op *op, const pia_targets *targets, pia_normal **out);
void pia_normal_close(pia_normal *normal);

#endif
