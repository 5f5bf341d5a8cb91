/* Corners of a curve: rows where its direction jumps. Found by the turn between the mean directions of the rows before and behind, over
 * two scales: at a corner the turn stays as the scale shrinks, along a bend it shrinks as well. A closed curve with corners begins and
 * ends at the first of them and is fitted as an open one whose ends meet. */
#include "fit.h"

#include <math.h>
#include <string.h>

/* NEAR: least rows of the smaller scale on either side; the larger one is twice it. MANY: one corner to so many rows is a zigzag, not
 * a shape with corners. */
enum { NEAR = 3, MANY = 8 };

/* The smaller scale in tolerances: what a curve can round within the tolerance is no corner. The least turn of a corner, and the least
 * share of it that is there at the smaller scale. */
static const double SCALE = 8, LEAST_TURN = 0.7, LEAST_SHARE = 0.8;

/* How far one looks from a row: as far as `length`, and at least `least` steps of `stride` rows. */
typedef struct scale {
    double length;
    pia_index least, stride;
} scale;

/* Some SAMPLES steps to an arm, however dense the rows. */
static scale scale_of(const pia_fit *fit)
{
    enum { SAMPLES = 16 };
    double chords = 0, length = SCALE * fit->options.tolerance;
    for (pia_index row = 1; row < fit->rows; row++) {
        double square = 0;
        for (int d = 0; d < fit->dim; d++) square += pow(fit->points[row * fit->dim + d] - fit->points[(row - 1) * fit->dim + d], 2);
        chords += sqrt(square);
    }
    pia_index stride = (pia_index)fmin(length / SAMPLES * (double)fit->rows / chords, (double)fit->rows);
    return (scale){length, NEAR, stride > 1 ? stride : 1};
}

/* The mean way from a row to the rows on one side (1 or -1). Returns how many rows that were; 0 where the curve ends before. */
static pia_index arm(const pia_fit *fit, pia_index row, int side, scale s, double *way)
{
    const double *here = fit->points + row * fit->dim;
    memset(way, 0, (size_t)fit->dim * sizeof *way);
    for (pia_index k = 1; k * s.stride <= fit->rows / 4; k++) {
        pia_index at = row + side * k * s.stride;
        if (fit->closed[0]) at = (at % fit->rows + fit->rows) % fit->rows;
        if (at < 0 || at >= fit->rows) return 0;
        double square = 0;
        for (int d = 0; d < fit->dim; d++) {
            double part = fit->points[at * fit->dim + d] - here[d];
            way[d] += part;
            square += part * part;
        }
        if (k >= s.least && square >= s.length * s.length) return k * s.stride;
    }
    return 0;
}

/* The angle between the way to a row and the way on from it; *reach: rows of the shorter arm. */
static double turn_at(const pia_fit *fit, pia_index row, scale s, pia_index *reach)
{
    double in[PIA_MAX_DIM], out[PIA_MAX_DIM], across = 0, before = 0, behind = 0;
    pia_index back = arm(fit, row, -1, s, in), on = arm(fit, row, 1, s, out);
    *reach = back < on ? back : on;
    if (*reach == 0) return 0;
    for (int d = 0; d < fit->dim; d++) {
        across -= in[d] * out[d];
        before += in[d] * in[d];
        behind += out[d] * out[d];
    }
    return before > 0 && behind > 0 ? acos(fmin(fmax(across / sqrt(before * behind), -1), 1)) : 0;
}

/* Corners are sharper than all other rows nearby, the first of equals. */
static void find_corners(const pia_fit *fit, double *turn, unsigned char *corner)
{
    scale near = scale_of(fit), far = {2 * near.length, 2 * near.least, near.stride};
    pia_index reach, found = 0;
    for (pia_index row = 0; row < fit->rows; row++) turn[row] = turn_at(fit, row, near, &reach);
    for (pia_index row = 0; row < fit->rows; row++) {
        double here = turn_at(fit, row, near, &reach);
        int best = here >= LEAST_TURN;
        for (pia_index k = 1; k <= reach && best; k++) {
            pia_index before = row - k, behind = row + k;
            if (before < 0) before += fit->rows;
            if (behind >= fit->rows) behind -= fit->rows;
            best = turn[before] < here && turn[behind] <= here;
        }
        corner[row] = best && here >= LEAST_SHARE * turn_at(fit, row, far, &reach) && reach > 0;
        found += corner[row];
    }
    if (found > fit->rows / MANY) memset(corner, 0, (size_t)fit->rows);
}

static pia_status found_corners(const pia_fit *fit, unsigned char *corner)
{
    double *turn = pia_take(fit->context, fit->rows, sizeof *turn);
    if (turn == NULL) return PIA_E_MEMORY;
    find_corners(fit, turn, corner);
    pia_give(fit->context, turn);
    return PIA_OK;
}

