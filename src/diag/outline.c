#include "outline.h"

#include "hull.h"
#include "spanning_tree.h"

#include <math.h>
#include <string.h>

enum { LEAST_NODES = 300, MOST_NODES = 1000, LOOKED_AT = 20000 };

/* The raster of the domain, in lengths of space, and what is known at its nodes. */
typedef struct map {
    pia_raster raster; /* with `pad` nodes around the domain */
    pia_index pad[2];
    double *square; /* [nodes] */
} map;

/* ---- the radius ---- */

static pia_status choose_radius(pia_context *context, const pia_outline_problem *p, double *radius)
{
    pia_index every = (p->count + LOOKED_AT - 1) / LOOKED_AT, count = (p->count + every - 1) / every;
    pia_tree_edge *edge = NULL;
    double *at = pia_take(context, 2 * count, sizeof *at);
    if (at == NULL) return pia_take_status(context, 2 * count, sizeof *at);
    for (pia_index i = 0; i < 2 * count; i++) at[i] = p->uv[2 * every * (i / 2) + i % 2] * p->scale[i % 2];
    pia_status status = pia_spanning_tree(context, at, count, 2, &edge);
    if (status == PIA_OK) *radius = count > 1 ? 1.5 * edge[(pia_index)(0.995 * (double)(count - 2))].length / sqrt((double)every) : 0;
    pia_give(context, edge);
    pia_give(context, at);
    return status;
}

/* ---- the raster ---- */

static double extent_of(const pia_outline_problem *p, int d)
{
    return (p->domain[d][1] - p->domain[d][0]) * p->scale[d];
}

/* Border nodes lie on the border of the domain. */
static pia_status open_map(pia_context *context, const pia_outline_problem *p, double radius, map *out)
{
    pia_index nodes;
    *out = (map){.square = NULL};
    for (int d = 0; d < 2; d++) {
        double extent = extent_of(p, d), spans = ceil(extent / (radius / 8));
        spans = fmin(fmax(spans, LEAST_NODES), MOST_NODES);
        out->raster.step[d] = extent / spans;
        out->pad[d] = (pia_index)fmin(ceil(radius / out->raster.step[d]) + 2, 2 * MOST_NODES);
        out->raster.count[d] = (pia_index)spans + 1 + 2 * out->pad[d];
    }
    if (!pia_multiply(out->raster.count[0], out->raster.count[1], &nodes))
        return pia_fail(context, PIA_E_SIZE, "the raster is too large");
    out->square = pia_take(context, nodes, sizeof *out->square);
    return out->square != NULL ? PIA_OK : pia_take_status(context, nodes, sizeof *out->square);
}

static pia_index node_of(const pia_outline_problem *p, const map *m, int d, double t)
{
    return m->pad[d] + (pia_index)floor((t - p->domain[d][0]) * p->scale[d] / m->raster.step[d] + 0.5);
}

/* Sites: nodes of the points, and of their copies beyond the seam of a closed direction. */
static void mark_points(const pia_outline_problem *p, map *m)
{
    const pia_index *count = m->raster.count;
    for (pia_index i = 0; i < count[0] * count[1]; i++) m->square[i] = INFINITY;
    for (pia_index row = 0; row < p->count; row++)
        for (int u = -p->closed[0]; u <= p->closed[0]; u++)
            for (int v = -p->closed[1]; v <= p->closed[1]; v++) {
                pia_index i = node_of(p, m, 0, p->uv[2 * row] + u * (p->domain[0][1] - p->domain[0][0]));
                pia_index j = node_of(p, m, 1, p->uv[2 * row + 1] + v * (p->domain[1][1] - p->domain[1][0]));
                if (i >= 0 && i < count[0] && j >= 0 && j < count[1]) m->square[i * count[1] + j] = 0;
            }
}

/* In steps of the raster. A point is up to 0.71 of one from the node that stands for it, contours are straight in a cell, and
 * simplified loops cut off what is to spare: with this margin the points at the border stay inside. */
static const double MARGIN = 1.7, SPARE = 0.65;

static double step_of(const map *m)
{
    return fmax(m->raster.step[0], m->raster.step[1]);
}

/* Closing: farther than a radius from all points is outside, and what is farther than a radius from all of that is inside. `square`
 * becomes how far inside a node is. */
