#include "cloud.h"

#include <math.h>
#include <string.h>

/* Both columns of uv to [0, 1] by their ranges; names are for the message. */
static pia_status to_unit(pia_context *context, double *uv, pia_index count, const char *surface)
{
    for (int d = 0; d < 2; d++) {
        double low = INFINITY, high = -INFINITY;
        for (pia_index i = 0; i < count; i++) {
            low = fmin(low, uv[2 * i + d]);
            high = fmax(high, uv[2 * i + d]);
        }
        if (!(high > low)) return pia_fail(context, PIA_E_DATA, "all points lie on one line of the %s; a surface needs more", surface);
        for (pia_index i = 0; i < count; i++) uv[2 * i + d] = (uv[2 * i + d] - low) / (high - low);
    }
    return PIA_OK;
}

static pia_status by_xy(pia_context *context, const double *points, pia_index count, int dim, double *uv, int *closed)
{
    *closed = 0;
    for (pia_index i = 0; i < count; i++) memcpy(uv + 2 * i, points + i * dim, 2 * sizeof *uv);
    return to_unit(context, uv, count, "plane z = 0");
}

/* Eigenvectors (rows, falling eigenvalues) of a symmetric 3 x 3 matrix, by Jacobi rotations. */
static void eigenvectors(double a[3][3], double vectors[3][3], double values[3])
{
    double v[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    for (int sweep = 0; sweep < 30; sweep++)
        for (int p = 0; p < 2; p++)
            for (int q = p + 1; q < 3; q++) {
                if (a[p][q] == 0) continue;
                double theta = (a[q][q] - a[p][p]) / (2 * a[p][q]);
                double t = (theta >= 0 ? 1 : -1) / (fabs(theta) + sqrt(theta * theta + 1)), c = 1 / sqrt(t * t + 1), s = t * c;
                for (int k = 0; k < 3; k++) {
                    double x = a[k][p], y = a[k][q];
                    a[k][p] = c * x - s * y;
                    a[k][q] = s * x + c * y;
                }
                for (int k = 0; k < 3; k++) {
                    double x = a[p][k], y = a[q][k], z = v[p][k], w = v[q][k];
                    a[p][k] = c * x - s * y;
                    a[q][k] = s * x + c * y;
                    v[p][k] = c * z - s * w;
                    v[q][k] = s * z + c * w;
                }
            }
    int order[3] = {0, 1, 2};
    for (int i = 0; i < 2; i++)
        for (int j = i + 1; j < 3; j++)
            if (a[order[j]][order[j]] > a[order[i]][order[i]]) {
                int swap = order[i];
                order[i] = order[j];
                order[j] = swap;
            }
    for (int i = 0; i < 3; i++) {
        values[i] = a[order[i]][order[i]];
        memcpy(vectors[i], v[order[i]], sizeof vectors[i]);
    }
}

/* Mean and principal axes of the first three components, longest first. */
static void principal_axes(const double *points, pia_index count, int dim, double mean[3], double axes[3][3], double spread[3])
{
    double a[3][3] = {{0}};
    memset(mean, 0, 3 * sizeof *mean);
    for (pia_index i = 0; i < count; i++)
        for (int d = 0; d < 3; d++) mean[d] += (points[i * dim + d] - mean[d]) / (double)(i + 1);
    for (pia_index i = 0; i < count; i++)
        for (int d = 0; d < 3; d++)
            for (int e = 0; e < 3; e++) a[d][e] += (points[i * dim + d] - mean[d]) * (points[i * dim + e] - mean[e]);
    eigenvectors(a, axes, spread);
}

static double along(const double *point, const double mean[3], const double axis[3])
{
    return (point[0] - mean[0]) * axis[0] + (point[1] - mean[1]) * axis[1] + (point[2] - mean[2]) * axis[2];
}

/* Area of the rectangle along two axes, turned by an angle, around every few of the points. */
static double box_area(const double *points, pia_index count, int dim, const double mean[3], double axes[3][3], double angle)
{
    enum { LOOKED_AT = 4000 };
    double c = cos(angle), s = sin(angle), low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY};
    for (pia_index i = 0; i < count; i += 1 + count / LOOKED_AT) {
        double x = along(points + i * dim, mean, axes[0]), y = along(points + i * dim, mean, axes[1]);
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
    principal_axes(points, count, dim, mean, axes, spread);
    turn_to_box(points, count, dim, mean, axes);
    for (pia_index i = 0; i < count; i++)
        for (int d = 0; d < 2; d++) uv[2 * i + d] = along(points + i * dim, mean, axes[d]);
    return to_unit(context, uv, count, "best plane");
}

/* The solution of a symmetric positive definite 4 x 4 system, by elimination; 0 when singular. */
static int solve4(double a[4][5])
{
    for (int k = 0; k < 4; k++) {
        int pivot = k;
        for (int i = k + 1; i < 4; i++)
            if (fabs(a[i][k]) > fabs(a[pivot][k])) pivot = i;
        if (!(fabs(a[pivot][k]) > 1e-12)) return 0;
        for (int j = 0; j < 5; j++) {
            double swap = a[k][j];
            a[k][j] = a[pivot][j];
            a[pivot][j] = swap;
        }
        for (int i = 0; i < 4; i++) {
            double factor = i == k ? 0 : a[i][k] / a[k][k];
            for (int j = k; j < 5; j++) a[i][j] -= factor * a[k][j];
        }
    }
    return 1;
}

/* The centre of the circle or sphere that fits best algebraically (Kasa): |x|^2 = 2 c . x + k, in coordinates relative to the mean and
 * scaled to size one. axes: the directions that count, `count_axes` of them. */
static int best_centre(const double *points, pia_index count, int dim, const double mean[3], double axes[3][3], int count_axes,
                       double scale, double centre[3])
{
    double a[4][5] = {{0}};
    for (pia_index i = 0; i < count; i++) {
        double x[4] = {0, 0, 0, 1}, square = 0;
        for (int d = 0; d < count_axes; d++) {
            x[d] = along(points + i * dim, mean, axes[d]) / scale;
            square += x[d] * x[d];
        }
        for (int r = 0; r < 4; r++) {
            for (int c = 0; c < 4; c++) a[r][c] += x[r] * x[c] / (double)count;
            a[r][4] += x[r] * square / (double)count;
        }
    }
    for (int d = count_axes; d < 3; d++) a[d][d] = 1;
    if (!solve4(a)) return 0;
    for (int d = 0; d < 3; d++) centre[d] = d < count_axes ? scale * a[d][4] / a[d][d] / 2 : 0;
    return 1;
}

static double turn_share(double y, double x)
{
    double share = atan2(y, x) / (2 * acos(-1));
    share -= floor(share);
    return share < 1 ? share : 0;
}

/* Turns in [0, 1) whose largest gap is a sixteenth or more are opened there and stretched to [0, 1]. Returns 1 when they are closed. */
static int open_gap(double *uv, pia_index count)
{
    enum { BINS = 64, WIDE = BINS / 16 };
    int hit[BINS] = {0}, longest = 0, end = 0;
    for (pia_index i = 0; i < count; i++) hit[(int)(uv[2 * i] * BINS)] = 1;
    for (int start = 0; start < BINS; start++) {
        int length = 0;
        while (length < BINS && !hit[(start + length) % BINS]) length++;
        if (length <= longest) continue;
        longest = length;
        end = (start + length) % BINS;
    }
    if (longest < WIDE) return 1;
    double low = INFINITY, high = -INFINITY;
    for (pia_index i = 0; i < count; i++) {
        double *u = &uv[2 * i];
        *u -= (double)end / BINS;
        *u -= floor(*u);
        low = fmin(low, *u);
        high = fmax(high, *u);
    }
    for (pia_index i = 0; i < count && high > low; i++) uv[2 * i] = (uv[2 * i] - low) / (high - low);
    return 0;
}

/* Roundness of the cloud seen along an axis: the variance of the distance to the best circle over its squared radius. */
static double roundness(const double *points, pia_index count, int dim, const double mean[3], double plane[3][3], double scale,
                        double centre[3])
{
    if (!best_centre(points, count, dim, mean, plane, 2, scale, centre)) return INFINITY;
    double average = 0, square = 0;
    for (pia_index i = 0; i < count; i++) {
        double x = along(points + i * dim, mean, plane[0]) - centre[0], y = along(points + i * dim, mean, plane[1]) - centre[1];
        double r = hypot(x, y), change = r - average;
        average += change / (double)(i + 1);
        square += change * (r - average);
    }
    return average > 0 ? square / (double)count / (average * average) : INFINITY;
}

/* Around the principal axis about which the cloud is roundest: u the share of the turn, v the height. */
static pia_status by_cylinder(pia_context *context, const double *points, pia_index count, int dim, double *uv, int *closed)
{
    double mean[3], axes[3][3], spread[3], best = INFINITY, centre[3] = {0}, chosen[3][3] = {{0}};
    principal_axes(points, count, dim, mean, axes, spread);
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
        uv[2 * i] = turn_share(along(p, mean, chosen[1]) - centre[1], along(p, mean, chosen[0]) - centre[0]);
        uv[2 * i + 1] = along(p, mean, chosen[2]);
        low = fmin(low, uv[2 * i + 1]);
        high = fmax(high, uv[2 * i + 1]);
    }
    if (!(high > low)) return pia_fail(context, PIA_E_DATA, "the points lie on a circle, not on a cylinder");
    for (pia_index i = 0; i < count; i++) uv[2 * i + 1] = (uv[2 * i + 1] - low) / (high - low);
    *closed = open_gap(uv, count);
    return PIA_OK;
}

