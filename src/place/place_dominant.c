/* Knots of [2011], Eq. (38), (41), (42): means of the parameters of the control points, which stand for the data of locally largest
 * curvature (dominant.h). */
#include "spacing.h"

static pia_status place(pia_context *context, const pia_place_problem *p, double *knots)
{
    return pia_place_find("average")->place(context, p, knots);
}

const pia_placement pia_place_dominant = {
    .name = "dominant",
    .title = "dominant points: knots are means of the parameters where the data bend most",
    .reference = "lin2011",
    .detail = "chooses how many by itself; open directions, points in order; the start of method epia",
    .square = 1,
    .by_curvature = 1,
    .place = place,
};
