/* Knot removal under a bound, after the strategy of Lyche and Moerken (1987) and Tiller (1992): the cheapest knots go first, knots near
 * each other in different passes. The new points of a removal leave residuals d_i over the old basis, so the shape changes by at most
 * max |d_i| over the spans of those functions and by nothing elsewhere. Each span adds up the bounds of all removals that touched it:
 * by the triangle inequality, no point of the final shape is farther from the first one than the largest sum. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "insert.h"
#include "knots.h"
#include "removal.h"

typedef struct candidate {
    double cost;
    pia_index index; /* of the knot */
} candidate;

typedef struct thinning {
    pia_model *model; /* thinned in place */
    int direction;
    double bound;
    double centre[PIA_MAX_DIM], radius; /* rational models: the shape stays within radius of centre */
    double *error;                      /* by span, the sum of the bounds so far; this and the others are [control + degree + 1] */
    candidate *candidates;
    unsigned char *near; /* knots too near one that left in this pass */
    unsigned char *gone_knot, *gone_point;
} thinning;

static double norm(const double *v, int count)
{
    double sum = 0;
    for (int c = 0; c < count; c++) sum = hypot(sum, v[c]);
    return sum;
}

/* Rational models: with C = A/w before, A + d and w + e after, C changes by (C e - d) / (w + e). */
static double change(const thinning *t, const double *defect)
{
    const pia_model *m = t->model;
    if (!m->rational) return norm(defect, m->dim);
    double moved[PIA_MAX_DIM], e = defect[m->dim];
    for (int c = 0; c < m->dim; c++) moved[c] = defect[c] - t->centre[c] * e;
    return norm(moved, m->dim) + t->radius * fabs(e);
}

/* Smallest weight of one line around a removal, with the new points in place of the old; 1 for polynomial models. */
static double least_weight(const thinning *t, const pia_removal *r, const double *line, pia_index stride, const double *points)
{
    const pia_model *m = t->model;
    int degree = m->degree[t->direction], width = m->dim + 1;
    if (!m->rational) return 1;
    double least = INFINITY;
    for (int k = 0; k < r->count - 1; k++) least = fmin(least, points[k * width + m->dim]);
    pia_index low = r->first - degree - 1, high = r->index + degree + 1, last = m->control[t->direction] - 1;
    for (pia_index i = low > 0 ? low : 0; i <= (high < last ? high : last); i++)
        if (i < r->first || i >= r->first + r->count) least = fmin(least, line[i * stride + m->dim]);
    return least;
}

/* Visits every line across the direction. Returns the bound of the change; with `write`, the new points replace the old. */
static double remove_knot(const thinning *t, const pia_removal *r, int write)
{
    pia_model *m = t->model;
    int width = pia_model_width(m);
    pia_lines lines = pia_model_lines(m, t->direction);
    pia_index control = m->control[t->direction];
    double points[PIA_MAX_DEGREE * PIA_MAX_WIDTH], defect[PIA_MAX_WIDTH], most = 0, weight = INFINITY;
    for (pia_index outer = 0; outer < lines.outer; outer++)
        for (pia_index inner = 0; inner < lines.inner; inner += width) {
            double *line = m->points + outer * control * lines.inner + inner;
            pia_removal_solve(r, line, lines.inner, width, points, defect);
            most = fmax(most, change(t, defect));
            weight = fmin(weight, least_weight(t, r, line, lines.inner, points));
            for (int k = 0; write && k < r->count - 1; k++)
                memcpy(line + (r->first + k) * lines.inner, points + k * width, (size_t)width * sizeof *line);
        }
    return weight > 0 && isfinite(most) ? most / weight : INFINITY;
}

static int by_cost(const void *a, const void *b)
{
    const candidate *x = a, *y = b;
    if (x->cost != y->cost) return x->cost < y->cost ? -1 : 1;
    return x->index < y->index ? -1 : x->index > y->index;
}

/* A periodic direction keeps its join: the control points and knots that the end derivatives depend on stay. */
static int may_leave(const thinning *t, pia_index index, int multiplicity)
{
    const pia_model *m = t->model;
    int degree = m->degree[t->direction];
    if (!m->periodic[t->direction]) return 1;
    return index - degree >= degree && index - multiplicity < m->control[t->direction] - degree;
}

static pia_index find_candidates(thinning *t)
{
    const pia_model *m = t->model;
    int degree = m->degree[t->direction];
    const double *knots = m->knots[t->direction];
    pia_index count = 0, control = m->control[t->direction];
    for (pia_index i = degree + 1, run = 0; i < control; i++) {
        run = knots[i] == knots[i - 1] ? run + 1 : 1;
        if (knots[i] == knots[i + 1] || !may_leave(t, i, (int)run)) continue;
        pia_removal r;
        pia_removal_open(knots, degree, i, (int)run, &r);
        double cost = remove_knot(t, &r, 0);
        if (cost <= t->bound) t->candidates[count++] = (candidate){cost, i};
    }
    qsort(t->candidates, (size_t)count, sizeof *t->candidates, by_cost);
    return count;
}

/* Whether the spans that a removal changes can bear its cost. */
static int is_affordable(const thinning *t, const candidate *c, pia_index first, pia_index last)
{
    for (pia_index s = first; s <= last; s++)
        if (!(t->error[s] + c->cost <= t->bound)) return 0;
    return 1;
}

