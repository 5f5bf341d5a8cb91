/* Whole knot lines are taken away, the cheapest first and many at a time as long as that works, each time with a fit of the whole. */
#include "refine.h"
#include "refine_tiles.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_MISSES = 6 };

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
    pia_tiles *tiles; /* where the fit suits them; else NULL */
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
    pia_index wide = fit->directions == 2 ? fit->full[1] : 1, lines = d == 0 ? wide : fit->full[0];
    pia_index along = d == 0 ? wide : 1, across = d == 0 ? 1 : wide;
    for (pia_index other = 0; other < lines; other++) {
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

static int is_corner(const double *inside, pia_index count, pia_index at)
{
    return (at > 0 && inside[at] == inside[at - 1]) || (at + 1 < count && inside[at] == inside[at + 1]);
}

/* Marks the `batch` cheapest lines that have not failed, no two of them neighbours. Returns how many. */
static pia_index choose(const pia_fit *fit, int d, pia_index batch, trial *t)
{
    const double *full = pia_op_full(fit->op, fit->iterate.points, fit->dim), *inside = pia_refine_inside(fit, d);
    pia_index count = pia_refine_inside_count(fit, d), going = 0;
    for (pia_index k = 0; k < count; k++) t->order[k] = (line){line_cost(fit, d, full, fit->degree[d] + 1 + k), inside[k], k};
    qsort(t->order, (size_t)count, sizeof *t->order, by_cost);
    for (pia_index k = 0; k < count; k++) t->gone[k] = 0;
    for (pia_index k = 0; k < count && going < batch; k++) {
        pia_index at = t->order[k].at;
        if (is_corner(inside, count, at)) continue;
        if ((at > 0 && t->gone[at - 1]) || (at + 1 < count && t->gone[at + 1]) || has_failed(t, t->order[k].knot)) continue;
        t->gone[at] = 1;
        going++;
    }
    return going;
}

/* The fit as the tiles have found it, taken back where it does not keep the tolerance after all. */
static pia_status take_over(pia_fit *fit, const pia_tiles *tiles, int *taken)
{
    pia_saved before;
    pia_status status = pia_refine_save(fit, &before);
    if (status != PIA_OK) return status;
    for (int d = 0; d < 2 && status == PIA_OK; d++)
        status = pia_refine_place(fit, d, tiles->line[d].knots + fit->degree[d] + 1, tiles->line[d].count - fit->degree[d] - 1);
    if (status == PIA_OK) status = pia_fit_assemble(fit);
    if (status == PIA_OK) {
        pia_tiles_control(tiles, fit->iterate.points);
        pia_iterate_measure(&fit->iterate);
        *taken = pia_refine_reached(fit);
        if (!*taken) status = pia_refine_go_back(fit, &before);
    }
    pia_refine_drop(fit, &before);
    return status;
}

static pia_status try_on_tiles(pia_fit *fit, int d, trial *t, pia_index kept, int *taken)
{
    pia_projection_line before;
    int found = 0;
    pia_status status = pia_tiles_place(t->tiles, d, t->kept, kept, &before);
    if (status != PIA_OK) return status;
    status = pia_tiles_search(t->tiles, &found);
    if (status == PIA_OK && found) status = take_over(fit, t->tiles, taken);
    if (*taken) {
        pia_projection_line_close(fit->context, &before);
        pia_tiles_keep(t->tiles);
    } else {
        pia_tiles_put_back(t->tiles, d, &before);
    }
    return status;
}

/* The fit without the marked lines, taken back when the tolerance does not hold. */
static pia_status try_without(pia_fit *fit, int d, trial *t, int *taken)
{
    pia_saved before;
    const double *inside = pia_refine_inside(fit, d);
    pia_index count = pia_refine_inside_count(fit, d), kept = 0;
    for (pia_index k = 0; k < count; k++)
        if (!t->gone[k]) t->kept[kept++] = inside[k];
    if (t->tiles != NULL) return try_on_tiles(fit, d, t, kept, taken);
    pia_status status = pia_refine_save(fit, &before);
    if (status != PIA_OK) return status;
    status = pia_refine_refit(fit, d, t->kept, kept);
    if (status == PIA_OK) status = pia_refine_relax(fit);
    *taken = status == PIA_OK && pia_refine_reached(fit);
    if ((status == PIA_OK || status == PIA_E_CONSTRAINT) && !*taken) status = pia_refine_go_back(fit, &before);
    pia_refine_drop(fit, &before);
    return status;
}

/* Many lines at a time, or one by one. */
static pia_status spare_lines(pia_fit *fit, int d, int many, trial *t, pia_index *spared)
{
    pia_index batch = many ? (pia_refine_inside_count(fit, d) + 3) / 4 : 1, misses = 0;
    pia_status status = PIA_OK;
    t->failures = 0;
    while (status == PIA_OK && batch > many && misses < MAX_MISSES && !pia_refine_stopped(fit)) {
        pia_index least = fit->closed[d] ? (fit->degree[d] > 3 ? fit->degree[d] : 3) : 0; /* a period keeps so many knots */
        pia_index going = pia_refine_inside_count(fit, d) > least ? choose(fit, d, batch, t) : 0;
        int taken = 0;
        if (going == 0) break;
        status = try_without(fit, d, t, &taken);
        if (taken) {
            *spared += going;
            misses = 0;
        } else if (going > 1) {
            batch = going / 2;
        } else {
            for (pia_index k = 0; k < pia_refine_inside_count(fit, d); k++)
                if (t->gone[k]) t->failed[t->failures++] = pia_refine_inside(fit, d)[k];
            misses++;
        }
    }
    return status;
}

static pia_status spare_direction(pia_fit *fit, pia_tiles *tiles, int d, int many, pia_index *spared)
{
    pia_index count = pia_refine_inside_count(fit, d);
    trial t = {.tiles = tiles,
               .order = pia_take(fit->context, count, sizeof *t.order),
               .kept = pia_take(fit->context, count, sizeof *t.kept),
               .gone = pia_take(fit->context, count, 1),
               .failed = pia_take(fit->context, count, sizeof *t.failed)};
    pia_status status = t.order != NULL && t.kept != NULL && t.gone != NULL && t.failed != NULL ? PIA_OK : PIA_E_MEMORY;
    if (status == PIA_OK) status = spare_lines(fit, d, many, &t, spared);
    pia_give(fit->context, t.order);
    pia_give(fit->context, t.kept);
    pia_give(fit->context, t.gone);
    pia_give(fit->context, t.failed);
    return status;
}

pia_status pia_refine_spare_lines(pia_fit *fit, pia_index *spared)
{
    pia_tiles tiles;
    int tiled = pia_tiles_suit(fit);
    pia_status status = tiled ? pia_tiles_open(fit, &tiles) : PIA_OK;
    *spared = 0;
    if (status != PIA_OK) return status;
    for (int many = 1; many >= 0; many--)
        for (int d = 0; d < fit->directions && status == PIA_OK; d++)
            status = spare_direction(fit, tiled ? &tiles : NULL, d, many, spared);
    pia_status left = tiled ? pia_tiles_close(&tiles) : PIA_OK;
    return status == PIA_OK ? left : status;
}