static pia_status close_gaps(pia_context *context, map *m, double radius)
{
    pia_index nodes = m->raster.count[0] * m->raster.count[1];
    pia_status status = pia_distance_map(context, &m->raster, m->square);
    if (status != PIA_OK) return status;
    for (pia_index i = 0; i < nodes; i++) m->square[i] = m->square[i] > radius * radius ? 0 : INFINITY;
    status = pia_distance_map(context, &m->raster, m->square);
    for (pia_index i = 0; i < nodes && status == PIA_OK; i++) m->square[i] = sqrt(m->square[i]) - radius + MARGIN * step_of(m);
    return status;
}

/* Only the domain, moved to the beginning of the array. */
static pia_raster cut_to_domain(map *m)
{
    pia_raster domain = m->raster;
    for (int d = 0; d < 2; d++) domain.count[d] -= 2 * m->pad[d];
    for (pia_index i = 0; i < domain.count[0]; i++)
        memmove(m->square + i * domain.count[1], m->square + (i + m->pad[0]) * m->raster.count[1] + m->pad[1],
                (size_t)domain.count[1] * sizeof *m->square);
    return domain;
}

/* ---- islands ---- */

/* island [nodes]: the number from 1 of the island a node inside is in, 0 outside; neighbours only, as the contours have it. */
static pia_index number_islands(const pia_raster *r, const double *value, int32_t *island, pia_index *stack)
{
    static const int step[4][2] = {{0, 1}, {0, -1}, {1, 0}, {-1, 0}};
    pia_index islands = 0, nodes = r->count[0] * r->count[1];
    memset(island, 0, (size_t)nodes * sizeof *island);
    for (pia_index seed = 0; seed < nodes; seed++) {
        if (!(value[seed] > 0) || island[seed] != 0) continue;
        pia_index depth = 0;
        island[seed] = (int32_t)++islands;
        stack[depth++] = seed;
        while (depth > 0) {
            pia_index node = stack[--depth];
            for (int k = 0; k < 4; k++) {
                pia_index i = node / r->count[1] + step[k][0], j = node % r->count[1] + step[k][1], next = i * r->count[1] + j;
                if (i < 0 || i >= r->count[0] || j < 0 || j >= r->count[1] || !(value[next] > 0) || island[next] != 0) continue;
                island[next] = (int32_t)islands;
                stack[depth++] = next;
            }
        }
    }
    return islands;
}

static pia_index island_of(const pia_outline_problem *p, const map *m, const pia_raster *r, const int32_t *island, pia_index row)
{
    pia_index i = node_of(p, m, 0, p->uv[2 * row]) - m->pad[0], j = node_of(p, m, 1, p->uv[2 * row + 1]) - m->pad[1];
    return i >= 0 && i < r->count[0] && j >= 0 && j < r->count[1] ? island[i * r->count[1] + j] : 0;
}

/* Leaves the island with the most points. *whole: it is the whole domain. */
static pia_status keep_largest(pia_context *context, const pia_outline_problem *p, const map *m, const pia_raster *r,
                               pia_index *outside, int *whole)
{
    pia_index nodes = r->count[0] * r->count[1], largest = 0, *points = NULL;
    int32_t *island = pia_take(context, nodes, sizeof *island);
    pia_index *stack = pia_take(context, nodes, sizeof *stack);
    pia_status status = island != NULL && stack != NULL ? PIA_OK : pia_take_status(context, nodes, sizeof *stack);
    if (status == PIA_OK) {
        pia_index islands = number_islands(r, m->square, island, stack);
        points = pia_take_zero(context, islands + 1, sizeof *points);
        if (points == NULL) status = pia_take_status(context, islands + 1, sizeof *points);
        for (pia_index row = 0; row < p->count && status == PIA_OK; row++) points[island_of(p, m, r, island, row)]++;
        for (pia_index k = 1; k <= islands && status == PIA_OK; k++)
            if (largest == 0 || points[k] > points[largest]) largest = k;
    }
    if (status == PIA_OK) {
        *outside = p->count - points[largest];
        *whole = 1;
        for (pia_index i = 0; i < nodes; i++)
            if (largest == 0 || island[i] != largest) {
                m->square[i] = -1; /* beside an island that is left out, values are as small as elsewhere outside */
                *whole = 0;
            }
    }
    pia_give(context, island);
    pia_give(context, stack);
    pia_give(context, points);
    return status;
}

