#include "cloud.h"

#include "cloud_frame.h"

#include <math.h>
#include <string.h>

static pia_status by_xy(pia_context *context, const double *points, pia_index count, int dim, double *uv, int *closed)
{
    *closed = 0;
    for (pia_index i = 0; i < count; i++) memcpy(uv + 2 * i, points + i * dim, 2 * sizeof *uv);
    return pia_cloud_to_unit(context, uv, count, "plane z = 0");
}

/* Area of the rectangle along two axes, turned by an angle, around every few of the points. */
static double box_area(const double *points, pia_index count, int dim, const double mean[3], double axes[3][3], double angle)
{
    enum { LOOKED_AT = 4000 };
    double c = cos(angle), s = sin(angle), low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY};
    for (pia_index i = 0; i < count; i += 1 + count / LOOKED_AT) {
        double x = pia_cloud_along(points + i * dim, mean, axes[0]), y = pia_cloud_along(points + i * dim, mean, axes[1]);
        const double turned[2] = {c * x + s * y, c * y - s * x};
        for (int d = 0; d < 2; d++) {
            low[d] = fmin(low[d], turned[d]);
            high[d] = fmax(high[d], turned[d]);
        }
    }
    return (high[0] - low[0]) * (high[1] - low[1]);
}

/* The principal axes of a square cloud are any; those of its smallest box leave fewer empty corners, and are taken when they save a
 * tenth. */
static void turn_to_box(const double *points, pia_index count, int dim, const double mean[3], double axes[3][3])
{
    enum { ANGLES = 36 };
    const double quarter = acos(0);
    double best = 0.9 * box_area(points, count, dim, mean, axes, 0), angle = 0;
    for (int k = 1; k < ANGLES; k++) {
        double area = box_area(points, count, dim, mean, axes, k * quarter / ANGLES);
        if (!(area < best)) continue;
        best = area;
        angle = k * quarter / ANGLES;
    }
    for (int e = 0; e < 3 && angle > 0; e++) {
        double x = axes[0][e], y = axes[1][e];
        axes[0][e] = cos(angle) * x + sin(angle) * y;
        axes[1][e] = cos(angle) * y - sin(angle) * x;
    }
}

static pia_status by_plane(pia_context *context, const double *points, pia_index count, int dim, double *uv, int *closed)
{
    *closed = 0;
    double mean[3], axes[3][3], spread[3];
    pia_cloud_axes(points, count, dim, mean, axes, spread);
    turn_to_box(points, count, dim, mean, axes);
    for (pia_index i = 0; i < count; i++)
        for (int d = 0; d < 2; d++) uv[2 * i + d] = pia_cloud_along(points + i * dim, mean, axes[d]);
    return pia_cloud_to_unit(context, uv, count, "best plane");
}

static const pia_cloud rule[] = {
    {"xy", "scattered points: u and v are x and y", NULL, "height data z over x, y", 2, by_xy},
    {"plane", "scattered points: projected onto their best plane", NULL, "principal axes", 3, by_plane},
    {"cylinder", "scattered points: turn and height about their best axis", NULL, "u is closed where the points go all the way round",
     3, pia_cloud_by_cylinder},
    {"sphere", "scattered points: longitude and latitude about their best centre, or a map of a dome", NULL,
     "poles where the points are not, or along their shortest axis; u is closed where the points go all the way round; "
     "more than half a sphere with a cap left free is a disc around its middle",
     3, pia_cloud_by_sphere},
};

const pia_cloud *pia_cloud_list(pia_index index)
{
    return index >= 0 && index < (pia_index)(sizeof rule / sizeof *rule) ? &rule[index] : NULL;
}

const pia_cloud *pia_cloud_find(const char *name)
{
    for (pia_index i = 0; pia_cloud_list(i) != NULL; i++)
        if (strcmp(rule[i].name, name) == 0) return &rule[i];
    return NULL;
}
