/* Lin, Zhang 2011: with fewer control points than data, each control point moves by the mean of the residuals of its own group of data
 * rows (Eq. (9), (22)). The group matrix is totally nonnegative with row sums 1, so a curve converges wherever it is not singular. */
#include "epia.h"
#include "groups.h"
#include "method.h"

static pia_status adjust(pia_iterate *iterate, void *state)
{
    (void)state;
    pia_groups_mean(iterate->context, iterate->groups, iterate->residual, iterate->dim, iterate->damping, iterate->adjust);
    pia_op_mask(iterate->op, iterate->adjust, iterate->dim);
    return PIA_OK;
}

static const pia_parameter parameters[] = {
    [PIA_EPIA_ETA] = {"eta", NULL, "0.6", 0, 1,
                      "a group is valid where |sum of its residuals| exceeds this share of the sum of their lengths"},
    [PIA_EPIA_FENCE] = {"fence", "printed|balanced", "printed", 0, 0,
                        "how groups are bounded: by Eq. (44) as printed, or with parameter increments, which balances the halves"},
    [PIA_EPIA_SMOOTH] = {"smooth", NULL, "3", 0, 1e6, "largest half width of the smoothing before curvature is measured; 0: none"},
    [PIA_EPIA_DOMINANT] = {"dominant", NULL, "0.03", 0, 1, "dominant points have more than this share of the largest curvature"},
    [PIA_EPIA_THRESHOLD] = {"insert-threshold", "auto|number", "auto", 0, 1e300,
                            "a knot is inserted when no control point moves more than this; auto: half the tolerance"},
    [PIA_EPIA_ENDS] = {"ends", "keep|free", "keep", 0, 0, "keep: the ends are groups of their own and are met; free: they are not"},
    [PIA_EPIA_ROUNDS] = {"validation-rounds", "auto|number", "auto", 0, 1e6,
                         "most rounds of the validity check; auto: 100 for a curve, 1 for a patch"},
    [PIA_EPIA_INSERT] = {"insert", NULL, "1", 1, 1e6, "most data points a round that become control parameters"},
    {0}};

const pia_method pia_method_epia = {
    .name = "epia",
    .title = "extended PIA: every control point moves by the mean error of its own group of data",
    .reference = "lin2011",
    .detail =
        "fewer control points than data, at dominant points; with a tolerance, one more where the error is worst; open directions",
    .needs = PIA_NEEDS_GROUPS | PIA_NEEDS_ROWS,
    .iterations = 10000,
    .parameters = parameters,
    .adjust = adjust,
};
