/* [2023] section 4.4 as printed: control points move one after the other; a step that meets one of two rays around the edge before it
 * (case a) or of two rays around the edge after it (case b) ends at alpha of the way to the first of them. The end points are free, and
 * the cases are no mirror images of each other, so that the control polygon may gain inflections: `inflection` does not. */
#include "limit.h"
#include "polygon.h"

#include <math.h>

enum { ALPHA, DELTA };

typedef struct paper {
    double alpha, delta;
    double *scale; /* [cols] */
} paper;

static pia_status begin(pia_iterate *iterate, const pia_values *values, void *state)
{
    paper *s = state;
    s->alpha = values->number[ALPHA];
    s->delta = values->is_word[DELTA] ? 1e-9 * iterate->extent : values->number[DELTA];
    s->scale = pia_take(iterate->context, iterate->op->cols, sizeof *s->scale);
    return s->scale != NULL ? pia_polygon_check(iterate, "inflection-paper") : PIA_E_MEMORY;
}

static double cross(const double a[2], const double b[2])
{
    return a[0] * b[1] - a[1] * b[0];
}

/* Where on the step of vertex i, as a factor in [0, 1], it meets the ray from vertex `from` along the edge from vertex a to vertex b;
 * INFINITY when it does not. */
static double meeting(const pia_iterate *iterate, const double *scale, pia_index i, pia_index from, pia_index a, pia_index b)
{
    const double *step = iterate->adjust + 2 * pia_polygon_vertex(iterate, i);
    double here[2], origin[2], tail[2], tip[2], ray[2], way[2];
    pia_polygon_point(iterate, scale, i, here);
    pia_polygon_point(iterate, scale, from, origin);
    pia_polygon_point(iterate, scale, a, tail);
    pia_polygon_point(iterate, scale, b, tip);
    for (int d = 0; d < 2; d++) {
        ray[d] = tip[d] - tail[d];
        way[d] = origin[d] - here[d];
    }
    double both = cross(step, ray);
    if (both == 0) return INFINITY;
    double on_step = cross(way, ray) / both, on_ray = cross(way, step) / both;
    return on_step >= 0 && on_step <= 1 && on_ray >= 0 ? on_step : INFINITY;
}

static double nearest_ray(const pia_iterate *iterate, const double *scale, pia_index i)
{
    int closed = pia_polygon_closed(iterate);
    double nearest = INFINITY;
    if (closed || i >= 2) {
        nearest = fmin(nearest, meeting(iterate, scale, i, i - 1, i - 1, i + 1));
        nearest = fmin(nearest, meeting(iterate, scale, i, i - 1, i - 1, i - 2));
    }
    if (closed || i + 2 < iterate->op->cols) {
        nearest = fmin(nearest, meeting(iterate, scale, i, i + 1, i + 1, i - 1));
        nearest = fmin(nearest, meeting(iterate, scale, i, i + 1, i + 2, i + 1));
    }
    return nearest;
}

static pia_status limit(pia_iterate *iterate, void *state)
{
    paper *s = state;
    pia_index n = iterate->op->cols, first, end;
    pia_polygon_turns(iterate, &first, &end);
    for (pia_index i = 0; i < n; i++) s->scale[i] = 0;
    for (pia_index i = 0; i < n; i++) {
        double nearest = i >= first && i < end ? nearest_ray(iterate, s->scale, i) : INFINITY;
        s->scale[i] = isinf(nearest) ? 1 : s->alpha * nearest;
    }
    pia_polygon_shorten(iterate, s->scale, s->delta);
    return PIA_OK;
}

static void end(pia_iterate *iterate, void *state)
{
    pia_give(iterate->context, ((paper *)state)->scale);
}

static const pia_parameter parameters[] = {
    {"alpha", NULL, "0.8", 1e-6, 1, "share of the way to the nearest ray that a step may go"},
    {"delta", "auto|number", "auto", 0, 1e300, "steps below this count as none, units of the points; auto is 1e-9 of the extent"},
    {0}};

const pia_limiter pia_limit_inflection_paper = {
    .name = "inflection-paper",
    .title = "inflections of the control polygon guarded as printed in 2023",
    .reference = "chang2023",
    .detail = "planar curves; may add inflections, which inflection never does",
    .parameters = parameters,
    .state_size = sizeof(paper),
    .begin = begin,
    .limit = limit,
    .end = end,
};
