/* The basis functions of one span as polynomials of a local parameter. */
#ifndef PIA_OP_CHEBYSHEV_H
#define PIA_OP_CHEBYSHEV_H

#include "collocation.h"
#include "vector.h"

/* The discrete Chebyshev transform of polynomials of a degree: from values at node[i] to coefficients,
 * coefficient j = sum over i of transform[i * (degree + 1) + j] value i. */
typedef struct pia_chebyshev {
    int degree;
    double node[PIA_MAX_DEGREE + 1], transform[(PIA_MAX_DEGREE + 1) * (PIA_MAX_DEGREE + 1)];
} pia_chebyshev;

void pia_chebyshev_fill(int degree, pia_chebyshev *out);

/* Chebyshev coefficients of the degree + 1 basis functions of span s in x = (t - middle) * scale: coefficient[k * (degree + 1) + j]. */
void pia_chebyshev_span(const pia_chebyshev *c, const pia_collocation *line, pia_index s, double *middle, double *scale,
                        double *coefficient);

/* A curve on a few spans, in the same polynomials of the local parameter of each. */
typedef struct pia_chebyshev_curves {
    double middle[PIA_LANES], scale[PIA_LANES];
    double coefficient[PIA_LANES][(PIA_MAX_DEGREE + 1) * PIA_MAX_DIM]; /* [(degree + 1) x dim] each */
} pia_chebyshev_curves;

/* Of the spans s .. s + count - 1 of positive length, count <= PIA_LANES; full [control points x dim]. */
void pia_chebyshev_take(const pia_chebyshev *c, const pia_collocation *line, pia_index s, int count, const double *full, int dim,
                        pia_chebyshev_curves *out);

#endif
