/* Sparing: knots are taken away, the cheapest first, each trial fitting a window anew towards the smallest largest deviation; then
 * pairs of knots are merged into one. A long curve is cut into segments that are thinned out side by side, the control points at the
 * cuts staying where they are; the next pass cuts elsewhere. The cuts depend on the number of control points alone. */
#include "constraint.h"
#include "kernel.h"
#include "refine.h"
#include "window.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { REACH = 2, LAWSON_ROUNDS = 6, MAX_SWEEPS = 40, MAX_PASSES = 12, HOLD_PASSES = 4, SEGMENT = 96, BATCH = 16 };

typedef struct candidate {
    double cost, knot;
} candidate;

static int compare_costs(const void *a, const void *b)
{
    const candidate *p = a, *q = b;
    if (p->cost != q->cost) return p->cost < q->cost ? -1 : 1;
    return (p->knot > q->knot) - (p->knot < q->knot);
}

static double knot_cost(const pia_draft *draft, pia_index j)
{
    double knots[2 * PIA_MAX_DEGREE + 3], points[(PIA_MAX_DEGREE + 2) * PIA_MAX_DIM];
    int p = draft->degree, dim = draft->dim;
    for (int i = 0; i < 2 * p + 3; i++) knots[i] = pia_draft_knot(draft, j - p - 1 + i);
    for (int i = 0; i < p + 2; i++) memcpy(points + i * dim, pia_draft_point(draft, j - p - 1 + i), (size_t)dim * sizeof(double));
    return pia_refine_knot_cost(knots, points, p, dim);
}

/* Tries to do with one knot instead of two, nearer to the one that does more. */
static int merge_knots(pia_draft *draft, pia_index j)
{
    pia_index first, end;
    pia_draft_inside(draft, &first, &end);
    if (j + 1 >= end && !draft->cyclic) return 0;
    if (draft->mark[(j + 1) % draft->count] & PIA_DRAFT_KEPT) return 0;
    double here = pia_draft_knot(draft, j), next = pia_draft_knot(draft, j + 1);
    double left = knot_cost(draft, j), right = knot_cost(draft, j + 1), share = left + right > 0 ? right / (left + right) : 0.5;
    double knot = here + fmin(fmax(share, 0.25), 0.75) * (next - here);
    return pia_draft_replace(draft, j, 2, &knot, 1, REACH, LAWSON_ROUNDS);
}

/* One sweep over all inside knots, the cheapest first. order has room for all knots. Returns how many knots went. */
static pia_index sweep(pia_draft *draft, int merge, candidate *order)
{
    pia_index first, end, taken = 0;
    pia_draft_inside(draft, &first, &end);
    unsigned char mark = merge ? PIA_DRAFT_MERGED : PIA_DRAFT_SPARED;
    pia_index count = 0;
    for (pia_index j = first; j < end; j++)
        if ((draft->mark[j] & (mark | PIA_DRAFT_KEPT)) == 0)
            order[count++] = (candidate){knot_cost(draft, j), pia_draft_knot(draft, j)};
    qsort(order, (size_t)count, sizeof *order, compare_costs);
    for (pia_index k = 0; k < count; k++) {
        pia_index j = pia_draft_find(draft, order[k].knot);
        if (j < 0) continue;
        draft->mark[j] |= mark;
        taken += merge ? merge_knots(draft, j) : pia_draft_replace(draft, j, 1, NULL, 0, REACH, LAWSON_ROUNDS);
    }
    return taken;
}

/* ---- segments ---- */

