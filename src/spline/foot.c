#include "foot.h"

#include <math.h>
#include <string.h>

enum { BUDGET = 1 << 17 };

static double dot(const double *a, const double *b, int dim)
{
    double sum = 0;
    for (int c = 0; c < dim; c++) sum += a[c] * b[c];
    return sum;
}

/* Numerator |w C - w Q|^2, denominator w^2. */
static void expand(pia_minimum *minimum, const pia_cell *cell)
{
    pia_foot *f = minimum->user;
    const pia_model *m = f->pieces->bezier;
    int width = pia_model_width(m);
    memcpy(f->cell, f->piece, (size_t)((m->degree[0] + 1) * (m->degree[1] + 1) * width) * sizeof *f->cell);
    for (int d = 0; d < m->directions; d++) pia_bernstein_restrict(f->cell, m->degree, width, d, cell->low[d], cell->high[d]);
    pia_bernstein_square(&f->scales, f->cell, width, 0, m->dim, minimum->numerator);
    if (m->rational) pia_bernstein_square(&f->scales, f->cell, width, m->dim, width, minimum->denominator);
}

/* Without the second derivatives of the point (Gauss-Newton), the bends are never negative. */
static void look(const pia_minimum *minimum, const double at[2], pia_look *out)
{
    const pia_foot *f = minimum->user;
    const pia_model *m = f->pieces->bezier;
    pia_bernstein_rows r;
    pia_bernstein_look(f->piece, m->degree, pia_model_width(m), m->rational, at, r);
    out->at[0] = at[0];
    out->at[1] = at[1];
    out->value = dot(r[PIA_S], r[PIA_S], m->dim);
    for (int d = 0; d < 2; d++) {
        out->slope[d] = 2 * dot(r[PIA_S], r[PIA_SU + d], m->dim);
        out->safe[d] = 2 * dot(r[PIA_SU + d], r[PIA_SU + d], m->dim);
    }
    out->hessian[0] = out->safe[0] + 2 * dot(r[PIA_S], r[PIA_SUU], m->dim);
    out->hessian[1] = 2 * (dot(r[PIA_SU], r[PIA_SV], m->dim) + dot(r[PIA_S], r[PIA_SUV], m->dim));
    out->hessian[2] = out->safe[1] + 2 * dot(r[PIA_S], r[PIA_SVV], m->dim);
}

void pia_foot_open(const pia_pieces *pieces, pia_foot *foot)
{
    const pia_model *m = pieces->bezier;
    foot->pieces = pieces;
    pia_bernstein_scales_of(m->degree, &foot->scales);
    foot->minimum.directions = m->directions;
    foot->minimum.rational = m->rational;
    foot->minimum.relative = 1e-12;
    foot->minimum.absolute = 0;
    foot->minimum.user = foot;
    foot->minimum.expand = expand;
    foot->minimum.look = look;
    for (int d = 0; d < 2; d++) foot->minimum.degree[d] = 2 * m->degree[d];
}

void pia_foot_start(pia_foot *foot, const double *point, double scale)
{
    foot->point = point;
    foot->scale = scale > 0 ? scale : 1;
    foot->parameter[0] = foot->parameter[1] = 0;
    foot->minimum.value = INFINITY;
    foot->minimum.budget = BUDGET;
}

/* Weights are taken over the largest, which changes no quotient. */
static void load(pia_foot *f, const pia_index piece[2])
{
    const pia_model *m = f->pieces->bezier;
    int width = pia_model_width(m), count = (m->degree[0] + 1) * (m->degree[1] + 1);
    pia_piece_control(f->pieces, piece, f->piece);
    double heaviest = m->rational ? 0 : 1;
    for (int i = 0; m->rational && i < count; i++) heaviest = fmax(heaviest, f->piece[i * width + m->dim]);
    for (int i = 0; i < count; i++) {
        double *p = f->piece + i * width, w = m->rational ? p[m->dim] / heaviest : 1;
        for (int c = 0; c < m->dim; c++) p[c] = (p[c] / heaviest - w * f->point[c]) / f->scale;
        if (m->rational) p[m->dim] = w;
    }
}

void pia_foot_search(pia_foot *foot, const pia_index piece[2])
{
    load(foot, piece);
    pia_minimum_find(&foot->minimum);
    for (int d = 0; foot->minimum.found && d < foot->minimum.directions; d++) {
        double low, high, at = foot->minimum.at[d];
        pia_piece_interval(foot->pieces, piece[d], d, &low, &high);
        foot->parameter[d] = (1 - at) * low + at * high;
    }
}
