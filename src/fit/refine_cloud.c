/* What refining scattered points needs beside knots: parameters at foot points, an end to growth that no longer helps, and a reason
 * where the tolerance cannot be had. */
#include "refine.h"

#include "overlap.h"
#include "sheets.h"

#include <math.h>

/* Growth is given up when so many times the control points have not helped. */
enum { PATIENCE = 6 };

/* It helps when the largest ratio or the RMS deviation falls at least with this power of the number of control points: on rough relief
 * they fall with the power 1/4 or more, on noise, walls and overhangs hardly. */
static const double HELPS = 0.1;

/* Sheets over each other in that share of the neighbourhoods are not tried to be met; foot points straighten a fold, which has less. */
static const double MOSTLY = 0.5;

int pia_refine_helps(const pia_fit *fit)
{
    const pia_watch *watch = &fit->stage.watch;
    return fit->kind != PIA_SCATTERED || watch->controls == 0 || fit->op->cols / PATIENCE < watch->controls;
}

void pia_refine_watch(pia_fit *fit)
{
    pia_watch *watch = &fit->stage.watch;
    double worst = pia_refine_worst(fit, 0, fit->rows), squares = fit->iterate.errors.sum_squares;
    double falls = watch->controls > 0 ? pow((double)fit->op->cols / (double)watch->controls, -HELPS) : INFINITY;
    if (watch->controls == 0 || worst < falls * watch->worst || squares < falls * falls * watch->squares)
        *watch = (pia_watch){worst, squares, fit->op->cols};
}

pia_status pia_refine_move_to_feet(pia_fit *fit)
{
    pia_fit_kept before;
    int *better = &fit->stage.feet;
    *better = 0;
    if (fit->kind != PIA_SCATTERED || !fit->options.measure_distance) return PIA_OK;
    int held = pia_refine_reached(fit);
    pia_status status = pia_fit_keep(fit, &before);
    if (status != PIA_OK) return status;
    status = fit->iterate.project(&fit->iterate);
    if (status == PIA_OK) status = pia_fit_assemble(fit);
    if (status == PIA_OK) status = pia_refine_solve(fit);
    if (status == PIA_OK && held) status = pia_refine_relax(fit);
    if (status == PIA_OK) {
        *better = held ? pia_refine_reached(fit) : fit->iterate.errors.weighted < before.squares;
        if (!*better) status = pia_fit_take_back(fit, &before, pia_fit_assemble);
        if (!*better && status == PIA_OK && !held) status = pia_refine_solve(fit); /* the same fit, with its factors */
        pia_iterate_measure(&fit->iterate);
    }
    pia_fit_keep_drop(fit, &before);
    return status;
}

static pia_index given_row(const pia_fit *fit, pia_index row)
{
    return fit->row != NULL ? fit->row[row] : row;
}

pia_status pia_refine_look_for_sheets(pia_fit *fit)
{
    pia_sheets sheets;
    double allowed = 0;
    if (fit->kind != PIA_SCATTERED || fit->was_grid || fit->stage.watch.controls > 0) return PIA_OK;
    for (pia_index row = 0; row < fit->rows; row++) allowed = fmax(allowed, pia_refine_allowed(fit, row));
    if (pia_refine_reached(fit) || pia_refine_stopped(fit)) return PIA_OK;
    pia_status status = pia_sheets_find(fit->context, fit->parameter[0], fit->points, fit->rows, fit->dim, 2 * allowed, &sheets);
    if (status != PIA_OK || !(sheets.share >= MOSTLY)) return status;
    const double *uv = fit->parameter[0] + 2 * sheets.row[0];
    pia_fit_note_add(fit,
                     "the points lie on sheets over each other: rows %lld and %lld are %g apart at nearly the same parameters (%.4g, "
                     "%.4g), and so are neighbours in %.0f %% of the base; the tolerance would take a surface that goes to and fro at "
                     "about every point, and was not tried: cut the points into single sheets, take another base with --param, or a "
                     "tolerance of more than half that distance",
                     (long long)given_row(fit, sheets.row[0]), (long long)given_row(fit, sheets.row[1]), sheets.distance, uv[0], uv[1],
                     100 * sheets.share);
    status = pia_refine_move_to_feet(fit);
    if (status == PIA_OK) status = pia_refine_count(fit);
    if (status == PIA_OK) fit->solve.stop = fit->stage.settled = pia_refine_reached(fit) ? PIA_STOP_TOLERANCE : PIA_STOP_NO_KNOT_LEFT;
    return status;
}

pia_status pia_refine_explain(pia_fit *fit)
{
    pia_overlap overlap;
    const double *points = fit->points;
    if (fit->kind != PIA_SCATTERED) return PIA_OK;
    pia_status status = pia_overlap_find(fit->context, fit->parameter[0], points, fit->rows, fit->dim, &overlap);
    if (status != PIA_OK) return status;
    double allowed = fmin(pia_refine_allowed(fit, overlap.row[0]), pia_refine_allowed(fit, overlap.row[1]));
    if (overlap.distance > 2 * allowed)
        pia_fit_note_add(
            fit,
            "rows %lld and %lld are %g apart at nearly the same parameters (%.4g, %.4g): there the points are no graph over "
            "their base (an overhang, a wall, outliers); another --param, or --measure distance, may do",
            (long long)given_row(fit, overlap.row[0]), (long long)given_row(fit, overlap.row[1]), overlap.distance,
            fit->parameter[0][2 * overlap.row[0]], fit->parameter[0][2 * overlap.row[0] + 1]);
    else if (fit->op->cols > fit->rows / 2)
        pia_fit_note_add(fit, "there are nearly as many control points as points: more points, or a larger tolerance, are needed");
    else
        pia_fit_note_add(fit, "finer knots no longer bring the surface closer: what is left is noise, or relief finer than the points "
                              "are dense; --robust huber lets outliers go");
    return PIA_OK;
}
