#include "bernstein.h"

#include <string.h>

#include "basis.h"

/* One line of de Casteljau's scheme: [n + 1] coefficients of `inner` contiguous values, `stride` apart. */
static void restrict_line(double *c, int n, pia_index stride, pia_index inner, double low, double high)
{
    for (int r = 1; low > 0 && r <= n; r++)
        for (int i = 0; i <= n - r; i++)
            for (pia_index k = 0; k < inner; k++) c[i * stride + k] = (1 - low) * c[i * stride + k] + low * c[(i + 1) * stride + k];
    double part = (high - low) / (1 - low);
    for (int r = 1; high < 1 && r <= n; r++)
        for (int i = n; i >= r; i--)
            for (pia_index k = 0; k < inner; k++) c[i * stride + k] = (1 - part) * c[(i - 1) * stride + k] + part * c[i * stride + k];
}

void pia_bernstein_restrict(double *c, const int degree[2], int width, int d, double low, double high)
{
    pia_index row = (pia_index)(degree[1] + 1) * width;
    if (d == 0)
        restrict_line(c, degree[0], row, row, low, high);
    else
        for (int i = 0; i <= degree[0]; i++) restrict_line(c + i * row, degree[1], width, width, low, high);
}

void pia_bernstein_binomials(int n, double *out)
{
    out[0] = 1;
    for (int k = 1; k <= n; k++) out[k] = out[k - 1] * (n - k + 1) / k;
}

void pia_bernstein_scales_of(const int degree[2], pia_bernstein_scales *out)
{
    for (int d = 0; d < 2; d++) {
        out->degree[d] = degree[d];
        pia_bernstein_binomials(degree[d], out->single[d]);
        pia_bernstein_binomials(2 * degree[d], out->twice[d]);
    }
}

/* Adds factor times the product of two rows of [m] coefficients in v to a row of [2 m - 1]. */
static void add_row_product(const double *a, const double *b, int m, int width, int first, int last, const double *scale, double factor,
                            double *out)
{
    for (int j = 0; j < m; j++)
        for (int k = 0; k < m; k++) {
            double product = 0;
            for (int c = first; c < last; c++) product += a[j * width + c] * b[k * width + c];
            out[j + k] += factor * scale[j] * scale[k] * product;
        }
}

void pia_bernstein_square(const pia_bernstein_scales *scales, const double *c, int width, int first, int last, double *out)
{
    const int n = scales->degree[0] + 1, m = scales->degree[1] + 1, row = 2 * m - 1;
    const double *u = scales->single[0];
    memset(out, 0, (size_t)((2 * n - 1) * row) * sizeof *out);
    for (int i = 0; i < n; i++)
        for (int k = i; k < n; k++)
            add_row_product(c + i * m * width, c + k * m * width, m, width, first, last, scales->single[1],
                            (i == k ? 1 : 2) * u[i] * u[k], out + (i + k) * row);
    for (int i = 0; i < 2 * n - 1; i++)
        for (int j = 0; j < row; j++) out[i * row + j] /= scales->twice[0][i] * scales->twice[1][j];
}

enum { WIDTH = PIA_MAX_DEGREE + 1 };

/* One direction's functions with two derivatives, as a B-spline basis over a single span. */
static void basis_of(int degree, double t, double out[3 * WIDTH])
{
    double knots[2 * WIDTH];
    for (int k = 0; k <= degree; k++) {
        knots[k] = 0;
        knots[degree + 1 + k] = 1;
    }
    if (degree > 0)
        pia_basis_derivatives(knots, degree, degree, t, 2, out);
    else
        out[0] = 1;
}

/* The quotient rule up to second order, in place. */
static void divide(pia_bernstein_rows rows, int dim)
{
    double w = rows[PIA_S][dim], wu = rows[PIA_SU][dim], wv = rows[PIA_SV][dim];
    for (int c = 0; c < dim; c++) {
        double s = rows[PIA_S][c] / w, su = (rows[PIA_SU][c] - wu * s) / w, sv = (rows[PIA_SV][c] - wv * s) / w;
        rows[PIA_S][c] = s;
        rows[PIA_SU][c] = su;
        rows[PIA_SV][c] = sv;
        rows[PIA_SUU][c] = (rows[PIA_SUU][c] - 2 * wu * su - rows[PIA_SUU][dim] * s) / w;
        rows[PIA_SUV][c] = (rows[PIA_SUV][c] - wu * sv - wv * su - rows[PIA_SUV][dim] * s) / w;
        rows[PIA_SVV][c] = (rows[PIA_SVV][c] - 2 * wv * sv - rows[PIA_SVV][dim] * s) / w;
    }
}

void pia_bernstein_look(const double *c, const int degree[2], int width, int rational, const double at[2], pia_bernstein_rows rows)
{
    static const int order[6][2] = {{0, 0}, {1, 0}, {0, 1}, {2, 0}, {1, 1}, {0, 2}};
    const int n = degree[0] + 1, m = degree[1] + 1;
    double u[3 * WIDTH], v[3 * WIDTH];
    basis_of(degree[0], at[0], u);
    basis_of(degree[1], at[1], v);
    for (int r = 0; r < 6; r++) {
        for (int k = 0; k < width; k++) rows[r][k] = 0;
        if (order[r][1] > 0 && degree[1] == 0) continue;
        for (int i = 0; i < n; i++)
            for (int j = 0; j < m; j++) {
                double b = u[order[r][0] * n + i] * v[order[r][1] * m + j];
                for (int k = 0; k < width; k++) rows[r][k] += b * c[(i * m + j) * width + k];
            }
    }
    if (rational) divide(rows, width - 1);
}
