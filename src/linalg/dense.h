/* Small dense systems: Schur complements of constraints, borders. Row-major. */
#ifndef PIA_LINALG_DENSE_H
#define PIA_LINALG_DENSE_H

#include "context.h"

/* Cholesky with diagonal pivoting of a symmetric positive semidefinite s [n x n], in place: of which the lower triangle counts, by the
 * factor of the permuted matrix below and its transpose above the diagonal.
 * order [n] receives the permutation. Stops at pivots below rtol times the largest; returns the rank. */
pia_index pia_dense_cholesky(double *s, pia_index n, double rtol, pia_index *order);
/* Solves with the leading rank unknowns of that factor; the others become 0. b [n x dim] in the original order. scratch [n x dim]. */
void pia_dense_cholesky_solve(const double *factor, pia_index n, pia_index rank, const pia_index *order, double *b, int dim,
                              double *scratch);

/* LU with partial pivoting; returns 0 when singular. pivot [n]. */
int pia_dense_lu(double *a, pia_index n, pia_index *pivot);
void pia_dense_lu_solve(const double *lu, pia_index n, const pia_index *pivot, double *b, int dim);

#endif