/* Where the points cover one side of the sphere, the poles go to where they are not: `axes` become two of the equator, the first
 * towards the points, and the poles, across which the points reach least far. */
static void turn_to_side(const double centre[3], double radius, double axes[3][3])
{
    double side[3] = {-centre[0], -centre[1], -centre[2]}, length = sqrt(side[0] * side[0] + side[1] * side[1] + side[2] * side[2]);
    if (!(length > radius / 4)) return;
    int across = fabs(side[2]) > 0.9 * length ? 1 : 2;
    double pole[3] = {0}, turned[3][3], size = 0;
    pole[across] = 1;
    for (int d = 0; d < 3; d++) {
        side[d] /= length;
        pole[d] -= side[d] * (-centre[across] / length);
        size += pole[d] * pole[d];
    }
    for (int d = 0; d < 3; d++) pole[d] /= sqrt(size);
    double third[3] = {pole[1] * side[2] - pole[2] * side[1], pole[2] * side[0] - pole[0] * side[2],
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

/* Around the centre of the best sphere: u the share of the turn, v the height as an angle. */
static pia_status by_sphere(pia_context *context, const double *points, pia_index count, int dim, double *uv, int *closed)
{
    double mean[3], axes[3][3], spread[3], centre[3], middle[3], radius = 0;
    principal_axes(points, count, dim, mean, axes, spread);
    double scale = sqrt(spread[0] / (double)count);
    if (!(scale > 0) || !best_centre(points, count, dim, mean, axes, 3, scale, centre))
        return pia_fail(context, PIA_E_DATA, "the points lie on no sphere; use --param plane");
    for (int e = 0; e < 3; e++) middle[e] = mean[e] + centre[0] * axes[0][e] + centre[1] * axes[1][e] + centre[2] * axes[2][e];
    for (pia_index i = 0; i < count; i++) {
        const double *p = points + i * dim;
        radius += hypot(hypot(p[0] - middle[0], p[1] - middle[1]), p[2] - middle[2]) / (double)count;
    }
    turn_to_side(centre, radius, axes);
    for (pia_index i = 0; i < count; i++) {
        double x[3];
        for (int d = 0; d < 3; d++) x[d] = along(points + i * dim, middle, axes[d]);
        uv[2 * i] = turn_share(x[1], x[0]);
        uv[2 * i + 1] = 0.5 + atan2(x[2], hypot(x[0], x[1])) / acos(-1);
    }
    *closed = open_gap(uv, count);
    return PIA_OK;
}

static const pia_cloud rule[] = {
    {"xy", "scattered points: u and v are x and y", NULL, "height data z over x, y", 2, by_xy},
    {"plane", "scattered points: projected onto their best plane", NULL, "principal axes", 3, by_plane},
    {"cylinder", "scattered points: turn and height about their best axis", NULL, "u is closed where the points go all the way round",
     3, by_cylinder},
    {"sphere", "scattered points: longitude and latitude about their best centre", NULL,
     "poles where the points are not, or along their shortest axis; u is closed where the points go all the way round", 3, by_sphere},
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
