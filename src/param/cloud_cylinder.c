#include "cloud_frame.h"

#include <math.h>
#include <string.h>

/* Roundness of the cloud seen along an axis: the variance of the distance to the best circle over its squared radius. */
static double roundness(const double *points, pia_index count, int dim, const double mean[3], double plane[3][3], double scale,
                        double centre[3])
{
    if (!pia_cloud_centre(points, count, dim, mean, plane, 2, scale, centre)) return INFINITY;
    double average = 0, square = 0;
    for (pia_index i = 0; i < count; i++) {
        double x = pia_cloud_along(points + i * dim, mean, plane[0]) - centre[0],
               y = pia_cloud_along(points + i * dim, mean, plane[1]) - centre[1];
        double r = hypot(x, y), change = r - average;
        average += change / (double)(i + 1);
        square += change * (r - average);
    }
    return average > 0 ? square / (double)count / (average * average) : INFINITY;
}

/* Around the principal axis about which the cloud is roundest: u the share of the turn, v the height. */
pia_status pia_cloud_by_cylinder(pia_context *context, const double *points, pia_index count, int dim, double *uv, int *closed)
{
    double mean[3], axes[3][3], spread[3], best = INFINITY, centre[3] = {0}, chosen[3][3] = {{0}};
    pia_cloud_axes(points, count, dim, mean, axes, spread);
    double scale = sqrt(spread[0] / (double)count);
    for (int axis = 0; axis < 3 && scale > 0; axis++) {
        double plane[3][3], try_centre[3] = {0};
        memcpy(plane[0], axes[(axis + 1) % 3], sizeof plane[0]);
        memcpy(plane[1], axes[(axis + 2) % 3], sizeof plane[1]);
        memcpy(plane[2], axes[axis], sizeof plane[2]);
        double round = roundness(points, count, dim, mean, plane, scale, try_centre);
        if (!(round < best)) continue;
        best = round;
        memcpy(centre, try_centre, sizeof centre);
        memcpy(chosen, plane, sizeof chosen);
    }
    if (isinf(best)) return pia_fail(context, PIA_E_DATA, "the points lie on no cylinder; use --param plane");
    double low = INFINITY, high = -INFINITY;
    for (pia_index i = 0; i < count; i++) {
        const double *p = points + i * dim;
        uv[2 * i] = pia_cloud_turn(pia_cloud_along(p, mean, chosen[1]) - centre[1], pia_cloud_along(p, mean, chosen[0]) - centre[0]);
        uv[2 * i + 1] = pia_cloud_along(p, mean, chosen[2]);
        low = fmin(low, uv[2 * i + 1]);
        high = fmax(high, uv[2 * i + 1]);
    }
    if (!(high > low))
        return pia_fail(context, PIA_E_DATA, "the points lie on a circle, not on a cylinder; take another parametrization");
    for (pia_index i = 0; i < count; i++) uv[2 * i + 1] = (uv[2 * i + 1] - low) / (high - low);
    *closed = pia_cloud_open_gap(uv, count);
    return PIA_OK;
}
