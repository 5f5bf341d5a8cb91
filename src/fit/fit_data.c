/* Data at the door: shapes, finite values, bounding box; then rows that repeat their neighbour. */
#include "box.h"
#include "fit.h"
#include "kernel.h"
#include "survey.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { GRAIN = 65536, MAX_CHUNKS = 64 };

void pia_fit_note_add(pia_fit *fit, const char *format, ...)
{
    char text[400];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    pia_note_add(pia_memory_of(fit->context), &fit->notes, "%s", text);
}

/* ---- finite values and the bounding box, in one parallel pass ---- */

typedef struct box {
    double low[PIA_MAX_DIM], high[PIA_MAX_DIM];
    pia_index bad; /* first offending row, or -1 */
    int holes;
} box;

typedef struct scan {
    const double *points;
    pia_index rows, chunks;
    int dim, allow_holes;
    box *part;
} scan;

/* Row by row, where a chunk holds something that is not finite. */
static void scan_rows(const scan *s, pia_index from, pia_index to, box *b)
{
    for (int d = 0; d < s->dim; d++) {
        b->low[d] = INFINITY;
        b->high[d] = -INFINITY;
    }
    for (pia_index i = from; i < to; i++) {
        const double *p = s->points + i * s->dim;
        int finite = 1, infinite = 0;
        for (int d = 0; d < s->dim; d++) {
            finite &= isfinite(p[d]) != 0;
            infinite |= isinf(p[d]) != 0;
        }
        if (!finite && (infinite || !s->allow_holes) && b->bad < 0) b->bad = i;
        b->holes |= !finite;
        for (int d = 0; d < s->dim && finite; d++) {
            b->low[d] = fmin(b->low[d], p[d]);
            b->high[d] = fmax(b->high[d], p[d]);
        }
    }
}

static void scan_chunk(void *work, pia_index chunk)
{
    const scan *s = work;
    box b = {.bad = -1};
    pia_index from = pia_chunk_begin(s->rows, s->chunks, chunk), to = pia_chunk_begin(s->rows, s->chunks, chunk + 1);
    pia_box scanned;
    pia_box_open(s->dim, &scanned);
    pia_box_add(&scanned, s->points + from * s->dim, to - from);
    if (!pia_box_close(&scanned, b.low, b.high)) scan_rows(s, from, to, &b);
    s->part[chunk] = b;
}

static pia_status bound(pia_fit *fit, const double *points, pia_index rows, int dim, box *out)
{
    box part[MAX_CHUNKS];
    pia_index chunks = pia_chunk_count(rows, GRAIN);
    scan s = {points, rows, chunks < MAX_CHUNKS ? chunks : MAX_CHUNKS, dim, fit->kind == PIA_GRID, part};
    pia_for_each(fit->context, s.chunks, scan_chunk, &s);
    box all = part[0];
    for (pia_index c = 1; c < s.chunks; c++) {
        if (all.bad < 0) all.bad = part[c].bad;
        all.holes |= part[c].holes;
        for (int d = 0; d < dim; d++) {
            all.low[d] = fmin(all.low[d], part[c].low[d]);
            all.high[d] = fmax(all.high[d], part[c].high[d]);
        }
    }
    *out = all;
    if (all.bad < 0) return PIA_OK;
    int d = 0;
    while (d < dim - 1 && isfinite(points[all.bad * dim + d])) d++;
    return pia_fail(fit->context, PIA_E_DATA, "row %lld: component %d is %g, not a finite number; drop such rows (--skip-invalid)",
                    (long long)all.bad, d, points[all.bad * dim + d]);
}

/* Deviations are squared and summed: beyond these sides the squares of a large or of a small one would be infinite or nothing. */
static const double smallest_side = 1e-130, largest_side = 1e130;

static pia_status set_box(pia_fit *fit, const double *low, const double *high)
{
    double square = 0, largest = 0;
    for (int d = 0; d < fit->dim; d++) {
        fit->low[d] = low[d];
        fit->high[d] = high[d];
        double side = fit->high[d] - fit->low[d];
        if (!(side <= largest_side))
            return pia_fail(fit->context, PIA_E_DATA, "component %d spans %g, more than %g; rescale the points", d, side, largest_side);
        fit->origin[d] = fit->low[d] + side / 2;
        largest = fmax(largest, side);
    }
    if (largest > 0 && largest < smallest_side)
        return pia_fail(fit->context, PIA_E_DATA, "the points span %g, less than %g; rescale them", largest, smallest_side);
    for (int d = 0; d < fit->dim && largest > 0; d++) square += pow((fit->high[d] - fit->low[d]) / largest, 2);
    fit->extent = largest * sqrt(square);
    if (largest > 0 || fit->function_graph) {
        if (!(fit->extent > 0)) fit->extent = 1;
        return PIA_OK;
    }
    return pia_fail(fit->context, PIA_E_DATA, "all %lld points are equal; there is no %s to fit", (long long)fit->rows,
                    fit->directions == 1 ? "curve" : "surface");
}

