/* Sparse symmetric positive definite systems, factored once. With CHOLMOD: fill-reducing order, simplicial LDL' (Davis, Hager).
 * Without: LL' in the envelope of the order given, which serves small surfaces. */
#ifndef PIA_LINALG_SPARSE_H
#define PIA_LINALG_SPARSE_H

#include "context.h"

typedef struct pia_sparse pia_sparse;

/* Entries of the lower triangle, row[k] >= column[k]; entries at one place add up. */
typedef struct pia_triplets {
    pia_index n, count;
    pia_index *row, *column; /* [count] */
    double *value;           /* [count] */
} pia_triplets;

/* weak receives how many pivots were at most threshold (the diagonal is about 1). When one was not positive at all, *out is NULL and
 * weak at least 1. Errors: PIA_E_MEMORY, PIA_E_SIZE. */
pia_status pia_sparse_factor(pia_context *context, const pia_triplets *matrix, double threshold, pia_sparse **out, pia_index *weak);
void pia_sparse_close(pia_sparse *sparse);
/* b [n x dim] := the solution, dim at most PIA_MAX_DIM. */
void pia_sparse_solve(const pia_sparse *sparse, double *b, int dim);

#endif
