#include "energy.h"

#include "basis.h"
#include "span_sums.h"

#include <math.h>
#include <string.h>

enum { MOST_NODES = PIA_MAX_DEGREE + 1 };

/* Order of the derivative in u of each term of the thin plate, that in v being what is left of 2, and its weight. */
enum { TERMS = 3 };
static const double term_weight[TERMS] = {1, 2, 1};

/* ---- integrals over spans ---- */

/* Gauss-Legendre rule of `count` nodes on [-1, 1]: roots of the Legendre polynomial by Newton, from Tricomi's estimate. */
static void gauss_rule(int count, double *node, double *weight)
{
    for (int i = 0; i < count; i++) {
        double x = cos(3.14159265358979323846 * (i + 0.75) / (count + 0.5)), slope = 1;
        for (int step = 0; step < 8; step++) {
            double before = 1, now = x;
            for (int k = 2; k <= count; k++) {
                double next = ((2 * k - 1) * x * now - (k - 1) * before) / k;
                before = now;
                now = next;
            }
            slope = count * (x * now - before) / (x * x - 1);
            x -= now / slope;
        }
        node[i] = x;
        weight[i] = 2 / ((1 - x * x) * slope * slope);
    }
}

static pia_index span_count(const pia_collocation *axis)
{
    return axis->full - axis->degree;
}

/* The shares of one span in all orders; a share is the upper triangle by rows. */
static void integrate_span(const pia_collocation *axis, pia_index s, const double *node, const double *weight, double *const share[3])
{
    int p = axis->degree, room = pia_span_room(p, 0);
    double low = axis->knots[p + s], high = axis->knots[p + s + 1], length = axis->knots[axis->full] - axis->knots[p];
    double value[3 * (PIA_MAX_DEGREE + 1)], scale = 1;
    for (int order = 0; order < 3; order++) memset(share[order] + s * room, 0, (size_t)room * sizeof(double));
    for (int i = 0; i <= p && low < high; i++) {
        pia_basis_derivatives(axis->knots, p, p + s, low + (high - low) * (1 + node[i]) / 2, 2, value);
        scale = weight[i] * (high - low) / (2 * length);
        for (int order = 0; order < 3; order++) {
            double *out = share[order] + s * room, *v = value + order * (p + 1);
            for (int k = 0; k <= p; k++)
                for (int l = k; l <= p; l++) *out++ += scale * v[k] * v[l];
            scale *= length * length;
        }
    }
}

/* The diagonal and the row sums of |entries|, copies of closed directions together. */
static void sum_lines(const pia_collocation *axis, const double *share, double *line)
{
    memset(line, 0, (size_t)axis->unknowns * 2 * sizeof *line);
    for (pia_index s = 0; s < span_count(axis); s++)
        for (int k = 0; k <= axis->degree; k++)
            for (int l = k; l <= axis->degree; l++, share++) {
                double *row = line + 2 * pia_collocation_unknown(axis, s + k),
                       *column = line + 2 * pia_collocation_unknown(axis, s + l);
                if (k == l) row[0] += *share;
                row[1] += fabs(*share);
                if (k != l) column[1] += fabs(*share);
            }
}

/* band [full x (degree + 1)]: entry (j, b) couples the full columns j and j + b. */
static void join_spans(const pia_collocation *axis, const double *share, double *band)
{
    int p = axis->degree;
    memset(band, 0, (size_t)(axis->full * (p + 1)) * sizeof *band);
    for (pia_index s = 0; s < span_count(axis); s++)
        for (int k = 0; k <= p; k++)
            for (int l = k; l <= p; l++) band[(s + k) * (p + 1) + l - k] += *share++;
}

