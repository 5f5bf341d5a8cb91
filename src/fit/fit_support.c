/* Control points that the data do not hold, found before solving. Least squares alone would put them anywhere, and those around them
 * far away; so where there are any, all control points are pulled to the start, as little as keeps the limit near the data. Every
 * method then has that limit. Fairing holds all control points itself. */
#include "fit.h"
#include "kernel.h"
#include "support.h"

#include <math.h>
#include <string.h>

/* A control point is barely held when the mean of its basis values, weighted by themselves, is below this: noise comes back a thousand
 * times as large. */
static const double BARELY = 1e-3;

/* Relative to the mean diagonal of the data's H; the first one that gives a tame limit is taken. */
static const double pulls[] = {1e-9, 1e-7, 1e-5, 1e-3, 1e-1};
enum { PULLS = sizeof pulls / sizeof *pulls, ROUNDS = 32 };

static const double TAME = 3;     /* extents from the centre of the data */
static const double WORTH = 3e-3; /* of the sum of squares: what a farther limit takes away at least */

/* ---- finding ---- */

typedef struct rows {
    const pia_collocation *line;
    const double *weights; /* NULL: 1 */
} rows;

/* As many different parameters of rows that count in each of these spans as make Schoenberg and Whitney content: O(spans degree). */
static int are_dense(const void *data, pia_index from, pia_index to)
{
    const rows *r = data;
    const pia_collocation *line = r->line;
    for (pia_index s = from; s < to; s++) {
        int found = 0;
        double last = NAN;
        for (pia_index row = line->begin[s]; row < line->begin[s + 1] && found <= line->degree; row++) {
            if (line->parameters[row] == last || (r->weights != NULL && !(r->weights[row] > 0))) continue;
            last = line->parameters[row];
            found++;
        }
        if (found <= line->degree) return 0;
    }
    return 1;
}

/* held [unknowns] of one direction. */
static void find_held(pia_context *context, const pia_collocation *line, const double *weights, unsigned char *held)
{
    memset(held, 1, (size_t)line->unknowns);
    const rows r = {line, weights};
    if (pia_all(context, line->full - line->degree, are_dense, &r)) return;
    pia_support_line support = {line->degree, line->map == PIA_MAP_CYCLIC, line->knots, line->unknowns, line->parameters, weights,
                                line->rows};
    pia_support_find(&support, held);
}

/* held [unknowns of u + unknowns of v] by the lines of curves and grids, all 1 for scattered points. */
static void find_lines(const pia_fit *fit, unsigned char *held)
{
    const pia_op *op = fit->op;
    memset(held, 1, (size_t)(op->count[0] + op->count[1]));
    for (int d = 0; d < op->directions && op->line[d] != NULL; d++)
        find_held(fit->context, op->line[d], op->directions == 1 ? op->weights : NULL, held + (d == 0 ? 0 : op->count[0]));
}

typedef struct search {
    const pia_fit *fit;
    const unsigned char *lines; /* as find_lines gives them */
} search;

/* Control point c = (i, j). */
static int is_held(const search *s, pia_index c, pia_index i, pia_index j)
{
    const pia_op *op = s->fit->op;
    const pia_normal *normal = s->fit->normal;
    if (op->frozen != NULL && op->frozen[c]) return 1;
    return s->lines[i] && s->lines[op->count[0] + j] && normal->diagonal[c] > BARELY * normal->column_sum[c];
}

static int are_held(const void *data, pia_index from, pia_index to)
{
    const search *s = data;
    pia_index columns = s->fit->op->count[1], i = from / columns, j = from % columns;
    for (pia_index c = from; c < to; c++) {
        if (!is_held(s, c, i, j)) return 0;
        if (++j < columns) continue;
        j = 0;
        i++;
    }
    return 1;
}

static pia_status list_unsupported(pia_fit *fit, const search *s)
{
    const pia_op *op = fit->op;
    pia_index count = 0, at = 0;
    for (pia_index c = 0; c < op->cols; c++) count += !is_held(s, c, c / op->count[1], c % op->count[1]);
    fit->unsupported = pia_take(fit->context, count, sizeof *fit->unsupported);
    if (fit->unsupported == NULL) return pia_take_status(fit->context, count, sizeof *fit->unsupported);
    fit->unsupported_count = count;
    for (pia_index c = 0; c < op->cols; c++)
        if (!is_held(s, c, c / op->count[1], c % op->count[1])) fit->unsupported[at++] = c;
    return PIA_OK;
}

static pia_status find_unsupported(pia_fit *fit)
{
    const pia_op *op = fit->op;
    unsigned char *lines = pia_take(fit->context, op->count[0] + op->count[1], 1);
    if (lines == NULL) return pia_take_status(fit->context, op->count[0] + op->count[1], 1);
    find_lines(fit, lines);
    search s = {fit, lines};
    pia_status status = pia_all(fit->context, op->cols, are_held, &s) ? PIA_OK : list_unsupported(fit, &s);
    pia_give(fit->context, lines);
    return status;
}

/* ---- holding ---- */

pia_status pia_fit_open_normal(pia_fit *fit)
{
    pia_iterate *iterate = &fit->iterate;
    pia_addition addition = {.fairing = fit->options.fairing, .pull = fit->pull, .start = fit->pull_start, .owner = fit};
    if (fit->unseen) addition.look = pia_fit_look;
    pia_normal_close(fit->normal);
    iterate->normal = fit->normal = NULL;
    pia_status status = pia_normal_open_with(fit->op, &iterate->targets, &addition, &fit->normal);
    if (status != PIA_OK) return status;
    iterate->normal = fit->normal;
    iterate->right_norm = sqrt(pia_iterate_dot(iterate, fit->normal->right, fit->normal->right));
    return PIA_OK;
}

