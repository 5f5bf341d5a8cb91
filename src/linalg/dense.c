#include "dense.h"

#include "clones.h"

#include <math.h>

static void exchange(double *a, double *b)
{
    double value = *a;
    *a = *b;
    *b = value;
}

/* Exchanges unknowns i < j of a symmetric matrix of which the lower triangle counts, and the rows above i of its factor's transpose. */
static void exchange_unknowns(double *s, pia_index n, pia_index i, pia_index j)
{
    for (pia_index k = 0; k < i; k++) {
        exchange(&s[i * n + k], &s[j * n + k]);
        exchange(&s[k * n + i], &s[k * n + j]);
    }
    for (pia_index k = i + 1; k < j; k++) exchange(&s[k * n + i], &s[j * n + k]);
    for (pia_index k = j + 1; k < n; k++) exchange(&s[k * n + i], &s[k * n + j]);
    exchange(&s[i * n + i], &s[j * n + j]);
}

/* x -= factor * y, [count]. */
PIA_INLINE void subtract(double *restrict x, double factor, const double *restrict y, pia_index count)
{
    for (pia_index i = 0; i < count; i++) x[i] -= factor * y[i];
}

/* Column k of the factor goes into row k as well, so that all loops run along rows. Constraints that are far apart leave zeros. */
PIA_CLONES static void eliminate(double *s, pia_index n, pia_index k)
{
    double pivot = sqrt(s[k * n + k]), *above = s + k * n;
    above[k] = pivot;
    for (pia_index i = k + 1; i < n; i++) {
        above[i] = s[i * n + k] /= pivot;
        if (above[i] != 0) subtract(s + i * n + k + 1, above[i], above + k + 1, i - k);
    }
}

pia_index pia_dense_cholesky(double *s, pia_index n, double rtol, pia_index *order)
{
    double least = 0;
    for (pia_index i = 0; i < n; i++) order[i] = i;
    for (pia_index k = 0; k < n; k++) {
        pia_index best = k;
        for (pia_index i = k + 1; i < n; i++)
            if (s[i * n + i] > s[best * n + best]) best = i;
        if (k == 0) least = rtol * s[best * n + best];
        if (!(s[best * n + best] > 0 && s[best * n + best] > least)) return k;
        if (best != k) {
            pia_index moved = order[k];
            exchange_unknowns(s, n, k, best);
            order[k] = order[best];
            order[best] = moved;
        }
        eliminate(s, n, k);
    }
    return n;
}

/* x [dim][n], of which `rank` count, := L'^-1 L^-1 x. */
PIA_CLONES static void substitute(const double *factor, pia_index n, pia_index rank, double *x, int dim)
{
    for (pia_index k = 0; k < rank; k++)
        for (int c = 0; c < dim; c++) {
            double *column = x + c * n, value = column[k] /= factor[k * n + k];
            subtract(column + k + 1, value, factor + k * n + k + 1, rank - k - 1);
        }
    for (pia_index k = rank - 1; k >= 0; k--)
        for (int c = 0; c < dim; c++) {
            double *column = x + c * n, value = column[k] /= factor[k * n + k];
            subtract(column, value, factor + k * n, k);
        }
}

void pia_dense_cholesky_solve(const double *factor, pia_index n, pia_index rank, const pia_index *order, double *b, int dim,
                              double *scratch)
{
    for (pia_index i = 0; i < rank; i++)
        for (int c = 0; c < dim; c++) scratch[c * n + i] = b[order[i] * dim + c];
    substitute(factor, n, rank, scratch, dim);
    for (pia_index i = 0; i < n; i++)
        for (int c = 0; c < dim; c++) b[order[i] * dim + c] = i < rank ? scratch[c * n + i] : 0;
}

int pia_dense_lu(double *a, pia_index n, pia_index *pivot)
{
    for (pia_index k = 0; k < n; k++) {
        pia_index best = k;
        for (pia_index i = k + 1; i < n; i++)
            if (fabs(a[i * n + k]) > fabs(a[best * n + k])) best = i;
        pivot[k] = best;
        if (!(fabs(a[best * n + k]) > 0 && isfinite(a[best * n + k]))) return 0;
        for (pia_index j = 0; j < n && best != k; j++) exchange(&a[k * n + j], &a[best * n + j]);
        for (pia_index i = k + 1; i < n; i++) {
            a[i * n + k] /= a[k * n + k];
            for (pia_index j = k + 1; j < n; j++) a[i * n + j] -= a[i * n + k] * a[k * n + j];
        }
    }
    return 1;
}

void pia_dense_lu_solve(const double *lu, pia_index n, const pia_index *pivot, double *b, int dim)
{
    for (pia_index k = 0; k < n; k++)
        for (int c = 0; c < dim && pivot[k] != k; c++) exchange(&b[k * dim + c], &b[pivot[k] * dim + c]);
    for (pia_index i = 0; i < n; i++)
        for (pia_index k = 0; k < i; k++)
            for (int c = 0; c < dim; c++) b[i * dim + c] -= lu[i * n + k] * b[k * dim + c];
    for (pia_index i = n - 1; i >= 0; i--)
        for (int c = 0; c < dim; c++) {
            for (pia_index k = i + 1; k < n; k++) b[i * dim + c] -= lu[i * n + k] * b[k * dim + c];
            b[i * dim + c] /= lu[i * n + i];
        }
}
