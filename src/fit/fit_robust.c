/* Robust losses by iteratively reweighted least squares: fit, weigh every row by how far it is off, fit again from there, until the
 * weights settle. Weights belong to the iterate; the fit around them may be any least-squares method. */
#include "fit.h"
#include "select.h"

#include <math.h>
#include <string.h>

enum { MOST_ROUNDS = 100, CONVEX_ROUNDS = 10 };

static const double SETTLED = 1e-5, ALMOST_SETTLED = 1e-2; /* largest change of a weight */
static const double NORMAL_MEDIAN = 0.6745;                /* of |x|, x normally distributed with variance 1 */

pia_status pia_fit_choose_loss(pia_fit *fit)
{
    const pia_fit_options *o = &fit->options;
    pia_robust *r = &fit->robust;
    if (o->robust == NULL) return PIA_OK;
    if (strcmp(o->robust, "huber") != 0 && strcmp(o->robust, "tukey") != 0)
        return pia_fail(fit->context, PIA_E_ARGUMENT, "there is no robust loss \"%s\"; there are huber, tukey", o->robust);
    r->loss = o->robust[0] == 'h' ? PIA_LOSS_HUBER : PIA_LOSS_TUKEY;
    r->convex = r->loss == PIA_LOSS_TUKEY;
    r->tuning = o->robust_scale == PIA_AUTO ? (r->loss == PIA_LOSS_HUBER ? 1.345 : 4.685) : o->robust_scale;
    if (fit->square || pia_fit_is_grouped(fit))
        return pia_fail(fit->context, PIA_E_ARGUMENT,
                        "a robust loss needs least squares, fewer control points than data; method %s is none",
                        fit->solve.method->name);
    if (fit->refining)
        return pia_fail(
            fit->context, PIA_E_ARGUMENT,
            "a tolerance adds knots for every point, outliers included; with a robust loss give the number of control points");
    return PIA_OK;
}

const double *pia_fit_row_weights(const pia_fit *fit)
{
    return fit->robust.loss != PIA_LOSS_NONE ? fit->robust.product : fit->weights;
}

static double given_weight(const pia_fit *fit, pia_index row)
{
    return fit->weights != NULL ? fit->weights[row] : 1;
}

void pia_fit_mix_weights(pia_fit *fit)
{
    pia_robust *r = &fit->robust;
    for (pia_index i = 0; r->loss != PIA_LOSS_NONE && i < fit->rows; i++) r->product[i] = r->weight[i] * given_weight(fit, i);
}

pia_status pia_fit_take_loss(pia_fit *fit)
{
    pia_robust *r = &fit->robust;
    if (r->loss == PIA_LOSS_NONE) return PIA_OK;
    if (r->rows != fit->rows || r->product == NULL) {
        int keep = r->rows == fit->rows && r->weight != NULL;
        double *weight = keep ? r->weight : pia_take(fit->context, fit->rows, sizeof *weight);
        double *product = pia_take(fit->context, fit->rows, sizeof *product);
        if (!keep) pia_give(fit->context, r->weight);
        pia_give(fit->context, r->product);
        r->weight = weight;
        r->product = product;
        r->rows = fit->rows;
        if (weight == NULL || product == NULL) return pia_take_status(fit->context, fit->rows, sizeof *weight);
        for (pia_index i = 0; i < fit->rows && !keep; i++) weight[i] = 1;
    }
    pia_fit_mix_weights(fit);
    return PIA_OK;
}

void pia_fit_robust_close(pia_fit *fit)
{
    pia_give(fit->context, fit->robust.weight);
    pia_give(fit->context, fit->robust.product);
}

static int is_hole(const pia_fit *fit, pia_index row)
{
    double sum = 0;
    for (int d = 0; d < fit->dim; d++) sum += fit->points[row * fit->dim + d];
    return isnan(sum);
}

/* off [rows]: how far each row is off, in units of its own accuracy 1 / sqrt(weight); -1 for rows that say nothing. */
static void measure_rows(const pia_fit *fit, const double *residual, double *off)
{
    for (pia_index i = 0; i < fit->rows; i++) {
        double square = 0, weight = given_weight(fit, i);
        for (int d = 0; d < fit->dim; d++) square += residual[i * fit->dim + d] * residual[i * fit->dim + d];
        off[i] = weight > 0 && !is_hole(fit, i) ? sqrt(weight * square) : -1;
    }
}

/* The spread of the good rows, outliers or not: the median over that of a normal distribution. Not below rounding. */
static double find_spread(const pia_fit *fit, const double *off, double *work)
{
    pia_index count = 0;
    double heaviest = 0;
    for (pia_index i = 0; i < fit->rows; i++) {
        if (off[i] < 0) continue;
        work[count++] = off[i];
        heaviest = fmax(heaviest, given_weight(fit, i));
    }
    double least = 1e-12 * fit->extent * sqrt(heaviest);
    return count > 0 ? fmax(pia_select(work, count, count / 2) / NORMAL_MEDIAN, least) : least;
}

