/* From least squares to a fit that keeps the tolerance on the same knots, where there is one: the residuals of all splines are a plane,
 * those within the tolerance a product of balls, and Douglas and Rachford's iteration finds a point of both. A round costs a pass over
 * the data and a solve with the factors at hand; a weighted fit towards the smallest largest deviation would need new ones. */
#include "refine.h"

#include "clones.h"
#include "constraint.h"
#include "kernel.h"
#include "refine_relax.h"
#include "refine_tiles.h"

#include <math.h>
#include <string.h>

/* Beyond FAR least squares is too far off. After k rounds a search that has not come below 1 + LATE 2^(-k / HALF) is given up: those
 * that succeed mostly have. */
static const double FAR = 1.7, LATE = 0.25, HALF = 10;
enum { ROUNDS = 64, LOOK = 8, GRAIN = 4096, CHUNKS = 64 };

/* Rounds times rows in one refinement: a few seconds. */
static const double MOST = 1.5e8;

int pia_relax_is_vain(pia_index rounds, double best)
{
    if (rounds == 0) return best > FAR;
    return rounds >= ROUNDS || (rounds % LOOK == 0 && best > 1 + LATE * exp2(-(double)rounds / HALF));
}

typedef struct round_work {
    const pia_fit *fit;
    double *x, *missing;
    pia_index chunks;
} round_work;

/* x := x + b - a, b = the nearest to 2 a - x within the ball, a the residual; and what is missing from a to x. */
PIA_INLINE void reflect(const double *a, double allowed, int dim, double *x, double *missing)
{
    double reflected[PIA_MAX_DIM], square = 0;
    for (int d = 0; d < dim; d++) reflected[d] = 2 * a[d] - x[d];
    for (int d = 0; d < dim; d++) square += reflected[d] * reflected[d];
    double factor = square > allowed * allowed ? allowed / sqrt(square) : 1;
    for (int d = 0; d < dim; d++) {
        x[d] += factor * reflected[d] - a[d];
        missing[d] = a[d] - x[d];
    }
}

/* With limits of components b is brought into the box as well: a point of both, nearest where only one of them is left. */
static void reflect_within(const double *a, double allowed, const double *axis, int dim, double *x, double *missing)
{
    double before[PIA_MAX_DIM];
    memcpy(before, x, (size_t)dim * sizeof *before);
    reflect(a, allowed, dim, x, missing);
    for (int d = 0; d < dim; d++) {
        double most = PIA_INSIDE * axis[d], b = x[d] - before[d] + a[d];
        x[d] = before[d] + fmax(-most, fmin(b, most)) - a[d];
        missing[d] = a[d] - x[d];
    }
}

static void reflect_chunk(void *work, pia_index chunk)
{
    const round_work *w = work;
    const pia_fit *fit = w->fit;
    int dim = fit->dim;
    pia_index begin = pia_chunk_begin(fit->rows, w->chunks, chunk), end = pia_chunk_begin(fit->rows, w->chunks, chunk + 1);
    for (pia_index row = begin; row < end; row++) {
        const double *a = fit->iterate.residual + row * dim;
        double *x = w->x + row * dim, *missing = w->missing + row * dim, allowed = PIA_INSIDE * pia_refine_allowed(fit, row);
        if (fit->axis_tolerances != NULL)
            reflect_within(a, allowed, fit->axis_tolerances, dim, x, missing);
        else if (dim == 3)
            reflect(a, allowed, 3, x, missing);
        else
            reflect(a, allowed, dim, x, missing);
    }
}

/* The spline whose residuals are nearest to x. */
static pia_status project(pia_fit *fit, const double *missing)
{
    pia_iterate *iterate = &fit->iterate;
    pia_index size = fit->op->cols * fit->dim;
    pia_status status = PIA_OK;
    pia_op_gather(fit->op, missing, fit->op->weights, fit->dim, iterate->adjust);
    iterate->normal->class->solve(iterate->normal, iterate->adjust, fit->dim);
    pia_op_mask(fit->op, iterate->adjust, fit->dim);
    if (iterate->constraints != NULL)
        status = pia_constraints_correct(iterate->constraints, iterate->normal, iterate->points, iterate->adjust);
    for (pia_index i = 0; i < size; i++) iterate->points[i] += iterate->adjust[i];
    iterate->errors_known = 0;
    pia_iterate_measure(iterate);
    return status;
}

