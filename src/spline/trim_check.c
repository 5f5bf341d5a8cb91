/* Loops checked by a sweep along u: edges in the order of their lower u, each against those whose u range reaches it. */
#include "trim.h"

#include <math.h>
#include <stdlib.h>

typedef struct edge {
    const double *from, *to;
    double low[2], high[2];
    pia_index loop, vertex; /* the vertex it starts from */
    int is_first;           /* 1: no edge of its loop comes before it in the sweep */
} edge;

static int by_low_u(const void *a, const void *b)
{
    const edge *p = a, *q = b;
    if (p->low[0] != q->low[0]) return p->low[0] < q->low[0] ? -1 : 1;
    if (p->loop != q->loop) return p->loop < q->loop ? -1 : 1;
    return p->vertex < q->vertex ? -1 : p->vertex > q->vertex;
}

static edge edge_of(const pia_trim *trim, pia_index loop, pia_index vertex)
{
    edge e = {
        .from = pia_trim_vertex(trim, loop, vertex), .to = pia_trim_vertex(trim, loop, vertex + 1), .loop = loop, .vertex = vertex};
    for (int d = 0; d < 2; d++) {
        e.low[d] = fmin(e.from[d], e.to[d]);
        e.high[d] = fmax(e.from[d], e.to[d]);
    }
    return e;
}

static void collect(const pia_trim *trim, edge *edges)
{
    for (pia_index l = 0; l < trim->loop_count; l++) {
        edge *first = edges;
        for (pia_index i = 0; i < trim->start[l + 1] - trim->start[l]; i++, edges++) {
            *edges = edge_of(trim, l, i);
            if (by_low_u(edges, first) < 0) first = edges;
        }
        first->is_first = 1;
    }
}

/* Twice the area of the triangle a b c, above 0 when it turns left. */
static double turn(const double *a, const double *b, const double *c)
{
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

static int on_opposite_sides(const double *a, const double *b, const double *p, const double *q)
{
    double left = turn(a, b, p), right = turn(a, b, q);
    return !((left > 0 && right > 0) || (left < 0 && right < 0));
}

/* Neighbours share a vertex: they meet elsewhere only when one runs back along the other. */
static int turns_back(const edge *first, const edge *second)
{
    const double *a = first->from, *b = first->to, *c = second->to;
    return turn(a, b, c) == 0 && (a[0] - b[0]) * (c[0] - b[0]) + (a[1] - b[1]) * (c[1] - b[1]) > 0;
}

static int meet(const edge *e, const edge *f)
{
    if (e->high[1] < f->low[1] || f->high[1] < e->low[1]) return 0;
    if (e->to == f->from) return turns_back(e, f);
    if (f->to == e->from) return turns_back(f, e);
    return on_opposite_sides(e->from, e->to, f->from, f->to) && on_opposite_sides(f->from, f->to, e->from, e->to);
}

/* Whether edge f passes below the point p: a ray from p downwards meets it. */
static int is_below(const edge *f, const double *p)
{
    int forth = f->from[0] < f->to[0];
    const double *left = forth ? f->from : f->to, *right = forth ? f->to : f->from;
    return left[0] < p[0] && p[0] <= right[0] && turn(left, right, p) > 0;
}

/* The ray from a point just outside a hole meets the other loops an odd number of times when it starts in the face. Islands in holes
 * and holes beside loop 0 have an even number, or lie in a hole that has. */
static pia_status check_place(pia_context *context, const edge *e, const edge *const *active, pia_index count)
{
    int odd = 0;
    const double *p = e->from[0] <= e->to[0] ? e->from : e->to;
    for (pia_index k = 0; k < count; k++)
        if (active[k]->loop != e->loop && is_below(active[k], p)) odd = !odd;
    if (odd == (e->loop > 0)) return PIA_OK;
    return pia_fail(
        context, PIA_E_DATA,
        "trim loop %lld is not a hole of its own in loop 0; give the outer boundary first, and islands as models of their own",
        (long long)e->loop);
}

static pia_status fail_meeting(pia_context *context, const edge *e, const edge *f)
{
    return pia_fail(
        context, PIA_E_DATA,
        "trim loop %lld, edge from vertex %lld (%.9g, %.9g), meets the edge of loop %lld from vertex %lld; loops may not cross "
        "or touch",
        (long long)e->loop, (long long)e->vertex, e->from[0], e->from[1], (long long)f->loop, (long long)f->vertex);
}

static pia_status sweep(pia_context *context, const edge *edges, pia_index count, const edge **active)
{
    pia_index kept = 0;
    for (const edge *e = edges; e < edges + count; e++) {
        pia_index still = 0;
        for (pia_index k = 0; k < kept; k++) {
            if (active[k]->high[0] < e->low[0]) continue;
            active[still++] = active[k];
            if (meet(e, active[k])) return fail_meeting(context, e, active[k]);
        }
        pia_status status = e->is_first ? check_place(context, e, active, still) : PIA_OK;
        if (status != PIA_OK) return status;
        active[still++] = e;
        kept = still;
    }
    return PIA_OK;
}

pia_status pia_trim_check(pia_context *context, const pia_trim *trim)
{
    pia_index count = trim->start[trim->loop_count];
    edge *edges = pia_take(context, count, sizeof *edges);
    if (edges == NULL) return pia_take_status(context, count, sizeof *edges);
    const edge **active = pia_take(context, count, sizeof *active);
    pia_status status = active != NULL ? PIA_OK : pia_take_status(context, count, sizeof *active);
    if (status == PIA_OK) {
        collect(trim, edges);
        qsort(edges, (size_t)count, sizeof *edges, by_low_u);
        status = sweep(context, edges, count, active);
    }
    pia_give(context, active);
    pia_give(context, edges);
    return status;
}