/* The whole curve, and a pass over it in segments that begin at control points cut[0], cut[1], ... */
typedef struct pass {
    pia_draft_data data;
    int degree, dim, closed, pinned;
    pia_index count;         /* control points */
    double *knots;           /* open: [count + degree + 1]; closed: one period [count] */
    double *control;         /* [count x dim] */
    unsigned char *mark;     /* as knots */
    unsigned char *critical; /* [rows] as in a draft; segments see different rows */
    pia_draft_condition *condition;
    double *condition_values;
    double *wanted;            /* [rows] see pia_refine_find_gaps */
    int hold;                  /* 1: this pass adds knots where the curve swings out, else it takes knots away */
    pia_index segments, batch; /* segments of this pass; the first of those at work */
    pia_index offset;          /* closed: control point at which the first segment begins */
    pia_draft *draft;          /* [segments] */
    candidate *order;          /* [count + segments (degree + 1)] */
    double inverse_axis[PIA_MAX_DIM];
    double *work; /* [BATCH x room] */
    pia_index room;
} pass;

static int is_cyclic(const pass *s)
{
    return s->closed && s->count <= PIA_WINDOW_SHORT;
}

/* Open curves: every second pass is shifted by half a segment, which makes one more. */
static pia_index cut(const pass *s, pia_index segment, int shifted)
{
    if (segment == 0) return 0;
    if (segment == s->segments) return s->count;
    pia_index whole = shifted && !s->closed ? s->segments - 1 : s->segments;
    return s->count * (2 * segment - (whole < s->segments)) / (2 * whole);
}

static double knot_of(const pass *s, pia_index i)
{
    if (!s->closed) return s->knots[i];
    pia_index n = s->count, period = i >= 0 ? i / n : -((n - 1 - i) / n);
    return s->knots[i - period * n] + (double)period;
}

/* Control points that a segment has room for beside those it has. */
static pia_index extra(const pass *s)
{
    return s->hold ? 2 * SEGMENT : 0;
}

/* Copies of the segments, one behind the other in store: knots, control points, marks. */
static void cut_out(pass *s, int shifted, double *store, unsigned char *marks)
{
    int p = s->degree, dim = s->dim;
    for (pia_index k = 0; k < s->segments; k++) {
        pia_index begin = cut(s, k, shifted), count = cut(s, k + 1, shifted) - begin, knots = count + (is_cyclic(s) ? 0 : p + 1);
        pia_draft *d = &s->draft[k];
        *d = (pia_draft){.data = &s->data, .degree = p, .dim = dim, .cyclic = is_cyclic(s), .count = count, .room = count + extra(s)};
        d->stays[0] = s->closed || k > 0 ? p : s->pinned;
        d->stays[1] = s->closed || k + 1 < s->segments ? p : s->pinned;
        d->knots = store;
        d->control = store + knots + extra(s);
        d->mark = marks;
        d->critical = s->critical;
        store += knots + count * dim + extra(s) * (dim + 1);
        marks += knots + extra(s);
        for (pia_index i = 0; i < knots; i++) d->knots[i] = knot_of(s, s->offset + begin + i);
        for (pia_index i = 0; i < knots; i++) d->mark[i] = s->mark[s->closed ? (s->offset + begin + i) % s->count : begin + i];
        for (pia_index i = 0; i < count; i++) {
            pia_index at = s->closed ? (s->offset + begin + i) % s->count : begin + i;
            memcpy(d->control + i * dim, s->control + at * dim, (size_t)dim * sizeof(double));
        }
    }
}

/* Room for as many control points as the segments have. */
static pia_status make_room(pia_context *context, pass *s)
{
    pia_index count = 0, knots;
    for (pia_index k = 0; k < s->segments; k++) count += s->draft[k].count;
    if (count <= s->count) return PIA_OK;
    knots = count + s->degree + 1;
    pia_give(context, s->knots);
    pia_give(context, s->control);
    pia_give(context, s->mark);
    s->knots = pia_take(context, knots, sizeof(double));
    s->control = pia_take(context, count * s->dim, sizeof(double));
    s->mark = pia_take(context, knots, 1);
    return s->knots != NULL && s->control != NULL && s->mark != NULL ? PIA_OK : PIA_E_MEMORY;
}

