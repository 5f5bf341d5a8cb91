#include "cloud_frame.h"

#include <math.h>
#include <string.h>

/* Turns the axes such that the first is `side`, a unit vector in them, and the third across it and as near to the old third as that
 * allows. */
static void turn_first_to(const double side[3], double axes[3][3])
{
    int across = fabs(side[2]) > 0.9 ? 1 : 2;
    double pole[3] = {0}, turned[3][3], size = 0;
    pole[across] = 1;
    for (int d = 0; d < 3; d++) {
        pole[d] -= side[d] * side[across];
        size += pole[d] * pole[d];
    }
    for (int d = 0; d < 3; d++) pole[d] /= sqrt(size);
    const double third[3] = {pole[1] * side[2] - pole[2] * side[1], pole[2] * side[0] - pole[0] * side[2],
                             pole[0] * side[1] - pole[1] * side[0]};
    for (int e = 0; e < 3; e++) {
        turned[0][e] = turned[1][e] = turned[2][e] = 0;
        for (int d = 0; d < 3; d++) {
            turned[0][e] += side[d] * axes[d][e];
            turned[1][e] += third[d] * axes[d][e];
            turned[2][e] += pole[d] * axes[d][e];
        }
    }
    memcpy(axes, turned, sizeof turned);
}

/* Where the points cover one side of the sphere, that is where the first axis goes, and the poles across it, where the points reach
 * least far. */
static void turn_to_side(const double centre[3], double radius, double axes[3][3])
{
    double length = hypot(hypot(centre[0], centre[1]), centre[2]);
    if (!(length > radius / 4)) return;
    const double side[3] = {-centre[0] / length, -centre[1] / length, -centre[2] / length};
    turn_first_to(side, axes);
}

enum { LOOKED_AT = 4000, LOOKS = 1000 };

/* Every few of the points, as directions from the middle in the axes. Returns how many. */
static pia_index look(const double *points, pia_index count, int dim, const double middle[3], double axes[3][3], double (*seen)[3])
{
    pia_index n = 0;
    for (pia_index i = 0; i < count; i += 1 + count / LOOKED_AT) {
        double size = 0;
        for (int d = 0; d < 3; d++) {
            seen[n][d] = pia_cloud_along(points + i * dim, middle, axes[d]);
            size = hypot(size, seen[n][d]);
        }
        for (int d = 0; d < 3 && size > 0; d++) seen[n][d] /= size;
        n += size > 0;
    }
    return n;
}

/* Angle from a direction to the nearest one seen. */
static double room(const double direction[3], double (*seen)[3], pia_index count)
{
    double nearest = -1;
    for (pia_index i = 0; i < count; i++)
        nearest = fmax(nearest, direction[0] * seen[i][0] + direction[1] * seen[i][1] + direction[2] * seen[i][2]);
    return acos(fmin(nearest, 1));
}

/* The middle of the widest cap without points, among directions evenly spread on a spiral; returns its angular radius. */
static double widest_hole(double (*seen)[3], pia_index count, double hole[3])
{
    const double golden_angle = acos(-1) * (3 - sqrt(5));
    double widest = 0;
    for (int k = 0; k < LOOKS; k++) {
        double z = 1 - (2 * k + 1.0) / LOOKS, r = sqrt(1 - z * z);
        const double direction[3] = {r * cos(k * golden_angle), r * sin(k * golden_angle), z};
        double radius = room(direction, seen, count);
        if (!(radius > widest)) continue;
        widest = radius;
        memcpy(hole, direction, 3 * sizeof *hole);
    }
    return widest;
}

/* Whether there are points at a pole, where longitude means nothing, and opposite of where to look at them instead: the middle of a
 * hole wide enough that the map of the rest, whose rim it becomes, is not torn too far apart. */
static int sees_pole(double (*seen)[3], pia_index count, double hole[3])
{
    const double degree = acos(-1) / 180, pole[2][3] = {{0, 0, 1}, {0, 0, -1}};
    const double near = fmin(room(pole[0], seen, count), room(pole[1], seen, count));
    return near < 30 * degree && widest_hole(seen, count, hole) > 30 * degree;
}

/* Longitude and latitude, from the two ends of the third axis. */
static pia_status map_turns(const double *points, pia_index count, int dim, const double middle[3], double axes[3][3], double *uv,
                            int *closed)
{
    for (pia_index i = 0; i < count; i++) {
        double x[3];
        for (int d = 0; d < 3; d++) x[d] = pia_cloud_along(points + i * dim, middle, axes[d]);
        uv[2 * i] = pia_cloud_turn(x[1], x[0]);
        uv[2 * i + 1] = 0.5 + atan2(x[2], hypot(x[0], x[1])) / acos(-1);
    }
    *closed = pia_cloud_open_gap(uv, count);
    return PIA_OK;
}

/* Direction and angle from the point opposite of the first axis, as polar coordinates: no pole among the points. */
static pia_status map_disc(pia_context *context, const double *points, pia_index count, int dim, const double middle[3],
                           double axes[3][3], double *uv, int *closed)
{
    for (pia_index i = 0; i < count; i++) {
        double x[3];
        for (int d = 0; d < 3; d++) x[d] = pia_cloud_along(points + i * dim, middle, axes[d]);
        double across = hypot(x[1], x[2]), stretch = across > 0 ? atan2(across, -x[0]) / across : 0;
        for (int d = 0; d < 2; d++) uv[2 * i + d] = stretch * x[1 + d];
    }
    *closed = 0;
    return pia_cloud_to_unit(context, uv, count, "sphere");
}

/* Around the centre of the best sphere. */
pia_status pia_cloud_by_sphere(pia_context *context, const double *points, pia_index count, int dim, double *uv, int *closed)
{
    double mean[3], axes[3][3], spread[3], centre[3], middle[3], radius = 0, hole[3];
    pia_cloud_axes(points, count, dim, mean, axes, spread);
    double scale = sqrt(spread[0] / (double)count);
    if (!(scale > 0) || !pia_cloud_centre(points, count, dim, mean, axes, 3, scale, centre))
        return pia_fail(context, PIA_E_DATA, "the points lie on no sphere; use --param plane");
    for (int e = 0; e < 3; e++) middle[e] = mean[e] + centre[0] * axes[0][e] + centre[1] * axes[1][e] + centre[2] * axes[2][e];
    for (pia_index i = 0; i < count; i++) {
        const double *p = points + i * dim;
        radius += hypot(hypot(p[0] - middle[0], p[1] - middle[1]), p[2] - middle[2]) / (double)count;
    }
    turn_to_side(centre, radius, axes);
    double(*seen)[3] = pia_take(context, LOOKED_AT + 1, sizeof *seen);
    if (seen == NULL) return PIA_E_MEMORY;
    int disc = sees_pole(seen, look(points, count, dim, middle, axes, seen), hole);
    pia_give(context, seen);
    if (!disc) return map_turns(points, count, dim, middle, axes, uv, closed);
    turn_first_to(hole, axes);
    return map_disc(context, points, count, dim, middle, axes, uv, closed);
}