/* From least squares, or from where the fit before it, on more knots, came to. */
static pia_status search(pia_fit *fit, double *x, double *missing)
{
    round_work w = {.fit = fit, .x = x, .missing = missing, .chunks = pia_chunk_count(fit->rows, GRAIN)};
    pia_index size = fit->rows * fit->dim, k = 0;
    const double *a = fit->iterate.residual;
    pia_status status = PIA_OK;
    if (w.chunks > CHUNKS) w.chunks = CHUNKS;
    memcpy(x, fit->relaxed != NULL ? fit->relaxed : a, (size_t)size * sizeof *x);
    if (fit->relaxed != NULL) {
        for (pia_index i = 0; i < size; i++) missing[i] = a[i] - x[i];
        status = project(fit, missing);
    }
    double ratio = pia_refine_worst_of_all(fit), best = ratio;
    for (; status == PIA_OK && ratio > 1 && !pia_relax_is_vain(k, best); k++) {
        pia_for_each(fit->context, w.chunks, reflect_chunk, &w);
        status = project(fit, missing);
        ratio = pia_refine_worst_of_all(fit);
        best = fmin(best, ratio);
    }
    fit->relaxation += (double)k * (double)fit->rows;
    return status;
}

/* What the next search begins with. */
static void keep(pia_fit *fit, double *x)
{
    pia_give(fit->context, fit->relaxed);
    fit->relaxed = x;
}

/* The same on tiles. */
static pia_status relax_on_tiles(pia_fit *fit)
{
    pia_tiles tiles;
    pia_saved before;
    int found = 0;
    if (pia_refine_worst_of_all(fit) > FAR) return PIA_OK;
    pia_status status = pia_refine_save(fit, &before);
    if (status != PIA_OK) return status;
    status = pia_tiles_open(fit, &tiles);
    if (status == PIA_OK) {
        status = pia_tiles_search(&tiles, &found);
        if (found) {
            pia_tiles_control(&tiles, fit->iterate.points);
            fit->iterate.errors_known = 0;
            pia_iterate_measure(&fit->iterate);
            if (pia_refine_reached(fit))
                pia_tiles_keep(&tiles);
            else
                status = pia_refine_go_back(fit, &before);
        }
        pia_status left = pia_tiles_close(&tiles);
        if (status == PIA_OK) status = left;
    }
    pia_refine_drop(fit, &before);
    return status;
}

pia_status pia_refine_relax(pia_fit *fit)
{
    pia_index size = fit->op->cols * fit->dim, rows = fit->rows * fit->dim;
    if (pia_refine_reached(fit) || fit->relaxation > MOST || fit->weights != NULL || fit->options.fairing > 0) return PIA_OK;
    if (pia_tiles_suit(fit)) return relax_on_tiles(fit);
    if (fit->factored == 0) {
        pia_status status = pia_refine_factor(fit);
        if (status != PIA_OK) return status;
    }
    if (fit->factored < 2) return PIA_OK;
    double *x = pia_take(fit->context, rows, sizeof *x), *missing = pia_take(fit->context, rows, sizeof *missing);
    double *before = pia_take(fit->context, size, sizeof *before);
    pia_status status = x != NULL && missing != NULL && before != NULL ? PIA_OK : PIA_E_MEMORY;
    int kept = 0;
    if (status == PIA_OK) {
        memcpy(before, fit->iterate.points, (size_t)size * sizeof *before);
        status = search(fit, x, missing);
        if (status == PIA_OK && fit->iterate.constraints != NULL) pia_constraints_finish(fit->iterate.constraints, fit->iterate.points);
        fit->iterate.errors_known = 0;
        pia_iterate_measure(&fit->iterate);
        kept = status == PIA_OK && pia_refine_reached(fit);
    }
    if (kept) {
        keep(fit, x);
        x = NULL;
    } else if (status == PIA_OK) {
        memcpy(fit->iterate.points, before, (size_t)size * sizeof *before);
        fit->iterate.errors_known = 0;
        pia_iterate_measure(&fit->iterate);
    }
    pia_give(fit->context, x);
    pia_give(fit->context, missing);
    pia_give(fit->context, before);
    return status;
}
