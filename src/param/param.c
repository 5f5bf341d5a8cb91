#include "param.h"

#include <string.h>

const pia_parametrization *pia_param_find(const char *name)
{
    const pia_parametrization *entry;
    for (pia_index i = 0; (entry = pia_param_list(i)) != NULL; i++)
        if (strcmp(entry->name, name) == 0) return entry;
    return NULL;
}

enum { PANEL = 8 }; /* lines copied together where they are not contiguous: a cache line is read once */

/* One direction of a grid: lines of `count` points, `step` doubles apart. */
typedef struct direction {
    const pia_parametrization *rule;
    pia_index count, lines, step, line_step;
    int dim, degree, closed;
    double *panel;      /* [PANEL x count x dim] */
    double *points;     /* [count x dim] the present points of a line */
    double *parameters; /* [count] theirs */
    pia_index *index;   /* [count] where on the line they are */
    double *share;      /* [count] sum of the shares of step i -> i + 1 */
    double *covered;    /* [count] lines that cover it, besides the whole ones */
    pia_index whole;    /* lines without holes that count */
    pia_index used;     /* lines that count */
} direction;

static const double *line_of(const direction *d, const double *points, pia_index line)
{
    if (d->step == d->dim) return points + line * d->line_step;
    for (pia_index i = 0; line % PANEL == 0 && i < d->count; i++)
        for (pia_index k = 0; k < PANEL && line + k < d->lines; k++)
            for (int c = 0; c < d->dim; c++)
                d->panel[(k * d->count + i) * d->dim + c] = points[(line + k) * d->line_step + i * d->step + c];
    return d->panel + line % PANEL * d->count * d->dim;
}

static int has_nan(const double *values, pia_index count)
{
    int found = 0;
    for (pia_index i = 0; i < count; i++) found |= values[i] != values[i];
    return found;
}

/* Keeps the points of a line without NaN; returns how many those are. */
static pia_index keep_present(direction *d, const double *line)
{
    pia_index present = 0;
    for (pia_index i = 0; i < d->count; i++) {
        const double *point = line + i * d->dim;
        if (has_nan(point, d->dim)) continue;
        memcpy(d->points + present * d->dim, point, (size_t)d->dim * sizeof *point);
        d->index[present++] = i;
    }
    return present;
}

/* `whole` is the parameter length from one present point to the next one, `steps` grid steps away. */
static void spread(direction *d, pia_index from, pia_index steps, double whole)
{
    for (pia_index k = 0; k < steps; k++) {
        pia_index i = (from + k) % d->count;
        d->share[i] += whole / (double)steps;
        d->covered[i] += 1;
    }
}

static void add_line(direction *d, pia_index present)
{
    const double *t = d->parameters;
    pia_index last = d->index[present - 1];
    double part = d->closed ? 1 : (double)(last - d->index[0]) / (double)(d->count - 1);
    for (pia_index k = 0; k + 1 < present; k++) spread(d, d->index[k], d->index[k + 1] - d->index[k], (t[k + 1] - t[k]) * part);
    if (d->closed) spread(d, last, d->count - last + d->index[0], 1 - t[present - 1]);
}

static void add_whole_line(direction *d)
{
    const double *t = d->parameters;
    for (pia_index i = 0; i + 1 < d->count; i++) d->share[i] += t[i + 1] - t[i];
    d->share[d->count - 1] += 1 - t[d->count - 1];
    d->whole++;
}

/* Mean shares, summed and scaled to [0, 1]. */
static void finish(const direction *d, double *out)
{
    double sum = 0;
    for (pia_index i = 0; i < d->count; i++) {
        double lines = d->covered[i] + (double)d->whole;
        double mean = lines > 0 ? d->share[i] / lines : 1 / (double)(d->count - 1);
        out[i] = sum;
        if (d->closed || i + 1 < d->count) sum += mean;
    }
    for (pia_index i = 0; i < d->count; i++) out[i] /= sum;
}

static pia_status average(pia_context *context, direction *d, const double *points, double *out)
{
    for (pia_index j = 0; j < d->lines; j++) {
        const double *line = line_of(d, points, j);
        int holes = has_nan(line, d->count * d->dim);
        pia_index present = holes ? keep_present(d, line) : d->count;
        if (present < 2) continue;
        pia_status status = d->rule->compute(context, holes ? d->points : line, present, d->dim, d->degree, d->closed, d->parameters);
        if (status == PIA_E_DATA) continue;
        if (status != PIA_OK) return status;
        if (holes)
            add_line(d, present);
        else
            add_whole_line(d);
        d->used++;
    }
    if (d->used == 0) return pia_fail(context, PIA_E_DATA, "no line of the grid has two different points: nothing to parametrize");
    finish(d, out);
    return PIA_OK;
}

static int take_work(pia_context *context, direction *d)
{
    pia_index values, panel;
    if (!pia_multiply(d->count, d->dim, &values) || !pia_multiply(values, PANEL, &panel)) return 0;
    d->panel = pia_take(context, d->step == d->dim ? 0 : panel, sizeof *d->panel);
    d->points = pia_take(context, values, sizeof *d->points);
    d->parameters = pia_take(context, d->count, sizeof *d->parameters);
    d->index = pia_take(context, d->count, sizeof *d->index);
    d->share = pia_take_zero(context, d->count, sizeof *d->share);
    d->covered = pia_take_zero(context, d->count, sizeof *d->covered);
    return d->panel != NULL && d->points != NULL && d->parameters != NULL && d->index != NULL && d->share != NULL && d->covered != NULL;
}

static void give_work(pia_context *context, direction *d)
{
    pia_give(context, d->panel);
    pia_give(context, d->points);
    pia_give(context, d->parameters);
    pia_give(context, d->index);
    pia_give(context, d->share);
    pia_give(context, d->covered);
}

static pia_status parametrize(pia_context *context, direction d, const double *points, double *out)
{
    if (d.count < 2) return pia_fail(context, PIA_E_SHAPE, "a grid needs at least 2 rows and 2 columns");
    pia_status status = take_work(context, &d) ? average(context, &d, points, out) : PIA_E_MEMORY;
    give_work(context, &d);
    return status;
}

pia_status pia_param_grid(pia_context *context, const pia_parametrization *rule, const double *points, const pia_index count[2],
                          int dim, const int degree[2], const int closed[2], double *u, double *v)
{
    direction down = {.rule = rule, .count = count[0], .lines = count[1], .step = count[1] * dim, .line_step = dim};
    direction across = {.rule = rule, .count = count[1], .lines = count[0], .step = dim, .line_step = count[1] * dim};
    down.dim = across.dim = dim;
    down.degree = degree[0];
    down.closed = closed[0];
    across.degree = degree[1];
    across.closed = closed[1];
    pia_status status = parametrize(context, down, points, u);
    return status == PIA_OK ? parametrize(context, across, points, v) : status;
}
