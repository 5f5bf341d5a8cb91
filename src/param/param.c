#include "param.h"

#include <math.h>
#include <string.h>

const pia_parametrization *pia_param_find(const char *name)
{
    const pia_parametrization *entry;
    for (pia_index i = 0; (entry = pia_param_list(i)) != NULL; i++)
        if (strcmp(entry->name, name) == 0) return entry;
    return NULL;
}

/* One direction of a grid: lines of `count` points, `step` doubles apart. */
typedef struct direction {
    const pia_parametrization *rule;
    pia_index count, lines, step, line_step;
    int dim, degree, closed;
    double *points;     /* [count x dim] the present points of a line */
    double *parameters; /* [count] theirs */
    pia_index *index;   /* [count] where on the line they are */
    double *share;      /* [count] sum of the shares of step i -> i + 1 */
    double *covered;    /* [count] lines that cover it */
    pia_index used;     /* lines that counted */
} direction;

static int has_nan(const double *point, int dim)
{
    for (int c = 0; c < dim; c++)
        if (isnan(point[c])) return 1;
    return 0;
}

/* Returns how many points of the line are present. */
static pia_index gather(direction *d, const double *line)
{
    pia_index present = 0;
    for (pia_index i = 0; i < d->count; i++) {
        const double *point = line + i * d->step;
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
    d->used++;
}

/* Mean shares, summed and scaled to [0, 1]. */
static void finish(const direction *d, double *out)
{
    double sum = 0;
    for (pia_index i = 0; i < d->count; i++) {
        double mean = d->covered[i] > 0 ? d->share[i] / d->covered[i] : 1 / (double)(d->count - 1);
        out[i] = sum;
        if (d->closed || i + 1 < d->count) sum += mean;
    }
    for (pia_index i = 0; i < d->count; i++) out[i] /= sum;
}

static pia_status average(pia_context *context, direction *d, const double *points, double *out)
{
    for (pia_index j = 0; j < d->lines; j++) {
        pia_index present = gather(d, points + j * d->line_step);
        if (present < 2) continue;
        pia_status status = d->rule->compute(context, d->points, present, d->dim, d->degree, d->closed, d->parameters);
        if (status == PIA_OK)
            add_line(d, present);
        else if (status != PIA_E_DATA)
            return status;
    }
    if (d->used == 0) return pia_fail(context, PIA_E_DATA, "no line of the grid has two different points: nothing to parametrize");
    finish(d, out);
    return PIA_OK;
}

static pia_status parametrize(pia_context *context, direction *d, const double *points, double *out)
{
    if (d->count < 2) return pia_fail(context, PIA_E_SHAPE, "a grid needs at least 2 rows and 2 columns");
    d->points = pia_take(context, d->count * d->dim, sizeof *d->points);
    d->parameters = pia_take(context, d->count, sizeof *d->parameters);
    d->index = pia_take(context, d->count, sizeof *d->index);
    d->share = pia_take_zero(context, d->count, sizeof *d->share);
    d->covered = pia_take_zero(context, d->count, sizeof *d->covered);
    pia_status status = PIA_E_MEMORY;
    if (d->points != NULL && d->parameters != NULL && d->index != NULL && d->share != NULL && d->covered != NULL)
        status = average(context, d, points, out);
    pia_give(context, d->points);
    pia_give(context, d->parameters);
    pia_give(context, d->index);
    pia_give(context, d->share);
    pia_give(context, d->covered);
    return status;
}

pia_status pia_param_grid(pia_context *context, const pia_parametrization *rule, const double *points, const pia_index count[2],
                          int dim, const int degree[2], const int closed[2], double *u, double *v)
{
    direction down = {rule, count[0], count[1], count[1] * dim, dim, dim, degree[0], closed[0], NULL, NULL, NULL, NULL, NULL, 0};
    direction across = {rule, count[1], count[0], dim, count[1] * dim, dim, degree[1], closed[1], NULL, NULL, NULL, NULL, NULL, 0};
    pia_status status = parametrize(context, &down, points, u);
    return status == PIA_OK ? parametrize(context, &across, points, v) : status;
}
