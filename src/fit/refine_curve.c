/* A curve to a tolerance. Grow: least squares, then every span that deviates too much is split into as many parts as the order of
 * approximation says, several spans a round. Spare: knots are taken away, the cheapest first and no two neighbours in a sweep, each
 * trial fitting a window anew towards the smallest largest deviation; then pairs of knots are merged into one. Correct: where true
 * distances count, parameters move to the foot points, which leaves room to spare more. */
#include "refine.h"

#include "draft.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { REACH = 4, LAWSON_ROUNDS = 12, MAX_GROWTH = 60, MAX_SWEEPS = 40, CORRECTIONS = 6, NEWTON_STEPS = 3, MOST_PARTS = 8 };

static double allowed(const pia_fit *fit, pia_index row)
{
    return fit->tolerances != NULL ? fit->tolerances[row] : fit->options.tolerance;
}

/* ---- growing ---- */

static double row_ratio(const pia_fit *fit, pia_index row)
{
    const double *r = fit->iterate.residual + row * fit->dim;
    double square = 0;
    for (int d = 0; d < fit->dim; d++) square += r[d] * r[d];
    return sqrt(square) / allowed(fit, row);
}

static double worst_ratio(const pia_fit *fit, pia_index begin, pia_index end)
{
    double worst = 0;
    for (pia_index row = begin; row < end; row++) worst = fmax(worst, row_ratio(fit, row));
    return worst;
}

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
        double ratio = rows >= 2 ? worst_ratio(fit, begin, begin + rows) : 0;
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

/* Knot vector from the knots strictly inside the domain: clamped, or one period that starts at the domain's first knot. */
static pia_status install_inside(pia_fit *fit, const double *inside, pia_index count)
{
    int p = fit->degree[0];
    double low = fit->knots[0][p], high = fit->knots[0][fit->full[0]];
    pia_index control = fit->closed[0] ? count + 1 : count + p + 1;
    double *knots = pia_take(fit->context, control + p + 1, sizeof *knots);
    if (knots == NULL) return PIA_E_MEMORY;
    if (fit->closed[0]) {
        /* One period, starting p knots before the domain. */
        for (pia_index i = 0; i < control; i++) {
            pia_index k = i - p, periods = 0;
            while (k < 0) {
                k += control;
                periods--;
            }
            knots[i] = (k == 0 ? low : inside[k - 1]) + (double)periods;
        }
    } else {
        for (int i = 0; i <= p; i++) {
            knots[i] = low;
            knots[control + i] = high;
        }
        memcpy(knots + p + 1, inside, (size_t)count * sizeof *knots);
    }
    pia_status status = pia_refine_install(fit, knots, control);
    pia_give(fit->context, knots);
    return status;
}

/* One round of growing. *grown is 0 when no span could be split. */
static pia_status grow(pia_fit *fit, int *grown)
{
    pia_index count;
    double *inside = pia_take(fit->context, fit->full[0] + fit->rows, sizeof *inside);
    if (inside == NULL) return PIA_E_MEMORY;
    pia_index added = split_spans(fit, inside, &count);
    *grown = added > 0 && (fit->closed[0] ? count + 1 : count + fit->degree[0] + 1) <= fit->rows;
    pia_status status = *grown ? install_inside(fit, inside, count) : PIA_OK;
    pia_give(fit->context, inside);
    return status == PIA_OK && *grown ? pia_refine_solve(fit) : status;
}

/* The parameters as placements take them: those of a closed curve in [0, 1), rising. */
static void unit_parameters(const pia_fit *fit, double *t)
{
    pia_index m = fit->rows, by = 0;
    memcpy(t, fit->parameter[0], (size_t)m * sizeof *t);
    if (!fit->closed[0]) return;
    double base = floor(t[0]);
    while (by < m && fit->parameter[0][by] < base + 1) by++;
    for (pia_index i = 0; i < m; i++) {
        pia_index from = (by + i) % m;
        t[i] = fit->parameter[0][from] - base - (from >= by ? 1 : 0);
    }
}

/* Interpolation, where growing ends: every row met, if all parameters differ. */
static pia_status interpolate(pia_fit *fit, int *possible)
{
    *possible = fit->rows > 2 * fit->degree[0] + 2;
    for (pia_index i = 1; i < fit->rows; i++) *possible &= fit->parameter[0][i] > fit->parameter[0][i - 1];
    if (!*possible) return PIA_OK;
    pia_index count = fit->rows + 2 * fit->degree[0] + 1;
    double *knots = pia_take(fit->context, count, sizeof *knots), *t = pia_take(fit->context, fit->rows, sizeof *t);
    pia_status status = knots != NULL && t != NULL ? PIA_OK : PIA_E_MEMORY;
    if (status == PIA_OK) {
        unit_parameters(fit, t);
        pia_place_problem problem = {fit->degree[0], fit->closed[0], fit->rows, t, fit->rows};
        status = pia_place_find("average")->place(fit->context, &problem, knots);
    }
    if (status == PIA_OK) status = pia_refine_install(fit, knots, fit->rows);
    if (status == PIA_OK) status = pia_refine_solve(fit);
    pia_give(fit->context, knots);
    pia_give(fit->context, t);
    return status;
}

