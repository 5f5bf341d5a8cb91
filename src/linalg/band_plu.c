/* General bands with partial pivoting, in place by rows: row i has room for the columns i - lower .. i + lower + upper, because an
 * exchange brings at most `lower` more. Multipliers stay where they were made; a solve repeats the exchanges as it goes (as LAPACK's
 * gbtrf). */
#include <float.h>
#include <math.h>

#include "band.h"

/* The diagonal entry of row i: entry (i, j) is j - i further. */
static double *diagonal(const pia_band_plu *lu, pia_index i)
{
    return lu->entry + i * (2 * lu->lower + lu->upper + 1) + lu->lower;
}

/* The row from k on whose entry in column k is largest. */
static pia_index find_pivot(const pia_band_plu *lu, pia_index k, pia_index last)
{
    pia_index best = k;
    for (pia_index i = k + 1; i <= last; i++)
        if (fabs(diagonal(lu, i)[k - i]) > fabs(diagonal(lu, best)[k - best])) best = i;
    return best;
}

static void exchange(const pia_band_plu *lu, pia_index k, pia_index other, pia_index right)
{
    double *a = diagonal(lu, k), *b = diagonal(lu, other) + k - other;
    for (pia_index j = 0; j <= right - k; j++) {
        double value = a[j];
        a[j] = b[j];
        b[j] = value;
    }
}

/* Eliminates column k; returns 0 when its pivot is at most `least` or no number. */
static int eliminate(pia_band_plu *lu, pia_index k, double least)
{
    pia_index last = k + lu->lower < lu->n ? k + lu->lower : lu->n - 1;
    pia_index right = k + lu->lower + lu->upper < lu->n ? k + lu->lower + lu->upper : lu->n - 1;
    pia_index pivot = find_pivot(lu, k, last);
    lu->pivot[k] = pivot;
    if (pivot != k) exchange(lu, k, pivot, right);
    const double *row = diagonal(lu, k);
    if (!(fabs(row[0]) > least && isfinite(row[0]))) return 0;
    for (pia_index i = k + 1; i <= last; i++) {
        double *below = diagonal(lu, i) + k - i;
        if (below[0] == 0) continue;
        below[0] /= row[0];
        for (pia_index j = 1; j <= right - k; j++) below[j] -= below[0] * row[j];
    }
    return 1;
}

/* Entry (i, j) of the rows as they are given; 0 outside the matrix. */
static double given(const double *a, const pia_band_plu *lu, pia_index i, pia_index j)
{
    return i < 0 || i >= lu->n || j < 0 || j >= lu->n ? 0 : a[i * (lu->lower + 1 + lu->upper) + j - i + lu->lower];
}

static double largest_in_column(const double *a, const pia_band_plu *lu, pia_index j)
{
    double largest = 0;
    for (pia_index i = j - lu->upper; i <= j + lu->lower; i++) largest = fmax(largest, fabs(given(a, lu, i, j)));
    return largest;
}

static pia_status factor(pia_context *context, const double *a, pia_band_plu *lu)
{
    for (pia_index i = 0; i < lu->n; i++)
        for (pia_index j = -lu->lower; j <= lu->upper; j++) diagonal(lu, i)[j] = given(a, lu, i, i + j);
    for (pia_index k = 0; k < lu->n; k++)
        if (!eliminate(lu, k, DBL_EPSILON * largest_in_column(a, lu, k)))
            return pia_fail(context, PIA_E_DATA, "column %lld of the system depends on those before it: it has no single solution",
                            (long long)k);
    return PIA_OK;
}

pia_status pia_band_plu_factor(pia_context *context, const double *a, pia_index n, int lower, int upper, pia_band_plu *out)
{
    pia_index size;
    pia_band_plu lu = {n, lower, upper, NULL, NULL};
    *out = (pia_band_plu){0};
    if (!pia_multiply(n, 2 * (pia_index)lower + upper + 1, &size))
        return pia_fail(context, PIA_E_SIZE, "a band of %lld rows is too large", (long long)n);
    lu.entry = pia_take_zero(context, size, sizeof *lu.entry);
    lu.pivot = pia_take(context, n, sizeof *lu.pivot);
    pia_status status = pia_take_status(context, size, sizeof *lu.entry);
    if (lu.entry != NULL && lu.pivot != NULL) status = factor(context, a, &lu);
    if (status == PIA_OK)
        *out = lu;
    else
        pia_band_plu_clear(context, &lu);
    return status;
}

static void subtract(double *x, const double *y, double factor, int dim)
{
    for (int c = 0; c < dim; c++) x[c] -= factor * y[c];
}

void pia_band_plu_solve(const pia_band_plu *lu, double *b, int dim)
{
    for (pia_index k = 0; k < lu->n; k++) {
        double *x = b + k * dim, *other = b + lu->pivot[k] * dim;
        for (int c = 0; c < dim && other != x; c++) {
            double value = x[c];
            x[c] = other[c];
            other[c] = value;
        }
        for (pia_index i = k + 1; i < lu->n && i <= k + lu->lower; i++) subtract(b + i * dim, x, diagonal(lu, i)[k - i], dim);
    }
    for (pia_index k = lu->n - 1; k >= 0; k--) {
        const double *row = diagonal(lu, k);
        double *x = b + k * dim;
        for (pia_index j = 1; j <= lu->lower + lu->upper && k + j < lu->n; j++) subtract(x, x + j * dim, row[j], dim);
        for (int c = 0; c < dim; c++) x[c] /= row[0];
    }
}

void pia_band_plu_clear(pia_context *context, pia_band_plu *plu)
{
    pia_give(context, plu->entry);
    pia_give(context, plu->pivot);
    *plu = (pia_band_plu){0};
}
