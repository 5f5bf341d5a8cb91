/* A surface to a tolerance. Grow: the strips of spans that deviate too much are split in one direction or the other, whichever takes
 * more of the error away for the control points it costs. Spare: whole knot lines are taken away, the cheapest first and many at a time
 * as long as that works, each time with a fit of the whole surface. */
#include "refine.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_GROWTH = 60, MAX_CYCLES = 3, MAX_MISSES = 6 };

/* A strip is split when it deviates at least this share of what the worst one does. */
static const double SHARE = 0.25;

/* ---- a surface to come back to ---- */

typedef struct saved {
    double *inside[2], *points;
    pia_index count[2], cols;
} saved;

static pia_index inside_count(const pia_fit *fit, int d)
{
    return fit->full[d] - fit->degree[d] - 1;
}

static const double *inside_of(const pia_fit *fit, int d)
{
    return fit->knots[d] + fit->degree[d] + 1;
}

static void drop(pia_fit *fit, saved *s)
{
    for (int d = 0; d < 2; d++) pia_give(fit->context, s->inside[d]);
    pia_give(fit->context, s->points);
    *s = (saved){.points = NULL};
}

static pia_status save(pia_fit *fit, saved *s)
{
    *s = (saved){.cols = fit->op->cols};
    for (int d = 0; d < 2; d++) {
        s->count[d] = inside_count(fit, d);
        s->inside[d] = pia_take(fit->context, s->count[d], sizeof(double));
        if (s->inside[d] != NULL) memcpy(s->inside[d], inside_of(fit, d), (size_t)s->count[d] * sizeof(double));
    }
    s->points = pia_take(fit->context, s->cols * fit->dim, sizeof(double));
    if (s->inside[0] == NULL || s->inside[1] == NULL || s->points == NULL) {
        drop(fit, s);
        return PIA_E_MEMORY;
    }
    memcpy(s->points, fit->iterate.points, (size_t)(s->cols * fit->dim) * sizeof(double));
    return PIA_OK;
}

static pia_status go_back(pia_fit *fit, const saved *s)
{
    pia_status status = PIA_OK;
    for (int d = 0; d < 2 && status == PIA_OK; d++) status = pia_refine_place(fit, d, s->inside[d], s->count[d]);
    if (status == PIA_OK) status = pia_fit_assemble(fit);
    if (status != PIA_OK) return status;
    memcpy(fit->iterate.points, s->points, (size_t)(s->cols * fit->dim) * sizeof(double));
    pia_iterate_measure(&fit->iterate);
    return PIA_OK;
}

/* Least squares with other knots in one direction. */
static pia_status refit(pia_fit *fit, int d, const double *inside, pia_index count)
{
    pia_status status = pia_refine_place(fit, d, inside, count);
    if (status == PIA_OK) status = pia_fit_assemble(fit);
    return status == PIA_OK ? pia_refine_solve(fit) : status;
}

/* ---- growing ---- */

typedef struct strip {
    double worst;    /* largest ratio */
    pia_index lines; /* grid: data lines; scattered: data rows */
} strip;

static double parameter_of(const pia_fit *fit, int d, pia_index row)
{
    if (fit->kind == PIA_SCATTERED) return fit->parameter[0][2 * row + d];
    return fit->parameter[d][d == 0 ? row / fit->count[1] : row % fit->count[1]];
}

