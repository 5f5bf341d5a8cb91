/* Maekawa, Matsumoto, Namiki 2007, geometric variant: the error is measured at the closest point of the curve, not at the point's
 * parameter. Every iteration first moves the parameters to the foot points, then steps like PIA. */
#include "method.h"
#include "owner.h"

static pia_status begin(pia_iterate *iterate, const pia_values *values, void *state)
{
    (void)values;
    (void)state;
    if (iterate->project != NULL) return PIA_OK;
    return pia_fail(iterate->context, PIA_E_ARGUMENT, "gia moves the parameters of curves only; use pia, wpia or direct here");
}

static pia_status adjust(pia_iterate *iterate, void *state)
{
    (void)state;
    pia_status status = iterate->project(iterate);
    if (status != PIA_OK) return status;
    pia_iterate_measure(iterate);
    pia_owner_adjust(iterate, iterate->damping);
    return PIA_OK;
}

const pia_method pia_method_gia = {
    .name = "gia",
    .title = "geometric PIA: every control point moves by the distance to the closest point",
    .reference = "maekawa2007",
    .detail = "interpolates curves; the parameters move too, so the limit is another curve through the same points",
    .needs = PIA_NEEDS_SQUARE | PIA_NEEDS_ROWS | PIA_IS_LIMITABLE,
    .iterations = 1000,
    .begin = begin,
    .adjust = adjust,
};
