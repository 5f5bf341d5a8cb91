#include "dense.h"

#include <math.h>

static void exchange(double *a, double *b)
{
    double value = *a;
    *a = *b;
    *b = value;
}

/* Exchanges unknowns i < j of a symmetric matrix of which the lower triangle counts. */
static void exchange_unknowns(double *s, pia_index n, pia_index i, pia_index j)
{
    for (pia_index k = 0; k < i; k++) exchange(&s[i * n + k], &s[j * n + k]);
    for (pia_index k = i + 1; k < j; k++) exchange(&s[k * n + i], &s[j * n + k]);
    for (pia_index k = j + 1; k < n; k++) exchange(&s[k * n + i], &s[k * n + j]);
    exchange(&s[i * n + i], &s[j * n + j]);
}

static void eliminate(double *s, pia_index n, pia_index k)
{
    double pivot = sqrt(s[k * n + k]);
    s[k * n + k] = pivot;
    for (pia_index i = k + 1; i < n; i++) {
        s[i * n + k] /= pivot;
        for (pia_index j = k + 1; j <= i; j++) s[i * n + j] -= s[i * n + k] * s[j * n + k];
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

void pia_dense_cholesky_solve(const double *factor, pia_index n, pia_index rank, const pia_index *order, double *b, int dim,
                              double *scratch)
{
    for (pia_index i = 0; i < rank; i++)
        for (int c = 0; c < dim; c++) {
            double sum = b[order[i] * dim + c];
            for (pia_index k = 0; k < i; k++) sum -= factor[i * n + k] * scratch[k * dim + c];
            scratch[i * dim + c] = sum / factor[i * n + i];
        }
    for (pia_index i = rank - 1; i >= 0; i--)
        for (int c = 0; c < dim; c++) {
            double sum = scratch[i * dim + c];
            for (pia_index k = i + 1; k < rank; k++) sum -= factor[k * n + i] * scratch[k * dim + c];
            scratch[i * dim + c] = sum / factor[i * n + i];
        }
    for (pia_index i = 0; i < n; i++)
        for (int c = 0; c < dim; c++) b[order[i] * dim + c] = i < rank ? scratch[i * dim + c] : 0;
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
