#include "chebyshev.h"

#include "basis.h"
#include "lanes.h"

#include <math.h>
#include <string.h>

static const double pi = 3.14159265358979323846;

void pia_chebyshev_fill(int degree, pia_chebyshev *out)
{
    int width = degree + 1;
    out->degree = degree;
    for (int i = 0; i < width; i++) {
        double angle = (i + 0.5) * pi / width;
        out->node[i] = cos(angle);
        for (int j = 0; j < width; j++) out->transform[i * width + j] = (j == 0 ? 1.0 : 2.0) / width * cos(j * angle);
    }
}

/* Where a span is short beside its parameters, its middle has digits to say of it, and parameters from the middle on have them all. */
void pia_chebyshev_span(const pia_chebyshev *c, const pia_collocation *line, pia_index s, double *middle, double *scale,
                        double *coefficient)
{
    int width = c->degree + 1;
    const double *knot = line->knots + c->degree + s;
    double half = 0.5 * (knot[1] - knot[0]), value[PIA_MAX_DEGREE + 1], near[2 * PIA_MAX_DEGREE]; /* knots from the middle on */
    *middle = knot[0] + half;
    for (int k = 0; k < 2 * c->degree; k++) near[k] = knot[k + 1 - c->degree] - *middle;
    *scale = 1 / half;
    memset(coefficient, 0, (size_t)(width * width) * sizeof *coefficient);
    for (int i = 0; i < width; i++) {
        pia_basis_values(near, c->degree, c->degree - 1, half * c->node[i], value);
        for (int k = 0; k < width; k++)
            for (int j = 0; j < width; j++) coefficient[k * width + j] += c->transform[i * width + j] * value[k];
    }
}

/* Span by span in the lanes: values at the nodes, then the transform. Lanes past the last span repeat it. */
PIA_INLINE void take_spans(const pia_chebyshev *c, const pia_collocation *line, pia_index s, int count, const double *full, int degree,
                           int dim, pia_chebyshev_curves *out)
{
    enum { WIDTH = PIA_MAX_DEGREE + 1 };
    pia_index span[PIA_LANES];
    pia_lanes knot[2 * PIA_MAX_DEGREE], inverse[PIA_MAX_DEGREE * WIDTH / 2], value[WIDTH], node[WIDTH][PIA_MAX_DIM];
    for (int l = 0; l < PIA_LANES; l++) span[l] = s + (l < count ? l : count - 1);
    pia_lanes low = pia_lanes_load(line->knots + degree, span), half = 0.5 * (pia_lanes_load(line->knots + degree + 1, span) - low);
    pia_lanes middle = low + half, scale = 1 / half;
    for (int k = 0; k < 2 * degree; k++) knot[k] = pia_lanes_load(line->knots + 1 + k, span) - middle;
    pia_lanes_inverses(knot, degree, inverse);
    pia_lanes_write(middle, out->middle);
    pia_lanes_write(scale, out->scale);
    for (int i = 0; i <= degree; i++) {
        pia_lanes_exact_basis(knot, inverse, degree, half * c->node[i], value);
        for (int d = 0; d < dim; d++) node[i][d] = value[0] * pia_lanes_component(full, span, dim, d);
        for (int k = 1; k <= degree; k++)
            for (int d = 0; d < dim; d++) node[i][d] += value[k] * pia_lanes_component(full + k * dim, span, dim, d);
    }
    for (int j = 0; j <= degree; j++)
        for (int d = 0; d < dim; d++) {
            pia_lanes sum = {0};
            for (int i = 0; i <= degree; i++) sum += c->transform[i * (degree + 1) + j] * node[i][d];
            for (int l = 0; l < PIA_LANES; l++) out->coefficient[l][j * dim + d] = sum[l];
        }
}

/* The cubic in up to three dimensions is what nearly everybody fits. */
PIA_CLONES static void take_any(const pia_chebyshev *c, const pia_collocation *line, pia_index s, int count, const double *full,
                                int degree, int dim, pia_chebyshev_curves *out)
{
    if (degree == 3 && dim == 3)
        take_spans(c, line, s, count, full, 3, 3, out);
    else if (degree == 3 && dim == 2)
        take_spans(c, line, s, count, full, 3, 2, out);
    else
        take_spans(c, line, s, count, full, degree, dim, out);
}

void pia_chebyshev_take(const pia_chebyshev *c, const pia_collocation *line, pia_index s, int count, const double *full, int dim,
                        pia_chebyshev_curves *out)
{
    take_any(c, line, s, count, full, c->degree, dim, out);
}