/* The curve from its segments. Returns by how many control points it changed. */
static pia_index put_back(pass *s)
{
    pia_index before = s->count, n = 0;
    int p = s->degree;
    for (pia_index k = 0; k < s->segments; k++) {
        const pia_draft *d = &s->draft[k];
        pia_index knots = d->count + (k + 1 == s->segments && !s->closed ? p + 1 : 0);
        memcpy(s->knots + n, d->knots, (size_t)knots * sizeof(double));
        memcpy(s->mark + n, d->mark, (size_t)knots);
        memcpy(s->control + n * s->dim, d->control, (size_t)(d->count * s->dim) * sizeof(double));
        n += d->count;
    }
    s->count = n;
    double base = s->closed ? floor(s->knots[0]) : 0;
    for (pia_index i = 0; i < n && base != 0; i++) s->knots[i] -= base;
    return before > n ? before - n : n - before;
}

static void hold_segment(void *work, pia_index chunk)
{
    pass *s = work;
    pia_draft *draft = &s->draft[s->batch + chunk];
    draft->work = s->work + chunk * s->room;
    pia_refine_hold(draft, s->wanted);
}

static void thin_out(void *work, pia_index chunk)
{
    pass *s = work;
    pia_index segment = s->batch + chunk;
    pia_draft *draft = &s->draft[segment];
    candidate *order = s->order + (draft->mark - s->draft[0].mark);
    draft->work = s->work + chunk * s->room;
    pia_index taken = 1;
    for (int k = 0; k < MAX_SWEEPS && taken > 0; k++) {
        taken = sweep(draft, 0, order);
        if (taken == 0) taken = sweep(draft, 1, order);
    }
}

/* One pass; *changed knots went, or came. */
static pia_status run_pass(pia_fit *fit, pass *s, int shifted, pia_index *changed)
{
    pia_context *context = fit->context;
    pia_index whole = s->count / SEGMENT;
    s->segments = whole > 1 ? whole + (shifted && !s->closed) : 1;
    s->offset = s->closed && shifted && !is_cyclic(s) ? s->count / (2 * s->segments) : 0;
    pia_index knots = s->count + s->segments * (s->degree + 1 + extra(s));
    pia_index values = knots + (s->count + s->segments * extra(s)) * s->dim;
    s->draft = pia_take(context, s->segments, sizeof *s->draft);
    s->order = pia_take(context, knots, sizeof *s->order);
    s->work = pia_take(context, BATCH * s->room, sizeof *s->work);
    double *store = pia_take(context, values, sizeof *store);
    unsigned char *marks = pia_take(context, knots, 1);
    *changed = 0;
    pia_status status =
        s->draft != NULL && s->order != NULL && s->work != NULL && store != NULL && marks != NULL ? PIA_OK : PIA_E_MEMORY;
    if (status == PIA_OK) {
        cut_out(s, shifted, store, marks);
        for (s->batch = 0; s->batch < s->segments && !pia_refine_stopped(fit); s->batch += BATCH)
            pia_for_each(context, s->segments - s->batch < BATCH ? s->segments - s->batch : BATCH, s->hold ? hold_segment : thin_out,
                         s);
        status = make_room(context, s);
    }
    if (status == PIA_OK) *changed = put_back(s);
    pia_give(context, s->draft);
    pia_give(context, s->order);
    pia_give(context, s->work);
    pia_give(context, store);
    pia_give(context, marks);
    return status;
}