static pia_status see(pia_fit *fit, const double *points, int dim)
{
    box all;
    int first = dim - fit->dim;
    pia_status status = bound(fit, points, fit->rows, dim, &all);
    if (status != PIA_OK) return status;
    fit->has_holes = all.holes;
    fit->unseen = 0;
    return set_box(fit, all.low + first, all.high + first);
}

pia_status pia_fit_see(pia_fit *fit)
{
    if (!fit->unseen) return PIA_OK;
    pia_status status = see(fit, fit->points, fit->dim);
    if (status != PIA_OK || !fit->has_holes) return status;
    return pia_fail(fit->context, PIA_E_DATA, "the grid has holes, which a fit has to know before it chooses");
}

pia_status pia_fit_look(void *owner, const pia_survey *survey)
{
    pia_fit *fit = owner;
    if (!survey->ordered) return pia_fit_refuse_parameters(fit, fit->parameter[0], 0, fit->rows);
    if (!survey->finite) return pia_fit_see(fit);
    fit->unseen = 0;
    return set_box(fit, survey->low, survey->high);
}

/* ---- dropping rows and lines ---- */

static pia_status record_dropped(pia_fit *fit, pia_index more)
{
    pia_index *dropped = pia_take(fit->context, fit->dropped_count + more, sizeof *dropped);
    if (dropped == NULL) return PIA_E_MEMORY;
    if (fit->dropped_count > 0) memcpy(dropped, fit->dropped, (size_t)fit->dropped_count * sizeof *dropped);
    pia_give(fit->context, fit->dropped);
    fit->dropped = dropped;
    return PIA_OK;
}

static int compare_indices(const void *a, const void *b)
{
    pia_index x = *(const pia_index *)a, y = *(const pia_index *)b;
    return (x > y) - (x < y);
}

pia_status pia_fit_own_rows(pia_fit *fit)
{
    if (fit->own_points == NULL) {
        fit->own_points = pia_take(fit->context, fit->rows * fit->dim, sizeof(double));
        if (fit->own_points == NULL) return PIA_E_MEMORY;
        memcpy(fit->own_points, fit->points, (size_t)(fit->rows * fit->dim) * sizeof(double));
        fit->points = fit->own_points;
    }
    if (fit->row == NULL) {
        fit->row = pia_take(fit->context, fit->rows, sizeof *fit->row);
        if (fit->row == NULL) return PIA_E_MEMORY;
        for (pia_index i = 0; i < fit->rows; i++) fit->row[i] = i;
    }
    return PIA_OK;
}

pia_status pia_fit_drop_rows(pia_fit *fit, const unsigned char *keep)
{
    pia_index kept = 0;
    for (pia_index i = 0; i < fit->rows; i++) kept += keep[i];
    if (kept == fit->rows) return PIA_OK;
    pia_status status = pia_fit_own_rows(fit);
    if (status == PIA_OK) status = record_dropped(fit, fit->rows - kept);
    if (status != PIA_OK) return status;
    kept = 0;
    for (pia_index i = 0; i < fit->rows; i++) {
        if (!keep[i]) {
            fit->dropped[fit->dropped_count++] = fit->row[i];
            continue;
        }
        memmove(fit->own_points + kept * fit->dim, fit->own_points + i * fit->dim, (size_t)fit->dim * sizeof(double));
        double *per_row[] = {fit->weights, fit->tolerances, fit->inverse_tolerance};
        for (size_t k = 0; k < sizeof per_row / sizeof *per_row; k++)
            if (per_row[k] != NULL) per_row[k][kept] = per_row[k][i];
        if (fit->parameter[0] != NULL && fit->directions == 1) fit->parameter[0][kept] = fit->parameter[0][i];
        fit->row[kept++] = fit->row[i];
    }
    qsort(fit->dropped, (size_t)fit->dropped_count, sizeof *fit->dropped, compare_indices);
    fit->rows = kept;
    if (fit->kind != PIA_GRID) fit->count[0] = kept;
    return PIA_OK;
}

