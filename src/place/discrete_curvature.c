#include "discrete_curvature.h"

#include <math.h>
#include <string.h>

/* Shares of the chord and of its length below which two of them count as equal: rounding must not decide where noise does not. */
static const double EQUAL = 1e-9;
/* The least |first difference|^2 / |second difference|^2 that is told from a turn back: 1 / (4 tan^2(173 degrees / 2)). */
static const double SHARPEST = 1e-3;

static double dot(const double *a, const double *b, int dim)
{
    double sum = 0;
    for (int d = 0; d < dim; d++) sum += a[d] * b[d];
    return sum;
}

static void subtract(const double *a, const double *b, int dim, double *out)
{
    for (int d = 0; d < dim; d++) out[d] = a[d] - b[d];
}

/* Length of the part of b that is perpendicular to a. */
static double perpendicular(const double *a, const double *b, int dim)
{
    double along = dot(a, a, dim), rest[PIA_MAX_DIM], share = along > 0 ? dot(a, b, dim) / along : 0;
    for (int d = 0; d < dim; d++) rest[d] = b[d] - share * a[d];
    return sqrt(dot(rest, rest, dim));
}

/* The chord from j - k to j + k, and the height of point j over it relative to its length. */
static double chord_over(const double *points, pia_index j, pia_index k, int dim, double *height)
{
    double chord[PIA_MAX_DIM], side[PIA_MAX_DIM];
    const double *from = points + (j - k) * dim;
    subtract(points + (j + k) * dim, from, dim, chord);
    subtract(points + j * dim, from, dim, side);
    double length = sqrt(dot(chord, chord, dim));
    *height = length > 0 ? perpendicular(chord, side, dim) / length : INFINITY;
    return length;
}

static pia_index support(const double *points, pia_index j, pia_index most, int dim)
{
    double height, wider;
    double length = chord_over(points, j, 1, dim, &height);
    pia_index k = 1;
    for (; k < most; k++) {
        double longer = chord_over(points, j, k + 1, dim, &wider);
        if (!(longer > length * (1 + EQUAL)) || !(wider >= height - EQUAL)) break;
        length = longer;
        height = wider;
    }
    return k;
}

static void smooth_point(const double *points, pia_index j, pia_index h, int dim, double *out)
{
    double total = 1, sum[PIA_MAX_DIM] = {0}, variance = (double)(h * h) / 4;
    const double *centre = points + j * dim;
    for (pia_index i = 1; i <= h; i++) {
        double weight = exp(-(double)(i * i) / (2 * variance));
        total += 2 * weight;
        for (int d = 0; d < dim; d++) sum[d] += weight * ((centre[d - i * dim] - centre[d]) + (centre[d + i * dim] - centre[d]));
    }
    for (int d = 0; d < dim; d++) out[d] = centre[d] + sum[d] / total;
}

void pia_curvature_smooth(const double *points, pia_index count, int dim, pia_index most, double *smooth)
{
    memcpy(smooth, points, (size_t)(count * dim) * sizeof *smooth);
    for (pia_index j = 1; most > 0 && j + 1 < count; j++) {
        pia_index room = j < count - 1 - j ? j : count - 1 - j;
        smooth_point(points, j, support(points, j, room < most ? room : most, dim), dim, smooth + j * dim);
    }
}

/* |a x b| / |a|^3 with a the first and b the second difference is the part of b across a over |a|^2. */
static double curvature_at(const double *before, const double *point, const double *after, int dim)
{
    double first[PIA_MAX_DIM], second[PIA_MAX_DIM];
    for (int d = 0; d < dim; d++) {
        first[d] = (after[d] - before[d]) / 2;
        second[d] = (after[d] - point[d]) - (point[d] - before[d]);
    }
    double square = fmax(dot(first, first, dim), SHARPEST * dot(second, second, dim));
    return square > 0 ? perpendicular(first, second, dim) / square : 0;
}

void pia_curvature_along(const double *points, pia_index count, int dim, double *curvature)
{
    for (pia_index j = 1; j + 1 < count; j++) {
        const double *point = points + j * dim;
        curvature[j] = curvature_at(point - dim, point, point + dim, dim);
    }
    curvature[0] = count > 2 ? curvature[1] : 0;
    curvature[count - 1] = count > 2 ? curvature[count - 2] : 0;
}

pia_status pia_curvature_of_curve(pia_context *context, const double *points, pia_index count, int dim, pia_index most,
                                  double *curvature)
{
    pia_index size;
    if (!pia_multiply(count, dim, &size)) return pia_fail(context, PIA_E_SIZE, "%lld points do not fit in 64 bits", (long long)count);
    double *smooth = pia_take(context, size, sizeof *smooth);
    if (smooth == NULL) return pia_take_status(context, size, sizeof *smooth);
    pia_curvature_smooth(points, count, dim, most, smooth);
    pia_curvature_along(smooth, count, dim, curvature);
    pia_give(context, smooth);
    return PIA_OK;
}

/* Adds the squared curvatures along the lines of one direction to the sums of both. */
static pia_status add_lines(pia_context *context, const double *points, const pia_index count[2], int dim, pia_index most,
                            int direction, double *const sum[2])
{
    pia_index along = count[direction], lines = count[1 - direction], size = along * dim;
    pia_index step = direction == 0 ? lines * dim : dim, line_step = direction == 0 ? dim : size;
    double *line = pia_take(context, size, sizeof *line), *curvature = pia_take(context, along, sizeof *curvature);
    pia_status status = line != NULL && curvature != NULL ? PIA_OK : PIA_E_MEMORY;
    for (pia_index i = 0; i < lines && status == PIA_OK; i++) {
        for (pia_index k = 0; k < along; k++) memcpy(line + k * dim, points + i * line_step + k * step, (size_t)dim * sizeof *line);
        status = pia_curvature_of_curve(context, line, along, dim, most, curvature);
        for (pia_index k = 0; k < along && status == PIA_OK; k++) {
            double square = curvature[k] * curvature[k];
            sum[direction][k] += square;
            sum[1 - direction][i] += square;
        }
    }
    pia_give(context, line);
    pia_give(context, curvature);
    return status;
}

pia_status pia_curvature_of_grid(pia_context *context, const double *points, const pia_index count[2], int dim, pia_index most,
                                 double *rows, double *columns)
{
    double *const sum[2] = {rows, columns};
    pia_status status = PIA_OK;
    for (int d = 0; d < 2; d++) memset(sum[d], 0, (size_t)count[d] * sizeof *sum[d]);
    for (int d = 0; d < 2 && status == PIA_OK; d++) status = add_lines(context, points, count, dim, most, d, sum);
    for (int d = 0; d < 2 && status == PIA_OK; d++)
        for (pia_index i = 0; i < count[d]; i++) sum[d][i] /= (double)count[1 - d];
    return status;
}
