/* Parameter correction (Hoschek 1988): the parameters move to the foot points of the fit, and the fit is made anew, as long as that
 * brings the points closer. A round that does not is taken back. */
#include "fit.h"

#include <math.h>
#include <string.h>

enum { NEWTON_STEPS = 3 };

/* What a round may have to be taken back to. */
typedef struct kept {
    double *parameters, *points;
    double squares; /* weighted, what the fit makes small */
} kept;

static void drop(pia_fit *fit, kept *k)
{
    pia_give(fit->context, k->parameters);
    pia_give(fit->context, k->points);
}

static pia_status keep(pia_fit *fit, kept *k)
{
    pia_index size = fit->op->cols * fit->dim;
    pia_iterate_measure(&fit->iterate);
    *k = (kept){pia_take(fit->context, fit->rows, sizeof(double)), pia_take(fit->context, size, sizeof(double)),
                fit->iterate.errors.weighted};
    if (k->parameters == NULL || k->points == NULL) {
        drop(fit, k);
        return PIA_E_MEMORY;
    }
    memcpy(k->parameters, fit->parameter[0], (size_t)fit->rows * sizeof(double));
    memcpy(k->points, fit->iterate.points, (size_t)size * sizeof(double));
    return PIA_OK;
}

static pia_status take_back(pia_fit *fit, const kept *k)
{
    memcpy(fit->parameter[0], k->parameters, (size_t)fit->rows * sizeof(double));
    pia_status status = pia_fit_reassemble(fit);
    if (status == PIA_OK) memcpy(fit->iterate.points, k->points, (size_t)(fit->op->cols * fit->dim) * sizeof(double));
    fit->iterate.errors_known = 0;
    return status;
}

static pia_status correct_once(pia_fit *fit, pia_stop *stop, int *better)
{
    kept before;
    pia_status status = keep(fit, &before);
    if (status != PIA_OK) return status;
    for (int newton = 0; newton < NEWTON_STEPS && status == PIA_OK; newton++) status = fit->iterate.project(&fit->iterate);
    if (status == PIA_OK) status = pia_fit_reassemble(fit);
    if (status == PIA_OK) status = pia_solve_step(&fit->solve, INT64_MAX);
    if (status == PIA_OK) {
        pia_iterate_measure(&fit->iterate);
        *better = fit->iterate.errors.weighted < before.squares;
        *stop = *better ? fit->solve.stop : *stop;
        if (!*better) status = take_back(fit, &before);
        fit->solve.stop = *stop;
    }
    drop(fit, &before);
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
