#include "polygon.h"

#include <math.h>

int pia_polygon_closed(const pia_iterate *iterate)
{
    return iterate->op->line[0]->map == PIA_MAP_CYCLIC;
}

pia_status pia_polygon_check(const pia_iterate *iterate, const char *limiter)
{
    if (iterate->op->directions == 1 && iterate->dim == 2) return PIA_OK;
    return pia_fail(iterate->context, PIA_E_ARGUMENT, "limiter %s guards planar curves; these data make a %s of dimension %d", limiter,
                    iterate->op->directions == 1 ? "curve" : "surface", iterate->dim);
}

pia_index pia_polygon_vertex(const pia_iterate *iterate, pia_index i)
{
    pia_index n = iterate->op->cols;
    return pia_polygon_closed(iterate) ? (i % n + n) % n : i;
}

void pia_polygon_turns(const pia_iterate *iterate, pia_index *first, pia_index *end)
{
    *first = pia_polygon_closed(iterate) ? 0 : 1;
    *end = pia_polygon_closed(iterate) ? iterate->op->cols : iterate->op->cols - 1;
}

void pia_polygon_point(const pia_iterate *iterate, const double *scale, pia_index i, double xy[2])
{
    pia_index v = pia_polygon_vertex(iterate, i);
    for (int d = 0; d < 2; d++) xy[d] = iterate->points[2 * v + d] + (scale != NULL ? scale[v] * iterate->adjust[2 * v + d] : 0);
}

static double cross_of(const pia_iterate *iterate, const double *scale, pia_index i, double *lengths)
{
    double a[2], b[2], c[2];
    pia_polygon_point(iterate, scale, i - 1, a);
    pia_polygon_point(iterate, scale, i, b);
    pia_polygon_point(iterate, scale, i + 1, c);
    double ux = b[0] - a[0], uy = b[1] - a[1], vx = c[0] - b[0], vy = c[1] - b[1];
    *lengths = hypot(ux, uy) * hypot(vx, vy);
    return ux * vy - uy * vx;
}

double pia_polygon_orientation(const pia_iterate *iterate, const double *scale, pia_index i)
{
    double lengths;
    return cross_of(iterate, scale, i, &lengths);
}

int pia_polygon_sign(const pia_iterate *iterate, const double *scale, pia_index i)
{
    double lengths, cross = cross_of(iterate, scale, i, &lengths);
    return fabs(cross) <= 1e-12 * lengths ? 0 : cross > 0 ? 1 : -1;
}

void pia_polygon_shorten(pia_iterate *iterate, const double *scale, double delta)
{
    double asked = pia_iterate_longest(iterate, iterate->adjust);
    iterate->shortened = 0;
    for (pia_index i = 0; i < iterate->op->cols; i++) {
        for (int d = 0; d < 2; d++) iterate->adjust[2 * i + d] *= scale[i];
        iterate->shortened |= scale[i] < 1;
    }
    iterate->stalled = asked >= delta && pia_iterate_longest(iterate, iterate->adjust) < delta;
}