static double mean_diagonal(const pia_fit *fit)
{
    double sum = 0;
    for (pia_index c = 0; c < fit->op->cols; c++) sum += fit->normal->diagonal[c];
    return sum / (double)fit->op->cols;
}

static pia_index count_empty(const pia_fit *fit)
{
    const pia_op *op = fit->op;
    pia_index empty = 0;
    for (pia_index c = 0; c < op->cols; c++) empty += fit->normal->diagonal[c] == 0 && !(op->frozen != NULL && op->frozen[c]);
    return empty;
}

/* Whether the limit x is unique but for control points without any data, which stay, and near the data. d: work; [cols x dim] both. */
static pia_status try_limit(pia_fit *fit, double *x, double *d, int *tame)
{
    pia_normal *normal = fit->normal;
    const double *start = fit->iterate.points;
    pia_index size = fit->op->cols * fit->dim;
    pia_status status = normal->class->factor(normal);
    if (status != PIA_OK) return status;
    normal->class->multiply(normal, start, fit->dim, d);
    for (pia_index i = 0; i < size; i++) d[i] = normal->right[i] - d[i];
    normal->class->solve(normal, d, fit->dim);
    *tame = normal->weak <= count_empty(fit);
    for (pia_index i = 0; i < size; i++) {
        x[i] = start[i] + d[i];
        *tame &= fabs(x[i]) <= TAME * fit->extent;
    }
    return PIA_OK;
}

/* How far the limit x moves where the pull leads to x itself: d := pull H^-1 (x - start). Returns what that takes from the sum of
 * squares of the data, pull d (x - start + d); 0 when it is not tame. */
static double next_step(const pia_fit *fit, const double *x, double *d)
{
    const double *start = fit->pull_start;
    pia_index size = fit->op->cols * fit->dim;
    double gain = 0;
    int tame = 1;
    for (pia_index i = 0; i < size; i++) d[i] = fit->pull * (x[i] - start[i]);
    fit->normal->class->solve(fit->normal, d, fit->dim);
    for (pia_index i = 0; i < size; i++) {
        gain += fit->pull * d[i] * (x[i] - start[i] + d[i]);
        tame &= fabs(x[i] + d[i]) <= TAME * fit->extent;
    }
    return tame ? gain : 0;
}

/* The pull takes from what the data say. Where it leads to the last limit x instead, it takes less, and control points that the data do
 * not hold go farther: as long as that is worth it. d: work. */
static pia_status approach(pia_fit *fit, double *x, double *d)
{
    pia_index size = fit->op->cols * fit->dim, round = 0;
    double left = pia_op_residual(fit->op, x, &fit->iterate.targets, NULL).weighted, gain;
    for (; round < ROUNDS && (gain = next_step(fit, x, d)) > WORTH * left; round++) {
        memcpy(fit->pull_start, x, (size_t)size * sizeof *x);
        for (pia_index i = 0; i < size; i++) x[i] += d[i];
        left -= gain;
    }
    return round > 0 ? pia_fit_open_normal(fit) : PIA_OK;
}

static pia_status hold(pia_fit *fit)
{
    pia_index size = fit->op->cols * fit->dim;
    double mean = mean_diagonal(fit);
    int tame = 0;
    double *x = pia_take(fit->context, size, 2 * sizeof *x);
    fit->pull_start = pia_take(fit->context, size, sizeof *fit->pull_start);
    pia_status status = x != NULL && fit->pull_start != NULL ? PIA_OK : pia_take_status(fit->context, size, 2 * sizeof *x);
    if (status == PIA_OK) memcpy(fit->pull_start, fit->iterate.points, (size_t)size * sizeof *x);
    if (status == PIA_OK) status = try_limit(fit, x, x + size, &tame);
    for (int k = 0; k < PULLS && status == PIA_OK && !tame; k++) {
        fit->pull = pulls[k] * mean;
        status = pia_fit_open_normal(fit);
        if (status == PIA_OK) status = try_limit(fit, x, x + size, &tame);
    }
    if (status == PIA_OK && tame && fit->pull > 0) status = approach(fit, x, x + size);
    pia_give(fit->context, x);
    return status;
}

void pia_fit_support_close(pia_fit *fit)
{
    pia_give(fit->context, fit->unsupported);
    pia_give(fit->context, fit->pull_start);
    fit->unsupported = NULL;
    fit->pull_start = NULL;
    fit->unsupported_count = 0;
    fit->pull = 0;
}

pia_status pia_fit_support(pia_fit *fit)
{
    if (fit->square || fit->normal == NULL) return PIA_OK;
    pia_status status = find_unsupported(fit);
    if (status != PIA_OK || fit->unsupported_count == 0 || fit->options.fairing > 0) return status;
    if (fit->iterate.start != NULL) status = fit->iterate.start(fit);
    return status == PIA_OK ? hold(fit) : status;
}

void pia_fit_describe_support(pia_fit *fit)
{
    if (fit->unsupported_count == 0) return;
    pia_fit_outcome_add(fit,
                        fit->options.fairing > 0 ? "control points that the data do not hold, left to fairing"
                                                 : "control points that the data do not hold, kept near the start",
                        fit->unsupported, fit->unsupported_count);
}

pia_status pia_fit_unsupported(pia_fit *fit, const pia_index **control, pia_index *count)
{
    if (control == NULL || count == NULL) return pia_fail(fit->context, PIA_E_ARGUMENT, "control or count is NULL");
    *control = fit->unsupported;
    *count = fit->unsupported_count;
    return PIA_OK;
}
