/* Park 2011: the knots of `dominant` for the rows and columns of a grid. With a tolerance, the fit adds the row and the column of the
 * worst point until it holds. */
#include "spacing.h"

static pia_status place(pia_context *context, const pia_place_problem *p, double *knots)
{
    return pia_place_find("average")->place(context, p, knots);
}

const pia_placement pia_place_dominant_columns = {
    .name = "dominant-columns",
    .title = "dominant columns: as dominant; a tolerance adds the row and column of the worst point",
    .reference = "park2011",
    .detail = "least squares of grids, open directions; the comparison method of [2011]",
    .square = 1,
    .by_curvature = 1,
    .adds_lines = 1,
    .place = place,
};
