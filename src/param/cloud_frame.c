#include "cloud_frame.h"

#include <math.h>
#include <string.h>

pia_status pia_cloud_to_unit(pia_context *context, double *uv, pia_index count, const char *surface)
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

void pia_cloud_axes(const double *points, pia_index count, int dim, double mean[3], double axes[3][3], double spread[3])
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

double pia_cloud_along(const double *point, const double mean[3], const double axis[3])
{
    return (point[0] - mean[0]) * axis[0] + (point[1] - mean[1]) * axis[1] + (point[2] - mean[2]) * axis[2];
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

int pia_cloud_centre(const double *points, pia_index count, int dim, const double mean[3], double axes[3][3], int count_axes,
                     double scale, double centre[3])
{
    double a[4][5] = {{0}};
    for (pia_index i = 0; i < count; i++) {
        double x[4] = {0, 0, 0, 1}, square = 0;
        for (int d = 0; d < count_axes; d++) {
            x[d] = pia_cloud_along(points + i * dim, mean, axes[d]) / scale;
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

double pia_cloud_turn(double y, double x)
{
    double share = atan2(y, x) / (2 * acos(-1));
    share -= floor(share);
    return share < 1 ? share : 0;
}

int pia_cloud_open_gap(double *uv, pia_index count)
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
