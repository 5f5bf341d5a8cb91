/* Parameter correction (Hoschek 1988): the parameters move to the foot points of the fit, and the fit is made anew, as long as that
 * brings the points closer. A round that does not is taken back. */
#include "fit.h"

#include <math.h>
#include <string.h>

enum { NEWTON_STEPS = 3 };

void pia_fit_keep_drop(pia_fit *fit, pia_fit_kept *kept)
{
    pia_give(fit->context, kept->parameters);
    pia_give(fit->context, kept->points);
}

pia_status pia_fit_keep(pia_fit *fit, pia_fit_kept *kept)
{
    pia_index size = fit->op->cols * fit->dim, count = pia_fit_parameter_count(fit);
    pia_iterate_measure(&fit->iterate);
    *kept = (pia_fit_kept){pia_take(fit->context, count, sizeof(double)), pia_take(fit->context, size, sizeof(double)),
                           fit->iterate.errors.weighted};
    if (kept->parameters == NULL || kept->points == NULL) {
        pia_fit_keep_drop(fit, kept);
        return PIA_E_MEMORY;
    }
    memcpy(kept->parameters, fit->parameter[0], (size_t)count * sizeof(double));
    memcpy(kept->points, fit->iterate.points, (size_t)size * sizeof(double));
    return PIA_OK;
}

pia_status pia_fit_take_back(pia_fit *fit, const pia_fit_kept *kept, pia_status (*assemble)(pia_fit *fit))
{
    memcpy(fit->parameter[0], kept->parameters, (size_t)pia_fit_parameter_count(fit) * sizeof(double));
    pia_status status = assemble(fit);
    if (status == PIA_OK) memcpy(fit->iterate.points, kept->points, (size_t)(fit->op->cols * fit->dim) * sizeof(double));
    fit->iterate.errors_known = 0;
    return status;
}

static pia_status correct_once(pia_fit *fit, pia_stop *stop, int *better)
{
    pia_fit_kept before;
    pia_status status = pia_fit_keep(fit, &before);
    if (status != PIA_OK) return status;
    for (int newton = 0; newton < NEWTON_STEPS && status == PIA_OK; newton++) status = fit->iterate.project(&fit->iterate);
    if (status == PIA_OK) status = pia_fit_reassemble(fit);
    if (status == PIA_OK) status = pia_solve_step(&fit->solve, INT64_MAX);
    if (status == PIA_OK) {
        pia_iterate_measure(&fit->iterate);
        *better = fit->iterate.errors.weighted < before.squares;
        *stop = *better ? fit->solve.stop : *stop;
        if (!*better) status = pia_fit_take_back(fit, &before, pia_fit_reassemble);
        fit->solve.stop = *stop;
    }
    pia_fit_keep_drop(fit, &before);
    return status;
}

int pia_fit_wants_correction(const pia_fit *fit)
{
    pia_stop stop = fit->solve.stop;
    return fit->options.correct > 0 && fit->round == 0 && !fit->refining && !fit->square && fit->iterate.project != NULL &&
           stop != PIA_STOP_NONE && stop != PIA_STOP_CANCELLED && stop != PIA_STOP_TIME && stop != PIA_STOP_ITERATIONS;
}

pia_status pia_fit_correct(pia_fit *fit)
{
    pia_stop stop = fit->solve.stop;
    pia_status status = PIA_OK;
    int better = 1;
    for (pia_index k = 0; k < fit->options.correct && better && status == PIA_OK; k++) {
        status = correct_once(fit, &stop, &better);
        fit->round += better;
        if (stop == PIA_STOP_CANCELLED || stop == PIA_STOP_TIME) break;
    }
    return status;
}