static pia_index strip_at(const pia_fit *fit, int d, double t)
{
    const double *inside = inside_of(fit, d);
    pia_index low = 0, high = inside_count(fit, d);
    while (low < high) {
        pia_index middle = low + (high - low) / 2;
        if (inside[middle] <= t)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

static void look_at_strips(const pia_fit *fit, int d, strip *strips)
{
    memset(strips, 0, (size_t)(inside_count(fit, d) + 1) * sizeof *strips);
    for (pia_index row = 0; row < fit->rows; row++) {
        strip *s = &strips[strip_at(fit, d, parameter_of(fit, d, row))];
        s->worst = fmax(s->worst, pia_refine_worst(fit, row, row + 1));
        s->lines += fit->kind == PIA_SCATTERED;
    }
    for (pia_index line = 0; fit->kind != PIA_SCATTERED && line < fit->count[d]; line++)
        strips[strip_at(fit, d, fit->parameter[d][line])].lines++;
}

/* Where a strip is to be split: between two data lines of a grid, in the middle of a strip of scattered rows. */
static double split_of(const pia_fit *fit, int d, double low, double high)
{
    double middle = low + (high - low) / 2;
    if (fit->kind == PIA_SCATTERED) return middle;
    const double *t = fit->parameter[d];
    pia_index after = 0, first = 0;
    while (first < fit->count[d] && t[first] < low) first++;
    for (after = first; after < fit->count[d] && t[after] < middle;) after++;
    if (after == first) after++;
    return after < fit->count[d] && t[after] < high ? t[after - 1] + (t[after] - t[after - 1]) / 2 : middle;
}

/* Knots with one more in each strip that deviates too much. Returns how many are new. */
static pia_index split_strips(const pia_fit *fit, int d, const strip *strips, double *out, pia_index *count)
{
    const double *inside = inside_of(fit, d);
    pia_index old = inside_count(fit, d), added = 0, n = 0, least = fit->kind == PIA_SCATTERED ? 4 * (fit->degree[d] + 1) : 2;
    double low = fit->knots[d][fit->degree[d]], high = fit->knots[d][fit->full[d]], limit = 1;
    for (pia_index s = 0; s <= old; s++) limit = fmax(limit, SHARE * strips[s].worst);
    for (pia_index s = 0; s <= old; s++) {
        double left = s > 0 ? inside[s - 1] : low, right = s < old ? inside[s] : high;
        double knot = split_of(fit, d, left, right);
        if (strips[s].worst > limit && strips[s].lines >= least && knot > left && knot < right) {
            out[n++] = knot;
            added++;
        }
        if (s < old) out[n++] = right;
    }
    *count = n;
    return added;
}

static pia_status split(pia_fit *fit, int d, int *possible)
{
    pia_index old = inside_count(fit, d), count, lines = fit->kind == PIA_SCATTERED ? fit->rows : fit->count[d];
    double *inside = pia_take(fit->context, 2 * old + 1, sizeof *inside);
    strip *strips = pia_take(fit->context, old + 1, sizeof *strips);
    pia_status status = inside != NULL && strips != NULL ? PIA_OK : PIA_E_MEMORY;
    *possible = 0;
    if (status == PIA_OK) {
        look_at_strips(fit, d, strips);
        *possible = split_strips(fit, d, strips, inside, &count) > 0 && count + fit->degree[d] + 1 <= lines;
        if (*possible) status = refit(fit, d, inside, count);
    }
    pia_give(fit->context, inside);
    pia_give(fit->context, strips);
    return status;
}

/* How fast the squared error falls with the number of control points. */
static double gain_of(const pia_fit *fit, double before, pia_index controls)
{
    double after = fit->iterate.errors.sum_squares;
    return log(before / fmax(after, 1e-300)) / log((double)fit->op->cols / (double)controls);
}

static pia_status grow(pia_fit *fit, int *possible)
{
    saved start, first = {.points = NULL};
    double gain[2] = {0, 0}, before = fit->iterate.errors.sum_squares;
    pia_index controls = fit->op->cols;
    int can[2] = {0, 0};
    pia_status status = save(fit, &start);
    if (status != PIA_OK) return status;
    status = split(fit, 0, &can[0]);
    if (status == PIA_OK && can[0]) {
        gain[0] = gain_of(fit, before, controls);
        status = save(fit, &first);
        if (status == PIA_OK) status = go_back(fit, &start);
    }
    if (status == PIA_OK) status = split(fit, 1, &can[1]);
    if (status == PIA_OK && can[1]) gain[1] = gain_of(fit, before, controls);
    if (status == PIA_OK && can[0] && (!can[1] || gain[0] > gain[1])) status = go_back(fit, &first);
    *possible = can[0] || can[1];
    drop(fit, &start);
    drop(fit, &first);
    return status;
}

/* ---- sparing ---- */

/* A knot line, and what is tried with it. */
typedef struct line {
    double cost, knot;
    pia_index at; /* number of its knot among those inside */
} line;

typedef struct trial {
    line *order;         /* [count] the cheapest first */
    double *kept;        /* [count] knots of the next try */
    unsigned char *gone; /* [count] by number of the knot */
    double *failed;      /* [count] knots that were tried alone in vain */
    pia_index failures;
} trial;

static int by_cost(const void *a, const void *b)
{
    const line *p = a, *q = b;
    if (p->cost != q->cost) return p->cost < q->cost ? -1 : 1;
    return (p->knot > q->knot) - (p->knot < q->knot);
}

/* The largest cost of a knot over all lines of control points that cross it. */
static double line_cost(const pia_fit *fit, int d, const double *full, pia_index j)
{
    double points[(PIA_MAX_DEGREE + 2) * PIA_MAX_DIM], worst = 0;
    int p = fit->degree[d], dim = fit->dim;
    pia_index along = d == 0 ? fit->full[1] : 1, across = d == 0 ? 1 : fit->full[1];
    for (pia_index other = 0; other < fit->full[1 - d]; other++) {
        for (int i = 0; i < p + 2; i++)
            memcpy(points + i * dim, full + ((j - p - 1 + i) * along + other * across) * dim, (size_t)dim * sizeof(double));
        worst = fmax(worst, pia_refine_knot_cost(fit->knots[d] + j - p - 1, points, p, dim));
    }
    return worst;
}

static int has_failed(const trial *t, double knot)
{
    for (pia_index k = 0; k < t->failures; k++)
        if (t->failed[k] == knot) return 1;
    return 0;
}

/* Marks the `batch` cheapest lines that have not failed, no two of them neighbours. Returns how many. */
static pia_index choose(const pia_fit *fit, int d, pia_index batch, trial *t)
{
    const double *full = pia_op_full(fit->op, fit->iterate.points, fit->dim), *inside = inside_of(fit, d);
    pia_index count = inside_count(fit, d), going = 0;
    for (pia_index k = 0; k < count; k++) t->order[k] = (line){line_cost(fit, d, full, fit->degree[d] + 1 + k), inside[k], k};
    qsort(t->order, (size_t)count, sizeof *t->order, by_cost);
    for (pia_index k = 0; k < count; k++) t->gone[k] = 0;
    for (pia_index k = 0; k < count && going < batch; k++) {
        pia_index at = t->order[k].at;
        if ((at > 0 && t->gone[at - 1]) || (at + 1 < count && t->gone[at + 1]) || has_failed(t, t->order[k].knot)) continue;
        t->gone[at] = 1;
        going++;
    }
    return going;
}

/* The fit without the marked lines, taken back when the tolerance does not hold. */
static pia_status try_without(pia_fit *fit, int d, trial *t, int *taken)
{
    saved before;
    const double *inside = inside_of(fit, d);
    pia_index count = inside_count(fit, d), kept = 0;
    for (pia_index k = 0; k < count; k++)
        if (!t->gone[k]) t->kept[kept++] = inside[k];
    pia_status status = save(fit, &before);
    if (status != PIA_OK) return status;
    status = refit(fit, d, t->kept, kept);
    *taken = status == PIA_OK && pia_refine_reached(fit);
    if (status == PIA_OK && !*taken) status = go_back(fit, &before);
    drop(fit, &before);
    return status;
}

static pia_status spare_lines(pia_fit *fit, int d, trial *t, pia_index *spared)
{
    pia_index batch = (inside_count(fit, d) + 3) / 4, misses = 0;
    pia_status status = PIA_OK;
    t->failures = 0;
    while (status == PIA_OK && misses < MAX_MISSES && !pia_refine_stopped(fit)) {
        pia_index least = fit->closed[d] ? (fit->degree[d] > 3 ? fit->degree[d] : 3) : 0; /* a period keeps so many knots */
        pia_index going = inside_count(fit, d) > least ? choose(fit, d, batch, t) : 0;
        int taken = 0;
        if (going == 0) break;
        status = try_without(fit, d, t, &taken);
        if (taken) {
            *spared += going;
            misses = 0;
        } else if (going > 1) {
            batch = going / 2;
        } else {
            for (pia_index k = 0; k < inside_count(fit, d); k++)
                if (t->gone[k]) t->failed[t->failures++] = inside_of(fit, d)[k];
            misses++;
        }
    }
    return status;
}

static pia_status spare_direction(pia_fit *fit, int d, pia_index *spared)
{
    pia_index count = inside_count(fit, d);
    trial t = {pia_take(fit->context, count, sizeof *t.order), pia_take(fit->context, count, sizeof *t.kept),
               pia_take(fit->context, count, 1), pia_take(fit->context, count, sizeof *t.failed), 0};
    pia_status status = t.order != NULL && t.kept != NULL && t.gone != NULL && t.failed != NULL ? PIA_OK : PIA_E_MEMORY;
    if (status == PIA_OK) status = spare_lines(fit, d, &t, spared);
    pia_give(fit->context, t.order);
    pia_give(fit->context, t.kept);
    pia_give(fit->context, t.gone);
    pia_give(fit->context, t.failed);
    return status;
}

pia_status pia_refine_surface(pia_fit *fit)
{
    pia_status status = fit->round == 0 ? pia_refine_solve(fit) : PIA_OK;
    if (status == PIA_OK && fit->round == 0 && fit->solve.rules.trace_every > 0) status = pia_solve_trace(&fit->solve);
    int more = 1;
    for (int k = 0; k < MAX_GROWTH && status == PIA_OK && more && !pia_refine_reached(fit) && !pia_refine_stopped(fit); k++) {
        status = grow(fit, &more);
        if (status == PIA_OK && more) status = pia_refine_count(fit);
    }
    if (status == PIA_OK && !pia_refine_reached(fit) && !pia_refine_stopped(fit)) status = pia_refine_interpolate(fit);
    pia_index spared = status == PIA_OK && pia_refine_reached(fit);
    for (int cycle = 0; cycle < MAX_CYCLES && spared > 0 && status == PIA_OK && !pia_refine_stopped(fit); cycle++) {
        spared = 0;
        for (int d = 0; d < 2 && status == PIA_OK; d++) status = spare_direction(fit, d, &spared);
        if (status == PIA_OK) status = pia_refine_count(fit);
    }
    return status;
}
