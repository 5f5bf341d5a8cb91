#include "basis.h"
#include "interval.h"
#include "param.h"

enum { KNOT_ROOM = 3 * (PIA_MAX_DEGREE + 1) };

/* Knot j of uniform clamped knots with count control points, in units of one span. */
static double knot(pia_index j, int degree, pia_index count)
{
    pia_index spans = count - degree;
    return j <= degree ? 0 : j >= count ? (double)spans : (double)(j - degree);
}

/* The knots around basis function i, which becomes function number `degree` of them. */
static void knots_near(pia_index i, int degree, pia_index count, double *near)
{
    for (int k = 0; k < KNOT_ROOM; k++) {
        pia_index j = i - degree + k;
        near[k] = knot(j < 0 ? 0 : j, degree, count);
    }
}

static double slope(const double *near, int degree, double t)
{
    double derivative[2 * (PIA_MAX_DEGREE + 1)];
    int span = degree;
    while (span < 2 * degree && !(t < near[span + 1])) span++;
    pia_basis_derivatives(near, degree, span, t, 1, derivative);
    return derivative[degree + 1 + 2 * degree - span];
}

/* The maximum of basis function i, which rises and falls once: bisection on its slope. */
static double peak(pia_index i, int degree, pia_index count)
{
    double near[KNOT_ROOM];
    knots_near(i, degree, count, near);
    double low = near[degree], high = near[2 * degree + 1];
    for (int k = 0; k < 60; k++) {
        double middle = low + (high - low) / 2;
        if (slope(near, degree, middle) > 0)
            low = middle;
        else
            high = middle;
    }
    return low + (high - low) / 2;
}

/* Functions away from the ends are symmetric, those near the right end mirror those near the left one. */
static double maximum(pia_index i, int degree, pia_index count)
{
    if (2 * i > count - 1) return (double)(count - degree) - maximum(count - 1 - i, degree, count);
    if (i == 0) return 0;
    int symmetric = (i >= degree && i + degree < count) || 2 * i == count - 1;
    if (symmetric) return (knot(i, degree, count) + knot(i + degree + 1, degree, count)) / 2;
    return peak(i, degree, count);
}

static pia_status compute(pia_context *context, const double *points, pia_index count, int dim, int degree, int closed,
                          double *parameters)
{
    if (degree > count - 1) degree = (int)(count - 1);
    double end = (double)(count - degree);
    for (pia_index i = 0; i < count; i++) parameters[i] = closed ? (double)i / (double)count : maximum(i, degree, count) / end;
    return pia_interval_check_distinct(context, points, count, dim);
}

const pia_parametrization pia_param_universal = {
    .name = "universal",
    .title = "universal: where the basis functions of uniform knots are largest",
    .reference = "lim1999",
    .detail = "depends on the number of points and the degree only; affinely invariant; closed curves: uniform",
    .compute = compute,
};