/* ---- sparing ---- */

typedef struct candidate {
    double cost, knot;
} candidate;

static int compare_costs(const void *a, const void *b)
{
    const candidate *p = a, *q = b;
    if (p->cost != q->cost) return p->cost < q->cost ? -1 : 1;
    return (p->knot > q->knot) - (p->knot < q->knot);
}

/* The highest derivative on a span, from divided differences of its control points. */
static void highest_derivative(const pia_draft *draft, pia_index span, double *out)
{
    int p = draft->degree, dim = draft->dim;
    double difference[(PIA_MAX_DEGREE + 1) * PIA_MAX_DIM];
    pia_index base = span - p;
    for (int i = 0; i <= p; i++) {
        pia_index at = draft->closed ? ((base + i) % draft->count + draft->count) % draft->count : base + i;
        memcpy(difference + i * dim, draft->control + at * dim, (size_t)dim * sizeof(double));
    }
    for (int order = 1; order <= p; order++)
        for (int i = p; i >= order; i--) {
            double width = pia_draft_knot(draft, base + i + p - order + 1) - pia_draft_knot(draft, base + i);
            for (int d = 0; d < dim; d++) {
                double *to = &difference[i * dim + d];
                *to = width > 0 ? (p - order + 1) * (*to - difference[(i - 1) * dim + d]) / width : 0;
            }
        }
    memcpy(out, difference + p * dim, (size_t)dim * sizeof(double));
}

/* How little a knot does: the jump of the highest derivative there, as the distance that the curve would move over the spans beside. */
static double knot_cost(const pia_draft *draft, pia_index j)
{
    double before[PIA_MAX_DIM], after[PIA_MAX_DIM], square = 0;
    double left = pia_draft_knot(draft, j) - pia_draft_knot(draft, j - 1),
           right = pia_draft_knot(draft, j + 1) - pia_draft_knot(draft, j);
    highest_derivative(draft, j - 1, before);
    highest_derivative(draft, j, after);
    for (int d = 0; d < draft->dim; d++) square += (after[d] - before[d]) * (after[d] - before[d]);
    return left + right > 0 ? sqrt(square) * pow(left * right / (left + right), draft->degree) : 0;
}

/* Tries to do without one knot, or with one instead of two. */
static pia_status try_knot(pia_draft *draft, pia_index j, int merge, pia_trial *trial)
{
    static const double share[] = {0.5, 0.25, 0.75};
    pia_index first, end;
    pia_draft_inside(draft, &first, &end);
    *trial = (pia_trial){0, 0};
    if (!merge) return pia_draft_replace(draft, j, 1, NULL, 0, REACH, LAWSON_ROUNDS, trial);
    if (j + 1 >= end && !draft->closed) return PIA_OK;
    double here = pia_draft_knot(draft, j), next = pia_draft_knot(draft, j + 1);
    pia_status status = PIA_OK;
    for (size_t k = 0; k < sizeof share / sizeof *share && status == PIA_OK && !trial->taken; k++) {
        double knot = here + share[k] * (next - here);
        status = pia_draft_replace(draft, pia_draft_find(draft, here), 2, &knot, 1, REACH, LAWSON_ROUNDS, trial);
    }
    return status;
}

/* One sweep over all inside knots, the cheapest first. */
static pia_status sweep(pia_fit *fit, pia_draft *draft, int merge, pia_index *taken)
{
    pia_index first, end;
    pia_draft_inside(draft, &first, &end);
    pia_index count = end - first;
    *taken = 0;
    if (count <= 0) return PIA_OK;
    candidate *order = pia_take(fit->context, count, sizeof *order);
    if (order == NULL) return PIA_E_MEMORY;
    for (pia_index k = 0; k < count; k++) order[k] = (candidate){knot_cost(draft, first + k), pia_draft_knot(draft, first + k)};
    qsort(order, (size_t)count, sizeof *order, compare_costs);
    pia_status status = PIA_OK;
    for (pia_index k = 0; k < count && status == PIA_OK; k++) {
        pia_index j = pia_draft_find(draft, order[k].knot);
        pia_trial trial;
        if (j < 0 || (draft->tried[j] & (merge ? 2 : 1)) != 0) continue;
        draft->tried[j] |= merge ? 2 : 1;
        status = try_knot(draft, j, merge, &trial);
        *taken += trial.taken;
    }
    pia_give(fit->context, order);
    return status;
}

