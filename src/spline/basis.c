#include "basis.h"

#include <string.h>

/* From the functions of degree d-1 to those of degree d at t, in place. Inside the span every term is a product of non-negative
 * factors, so high degrees keep their relative accuracy, and a span that is not empty has no zero divisor. The quotients come first: at
 * a knot they are exactly 0 and 1, and ends and inserted knots are met to the last bit. */
static inline void raise(const double *knots, pia_index span, int d, double t, double *values)
{
    double carried = 0;
    for (int r = 0; r < d; r++) {
        double right = knots[span + 1 + r], left = knots[span + 1 + r - d];
        double value = values[r];
        values[r] = carried + value * ((right - t) / (right - left));
        carried = value * ((t - left) / (right - left));
    }
    values[d] = carried;
}

void pia_basis_values(const double *knots, int degree, pia_index span, double t, double *values)
{
    values[0] = 1;
    for (int d = 1; d <= degree; d++) raise(knots, span, d, t, values);
}

void pia_basis_blossom(const double *knots, int degree, pia_index span, const double *arguments, double *values)
{
    values[0] = 1;
    for (int d = 1; d <= degree; d++) raise(knots, span, d, arguments[d - 1], values);
}

/* The derivative of a function of degree d is the difference of its two neighbours of degree d-1, each over its support. */
static void differentiate(const double *knots, pia_index span, int d, double *values)
{
    double carried = 0;
    for (int r = 0; r < d; r++) {
        double part = d * values[r] / (knots[span + 1 + r] - knots[span + 1 + r - d]);
        values[r] = carried - part;
        carried = part;
    }
    values[d] = carried;
}

void pia_basis_derivatives(const double *knots, int degree, pia_index span, double t, int count, double *out)
{
    int width = degree + 1;
    int last = count < degree ? count : degree;
    memset(out, 0, (size_t)(count + 1) * (size_t)width * sizeof *out);
    double value[PIA_MAX_DEGREE + 1] = {1}; /* the functions of degree d */
    for (int d = 0; d <= degree; d++) {
        if (d > 0) raise(knots, span, d, t, value);
        int order = degree - d;
        if (order > last) continue;
        double *row = out + (size_t)order * (size_t)width;
        memcpy(row, value, (size_t)(d + 1) * sizeof *row);
        for (int e = d + 1; e <= degree; e++) differentiate(knots, span, e, row);
    }
}
