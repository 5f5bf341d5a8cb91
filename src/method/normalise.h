/* What the least-squares iterations divide a gradient by. */
#ifndef PIA_METHOD_NORMALISE_H
#define PIA_METHOD_NORMALISE_H

#include "iterate.h"

/* Column sums, sum over the rows of w N_c, into sums [cols]: the row sums of H = A'WA, because the basis functions sum to 1. Their
 * reciprocals are the step of LSPIA per control point; the largest bounds the eigenvalues of H. Without a normal form: one pass.
 * Errors: PIA_E_MEMORY. */
pia_status pia_column_sums(const pia_iterate *iterate, double *sums);

/* 1 / sums in place, 0 where the sum is 0: unknowns without data stay. */
void pia_reciprocals(pia_index count, double *sums);
/* 0 without values. */
double pia_largest(pia_index count, const double *values);

#endif
