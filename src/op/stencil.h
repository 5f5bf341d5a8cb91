/* The Gram matrix A'WA of a surface that is no Kronecker product: every control point is coupled with the (2p + 1) x (2q + 1) around
 * it. Kept over the full control points, before closed directions are wrapped; one of each symmetric pair of entries is stored. */
#ifndef PIA_OP_STENCIL_H
#define PIA_OP_STENCIL_H

#include "gram.h"
#include "op.h"

typedef struct pia_stencil {
    pia_context *context;
    int p, q, dim;            /* degrees; the most components of a product */
    pia_index lines, columns; /* full control points a direction */
    pia_index stride;         /* columns + 2 q: lines of numbers have q zeros at both ends */
    double *entry;            /* [lines x (p + 1) x (2 q + 1) x stride], see pia_stencil_line */
    double *x, *y;            /* work of products [lines x dim x stride] */
} pia_stencil;

/* A matrix of zeros. Errors: PIA_E_MEMORY, PIA_E_SIZE. */
pia_status pia_stencil_open(const pia_op *op, int dim, pia_stencil *out);
void pia_stencil_close(pia_stencil *stencil);
void pia_stencil_clear(pia_stencil *stencil);

/* The entries that couple (i, j) with (i + a, j + b) for all j, 0 <= a <= p, -q <= b <= q; for a = 0 only b >= 0 is used. */
static inline double *pia_stencil_line(const pia_stencil *stencil, pia_index i, int a, int b)
{
    return stencil->entry + ((i * (stencil->p + 1) + a) * (2 * stencil->q + 1) + b + stencil->q) * stencil->stride + stencil->q;
}

/* y = S x over full control points, x and y [lines x columns x dim]. */
void pia_stencil_multiply(const pia_stencil *stencil, const double *x, int dim, double *y);

/* Entries as (row, column, value) of the unknowns, scaled on both sides by scale [cols]; those of unknowns whose scale is 0 become a
 * unit diagonal. At most pia_stencil_room triplets, of the lower triangle; returns how many. */
pia_index pia_stencil_room(const pia_stencil *stencil, const pia_op *op);
pia_index pia_stencil_triplets(const pia_stencil *stencil, const pia_op *op, const double *scale, pia_index *row, pia_index *column,
                               double *value);
/* The diagonal over the unknowns [cols]. */
void pia_stencil_diagonal(const pia_stencil *stencil, const pia_op *op, double *diagonal);

/* The Gram matrices of both directions alone, u [direction 0] and v, whose Kronecker product is like S: basis functions sum to 1, so
 * they are sums of S over the other direction; v is divided by the sum of everything. */
void pia_stencil_marginals(const pia_stencil *stencil, const pia_op *op, pia_gram *gram);

#endif
