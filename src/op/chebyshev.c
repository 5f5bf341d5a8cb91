#include "chebyshev.h"

#include "basis.h"

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