pia_status pia_fit_drop_lines(pia_fit *fit, int direction, const unsigned char *keep)
{
    pia_index lines = 0;
    for (pia_index i = 0; i < fit->count[direction]; i++) lines += keep[i];
    if (lines == fit->count[direction]) return PIA_OK;
    unsigned char *keep_row = pia_take(fit->context, fit->rows, 1);
    if (keep_row == NULL) return PIA_E_MEMORY;
    for (pia_index r = 0; r < fit->rows; r++) keep_row[r] = keep[direction == 0 ? r / fit->count[1] : r % fit->count[1]];
    pia_status status = pia_fit_drop_rows(fit, keep_row);
    pia_give(fit->context, keep_row);
    if (status != PIA_OK) return status;
    if (fit->parameter[direction] != NULL) {
        pia_index to = 0;
        for (pia_index i = 0; i < fit->count[direction]; i++)
            if (keep[i]) fit->parameter[direction][to++] = fit->parameter[direction][i];
    }
    fit->count[direction] = lines;
    return PIA_OK;
}

/* ---- function graphs: component 0 is the parameter ---- */

typedef struct abscissa {
    double x;
    pia_index row;
} abscissa;

static int compare_abscissas(const void *a, const void *b)
{
    const abscissa *p = a, *q = b;
    if (p->x != q->x) return p->x < q->x ? -1 : 1;
    return (p->row > q->row) - (p->row < q->row);
}

/* Rows sorted by abscissa, values and weights carried along; x becomes the parameter. */
static pia_status take_graph(pia_fit *fit, const pia_data *data)
{
    pia_index rows = data->count[0];
    abscissa *order = pia_take(fit->context, rows, sizeof *order);
    fit->own_points = pia_take(fit->context, rows * fit->dim, sizeof(double));
    fit->row = pia_take(fit->context, rows, sizeof *fit->row);
    fit->parameter[0] = pia_take(fit->context, rows, sizeof(double));
    if (order == NULL || fit->own_points == NULL || fit->row == NULL || fit->parameter[0] == NULL) {
        pia_give(fit->context, order);
        return PIA_E_MEMORY;
    }
    int sorted = 1;
    for (pia_index i = 0; i < rows; i++) {
        order[i] = (abscissa){data->points[i * data->dim], i};
        sorted &= i == 0 || order[i - 1].x <= order[i].x;
    }
    if (!sorted) {
        qsort(order, (size_t)rows, sizeof *order, compare_abscissas);
        pia_fit_note_add(fit, "rows were sorted by the first column, the parameter");
    }
    for (pia_index i = 0; i < rows; i++) {
        pia_index from = order[i].row;
        memcpy(fit->own_points + i * fit->dim, data->points + from * data->dim + 1, (size_t)fit->dim * sizeof(double));
        fit->parameter[0][i] = order[i].x;
        fit->row[i] = from;
        if (fit->weights != NULL) fit->weights[i] = data->weights[from];
        if (fit->tolerances != NULL) {
            fit->tolerances[i] = data->tolerances[from];
            fit->inverse_tolerance[i] = 1 / data->tolerances[from];
        }
    }
    pia_give(fit->context, order);
    fit->points = fit->own_points;
    if (fit->parameter[0][0] < fit->parameter[0][rows - 1]) return PIA_OK;
    return pia_fail(fit->context, PIA_E_DATA, "all abscissas equal %g; a function graph needs at least two", fit->parameter[0][0]);
}

static pia_status take_weights(pia_fit *fit, const double *weights)
{
    if (weights == NULL) return PIA_OK;
    double sum = 0;
    fit->weights = pia_take(fit->context, fit->rows, sizeof(double));
    if (fit->weights == NULL) return PIA_E_MEMORY;
    for (pia_index i = 0; i < fit->rows; i++) {
        if (!(weights[i] >= 0) || isinf(weights[i]))
            return pia_fail(fit->context, PIA_E_DATA, "weight %lld is %g; weights are finite and not negative", (long long)i,
                            weights[i]);
        sum += weights[i];
        fit->weights[i] = weights[i];
    }
    if (sum > 0 && isfinite(sum)) return PIA_OK;
    return pia_fail(fit->context, PIA_E_DATA, "the weights add up to %g; at least one must be positive, and none huge", sum);
}

