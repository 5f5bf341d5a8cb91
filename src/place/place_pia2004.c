/* The knots of the 2004 format, Eq. (1): the parameters themselves, raw accumulated chords, the outer two four-fold. Two control points
 * more than parameters. */
#include "spacing.h"

static pia_status place(pia_context *context, const pia_place_problem *p, double *knots)
{
    if (p->degree != 3 || p->closed)
        return pia_fail(context, PIA_E_ARGUMENT, "the 2004 format is cubic and open; degree %d, closed %d was asked", p->degree,
                        p->closed);
    if (p->control != p->count + 2)
        return pia_fail(context, PIA_E_SHAPE,
                        "the 2004 format has %lld control points for %lld parameters, not %lld; leave their number out",
                        (long long)p->count + 2, (long long)p->count, (long long)p->control);
    pia_status status = pia_spacing_check_problem(context, p);
    if (status != PIA_OK) return status;
    pia_spacing_clamp(p, knots);
    for (pia_index i = 1; i + 1 < p->count; i++) knots[3 + i] = p->parameters[i];
    return pia_spacing_finish(context, p, knots);
}

const pia_placement pia_place_pia2004 = {
    .name = "pia2004",
    .title = "the knots of the 2004 format: accumulated chords",
    .reference = "lin2004",
    .detail = "cubic, open; two control points more than data points, the doubled ends",
    .square = 1,
    .place = place,
};