static pia_status given_corners(pia_fit *fit, unsigned char *corner)
{
    for (pia_index k = 0; k < fit->options.corner_count; k++) {
        pia_index asked = fit->options.corners[k], row = 0;
        if (asked < 0 || asked >= fit->given)
            return pia_fail(fit->context, PIA_E_ARGUMENT, "corner row %lld does not exist; there are 0 to %lld", (long long)asked,
                            (long long)fit->given - 1);
        while (row < fit->rows && (fit->row != NULL ? fit->row[row] : row) < asked) row++;
        if (row < fit->rows && (fit->closed[0] || (row > 0 && row + 1 < fit->rows))) corner[row] = 1;
    }
    return PIA_OK;
}

/* [rows + 1] in place of an array of rows turned by `by`, whose first row is repeated at the end. */
static pia_status turn_rows(pia_fit *fit, void *base, size_t size, pia_index by, void **out)
{
    *out = NULL;
    if (base == NULL) return PIA_OK;
    char *turned = pia_take(fit->context, fit->rows + 1, size);
    if (turned == NULL) return PIA_E_MEMORY;
    for (pia_index i = 0; i <= fit->rows; i++)
        memcpy(turned + (size_t)i * size, (char *)base + (size_t)((i + by) % fit->rows) * size, size);
    pia_give(fit->context, base);
    *out = turned;
    return PIA_OK;
}

/* Opens a closed curve at row `by`, which becomes the first row and is repeated as the last one. */
static pia_status open_at(pia_fit *fit, pia_index by)
{
    pia_status status = pia_fit_own_rows(fit);
    double **per_row[] = {&fit->weights, &fit->tolerances, &fit->inverse_tolerance};
    void *turned;
    if (status == PIA_OK) status = turn_rows(fit, fit->own_points, (size_t)fit->dim * sizeof(double), by, &turned);
    if (status == PIA_OK) fit->points = fit->own_points = turned;
    if (status == PIA_OK) status = turn_rows(fit, fit->row, sizeof *fit->row, by, &turned);
    if (status == PIA_OK) fit->row = turned;
    for (size_t k = 0; k < sizeof per_row / sizeof *per_row && status == PIA_OK; k++) {
        status = turn_rows(fit, *per_row[k], sizeof(double), by, &turned);
        if (status == PIA_OK) *per_row[k] = turned;
    }
    if (status != PIA_OK) return status;
    fit->rows++;
    fit->count[0] = fit->rows;
    fit->closed[0] = 0;
    fit->pinned = 1;
    pia_fit_note_add(fit, "the closed curve has corners: it begins and ends at the one in row %lld", (long long)fit->row[0]);
    return PIA_OK;
}

static pia_status keep_corners(pia_fit *fit, const unsigned char *corner, pia_index first)
{
    pia_index rows = fit->rows, count = 0;
    for (pia_index row = 0; row < rows; row++) count += corner[row];
    fit->corner = pia_take(fit->context, count, sizeof *fit->corner);
    fit->corner_row = pia_take(fit->context, count, sizeof *fit->corner_row);
    if (fit->corner == NULL || fit->corner_row == NULL) return PIA_E_MEMORY;
    for (pia_index row = 0; row < rows; row++)
        if (corner[row]) fit->corner_row[fit->corner_rows++] = fit->row != NULL ? fit->row[row] : row;
    pia_fit_note_add(fit, "%lld corners %s", (long long)count, fit->options.corner_count == PIA_AUTO ? "found" : "given");
    pia_index by = fit->closed[0] ? first : 0;
    for (pia_index i = fit->closed[0]; i < rows; i++)
        if (corner[(i + by) % rows]) fit->corner[fit->corner_count++] = i;
    return fit->closed[0] ? open_at(fit, first) : PIA_OK;
}

pia_status pia_fit_take_corners(pia_fit *fit)
{
    if (fit->options.corner_count == 0) return PIA_OK;
    if (fit->directions != 1 || fit->function_graph || !fit->refining) {
        pia_fit_note_add(fit, "corners were not used: they belong to a curve that is fitted to a tolerance");
        return PIA_OK;
    }
    unsigned char *corner = pia_take_zero(fit->context, fit->rows, 1);
    if (corner == NULL) return PIA_E_MEMORY;
    pia_status status = PIA_OK;
    if (fit->options.corner_count == PIA_AUTO)
        status = found_corners(fit, corner);
    else
        status = given_corners(fit, corner);
    const unsigned char *first = memchr(corner, 1, (size_t)fit->rows);
    if (status == PIA_OK && first != NULL) status = keep_corners(fit, corner, first - corner);
    pia_give(fit->context, corner);
    return status;
}

pia_status pia_fit_corners(pia_fit *fit, const pia_index **row, pia_index *count)
{
    if (row == NULL || count == NULL) return pia_fail(fit->context, PIA_E_ARGUMENT, "row or count is NULL");
    *row = fit->corner_row;
    *count = fit->corner_rows;
    return PIA_OK;
}
