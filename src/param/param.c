#include "param.h"

#include "kernel.h"
#include "rooms.h"

#include <string.h>

const pia_parametrization *pia_param_find(const char *name)
{
    const pia_parametrization *entry;
    for (pia_index i = 0; (entry = pia_param_list(i)) != NULL; i++)
        if (strcmp(entry->name, name) == 0) return entry;
    return NULL;
}

/* PANEL: lines copied together where they are not contiguous: a cache line is read once. GRAIN: numbers a task should get at least. */
enum { PANEL = 8, GRAIN = 32768, MAX_CHUNKS = 64 };

/* One direction of a grid: lines of `count` points, `step` doubles apart. */
typedef struct direction {
    const pia_parametrization *rule;
    pia_index count, lines, step, line_step;
    int dim, degree, closed;
} direction;

/* What some of its lines add up to. */
typedef struct shares {
    double *share;   /* [count] sum of the shares of step i -> i + 1 */
    double *covered; /* [count] lines that cover it, besides the whole ones */
    pia_index whole; /* lines without holes that count */
    pia_index used;  /* lines that count */
} shares;

/* A line at hand. */
typedef struct desk {
    const direction *d;
    shares *sum;
    double *panel;      /* [PANEL x count x dim] */
    double *points;     /* [count x dim] the present points of a line */
    double *parameters; /* [count] theirs */
    pia_index *index;   /* [count] where on the line they are */
} desk;

/* Lines come in order, from a multiple of PANEL on. */
static const double *line_of(const desk *k, const double *points, pia_index line)
{
    const direction *d = k->d;
    if (d->step == d->dim) return points + line * d->line_step;
    for (pia_index i = 0; line % PANEL == 0 && i < d->count; i++)
        for (pia_index m = 0; m < PANEL && line + m < d->lines; m++)
            for (int c = 0; c < d->dim; c++)
                k->panel[(m * d->count + i) * d->dim + c] = points[(line + m) * d->line_step + i * d->step + c];
    return k->panel + line % PANEL * d->count * d->dim;
}

static int has_nan(const double *values, pia_index count)
{
    int found = 0;
    for (pia_index i = 0; i < count; i++) found |= values[i] != values[i];
    return found;
}

/* Keeps the points of a line without NaN; returns how many those are. */
static pia_index keep_present(desk *k, const double *line)
{
    const direction *d = k->d;
    pia_index present = 0;
    for (pia_index i = 0; i < d->count; i++) {
        const double *point = line + i * d->dim;
        if (has_nan(point, d->dim)) continue;
        memcpy(k->points + present * d->dim, point, (size_t)d->dim * sizeof *point);
        k->index[present++] = i;
    }
    return present;
}

/* `whole` is the parameter length from one present point to the next one, `steps` grid steps away. */
static void spread(desk *k, pia_index from, pia_index steps, double whole)
{
    for (pia_index m = 0; m < steps; m++) {
        pia_index i = (from + m) % k->d->count;
        k->sum->share[i] += whole / (double)steps;
        k->sum->covered[i] += 1;
    }
}

static void add_line(desk *k, pia_index present)
{
    const double *t = k->parameters;
    const pia_index *index = k->index;
    pia_index last = index[present - 1];
    double part = k->d->closed ? 1 : (double)(last - index[0]) / (double)(k->d->count - 1);
    for (pia_index m = 0; m + 1 < present; m++) spread(k, index[m], index[m + 1] - index[m], (t[m + 1] - t[m]) * part);
    if (k->d->closed) spread(k, last, k->d->count - last + index[0], 1 - t[present - 1]);
}

static void add_whole_line(desk *k)
{
    const double *t = k->parameters;
    double *share = k->sum->share;
    pia_index count = k->d->count;
    for (pia_index i = 0; i + 1 < count; i++) share[i] += t[i + 1] - t[i];
    share[count - 1] += 1 - t[count - 1];
    k->sum->whole++;
}

/* Lines that have no parameters do not count; what the rule says of them goes to a context of their own. */
static void take_line(desk *k, const double *line, pia_context *own)
{
    const direction *d = k->d;
    int holes = has_nan(line, d->count * d->dim);
    pia_index present = holes ? keep_present(k, line) : d->count;
    if (present < 2) return;
    if (d->rule->compute(own, holes ? k->points : line, present, d->dim, d->degree, d->closed, k->parameters) != PIA_OK) return;
    if (holes)
        add_line(k, present);
    else
        add_whole_line(k);
    k->sum->used++;
}

