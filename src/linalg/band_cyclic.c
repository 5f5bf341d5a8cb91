/* A cyclic band, bordered: the last `width` unknowns are set aside, the m others are an ordinary band A. With C the columns set aside,
 * the border holds X = A^-1 C [m x width], the corner of C [width x width] and the factor of the Schur complement [width x width]. */
#include <string.h>

#include "band.h"

/* C is nonzero in its first rows, where the band wraps, and in its last ones, its corner: C(m - width + i, a) = corner[i * width + a].
 */
static void take_columns(const double *h, pia_index m, int width, double *x, double *corner)
{
    memset(x, 0, (size_t)((m + width) * width) * sizeof *x);
    for (int i = 0; i < width; i++)
        for (int a = 0; a <= i; a++) corner[i * width + a] = h[(m - width + i) * (width + 1) + width - i + a];
    memcpy(x + (m - width) * width, corner, (size_t)(width * width) * sizeof *x);
    for (int a = 0; a < width; a++)
        for (int i = 0; i <= a; i++) x[i * width + a] = h[(m + a) * (width + 1) + width - a + i];
}

/* Entry (a, b) of S - C'X. */
static double schur_entry(const double *h, const double *corner, const double *x, pia_index m, int width, int a, int b)
{
    double sum = h[(m + a) * (width + 1) + b - a];
    for (int i = 0; i <= a; i++) sum -= h[(m + a) * (width + 1) + width - a + i] * x[i * width + b];
    for (int i = a; i < width; i++) sum -= corner[i * width + a] * x[(m - width + i) * width + b];
    return sum;
}

pia_index pia_band_cyclic_factor(double *h, pia_index n, int width, double threshold, double *border)
{
    pia_index m = n - width;
    double *x = border, *corner = border + m * width, *schur = border + n * width;
    if (width == 0) return pia_band_ldl_factor(h, n, 0, threshold, NULL, 0);
    take_columns(h, m, width, x, corner);
    pia_index refused = pia_band_ldl_factor(h, m, width, threshold, NULL, 0);
    pia_band_ldl_solve(h, m, width, x, width);
    memset(schur, 0, (size_t)(width * width) * sizeof *schur);
    for (int a = 0; a < width; a++) {
        for (int b = a; b < width; b++) schur[a * width + b - a] = schur_entry(h, corner, x, m, width, a, b);
        if (!(schur[a * width] > threshold * h[(m + a) * (width + 1)])) schur[a * width] = 0;
    }
    return refused + pia_band_ldl_factor(schur, width, width - 1, threshold, NULL, 0);
}

/* Takes X times the last unknowns from the others; transposed, X' times the others from the last. */
static void couple(const double *x, pia_index m, int width, double *b, int dim)
{
    for (pia_index i = 0; i < m; i++)
        for (int a = 0; a < width; a++)
            for (int c = 0; c < dim; c++) b[i * dim + c] -= x[i * width + a] * b[(m + a) * dim + c];
}

static void couple_transposed(const double *x, pia_index m, int width, double *b, int dim)
{
    for (pia_index i = 0; i < m; i++)
        for (int a = 0; a < width; a++)
            for (int c = 0; c < dim; c++) b[(m + a) * dim + c] -= x[i * width + a] * b[i * dim + c];
}

void pia_band_cyclic_solve(const double *ldl, const double *border, pia_index n, int width, double *b, int dim)
{
    pia_index m = n - width;
    couple_transposed(border, m, width, b, dim);
    if (width > 0) pia_band_ldl_solve(border + n * width, width, width - 1, b + m * dim, dim);
    pia_band_ldl_solve(ldl, m, width, b, dim);
    couple(border, m, width, b, dim);
}
