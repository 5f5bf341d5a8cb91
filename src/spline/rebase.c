#include "rebase.h"

#include <string.h>

#include "knots.h"

static void combine(const double *row, int count, const double *from, pia_index inner, double *to)
{
    for (pia_index c = 0; c < inner; c++) to[c] = row[0] * from[c];
    for (int k = 1; k < count; k++) {
        if (row[k] == 0) continue;
        for (pia_index c = 0; c < inner; c++) to[c] += row[k] * from[k * inner + c];
    }
}

void pia_rebase_points(const pia_rebase *r, const double *from, double *to)
{
    pia_index inner = r->lines.inner, span = r->degree;
    double row[PIA_MAX_DEGREE + 1];
    for (pia_index j = 0; j < r->target_control; j++) {
        span = pia_knots_span_near(r->knots, r->degree, r->control, r->target[j], span);
        r->rule(r->knots, r->degree, span, r->target + j + 1, row);
        for (pia_index line = 0; line < r->lines.outer; line++)
            combine(row, r->degree + 1, from + (line * r->control + span - r->degree) * inner, inner,
                    to + (line * r->target_control + j) * inner);
    }
}

pia_status pia_model_rebase(pia_context *context, const pia_model *model, int direction, int degree, const double *target,
                            pia_index target_control, pia_rebase_rule *rule, pia_model **out)
{
    pia_status status = pia_knots_check(context, degree, target, target_control + degree + 1, target_control);
    if (status != PIA_OK) return status;
    int degrees[2] = {model->degree[0], model->degree[1]};
    pia_index control[2] = {model->control[0], model->control[1]};
    degrees[direction] = degree;
    control[direction] = target_control;
    pia_model *made = NULL;
    status = pia_model_new(context, model->directions, degrees, control, model->dim, model->rational, &made);
    if (status == PIA_OK) status = pia_trim_copy(context, model->trim, &made->trim);
    if (status != PIA_OK) {
        pia_model_destroy(made);
        return status;
    }
    for (int d = 0; d < model->directions; d++) {
        const double *knots = d == direction ? target : model->knots[d];
        memcpy(made->knots[d], knots, (size_t)(control[d] + degrees[d] + 1) * sizeof *knots);
        made->periodic[d] = model->periodic[d];
    }
    pia_rebase r = {model->knots[direction],
                    model->degree[direction],
                    model->control[direction],
                    pia_model_lines(model, direction),
                    target,
                    target_control,
                    rule};
    pia_rebase_points(&r, model->points, made->points);
    made->periodic[direction] = pia_model_joins(made, direction);
    *out = made;
    return PIA_OK;
}