static pia_status integrate_axis(pia_energy *e, int d)
{
    const pia_collocation *axis = e->op->axis[d];
    pia_index spans = span_count(axis);
    size_t room = (size_t)pia_span_room(axis->degree, 0) * sizeof(double);
    double node[MOST_NODES], weight[MOST_NODES];
    for (int order = 0; order < 3; order++) {
        e->share[d][order] = pia_take(e->context, spans, room);
        e->line[d][order] = pia_take(e->context, axis->unknowns, 2 * sizeof(double));
        e->band[d][order] = pia_take(e->context, axis->full, (size_t)(axis->degree + 1) * sizeof(double));
        if (e->share[d][order] == NULL || e->line[d][order] == NULL || e->band[d][order] == NULL)
            return pia_take_status(e->context, spans, room);
    }
    gauss_rule(axis->degree + 1, node, weight);
    for (pia_index s = 0; s < spans; s++) integrate_span(axis, s, node, weight, e->share[d]);
    for (int order = 0; order < 3; order++) {
        sum_lines(axis, e->share[d][order], e->line[d][order]);
        join_spans(axis, e->share[d][order], e->band[d][order]);
    }
    return PIA_OK;
}

pia_status pia_energy_open(const pia_op *op, double strength, pia_energy **out)
{
    pia_energy *e = pia_take_zero(op->context, 1, sizeof *e);
    if (e == NULL) return pia_take_status(op->context, 1, sizeof *e);
    e->context = op->context;
    e->op = op;
    e->strength = strength;
    pia_status status = PIA_OK;
    for (int d = 0; d < op->directions && status == PIA_OK; d++) status = integrate_axis(e, d);
    if (status == PIA_OK)
        *out = e;
    else
        pia_energy_close(e);
    return status;
}

void pia_energy_close(pia_energy *e)
{
    if (e == NULL) return;
    for (int k = 0; k < 6; k++) {
        pia_give(e->context, e->share[k / 3][k % 3]);
        pia_give(e->context, e->line[k / 3][k % 3]);
        pia_give(e->context, e->band[k / 3][k % 3]);
    }
    pia_give(e->context, e);
}

/* ---- matrices ---- */

/* Diagonal (which = 0) or row sum (1) of unknown c. */
static double entry(const pia_energy *e, pia_index c, int which)
{
    if (e->op->directions == 1) return e->line[0][2][2 * c + which];
    pia_index i = c / e->op->count[1], j = c % e->op->count[1];
    double sum = 0;
    for (int t = 0; t < TERMS; t++) sum += term_weight[t] * e->line[0][t][2 * i + which] * e->line[1][2 - t][2 * j + which];
    return sum;
}

double pia_energy_factor(const pia_energy *e, const double *diagonal)
{
    double data = 0, energy = 0;
    for (pia_index c = 0; c < e->op->cols; c++) {
        data += diagonal[c];
        energy += entry(e, c, 0);
    }
    return energy > 0 ? e->strength * data / energy : 0;
}

void pia_energy_add_sums(const pia_energy *e, double factor, double *sums)
{
    for (pia_index c = 0; c < e->op->cols; c++) sums[c] += factor * entry(e, c, 1);
}

void pia_energy_add_gram(const pia_energy *e, double factor, pia_gram *gram)
{
    int room = pia_span_room(gram->line->degree, 0);
    double share[(PIA_MAX_DEGREE + 1) * (PIA_MAX_DEGREE + 2) / 2];
    for (pia_index s = 0; s < span_count(gram->line); s++) {
        for (int k = 0; k < room; k++) share[k] = factor * e->share[0][2][s * room + k];
        pia_gram_add(gram, s, share);
    }
}

/* Adds one product of a matrix in u and a matrix in v, both as bands of `width + 1` entries a column. */
static void add_product(double factor, const double *u, const double *v, pia_stencil *stencil)
{
    int p = stencil->p, q = stencil->q;
    for (pia_index i = 0; i < stencil->lines; i++)
        for (int a = 0; a <= p && i + a < stencil->lines; a++) {
            double along = factor * u[i * (p + 1) + a];
            for (int b = a == 0 ? 0 : -q; b <= q; b++) {
                double *line = pia_stencil_line(stencil, i, a, b);
                pia_index from = b < 0 ? -b : 0, to = b > 0 ? stencil->columns - b : stencil->columns;
                for (pia_index j = from; j < to; j++) line[j] += along * (b < 0 ? v[(j + b) * (q + 1) - b] : v[j * (q + 1) + b]);
            }
        }
}

void pia_energy_add_stencil(const pia_energy *e, double factor, pia_stencil *stencil)
{
    for (int t = 0; t < TERMS; t++) add_product(factor * term_weight[t], e->band[0][t], e->band[1][2 - t], stencil);
}
