/* Growing: every span that deviates too much is split into as many parts as the order of approximation says, several spans a round. */
#include "refine.h"

#include <math.h>
#include <string.h>

enum { MOST_PARTS = 8 };

/* Parts that a span is to be split into: the error of a degree p spline falls with the (p + 1)st power of its spans. */
static int parts_of(const pia_fit *fit, double ratio)
{
    int parts = (int)ceil(pow(ratio, 1.0 / (fit->degree[0] + 1)) - 1e-9);
    return parts < 2 ? 2 : parts > MOST_PARTS ? MOST_PARTS : parts;
}

/* New knots for the spans that deviate too much, put between data so that every part keeps rows. Returns how many were added;
 * out [count + rows] holds old and new knots of the domain, sorted. */
static pia_index split_spans(const pia_fit *fit, double *out, pia_index *count)
{
    const pia_collocation *c = &fit->line[0];
    const double *t = fit->parameter[0];
    pia_index added = 0, n = 0;
    int p = fit->degree[0];
    for (pia_index s = 0; s < c->full - p; s++) {
        pia_index begin = c->begin[s], rows = c->begin[s + 1] - begin;
        if (s > 0) out[n++] = fit->knots[0][p + s];
        double ratio = rows >= 2 ? pia_refine_worst(fit, begin, begin + rows) : 0;
        if (!(ratio > 1)) continue;
        int parts = parts_of(fit, ratio);
        if (parts > rows) parts = (int)rows;
        double last = fit->knots[0][p + s];
        for (int k = 1; k < parts; k++) {
            pia_index at = begin + rows * k / parts;
            double knot = t[at - 1] + (t[at] - t[at - 1]) / 2;
            if (!(knot > last) || !(knot < fit->knots[0][p + s + 1])) continue;
            out[n++] = last = knot;
            added++;
        }
    }
    *count = n;
    return added;
}

pia_status pia_refine_grow(pia_fit *fit, int *grown)
{
    pia_index count;
    double *inside = pia_take(fit->context, fit->full[0] + fit->rows, sizeof *inside);
    if (inside == NULL) return PIA_E_MEMORY;
    pia_index added = split_spans(fit, inside, &count);
    *grown = added > 0 && (fit->closed[0] ? count + 1 : count + fit->degree[0] + 1) <= fit->rows;
    pia_status status = *grown ? pia_refine_place(fit, 0, inside, count) : PIA_OK;
    pia_give(fit->context, inside);
    if (status == PIA_OK && *grown) status = pia_fit_assemble(fit);
    return status == PIA_OK && *grown ? pia_refine_solve(fit) : status;
}

/* The parameters as placements take them: those of a closed direction in [0, 1), rising. */
static void unit_parameters(const pia_fit *fit, int d, double *t)
{
    pia_index m = fit->count[d], by = 0;
    memcpy(t, fit->parameter[d], (size_t)m * sizeof *t);
    if (!fit->closed[d]) return;
    double base = floor(t[0]);
    while (by < m && fit->parameter[d][by] < base + 1) by++;
    for (pia_index i = 0; i < m; i++) {
        pia_index from = (by + i) % m;
        t[i] = fit->parameter[d][from] - base - (from >= by ? 1 : 0);
    }
}

static pia_status place_on_data(pia_fit *fit, int d)
{
    int p = fit->degree[d];
    pia_index lines = fit->count[d], full = lines + (fit->closed[d] ? p : 0);
    double *knots = pia_take(fit->context, full + p + 1, sizeof *knots), *t = pia_take(fit->context, lines, sizeof *t);
    pia_status status = knots != NULL && t != NULL ? PIA_OK : PIA_E_MEMORY;
    if (status == PIA_OK) {
        unit_parameters(fit, d, t);
        pia_place_problem problem = {p, fit->closed[d], lines, t, lines};
        status = pia_place_find("average")->place(fit->context, &problem, knots);
    }
    pia_give(fit->context, t);
    if (status != PIA_OK) {
        pia_give(fit->context, knots);
        return status;
    }
    pia_give(fit->context, fit->knots[d]);
    fit->knots[d] = knots;
    fit->full[d] = full;
    return fit->closed[d] ? pia_fit_turn(fit, d) : PIA_OK;
}

static int can_interpolate(const pia_fit *fit)
{
    if (fit->kind == PIA_SCATTERED || fit->has_holes) return 0;
    for (int d = 0; d < fit->directions; d++) {
        if (fit->count[d] <= fit->degree[d]) return 0;
        for (pia_index i = 1; i < fit->count[d]; i++)
            if (!(fit->parameter[d][i] > fit->parameter[d][i - 1])) return 0;
    }
    return 1;
}

pia_status pia_refine_interpolate(pia_fit *fit)
{
    pia_status status = PIA_OK;
    if (!can_interpolate(fit)) return PIA_OK;
    for (int d = 0; d < fit->directions && status == PIA_OK; d++) status = place_on_data(fit, d);
    if (status == PIA_OK) status = pia_fit_assemble(fit);
    return status == PIA_OK ? pia_refine_solve(fit) : status;
}
