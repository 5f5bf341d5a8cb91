/* A run of curve points on one knot span, in the Chebyshev polynomials T_j of a local parameter x in [-1, 1]: everything that least
 * squares wants to know about them, in one pass at the speed of memory, without basis functions. The order of summation depends on the
 * number of points alone. */
#ifndef PIA_KERNEL_RUN_H
#define PIA_KERNEL_RUN_H

#include "survey.h"

typedef struct pia_run {
    int degree, dim;       /* dim 0: no points */
    const double *origin;  /* [dim], subtracted from the points */
    double middle, scale;  /* x = (t - middle) * scale */
    const double *t;       /* [count] */
    const double *points;  /* [count x dim] */
    const double *weights; /* [count]; NULL: 1 */
    pia_index count;
} pia_run;

/* Adds to sums [dim + 2][degree + 1]: sum w T_j, sum w T_degree T_j, and for each component sum w T_j (q - origin). The scout
 * sees the rows as well, which begin where it is or before; NULL: none. */
enum { PIA_RUN_SUMS = (PIA_MAX_DIM + 2) * (PIA_MAX_DEGREE + 1) };
void pia_run_moments(const pia_run *run, pia_scout *scout, double *sums);

typedef struct pia_run_errors {
    double sum_squares, weighted, worst; /* worst: largest square */
    pia_index index;                     /* of the point it belongs to */
} pia_run_errors;

/* Squares of the differences q - origin - sum_j coefficient[j] T_j(x), coefficient [(degree + 1) x dim]: added to the sums of errors;
 * worst and index (`first` for the first point of the run) change where a square is larger. out [count x dim] receives the differences;
 * NULL: they are not wanted. */
void pia_run_residual(const pia_run *run, const double *coefficient, pia_index first, double *out, pia_run_errors *errors);

#endif
