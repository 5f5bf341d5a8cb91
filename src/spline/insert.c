/* Knot insertion by blossoms: each control point over the refined knots is a convex combination of degree+1 old ones (the Oslo
 * algorithm; for a single knot, Boehm's), and those whose knots stay are copied to the last bit. */
#include "insert.h"

#include "basis.h"
#include "finite.h"
#include "rebase.h"

static pia_status check_values(pia_context *context, const double *values, pia_index count)
{
    pia_status status = pia_check_finite(context, "inserted knot", values, count, 1);
    if (status != PIA_OK) return status;
    for (pia_index i = 1; i < count; i++)
        if (values[i] < values[i - 1])
            return pia_fail(context, PIA_E_DATA, "inserted knot %lld (%.17g) is below the one before; sort them", (long long)i,
                            values[i]);
    return PIA_OK;
}

static void merge(const double *a, pia_index a_count, const double *b, pia_index b_count, double *out)
{
    for (pia_index i = 0, j = 0; i < a_count || j < b_count;) *out++ = j == b_count || (i < a_count && a[i] <= b[j]) ? a[i++] : b[j++];
}

pia_status pia_model_insert_knots(pia_context *context, const pia_model *model, int direction, const double *values, pia_index count,
                                  pia_model **out)
{
    pia_status status = pia_model_check_direction(context, model, direction);
    if (status == PIA_OK && out == NULL) status = pia_fail(context, PIA_E_ARGUMENT, "pia_model_insert_knots needs out");
    if (status == PIA_OK) status = check_values(context, values, count);
    if (status != PIA_OK) return status;
    pia_index old = model->control[direction] + model->degree[direction] + 1, total = old + count; /* both arrays are in memory */
    double *target = pia_take(context, total, sizeof *target);
    if (target == NULL) return pia_take_status(context, total, sizeof *target);
    merge(model->knots[direction], old, values, count, target);
    status = pia_model_rebase(context, model, direction, model->degree[direction], target, model->control[direction] + count,
                              pia_basis_blossom, out);
    pia_give(context, target);
    return status;
}

/* Inside knots `degree` times each; returns how many control points that makes. target NULL: only counts. */
static pia_index saturate(const double *knots, int degree, pia_index control, double *target)
{
    pia_index next = 0;
    for (pia_index i = 0; i < control + degree + 1; i++) {
        int inside = i > degree && i < control, copies = !inside ? 1 : knots[i] == knots[i - 1] ? 0 : degree;
        for (int k = 0; k < copies; k++, next++)
            if (target != NULL) target[next] = knots[i];
    }
    return next - degree - 1;
}

pia_status pia_model_saturate(pia_context *context, const pia_model *model, int direction, pia_model **out)
{
    int degree = model->degree[direction];
    pia_index control = saturate(model->knots[direction], degree, model->control[direction], NULL);
    double *target = pia_take(context, control + degree + 1, sizeof *target);
    if (target == NULL) return pia_take_status(context, control + degree + 1, sizeof *target);
    saturate(model->knots[direction], degree, model->control[direction], target);
    pia_status status = pia_model_rebase(context, model, direction, degree, target, control, pia_basis_blossom, out);
    pia_give(context, target);
    return status;
}

pia_status pia_model_copy(pia_context *context, const pia_model *model, pia_model **out)
{
    return pia_model_rebase(context, model, 0, model->degree[0], model->knots[0], model->control[0], pia_basis_blossom, out);
}

pia_status pia_model_bezier(pia_context *context, const pia_model *model, pia_model **out)
{
    if (model == NULL || out == NULL) return pia_fail(context, PIA_E_ARGUMENT, "pia_model_bezier needs a model and out");
    pia_model *first = NULL;
    pia_status status = pia_model_saturate(context, model, 0, &first);
    if (status != PIA_OK || model->directions == 1) {
        if (status == PIA_OK) *out = first;
        return status;
    }
    status = pia_model_saturate(context, first, 1, out);
    pia_model_destroy(first);
    return status;
}
