/* Tensor-product Bernstein polynomials on the unit square: subdivision and products. A curve has degree 0 in v. Coefficients are
 * [degree[0] + 1][degree[1] + 1][width], width last. */
#ifndef PIA_SPLINE_BERNSTEIN_H
#define PIA_SPLINE_BERNSTEIN_H

#include "model.h"

enum {
    PIA_PIECE_COUNT = (PIA_MAX_DEGREE + 1) * (PIA_MAX_DEGREE + 1),         /* coefficients of a piece */
    PIA_SQUARE_COUNT = (2 * PIA_MAX_DEGREE + 1) * (2 * PIA_MAX_DEGREE + 1) /* coefficients of a product of two */
};

/* The same polynomial over [low, high] of direction d, 0 <= low < high <= 1, in place (de Casteljau). */
void pia_bernstein_restrict(double *c, const int degree[2], int width, int d, double low, double high);

/* binomial(n, k) for k = 0..n, n <= 50: exact. */
void pia_bernstein_binomials(int n, double *out);

/* Binomials of one pair of degrees, for pia_bernstein_square: of the degree, and of twice the degree. */
typedef struct pia_bernstein_scales {
    int degree[2];
    double single[2][PIA_MAX_DEGREE + 1], twice[2][2 * PIA_MAX_DEGREE + 1];
} pia_bernstein_scales;
void pia_bernstein_scales_of(const int degree[2], pia_bernstein_scales *out);

/* Coefficients, of twice the degrees, of the sum of the squares of components [first, last). */
void pia_bernstein_square(const pia_bernstein_scales *scales, const double *c, int width, int first, int last, double *out);

/* Value and derivatives up to second order at one place of a piece, rows by the enumerators. */
typedef double pia_bernstein_rows[6][PIA_MAX_WIDTH];
enum { PIA_S, PIA_SU, PIA_SV, PIA_SUU, PIA_SUV, PIA_SVV };
/* rational: component width - 1 is a weight, and the others come divided by it. */
void pia_bernstein_look(const double *c, const int degree[2], int width, int rational, const double at[2], pia_bernstein_rows rows);

#endif
