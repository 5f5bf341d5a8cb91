/* What a curve that keeps its tolerance at the points does between them: nothing asks it to stay near the straight line there, and
 * where points are far apart beside the curve's own spans it may swing out. Looked at where a gap takes a good part of a span. */
#include "fit.h"

#include "basis.h"
#include "draft.h"
#include "knots.h"

#include <math.h>
#include <string.h>

/* Parts of a span that a gap has to be longer than; how many times the tolerance is worth a note. */
enum { PARTS = 16, WORTH = 3 };

/* A gap that is longer than so many of the longer one beside it bends as if it were shorter: what the points there say of their bend,
 * they say of a piece of their own length. */
static const double FAR = 4;

/* A change of direction by so much of the speed is a corner and says nothing of a bend: 89 degrees. */
static const double CORNER = 1.4;

static double after(const pia_fit *fit, pia_index row)
{
    return row + 1 < fit->rows ? fit->parameter[0][row + 1] : fit->parameter[0][0] + 1;
}

/* Row numbers of a closed curve go round. Returns 0 where there is no such row. */
static int is_row(const pia_fit *fit, pia_index *row)
{
    if (fit->closed[0]) *row = (*row % fit->rows + fit->rows) % fit->rows;
    return *row >= 0 && *row < fit->rows;
}

/* Width of the gap behind a row; 0 where there is none. */
static double width_of(const pia_fit *fit, pia_index row)
{
    if (!is_row(fit, &row) || (!fit->closed[0] && row + 1 == fit->rows)) return 0;
    return after(fit, row) - fit->parameter[0][row];
}

/* How fast the direction of the polygon of the points turns at a row: the change of its velocity over the parameter; -1: unknown. */
static double turn_at(const pia_fit *fit, pia_index row)
{
    double square = 0, before = width_of(fit, row - 1), behind = width_of(fit, row);
    pia_index last = row - 1, next = row + 1;
    if (!(before > 0) || !(behind > 0)) return -1;
    if (!is_row(fit, &row) || !is_row(fit, &last) || !is_row(fit, &next)) return -1;
    const double *a = fit->points + last * fit->dim, *b = fit->points + row * fit->dim, *c = fit->points + next * fit->dim;
    double speed[2] = {0, 0};
    for (int d = 0; d < fit->dim; d++) {
        double in = (b[d] - a[d]) / before, out = (c[d] - b[d]) / behind;
        square += (out - in) * (out - in);
        speed[0] += in * in;
        speed[1] += out * out;
    }
    if (!fit->function_graph && square > CORNER * CORNER * fmax(speed[0], speed[1])) return 0;
    return 2 * sqrt(square) / (before + behind);
}

/* Twice the height of the arc that the points around the gap speak of. The second smallest of their turns: one that is alone is a
 * corner, and at an inflection one may vanish. */
static double bend_of(const pia_fit *fit, pia_index row)
{
    double turn[4], width = width_of(fit, row), beside = fmax(width_of(fit, row - 1), width_of(fit, row + 1));
    int count = 0;
    for (int k = -1; k <= 2; k++) {
        double value = turn_at(fit, row + k);
        int at = count;
        if (value < 0) continue;
        for (; at > 0 && turn[at - 1] > value; at--) turn[at] = turn[at - 1];
        turn[at] = value;
        count++;
    }
    return count == 0 ? 0 : turn[count > 2] * width * fmin(width, FAR * beside) / 4;
}

static double allowed_at(const pia_fit *fit, pia_index row)
{
    if (fit->weights != NULL && fit->weights[row] == 0) return INFINITY;
    return fit->tolerances != NULL ? fit->tolerances[row] : fit->options.tolerance;
}

double pia_fit_swing(const pia_fit *fit, pia_index row, double factor)
{
    pia_index next = row + 1;
    if (!is_row(fit, &next)) return INFINITY;
    return factor * fmin(allowed_at(fit, row), allowed_at(fit, next)) + bend_of(fit, row);
}

/* The farthest of the places within one span, from low to high of the parameter of the rows. */
static double farthest_in(const pia_fit *fit, const double *full, pia_index span, double low, double high, double shift,
                          const double *a, const double *b)
{
    double basis[PIA_MAX_DEGREE + 1], value[PIA_MAX_DIM], worst = 0;
    int p = fit->degree[0], dim = fit->dim;
    for (int k = 1; k <= PIA_DRAFT_PLACES; k++) {
        pia_basis_values(fit->knots[0], p, span, low + (high - low) * k / (PIA_DRAFT_PLACES + 1) - shift, basis);
        for (int d = 0; d < dim; d++) {
            value[d] = fit->origin[d];
            for (int i = 0; i <= p; i++) value[d] += basis[i] * full[(span - p + i) * dim + d];
        }
        worst = fmax(worst, pia_draft_distance(value, a, b, dim));
    }
    return worst;
}

static double farthest(const pia_fit *fit, const double *full, pia_index row, pia_index span)
{
    const double *knots = fit->knots[0];
    pia_index next = row + 1 < fit->rows ? row + 1 : 0, count = fit->full[0];
    double from = fit->parameter[0][row], to = after(fit, row), worst = 0;
    for (double low = from, high; low < to; low = high) {
        double shift = fit->closed[0] && low >= knots[count] ? 1 : 0;
        span = pia_knots_span_near(knots, fit->degree[0], count, low - shift, span);
        while (span + 1 < count && !(knots[span + 1] + shift > low)) span++;
        high = span + 1 < count || fit->closed[0] ? fmin(to, knots[span + 1] + shift) : to;
        if (!(high > low)) break;
        worst =
            fmax(worst, farthest_in(fit, full, span, low, high, shift, fit->points + row * fit->dim, fit->points + next * fit->dim));
    }
    return worst;
}

double pia_fit_excursion(const pia_fit *fit, const double *full, pia_index row, pia_index *span)
{
    const double *knots = fit->knots[0];
    *span = pia_collocation_advance(&fit->line[0], row, *span);
    double width = width_of(fit, row);
    return PARTS * width > knots[*span + 1] - knots[*span] && width > 0 ? farthest(fit, full, row, *span) : -1;
}

/* Of those that swing out more than the bend of their points explains, the gap that does so most. */
static void note(pia_fit *fit, pia_index gap, double excursion)
{
    pia_index row = fit->row != NULL ? fit->row[gap] : gap;
    pia_note_add(
        pia_memory_of(fit->context), &fit->outcome,
        "between the points, behind row %lld, the curve is up to %g away from the straight line, %.3g times the tolerance, which "
        "holds at the points; the option between, more points there, corners or a lower degree keep it closer",
        (long long)row, excursion, excursion / fit->options.tolerance);
}

void pia_fit_look_between(pia_fit *fit)
{
    pia_index span = fit->degree[0], gap = -1;
    double most = 0, excursion = 0;
    fit->between_error = NAN;
    if (!fit->refining || fit->directions != 1) return;
    const double *full = pia_op_full(fit->op, fit->iterate.points, fit->dim);
    fit->between_error = 0;
    for (pia_index row = 0; row < fit->rows; row++) {
        double far = pia_fit_excursion(fit, full, row, &span);
        fit->between_error = fmax(fit->between_error, far);
        if (!(far > WORTH * fit->options.tolerance)) continue;
        double beyond = far - pia_fit_swing(fit, row, WORTH);
        if (!(beyond > most)) continue;
        most = beyond;
        gap = row;
        excursion = far;
    }
    if (gap >= 0) note(fit, gap, excursion);
}
