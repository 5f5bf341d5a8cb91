#include "basis.h"
#include "rebase.h"

/* Knots of the part before (side 0) or after (side 1) `value`, clamped there; returns how many control points it has. */
static pia_index part_knots(const double *knots, pia_index count, int degree, double value, int side, double *out)
{
    pia_index next = 0;
    for (int k = 0; side == 1 && k <= degree; k++) out[next++] = value;
    for (pia_index i = 0; i < count; i++)
        if (side == 0 ? knots[i] < value : knots[i] > value) out[next++] = knots[i];
    for (int k = 0; side == 0 && k <= degree; k++) out[next++] = value;
    return next - degree - 1;
}

pia_status pia_model_split(pia_context *context, const pia_model *model, int direction, double value, pia_model **left,
                           pia_model **right)
{
    pia_status status = pia_model_check_direction(context, model, direction);
    if (status != PIA_OK) return status;
    if (left == NULL || right == NULL) return pia_fail(context, PIA_E_ARGUMENT, "pia_model_split needs left and right");
    if (model->trim != NULL)
        return pia_fail(context, PIA_E_ARGUMENT,
                        "a trimmed surface is not split; take its trim loops away first (pia_model_trim with none)");
    int degree = model->degree[direction];
    pia_index control = model->control[direction], count = control + degree + 1;
    const double *knots = model->knots[direction];
    if (!(value > knots[degree] && value < knots[control]))
        return pia_fail(context, PIA_E_ARGUMENT, "%.17g is no place to split at; choose one inside the domain [%.17g, %.17g]", value,
                        knots[degree], knots[control]);
    double *target = pia_take(context, count + degree + 1, sizeof *target);
    if (target == NULL) return pia_take_status(context, count + degree + 1, sizeof *target);
    pia_model *part[2] = {NULL, NULL};
    for (int side = 0; status == PIA_OK && side < 2; side++) {
        pia_index part_control = part_knots(knots, count, degree, value, side, target);
        status = pia_model_rebase(context, model, direction, degree, target, part_control, pia_basis_blossom, &part[side]);
    }
    pia_give(context, target);
    if (status == PIA_OK) {
        *left = part[0];
        *right = part[1];
    } else {
        pia_model_destroy(part[0]);
    }
    return status;
}
