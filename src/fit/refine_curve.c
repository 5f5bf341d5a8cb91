/* A curve to a tolerance. Grow: least squares, then knots where the error is. Spare: knots are taken away as long as the tolerance
 * holds. Correct: where true distances count, parameters move to the foot points, which leaves room to spare more. */
#include "refine.h"

#include <math.h>
#include <string.h>

enum { MAX_GROWTH = 60, CORRECTIONS = 6, NEWTON_STEPS = 3 };

/* Parameters at the foot points of the current curve; taken back where a step that was meant to bring points closer did not. */
static pia_status move_to_feet(pia_fit *fit)
{
    double *before = pia_take(fit->context, fit->rows, sizeof *before);
    if (before == NULL) return PIA_E_MEMORY;
    memcpy(before, fit->parameter[0], (size_t)fit->rows * sizeof *before);
    pia_status status = PIA_OK;
    for (int newton = 0; newton < NEWTON_STEPS && status == PIA_OK; newton++) status = pia_fit_project(&fit->iterate);
    pia_iterate_measure(&fit->iterate);
    if (pia_refine_worst(fit, 0, fit->rows) > 1) {
        memcpy(fit->parameter[0], before, (size_t)fit->rows * sizeof *before);
        pia_collocation_rebucket(&fit->line[0]);
        fit->iterate.errors_known = 0;
        pia_iterate_measure(&fit->iterate);
    }
    pia_give(fit->context, before);
    return status;
}

static pia_status grow_until_kept(pia_fit *fit)
{
    pia_status status = fit->round == 0 ? pia_refine_solve(fit) : PIA_OK;
    if (status == PIA_OK && fit->round == 0 && fit->solve.rules.trace_every > 0) status = pia_solve_trace(&fit->solve);
    int more = 1;
    for (int k = 0; k < MAX_GROWTH && status == PIA_OK && more && !pia_refine_reached(fit) && !pia_refine_stopped(fit); k++) {
        status = pia_refine_grow(fit, &more);
        if (status == PIA_OK && more) status = pia_refine_count(fit);
    }
    if (status == PIA_OK && !pia_refine_reached(fit) && !pia_refine_stopped(fit)) status = pia_refine_interpolate(fit);
    return status;
}

/* With weights or fairing the result is the least-squares fit on the knots that are found, since it is that they are about. */
static int is_weighed(const pia_fit *fit)
{
    return fit->weights != NULL || fit->options.fairing > 0;
}

pia_status pia_refine_curve(pia_fit *fit)
{
    pia_status status = grow_until_kept(fit);
    pia_stage *stage = &fit->stage;
    int kept = status == PIA_OK && pia_refine_reached(fit);
    while (kept && status == PIA_OK && stage->sparing < CORRECTIONS && stage->spares && !pia_refine_stopped(fit)) {
        pia_index spared;
        status = is_weighed(fit) ? pia_refine_spare_lines(fit, &spared) : pia_refine_spare(fit, &spared);
        stage->sparing++;
        stage->spares = spared > 0;
        if (status == PIA_OK) status = pia_refine_count(fit);
        if ((fit->options.measure_distance == 0 && stage->sparing > fit->options.correct) || fit->iterate.project == NULL) break;
        if (status == PIA_OK) status = move_to_feet(fit);
    }
    return status;
}