static pia_status check_shape(pia_fit *fit, const pia_data *data)
{
    pia_context *context = fit->context;
    if (data->points == NULL) return pia_fail(context, PIA_E_ARGUMENT, "no points were given");
    if ((unsigned)data->kind > PIA_SCATTERED)
        return pia_fail(context, PIA_E_ARGUMENT, "kind %d is none of curve, grid, scattered", (int)data->kind);
    if (data->dim < 1 || data->dim > PIA_MAX_DIM)
        return pia_fail(context, PIA_E_SHAPE, "points have %d components; 1 to %d are possible", data->dim, PIA_MAX_DIM);
    if (data->function_graph && (data->kind != PIA_CURVE || data->dim < 2))
        return pia_fail(context, PIA_E_SHAPE, "a function graph is a curve with an abscissa and at least one value a row");
    pia_index size;
    if (data->count[0] < 0 || data->count[1] < 0 || !pia_multiply(data->count[0], data->count[1], &fit->rows) ||
        !pia_multiply(fit->rows, data->dim * (pia_index)sizeof(double), &size))
        return pia_fail(context, PIA_E_SIZE, "%lld x %lld points do not fit in memory", (long long)data->count[0],
                        (long long)data->count[1]);
    if (data->kind != PIA_GRID && data->count[1] != 1)
        return pia_fail(context, PIA_E_SHAPE, "count[1] is %lld; it is 1 unless a grid is fitted", (long long)data->count[1]);
    pia_index least = data->kind == PIA_GRID && data->count[1] < data->count[0] ? data->count[1] : data->count[0];
    if (least < 2)
        return pia_fail(context, PIA_E_DATA, "%lld point%s too few; a %s needs at least two%s", (long long)least,
                        least == 1 ? " is" : "s are", data->kind == PIA_CURVE ? "curve" : "surface",
                        data->kind == PIA_GRID ? " in each direction" : "");
    return PIA_OK;
}

/* Two points are one: a closed curve whose ends were computed may miss itself by rounding. */
static int same_point(const pia_fit *fit, pia_index row, pia_index other)
{
    double square = 0;
    for (int d = 0; d < fit->dim; d++) {
        double a = fit->points[row * fit->dim + d], b = fit->points[other * fit->dim + d];
        if (isnan(a) && isnan(b)) continue;
        square += (a - b) * (a - b);
    }
    return sqrt(square) <= 1e-14 * fit->extent;
}

/* A closed direction whose last point (line) repeats the first one drops it. */
static pia_status drop_seam(pia_fit *fit, int direction)
{
    pia_index lines = fit->count[direction], other = fit->rows / lines;
    for (pia_index j = 0; j < other; j++) {
        pia_index first = direction == 0 ? j : j * lines, last = direction == 0 ? (lines - 1) * other + j : j * lines + lines - 1;
        if (!same_point(fit, first, last)) return PIA_OK;
    }
    unsigned char *keep = pia_take(fit->context, lines, 1);
    if (keep == NULL) return PIA_E_MEMORY;
    memset(keep, 1, (size_t)lines);
    keep[lines - 1] = 0;
    pia_status status = fit->directions == 1 ? pia_fit_drop_rows(fit, keep) : pia_fit_drop_lines(fit, direction, keep);
    pia_give(fit->context, keep);
    if (status == PIA_OK && fit->directions == 1)
        pia_fit_note_add(fit, "the last row repeats the first one and was dropped: the curve is closed");
    if (status == PIA_OK && fit->directions == 2)
        pia_fit_note_add(fit, "the last line in %c repeats the first one and was dropped: the direction is closed", 'u' + direction);
    return status;
}

/* Whether parameters, knots and method can be chosen before anybody looks at the points; those of a grid may be holes, which only a
 * careful fit knows in time. */
static int may_wait(const pia_fit *fit, const pia_data *data)
{
    if (data->parameters == NULL || fit->options.closed[0]) return 0;
    if (fit->kind == PIA_GRID) return !fit->careful && !fit->options.closed[1];
    return fit->kind == PIA_CURVE && !fit->function_graph;
}

pia_status pia_fit_take_data(pia_fit *fit, const pia_data *data)
{
    pia_status status = check_shape(fit, data);
    if (status != PIA_OK) return status;
    fit->kind = data->kind;
    fit->directions = data->kind == PIA_CURVE ? 1 : 2;
    fit->count[0] = data->count[0];
    fit->count[1] = data->count[1];
    fit->given = fit->rows;
    fit->function_graph = data->function_graph;
    fit->dim = data->dim - (data->function_graph != 0);
    fit->points = data->points;
    fit->unseen = may_wait(fit, data);
    if (!fit->unseen) status = see(fit, data->points, data->dim);
    if (status == PIA_OK) status = take_weights(fit, data->weights);
    if (status == PIA_OK) status = pia_fit_take_tolerances(fit, data->tolerances);
    if (status == PIA_OK && fit->function_graph) return take_graph(fit, data);
    if (status == PIA_OK && !fit->borrowed) {
        fit->own_points = pia_take(fit->context, fit->rows * fit->dim, sizeof(double));
        if (fit->own_points == NULL) return PIA_E_MEMORY;
        memcpy(fit->own_points, fit->points, (size_t)(fit->rows * fit->dim) * sizeof(double));
        fit->points = fit->own_points;
    }
    for (int d = 0; status == PIA_OK && d < fit->directions && fit->kind != PIA_SCATTERED; d++)
        if (fit->options.closed[d]) status = drop_seam(fit, d);
    return status;
}