static void mark_near(thinning *t, pia_index index, pia_index knots)
{
    int reach = 2 * t->model->degree[t->direction] + 3; /* neither reads what the other writes */
    pia_index low = index > reach ? index - reach : 0, high = index + reach < knots ? index + reach : knots - 1;
    memset(t->near + low, 1, (size_t)(high - low + 1));
}

/* Drops what was removed from knots, spans and points. */
static void compact(thinning *t)
{
    pia_model *m = t->model;
    int degree = m->degree[t->direction];
    double *knots = m->knots[t->direction];
    pia_index control = m->control[t->direction], kept = 0;
    for (pia_index i = 0; i < control + degree + 1; i++) {
        if (t->gone_knot[i]) {
            t->error[kept - 1] = fmax(t->error[kept - 1], t->error[i]);
            continue;
        }
        knots[kept] = knots[i];
        if (i < control + degree) t->error[kept] = t->error[i];
        kept++;
    }
    pia_lines lines = pia_model_lines(m, t->direction);
    double *to = m->points;
    for (pia_index i = 0; i < lines.outer * control; i++) {
        if (t->gone_point[i % control]) continue;
        memmove(to, m->points + i * lines.inner, (size_t)lines.inner * sizeof *to);
        to += lines.inner;
    }
    m->control[t->direction] = kept - degree - 1;
}

/* One pass; returns how many knots left. */
static pia_index thin_once(thinning *t)
{
    pia_model *m = t->model;
    int degree = m->degree[t->direction];
    pia_index control = m->control[t->direction], knots = control + degree + 1, count = find_candidates(t), removed = 0;
    memset(t->near, 0, (size_t)knots);
    memset(t->gone_knot, 0, (size_t)knots);
    memset(t->gone_point, 0, (size_t)control);
    for (pia_index k = 0; k < count; k++) {
        const candidate *c = &t->candidates[k];
        int multiplicity = pia_knots_multiplicity(m->knots[t->direction], knots, c->index);
        pia_index first = c->index - degree, last = c->index - multiplicity + degree;
        if (t->near[c->index] || !is_affordable(t, c, first, last)) continue;
        pia_removal r;
        pia_removal_open(m->knots[t->direction], degree, c->index, multiplicity, &r);
        remove_knot(t, &r, 1);
        for (pia_index s = first; s <= last; s++) t->error[s] += c->cost;
        t->gone_knot[c->index] = 1;
        t->gone_point[c->index - multiplicity] = 1;
        mark_near(t, c->index, knots);
        removed++;
    }
    if (removed > 0) compact(t);
    return removed;
}

static void release(pia_context *context, thinning *t)
{
    pia_give(context, t->error);
    pia_give(context, t->candidates);
    pia_give(context, t->near);
    pia_give(context, t->gone_knot);
    pia_give(context, t->gone_point);
}

/* Thins one direction under its own bound; *used is the part of it that was needed. */
static pia_status thin(pia_context *context, thinning *t, double *used)
{
    pia_index knots = t->model->control[t->direction] + t->model->degree[t->direction] + 1;
    t->error = pia_take_zero(context, knots, sizeof *t->error);
    t->candidates = pia_take(context, knots, sizeof *t->candidates);
    t->near = pia_take(context, knots, 1);
    t->gone_knot = pia_take(context, knots, 1);
    t->gone_point = pia_take(context, knots, 1);
    int all = t->error != NULL && t->candidates != NULL && t->near != NULL && t->gone_knot != NULL && t->gone_point != NULL;
    *used = 0;
    if (all) {
        while (thin_once(t) > 0) {
        }
        for (pia_index i = 0; i < t->model->control[t->direction] + t->model->degree[t->direction]; i++)
            *used = fmax(*used, t->error[i]);
    }
    release(context, t);
    return all ? PIA_OK : PIA_E_MEMORY;
}

/* A ball that holds the shape before every removal: that of its control points, and what removals may add. */
static void find_ball(const pia_model *m, double bound, thinning *t)
{
    int width = pia_model_width(m);
    pia_index count = m->control[0] * m->control[1];
    t->radius = 0;
    for (int c = 0; m->rational && c < m->dim; c++) {
        double low = INFINITY, high = -INFINITY;
        for (pia_index i = 0; i < count; i++) {
            double x = m->points[i * width + c] / m->points[i * width + m->dim];
            low = fmin(low, x);
            high = fmax(high, x);
        }
        t->centre[c] = low + (high - low) / 2;
        t->radius = hypot(t->radius, high - t->centre[c]);
    }
    t->radius += bound;
}

pia_status pia_model_remove_knots(pia_context *context, const pia_model *model, double bound, pia_model **out, double *error)
{
    if (model == NULL || out == NULL) return pia_fail(context, PIA_E_ARGUMENT, "pia_model_remove_knots needs a model and out");
    if (!(bound >= 0) || !isfinite(bound))
        return pia_fail(context, PIA_E_ARGUMENT, "bound %g; it must be finite and at least 0", bound);
    pia_model *made = NULL;
    pia_status status = pia_model_copy(context, model, &made);
    if (status != PIA_OK) return status;
    thinning t = {.model = made};
    find_ball(made, bound, &t);
    double total = 0;
    for (int d = 0; status == PIA_OK && d < made->directions; d++) {
        double used;
        t.direction = d;
        t.bound = (bound - total) / (made->directions - d); /* a surface's first direction gets one half, its second what is left */
        status = thin(context, &t, &used);
        total += used;
    }
    if (status != PIA_OK) {
        pia_model_destroy(made);
        return status;
    }
    *out = made;
    if (error != NULL) *error = total;
    return PIA_OK;
}
