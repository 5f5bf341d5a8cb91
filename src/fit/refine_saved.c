/* Knots taken back, and knots changed in one direction. */
#include "refine.h"

#include <string.h>

pia_index pia_refine_inside_count(const pia_fit *fit, int d)
{
    return fit->full[d] - fit->degree[d] - 1;
}

const double *pia_refine_inside(const pia_fit *fit, int d)
{
    return fit->knots[d] + fit->degree[d] + 1;
}

void pia_refine_drop(pia_fit *fit, pia_saved *s)
{
    for (int d = 0; d < 2; d++) pia_give(fit->context, s->inside[d]);
    pia_give(fit->context, s->points);
    *s = (pia_saved){.points = NULL};
}

pia_status pia_refine_save(pia_fit *fit, pia_saved *s)
{
    *s = (pia_saved){.cols = fit->op->cols};
    for (int d = 0; d < fit->directions; d++) {
        s->count[d] = pia_refine_inside_count(fit, d);
        s->inside[d] = pia_take(fit->context, s->count[d], sizeof(double));
        if (s->inside[d] != NULL) memcpy(s->inside[d], pia_refine_inside(fit, d), (size_t)s->count[d] * sizeof(double));
    }
    s->points = pia_take(fit->context, s->cols * fit->dim, sizeof(double));
    if (s->inside[0] == NULL || s->inside[fit->directions - 1] == NULL || s->points == NULL) {
        pia_refine_drop(fit, s);
        return PIA_E_MEMORY;
    }
    memcpy(s->points, fit->iterate.points, (size_t)(s->cols * fit->dim) * sizeof(double));
    return PIA_OK;
}

pia_status pia_refine_go_back(pia_fit *fit, const pia_saved *s)
{
    pia_status status = PIA_OK;
    for (int d = 0; d < fit->directions && status == PIA_OK; d++) status = pia_refine_place(fit, d, s->inside[d], s->count[d]);
    if (status == PIA_OK) status = pia_fit_assemble(fit);
    if (status != PIA_OK) return status;
    memcpy(fit->iterate.points, s->points, (size_t)(s->cols * fit->dim) * sizeof(double));
    pia_iterate_measure(&fit->iterate);
    return pia_fit_bind(fit);
}

pia_status pia_refine_refit(pia_fit *fit, int d, const double *inside, pia_index count)
{
    pia_status status = pia_refine_place(fit, d, inside, count);
    if (status == PIA_OK) status = pia_fit_assemble(fit);
    return status == PIA_OK ? pia_refine_solve(fit) : status;
}