static pia_draft draft_of(const pia_fit *fit)
{
    return (pia_draft){.context = fit->context,
                       .degree = fit->degree[0],
                       .dim = fit->dim,
                       .closed = fit->closed[0],
                       .count = fit->op->cols,
                       .knots = fit->knots[0],
                       .control = fit->iterate.points,
                       .parameters = fit->parameter[0],
                       .points = fit->points,
                       .origin = fit->origin,
                       .inverse_tolerance = fit->inverse_tolerance,
                       .inverse_one = 1 / fit->options.tolerance,
                       .rows = fit->rows};
}

/* The draft works on copies; the fit takes them over when it is done. */
static pia_status spare(pia_fit *fit, pia_index *spared)
{
    pia_draft draft = draft_of(fit);
    pia_index knots = draft.count + (draft.closed ? 0 : draft.degree + 1), before = draft.count;
    size_t points = (size_t)(draft.count * draft.dim) * sizeof(double);
    draft.knots = pia_take(fit->context, knots, sizeof(double));
    draft.control = pia_take(fit->context, draft.count * draft.dim, sizeof(double));
    draft.tried = pia_take_zero(fit->context, knots, 1);
    pia_status status = draft.knots != NULL && draft.control != NULL && draft.tried != NULL ? PIA_OK : PIA_E_MEMORY;
    if (status == PIA_OK) {
        memcpy(draft.knots, fit->knots[0], (size_t)knots * sizeof(double));
        memcpy(draft.control, fit->iterate.points, points);
    }
    pia_index taken = 1;
    for (int k = 0; k < MAX_SWEEPS && taken > 0 && status == PIA_OK; k++) {
        status = sweep(fit, &draft, 0, &taken);
        if (status == PIA_OK && taken == 0) status = sweep(fit, &draft, 1, &taken);
        fit->round++;
    }
    *spared = before - draft.count;
    if (status == PIA_OK && *spared > 0) {
        status = pia_refine_install(fit, draft.knots, draft.count);
        if (status == PIA_OK) memcpy(fit->iterate.points, draft.control, (size_t)(draft.count * draft.dim) * sizeof(double));
        pia_iterate_measure(&fit->iterate);
    }
    pia_draft_close(&draft);
    pia_give(fit->context, draft.knots);
    pia_give(fit->context, draft.control);
    pia_give(fit->context, draft.tried);
    return status;
}

/* Parameters at the foot points of the current curve; taken back where a step that was meant to bring points closer did not. */
static pia_status move_to_feet(pia_fit *fit)
{
    double *before = pia_take(fit->context, fit->rows, sizeof *before);
    if (before == NULL) return PIA_E_MEMORY;
    memcpy(before, fit->parameter[0], (size_t)fit->rows * sizeof *before);
    pia_status status = PIA_OK;
    for (int newton = 0; newton < NEWTON_STEPS && status == PIA_OK; newton++) status = pia_fit_project(&fit->iterate);
    pia_iterate_measure(&fit->iterate);
    if (worst_ratio(fit, 0, fit->rows) > 1) {
        memcpy(fit->parameter[0], before, (size_t)fit->rows * sizeof *before);
        pia_collocation_rebucket(&fit->line[0]);
        fit->iterate.errors_known = 0;
        pia_iterate_measure(&fit->iterate);
    }
    pia_give(fit->context, before);
    return status;
}

pia_status pia_refine_curve(pia_fit *fit)
{
    pia_status status = pia_refine_solve(fit);
    int grown = 1;
    for (int k = 0; k < MAX_GROWTH && status == PIA_OK && grown && worst_ratio(fit, 0, fit->rows) > 1; k++) {
        status = grow(fit, &grown);
        fit->round++;
    }
    int reached = status == PIA_OK && worst_ratio(fit, 0, fit->rows) <= 1;
    if (status == PIA_OK && !reached) {
        status = interpolate(fit, &reached);
        reached = reached && status == PIA_OK && worst_ratio(fit, 0, fit->rows) <= 1;
    }
    pia_index spared = reached;
    for (int k = 0; status == PIA_OK && k < CORRECTIONS && spared > 0; k++) {
        status = spare(fit, &spared);
        if (fit->options.measure_distance == 0) break;
        if (status == PIA_OK) status = move_to_feet(fit);
    }
    fit->solve.stop = reached ? PIA_STOP_TOLERANCE : PIA_STOP_NO_KNOT_LEFT;
    return status;
}