/* ---- lines side by side: chunks of whole panels, whose sums are added in order ---- */

typedef struct work {
    const direction *d;
    const double *points;
    pia_index chunks;
    pia_rooms rooms;
    shares part[MAX_CHUNKS];
} work;

static pia_index panels(const direction *d)
{
    return (d->lines + PANEL - 1) / PANEL;
}

static desk sit_down(const work *w, shares *sum, void *room)
{
    pia_index size = w->d->count * w->d->dim;
    desk k = {.d = w->d, .sum = sum, .parameters = room};
    k.index = (pia_index *)(k.parameters + w->d->count);
    k.points = (double *)(k.index + w->d->count);
    k.panel = k.points + size;
    return k;
}

static void take_chunk(void *argument, pia_index chunk)
{
    work *w = argument;
    const direction *d = w->d;
    pia_context own = {.threads = 1, .kernel = &pia_kernel_serial};
    void *room = pia_rooms_take(&w->rooms);
    desk k = sit_down(w, &w->part[chunk], room);
    pia_index end = pia_chunk_begin(panels(d), w->chunks, chunk + 1) * PANEL;
    for (pia_index i = 0; i < d->count; i++) k.sum->share[i] = k.sum->covered[i] = 0;
    for (pia_index j = pia_chunk_begin(panels(d), w->chunks, chunk) * PANEL; j < end && j < d->lines; j++)
        take_line(&k, line_of(&k, w->points, j), &own);
    pia_rooms_leave(&w->rooms, room);
}

/* Into the first part. */
static void join(work *w)
{
    shares *all = &w->part[0];
    for (pia_index c = 1; c < w->chunks; c++) {
        const shares *part = &w->part[c];
        for (pia_index i = 0; i < w->d->count; i++) {
            all->share[i] += part->share[i];
            all->covered[i] += part->covered[i];
        }
        all->whole += part->whole;
        all->used += part->used;
    }
}

/* Mean shares, summed and scaled to [0, 1]. */
static void finish(const direction *d, const shares *all, double *out)
{
    double sum = 0;
    for (pia_index i = 0; i < d->count; i++) {
        double lines = all->covered[i] + (double)all->whole;
        double mean = lines > 0 ? all->share[i] / lines : 1 / (double)(d->count - 1);
        out[i] = sum;
        if (d->closed || i + 1 < d->count) sum += mean;
    }
    for (pia_index i = 0; i < d->count; i++) out[i] /= sum;
}

static pia_status average(pia_context *context, work *w, double *sums, double *out)
{
    for (pia_index c = 0; c < w->chunks; c++) {
        double *own = sums + 2 * c * w->d->count;
        w->part[c] = (shares){.share = own, .covered = own + w->d->count};
    }
    pia_for_each(context, w->chunks, take_chunk, w);
    join(w);
    if (w->part[0].used == 0) return pia_fail(context, PIA_E_DATA, "no line of the grid has two different points; give its parameters");
    finish(w->d, &w->part[0], out);
    return PIA_OK;
}

static pia_status parametrize(pia_context *context, const direction *d, const double *points, double *out)
{
    work w = {.d = d, .points = points};
    pia_index room, sizes = d->dim * (pia_index)((d->step == d->dim ? 0 : PANEL) + 1) + 2;
    if (d->count < 2) return pia_fail(context, PIA_E_SHAPE, "a grid needs at least 2 rows and 2 columns");
    if (!pia_multiply(d->count, sizes * (pia_index)sizeof(double), &room))
        return pia_fail(context, PIA_E_SIZE, "lines of %lld points do not fit in 64 bits", (long long)d->count);
    w.chunks = pia_chunk_count(d->lines * d->count * d->dim, GRAIN);
    if (w.chunks > panels(d)) w.chunks = panels(d);
    if (w.chunks > MAX_CHUNKS) w.chunks = MAX_CHUNKS;
    pia_status status = pia_rooms_open(context, w.chunks, room, &w.rooms);
    if (status != PIA_OK) return status;
    double *sums = pia_take(context, 2 * w.chunks, (size_t)d->count * sizeof *sums);
    status = sums != NULL ? average(context, &w, sums, out) : pia_take_status(context, 2 * w.chunks, (size_t)d->count * sizeof *sums);
    pia_give(context, sums);
    pia_rooms_close(context, &w.rooms);
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
    pia_status status = parametrize(context, &down, points, u);
    return status == PIA_OK ? parametrize(context, &across, points, v) : status;
}
