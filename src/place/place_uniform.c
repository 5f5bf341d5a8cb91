#include "spacing.h"

/* Closed curves of even degree start half a step early, so that basis functions are centred on uniform parameters for every degree. */
static pia_status place(pia_context *context, const pia_place_problem *p, double *knots)
{
    pia_status status = pia_spacing_check_problem(context, p);
    if (status != PIA_OK) return status;
    if (p->closed) {
        double early = p->degree % 2 == 0 ? 0.5 : 0;
        for (pia_index i = 0; i < p->control; i++) knots[p->degree + i] = ((double)i - early) / (double)p->control;
    } else {
        double first = p->parameters[0], length = p->parameters[p->count - 1] - first;
        pia_index spans = p->control - p->degree;
        pia_spacing_clamp(p, knots);
        for (pia_index j = 1; j < spans; j++) knots[p->degree + j] = first + length * ((double)j / (double)spans);
    }
    return pia_spacing_finish(context, p, knots);
}

const pia_placement pia_place_uniform = {
    .name = "uniform",
    .title = "uniform: equal spans",
    .reference = "piegl1997",
    .detail = "any number of control points; may leave spans without data",
    .square = 0,
    .place = place,
};