/* ---- loops ---- */

/* The loop outside to the front. */
static pia_status put_first(pia_context *context, pia_loops *loops)
{
    pia_index at = 0, outer = 0, begin = 0;
    double most = -INFINITY;
    for (pia_index k = 0; k < loops->loop_count; at += loops->vertex_count[k++]) {
        double area = pia_loop_area(loops->at + 2 * at, loops->vertex_count[k]);
        if (!(area > most)) continue;
        most = area;
        outer = k;
        begin = at;
    }
    pia_index size = loops->loop_count > 0 ? loops->vertex_count[outer] : 0;
    double *copy = pia_take(context, 2 * size, sizeof *copy);
    if (copy == NULL) return pia_take_status(context, 2 * size, sizeof *copy);
    memcpy(copy, loops->at + 2 * begin, (size_t)(2 * size) * sizeof *copy);
    memmove(loops->at + 2 * size, loops->at, (size_t)(2 * begin) * sizeof *copy);
    memcpy(loops->at, copy, (size_t)(2 * size) * sizeof *copy);
    for (pia_index k = outer; k > 0; k--) loops->vertex_count[k] = loops->vertex_count[k - 1];
    if (loops->loop_count > 0) loops->vertex_count[0] = size;
    pia_give(context, copy);
    return PIA_OK;
}

/* From lengths into the domain. */
static void into_domain(const pia_outline_problem *p, pia_loops *loops)
{
    for (pia_index i = 0; i < 2 * loops->vertex_total; i++) {
        const double *domain = p->domain[i % 2];
        loops->at[i] = fmin(fmax(domain[0] + loops->at[i] / p->scale[i % 2], domain[0]), domain[1]);
    }
}

static pia_status find_shape(pia_context *context, const pia_outline_problem *p, pia_outline *out)
{
    map m = {.square = NULL};
    int whole = 0;
    pia_raster domain;
    double radius = p->radius;
    pia_status status = radius > 0 ? PIA_OK : choose_radius(context, p, &radius);
    if (status != PIA_OK) return status;
    radius = fmax(radius, 2.5 * fmax(extent_of(p, 0), extent_of(p, 1)) / MOST_NODES);
    status = open_map(context, p, radius, &m);
    if (status == PIA_OK) {
        mark_points(p, &m);
        status = close_gaps(context, &m, radius);
    }
    if (status == PIA_OK) {
        domain = cut_to_domain(&m);
        status = keep_largest(context, p, &m, &domain, &out->outside, &whole);
    }
    if (status == PIA_OK && !whole) status = pia_contour(context, &domain, m.square, &out->loops);
    if (status == PIA_OK && !whole) status = put_first(context, &out->loops);
    out->radius = radius;
    out->coarseness = SPARE * step_of(&m);
    pia_give(context, m.square);
    return status;
}

static pia_status find_hull(pia_context *context, const pia_outline_problem *p, pia_outline *out)
{
    double *at = pia_take(context, 2 * p->count, sizeof *at);
    pia_index count, *vertices = pia_take(context, 1, sizeof *vertices);
    if (at == NULL || vertices == NULL) {
        pia_give(context, at);
        pia_give(context, vertices);
        return pia_take_status(context, 2 * p->count, sizeof *at);
    }
    for (pia_index i = 0; i < 2 * p->count; i++) at[i] = (p->uv[i] - p->domain[i % 2][0]) * p->scale[i % 2];
    pia_status status = pia_hull(context, at, p->count, &count);
    *vertices = count;
    out->loops = (pia_loops){
        .loop_count = 1, .loop_room = 1, .vertex_count = vertices, .at = at, .vertex_total = count, .vertex_room = p->count};
    return status;
}

pia_status pia_outline_find(pia_context *context, const pia_outline_problem *problem, pia_outline *out)
{
    pia_outline outline = {.radius = 0};
    pia_status status = problem->hull ? find_hull(context, problem, &outline) : find_shape(context, problem, &outline);
    if (status == PIA_OK) {
        into_domain(problem, &outline.loops);
        *out = outline;
    } else {
        pia_loops_clear(context, &outline.loops);
    }
    return status;
}
