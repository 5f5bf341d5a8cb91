/* Degree elevation by blossoms: the polar form of one degree more is the mean of the polar form over all its arguments but one
 * (Prautzsch 1984). Every knot occurs once more. With one argument left out the rest is still a refinement of the old knots, so every
 * term is a convex combination, and high degrees stay accurate. */
#include "basis.h"
#include "insert.h"
#include "rebase.h"

static void mean_of_blossoms(const double *knots, int degree, pia_index span, const double *arguments, double *row)
{
    double rest[PIA_MAX_DEGREE], part[PIA_MAX_DEGREE + 1];
    for (int k = 0; k <= degree; k++) row[k] = 0;
    for (int k = 0; k < degree; k++) rest[k] = arguments[k + 1];
    for (int out = 0; out <= degree; out++) {
        pia_basis_blossom(knots, degree, span, rest, part);
        for (int k = 0; k <= degree; k++) row[k] += part[k];
        if (out < degree) rest[out] = arguments[out];
    }
    for (int k = 0; k <= degree; k++) row[k] /= degree + 1;
}

/* Every value once more; returns how many control points of degree+1 that makes. target NULL: only counts. */
static pia_index repeat_once(const double *knots, int degree, pia_index control, double *target)
{
    pia_index next = 0;
    for (pia_index i = 0; i < control + degree + 1; i++) {
        int copies = i == 0 || knots[i] != knots[i - 1] ? 2 : 1;
        for (int k = 0; k < copies; k++, next++)
            if (target != NULL) target[next] = knots[i];
    }
    return next - degree - 2;
}

static pia_status elevate_once(pia_context *context, const pia_model *model, int direction, pia_model **out)
{
    int degree = model->degree[direction];
    pia_index control = repeat_once(model->knots[direction], degree, model->control[direction], NULL);
    double *target = pia_take(context, control + degree + 2, sizeof *target);
    if (target == NULL) return pia_take_status(context, control + degree + 2, sizeof *target);
    repeat_once(model->knots[direction], degree, model->control[direction], target);
    pia_status status = pia_model_rebase(context, model, direction, degree + 1, target, control, mean_of_blossoms, out);
    pia_give(context, target);
    return status;
}

pia_status pia_model_elevate(pia_context *context, const pia_model *model, int direction, int raise, pia_model **out)
{
    pia_status status = pia_model_check_direction(context, model, direction);
    if (status != PIA_OK) return status;
    if (out == NULL) return pia_fail(context, PIA_E_ARGUMENT, "pia_model_elevate needs out");
    if (raise < 0 || raise > PIA_MAX_DEGREE - model->degree[direction])
        return pia_fail(context, PIA_E_ARGUMENT, "degree %d raised by %d; 0 to %d is possible", model->degree[direction], raise,
                        PIA_MAX_DEGREE - model->degree[direction]);
    pia_model *made = NULL;
    status = pia_model_copy(context, model, &made);
    for (int k = 0; status == PIA_OK && k < raise; k++) {
        pia_model *higher = NULL;
        status = elevate_once(context, made, direction, &higher);
        pia_model_destroy(made);
        made = higher;
    }
    if (status == PIA_OK) *out = made;
    return status;
}
