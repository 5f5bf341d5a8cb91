/* [2004] Eq. (4), (5) and (16), (17): D = Q - r(t), P += D. */
#include "method.h"
#include "owner.h"

static pia_status adjust(pia_iterate *iterate, void *state)
{
    (void)state;
    pia_owner_adjust(iterate, iterate->damping);
    return PIA_OK;
}

static pia_status step(pia_iterate *iterate, void *state)
{
    (void)state;
    pia_owner_step(iterate, iterate->damping);
    return PIA_OK;
}

const pia_method pia_method_pia = {
    .name = "pia",
    .title = "progressive-iterative approximation: every control point moves by the error at its own data point",
    .reference = "lin2004",
    .detail = "interpolates; curves and grids, open and closed, any degree; keeps convexity with --shape convex",
    .needs = PIA_NEEDS_SQUARE | PIA_NEEDS_ROWS | PIA_IS_LIMITABLE,
    .iterations = 1000,
    .adjust = adjust,
    .step = step,
};
