/* Orthogonal factorisation one row at a time: Givens rotations turn a row into the upper band until nothing of it is left (FITPACK's
 * way). */
#include <math.h>
#include <string.h>

#include "band.h"

pia_status pia_band_qr_open(pia_context *context, pia_index columns, int width, int dim, pia_band_qr *out)
{
    pia_index size, right;
    pia_band_qr qr = {columns, width, dim, NULL, NULL};
    *out = (pia_band_qr){0};
    if (!pia_multiply(columns, width, &size) || !pia_multiply(columns, dim, &right))
        return pia_fail(context, PIA_E_SIZE, "a band of %lld columns is too large", (long long)columns);
    qr.r = pia_take_zero(context, size, sizeof *qr.r);
    qr.q = pia_take_zero(context, right, sizeof *qr.q);
    if (qr.r == NULL || qr.q == NULL) {
        pia_band_qr_close(context, &qr);
        return pia_take_status(context, size, sizeof *qr.r);
    }
    *out = qr;
    return PIA_OK;
}

void pia_band_qr_clear(pia_band_qr *qr)
{
    memset(qr->r, 0, (size_t)(qr->columns * qr->width) * sizeof *qr->r);
    memset(qr->q, 0, (size_t)(qr->columns * qr->dim) * sizeof *qr->q);
}

static void rotate(double cosine, double sine, double *upper, double *lower, int count)
{
    for (int k = 0; k < count; k++) {
        double u = upper[k], l = lower[k];
        upper[k] = cosine * u + sine * l;
        lower[k] = cosine * l - sine * u;
    }
}

/* Turns row[0], of column `column`, into the factor; row has `length` entries that matter. */
static void eliminate(pia_band_qr *qr, pia_index column, double *row, int length, double *right)
{
    double *upper = qr->r + column * qr->width;
    if (row[0] == 0) return;
    double length_of_both = hypot(upper[0], row[0]), cosine = upper[0] / length_of_both, sine = row[0] / length_of_both;
    rotate(cosine, sine, upper, row, length);
    rotate(cosine, sine, qr->q + column * qr->dim, right, qr->dim);
}

void pia_band_qr_add(pia_band_qr *qr, pia_index first, double *row, double *right)
{
    for (int k = 0; k < qr->width; k++) eliminate(qr, first + k, row + k, qr->width - k, right);
}

static int nothing_left(const double *row, int width)
{
    for (int k = 0; k < width; k++)
        if (row[k] != 0) return 0;
    return 1;
}

/* What row `column` says about the columns after it is an equation of its own: it is turned into the rows below, which may reach
 * further, so that the row is shifted along with the columns. */
static void push_down(pia_band_qr *qr, pia_index column)
{
    double *row = qr->r + column * qr->width, *right = qr->q + column * qr->dim;
    for (pia_index j = column + 1; j < qr->columns; j++) {
        memmove(row, row + 1, (size_t)(qr->width - 1) * sizeof *row);
        row[qr->width - 1] = 0;
        if (nothing_left(row, qr->width)) break;
        eliminate(qr, j, row, qr->width, right);
    }
    memset(row, 0, (size_t)qr->width * sizeof *row);
}

static double largest_diagonal(const pia_band_qr *qr)
{
    double largest = 0;
    for (pia_index i = 0; i < qr->columns; i++) largest = fmax(largest, fabs(qr->r[i * qr->width]));
    return largest;
}

static void substitute(const pia_band_qr *qr, pia_index i, double *x)
{
    const double *row = qr->r + i * qr->width;
    pia_index reach = qr->columns - 1 - i < qr->width - 1 ? qr->columns - 1 - i : qr->width - 1;
    for (int c = 0; c < qr->dim; c++) {
        double sum = qr->q[i * qr->dim + c];
        for (pia_index k = 1; k <= reach; k++) sum -= row[k] * x[(i + k) * qr->dim + c];
        x[i * qr->dim + c] = sum / row[0];
    }
}

pia_index pia_band_qr_solve(pia_band_qr *qr, double threshold, double *x)
{
    pia_index weak = 0;
    double least = threshold * largest_diagonal(qr);
    for (pia_index i = 0; i < qr->columns; i++) {
        if (fabs(qr->r[i * qr->width]) > least) continue;
        push_down(qr, i);
        weak++;
    }
    for (pia_index i = qr->columns - 1; i >= 0; i--)
        if (qr->r[i * qr->width] != 0) substitute(qr, i, x);
    return weak;
}

void pia_band_qr_close(pia_context *context, pia_band_qr *qr)
{
    pia_give(context, qr->r);
    pia_give(context, qr->q);
    *qr = (pia_band_qr){0};
}