static double huber(double off)
{
    return off <= 1 ? 1 : 1 / off;
}

static double tukey(double off)
{
    return off < 1 ? (1 - off * off) * (1 - off * off) : 0;
}

/* Tukey's loss has many minima; the convex one leads to the right one. Returns the largest change of a weight. */
static double weigh_rows(pia_fit *fit, const double *off, double spread)
{
    pia_robust *r = &fit->robust;
    int convex = r->loss == PIA_LOSS_HUBER || r->convex;
    double change = 0, unit = spread * (convex && r->loss == PIA_LOSS_TUKEY ? 1.345 : r->tuning);
    r->outliers = 0;
    for (pia_index i = 0; i < fit->rows; i++) {
        if (off[i] < 0) continue;
        double weight = convex ? huber(off[i] / unit) : tukey(off[i] / unit);
        change = fmax(change, fabs(weight - r->weight[i]));
        r->weight[i] = weight;
        r->outliers += weight < 0.5;
    }
    return change;
}

/* New weights from the current iterate, and the fit ready to go on with them, unless they have settled. */
static pia_status reweigh(pia_fit *fit)
{
    pia_robust *r = &fit->robust;
    pia_iterate *iterate = &fit->iterate;
    double *residual = pia_take(fit->context, fit->rows, (size_t)fit->dim * sizeof *residual);
    double *off = pia_take(fit->context, fit->rows, 2 * sizeof *off);
    pia_status status = pia_take_status(fit->context, fit->rows, (size_t)(fit->dim + 2) * sizeof *off);
    if (residual != NULL && off != NULL) {
        pia_op_residual(fit->op, iterate->points, &iterate->targets, residual);
        measure_rows(fit, residual, off);
        double change = weigh_rows(fit, off, find_spread(fit, off, off + fit->rows));
        r->settled = change <= SETTLED || ++r->round >= MOST_ROUNDS;
        if (r->convex && r->loss == PIA_LOSS_TUKEY && (change <= ALMOST_SETTLED || r->round >= CONVEX_ROUNDS))
            r->convex = r->settled = 0;
        status = PIA_OK;
    }
    pia_give(fit->context, residual);
    pia_give(fit->context, off);
    if (status != PIA_OK || r->settled) return status;
    pia_fit_mix_weights(fit);
    return pia_fit_refresh(fit, 0, fit->rows - 1);
}

/* Reasons after which another round makes no sense. */
static int is_over(const pia_fit *fit)
{
    pia_stop stop = fit->solve.stop;
    if (stop == PIA_STOP_ITERATIONS) return fit->options.max_iterations != PIA_AUTO;
    return stop == PIA_STOP_NONE || stop == PIA_STOP_TIME || stop == PIA_STOP_CANCELLED;
}

pia_status pia_fit_robust_step(pia_fit *fit, pia_index iterations)
{
    pia_solve *solve = &fit->solve;
    pia_index now = fit->iterate.iteration, goal = iterations > INT64_MAX - now ? INT64_MAX : now + iterations;
    pia_status status = pia_solve_step(solve, iterations);
    while (status == PIA_OK && !is_over(fit) && !fit->robust.settled) {
        pia_index first = solve->first_iteration;
        status = reweigh(fit);
        if (status != PIA_OK || fit->robust.settled) break;
        status = pia_solve_restart(solve, &fit->method_values, &fit->limiter_values);
        if (status != PIA_OK) break;
        if (fit->options.max_iterations != PIA_AUTO) solve->first_iteration = first;
        status = pia_solve_step(solve, goal - fit->iterate.iteration);
    }
    return status;
}

void pia_fit_describe_outliers(pia_fit *fit)
{
    const pia_robust *r = &fit->robust;
    pia_index list[PIA_LISTED], listed = 0;
    for (pia_index i = 0; i < r->rows && listed < r->outliers && listed < PIA_LISTED; i++)
        if (r->weight[i] < 0.5) list[listed++] = fit->row != NULL ? fit->row[i] : i;
    if (r->outliers > 0) pia_fit_outcome_add(fit, "outliers, data rows of less than half weight", list, r->outliers);
    if (r->round >= MOST_ROUNDS)
        pia_note_add(pia_memory_of(fit->context), &fit->outcome, "the weights of the robust loss had not settled after %d rounds",
                     MOST_ROUNDS);
}

pia_status pia_fit_weights(pia_fit *fit, const double **weights, const pia_index **row, pia_index *count)
{
    if (weights == NULL || count == NULL) return pia_fail(fit->context, PIA_E_ARGUMENT, "weights or count is NULL");
    int robust = fit->robust.loss != PIA_LOSS_NONE;
    *weights = robust ? fit->robust.weight : NULL;
    *count = robust ? fit->robust.rows : 0;
    if (row != NULL) *row = fit->row;
    return PIA_OK;
}