/* A pass works on copies; the fit takes them over when all is done. */
static pia_status open_pass(pia_fit *fit, pass *s)
{
    pia_context *context = fit->context;
    pia_index count = fit->op->cols, knots = count + fit->degree[0] + 1;
    *s = (pass){.degree = fit->degree[0], .dim = fit->dim, .closed = fit->closed[0], .pinned = fit->pinned, .count = count};
    s->data = (pia_draft_data){.parameters = fit->parameter[0],
                               .points = fit->points,
                               .origin = fit->origin,
                               .inverse_tolerance = fit->inverse_tolerance,
                               .inverse_one = 1 / fit->options.tolerance,
                               .rows = fit->rows,
                               .periodic = fit->closed[0]};
    if (fit->axis_tolerances != NULL) s->data.inverse_axis = s->inverse_axis;
    for (int d = 0; fit->axis_tolerances != NULL && d < fit->dim; d++) s->inverse_axis[d] = 1 / fit->axis_tolerances[d];
    s->room = pia_draft_room(s->degree, s->dim, PIA_HOLD_REACH);
    s->knots = pia_take(context, knots, sizeof(double));
    s->control = pia_take(context, count * s->dim, sizeof(double));
    s->mark = pia_take_zero(context, knots, 1);
    s->critical = pia_take_zero(context, fit->rows, 1);
    if (s->knots == NULL || s->control == NULL || s->mark == NULL || s->critical == NULL) return PIA_E_MEMORY;
    pia_status status = pia_refine_conditions(fit, &s->condition, &s->data.condition_count, &s->condition_values);
    if (status == PIA_OK) status = pia_refine_find_gaps(fit, &s->data, &s->wanted);
    if (status != PIA_OK) return status;
    s->data.condition = s->condition;
    memcpy(s->knots, fit->knots[0], (size_t)knots * sizeof(double));
    for (pia_index j = 1; j < knots; j++)
        if (s->knots[j] == s->knots[j - 1]) s->mark[j] = s->mark[j - 1] = PIA_DRAFT_KEPT; /* corners */
    memcpy(s->control, fit->iterate.points, (size_t)(count * s->dim) * sizeof(double));
    return PIA_OK;
}

static int swings_out(const pia_fit *fit, const pass *s)
{
    for (pia_index row = 0; row < fit->rows && s->wanted != NULL; row++)
        if (s->data.swing[row] > s->wanted[row]) return 1;
    return 0;
}

/* Passes that hold the curve between rows. */
static pia_status hold(pia_fit *fit, pass *s, pia_index *added)
{
    pia_index idle = 0, changed;
    pia_status status = PIA_OK;
    s->hold = 1;
    *added = 0;
    for (int k = 0; k < HOLD_PASSES && idle < 2 && status == PIA_OK && swings_out(fit, s) && !pia_refine_stopped(fit); k++) {
        status = run_pass(fit, s, k % 2, &changed);
        *added += changed;
        idle = changed > 0 ? 0 : idle + 1;
    }
    s->hold = 0;
    return status;
}

pia_status pia_refine_spare(pia_fit *fit, pia_index *spared)
{
    pass s;
    pia_index taken = 1, idle = 0;
    *spared = 0;
    pia_status status = open_pass(fit, &s);
    if (status == PIA_OK) status = hold(fit, &s, spared);
    for (int k = 0; k < MAX_PASSES && idle < 2 && status == PIA_OK && !pia_refine_stopped(fit); k++) {
        status = run_pass(fit, &s, k % 2, &taken);
        *spared += taken;
        idle = taken > 0 ? 0 : s.segments == 1 && !s.closed ? 2 : idle + 1;
    }
    if (status == PIA_OK && *spared > 0) {
        status = pia_refine_install(fit, s.knots, s.count);
        if (status == PIA_OK) memcpy(fit->iterate.points, s.control, (size_t)(s.count * s.dim) * sizeof(double));
        if (status == PIA_OK) status = pia_fit_bind(fit);
        if (status == PIA_OK && fit->iterate.constraints != NULL) pia_constraints_finish(fit->iterate.constraints, fit->iterate.points);
        if (status == PIA_OK) pia_iterate_measure(&fit->iterate);
    }
    pia_refine_drop_gaps(fit, &s.data, &s.wanted);
    pia_give(fit->context, s.condition);
    pia_give(fit->context, s.condition_values);
    pia_give(fit->context, s.knots);
    pia_give(fit->context, s.control);
    pia_give(fit->context, s.mark);
    pia_give(fit->context, s.critical);
    return status;
}
