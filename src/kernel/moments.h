/* Sums over a run of curve points, in the Chebyshev polynomials T_j of a local parameter x in [-1, 1]: everything that least squares
 * on one knot span wants to know about its points. One pass at the speed of memory, no basis functions. */
#ifndef PIA_KERNEL_MOMENTS_H
#define PIA_KERNEL_MOMENTS_H

#include "pia/pia.h"

/* Sums of one run, [dim + 2] rows of degree + 1 numbers: sum w T_j, sum w T_degree T_j, and for each component sum w T_j (q - origin).
 */
enum { PIA_MOMENTS_ROOM = (PIA_MAX_DIM + 2) * (PIA_MAX_DEGREE + 1) };

typedef struct pia_moments {
    int degree, dim;      /* dim 0: only the first two rows of sums */
    const double *origin; /* [dim] */
    double middle, scale; /* x = (t - middle) * scale */
} pia_moments;

/* Adds the sums of `count` points [count x dim] at parameters t [count] with weights [count] (NULL: 1). The order of summation
 * depends on count alone. */
void pia_moments_add(const pia_moments *m, const double *t, const double *points, const double *weights, pia_index count, double *sums);

#endif
