/* Control points that the data do not hold, found before solving. Least squares alone would put them anywhere, and those around them
 * far away; so where there are any, all control points are pulled to the start, as little as keeps the limit near the data. Every
 * method then has that limit. Fairing holds all control points itself. */
#include "fit.h"
#include "support.h"

#include <math.h>
#include <string.h>

/* A control point is barely held when the mean of its basis values, weighted by themselves, is below this: noise comes back a thousand
 * times as large. */
static const double BARELY = 1e-3;

/* Relative to the mean diagonal of the data's H; the first one that gives a tame limit is taken. */
static const double pulls[] = {1e-9, 1e-7, 1e-5, 1e-3, 1e-1};
enum { PULLS = sizeof pulls / sizeof *pulls };

static const double TAME = 3; /* extents from the centre of the data */

/* ---- finding ---- */

/* As many different parameters of rows that count in every span as make Schoenberg and Whitney content: O(spans degree). */
static int is_dense(const pia_collocation *line, const double *weights)
{
    for (pia_index s = 0; s < line->full - line->degree; s++) {
        int found = 0;
        double last = NAN;
        for (pia_index r = line->begin[s]; r < line->begin[s + 1] && found <= line->degree; r++) {
            if (line->parameters[r] == last || (weights != NULL && !(weights[r] > 0))) continue;
            last = line->parameters[r];
            found++;
        }
        if (found <= line->degree) return 0;
    }
    return 1;
}

/* held [unknowns] of one direction. */
static void find_held(const pia_collocation *line, const double *weights, unsigned char *held)
{
    memset(held, 1, (size_t)line->unknowns);
    if (is_dense(line, weights)) return;
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
        find_held(op->line[d], op->directions == 1 ? op->weights : NULL, held + (d == 0 ? 0 : op->count[0]));
}

static int is_held(const pia_fit *fit, const unsigned char *lines, pia_index c)
{
    const pia_op *op = fit->op;
    const pia_normal *normal = fit->normal;
    if (op->frozen != NULL && op->frozen[c]) return 1;
    if (!lines[c / op->count[1]] || !lines[op->count[0] + c % op->count[1]]) return 0;
    return normal->diagonal[c] > BARELY * normal->column_sum[c];
}

static pia_status find_unsupported(pia_fit *fit)
{
    const pia_op *op = fit->op;
    pia_index count = 0, at = 0;
    unsigned char *lines = pia_take(fit->context, op->count[0] + op->count[1], 1);
    if (lines == NULL) return pia_take_status(fit->context, op->count[0] + op->count[1], 1);
    find_lines(fit, lines);
    for (pia_index c = 0; c < op->cols; c++) count += !is_held(fit, lines, c);
    fit->unsupported = count > 0 ? pia_take(fit->context, count, sizeof *fit->unsupported) : NULL;
    if (count == 0 || fit->unsupported != NULL) {
        fit->unsupported_count = count;
        for (pia_index c = 0; c < op->cols; c++)
            if (!is_held(fit, lines, c)) fit->unsupported[at++] = c;
    }
    pia_give(fit->context, lines);
    return count == 0 || fit->unsupported != NULL ? PIA_OK : pia_take_status(fit->context, count, sizeof *fit->unsupported);
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

/* Whether the limit is unique but for control points without any data, which stay, and near the data. x: work [cols x dim]. */
static pia_status try_limit(pia_fit *fit, double *x, int *tame)
{
    pia_normal *normal = fit->normal;
    const double *start = fit->iterate.points;
    pia_index size = fit->op->cols * fit->dim;
    pia_status status = normal->class->factor(normal);
    if (status != PIA_OK) return status;
    normal->class->multiply(normal, start, fit->dim, x);
    for (pia_index i = 0; i < size; i++) x[i] = normal->right[i] - x[i];
    normal->class->solve(normal, x, fit->dim);
    *tame = normal->weak <= count_empty(fit);
    for (pia_index i = 0; i < size; i++) *tame &= fabs(start[i] + x[i]) <= TAME * fit->extent;
    return PIA_OK;
}

static pia_status hold(pia_fit *fit)
{
    pia_index size = fit->op->cols * fit->dim;
    double mean = mean_diagonal(fit);
    int tame = 0;
    double *x = pia_take(fit->context, size, sizeof *x);
    fit->pull_start = pia_take(fit->context, size, sizeof *fit->pull_start);
    pia_status status = x != NULL && fit->pull_start != NULL ? PIA_OK : pia_take_status(fit->context, size, sizeof *x);
    if (status == PIA_OK) memcpy(fit->pull_start, fit->iterate.points, (size_t)size * sizeof *x);
    if (status == PIA_OK) status = try_limit(fit, x, &tame);
    for (int k = 0; k < PULLS && status == PIA_OK && !tame; k++) {
        fit->pull = pulls[k] * mean;
        status = pia_fit_open_normal(fit);
        if (status == PIA_OK) status = try_limit(fit, x, &tame);
    }
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
    return hold(fit);
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
