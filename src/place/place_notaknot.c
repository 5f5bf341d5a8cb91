/* Parameters are knots, except the first and the last few inside ones; for even degrees their midpoints are (not-a-knot; de Boor 2001,
 * chapter IV). These are also the default knots of SciPy's make_interp_spline. */
#include "spacing.h"

static double midpoint(double a, double b)
{
    return a + (b - a) / 2;
}

static pia_status place(pia_context *context, const pia_place_problem *p, double *knots)
{
    pia_status status = pia_spacing_check_square(context, p);
    if (status != PIA_OK) return status;
    int even = p->degree % 2 == 0, half = p->degree / 2;
    const double *t = p->parameters;
    if (p->closed) {
        for (pia_index i = 0; i < p->control; i++) knots[p->degree + i] = even ? midpoint(pia_spacing_cyclic(p, i - 1), t[i]) : t[i];
    } else {
        pia_spacing_clamp(p, knots);
        for (pia_index j = 1; j < p->control - p->degree; j++)
            knots[p->degree + j] = even ? midpoint(t[half + j - 1], t[half + j]) : t[half + j];
    }
    return pia_spacing_finish(context, p, knots);
}

const pia_placement pia_place_notaknot = {
    .name = "notaknot",
    .title = "not-a-knot: parameters are knots but for the outermost inside ones",
    .reference = "deboor2001",
    .detail = "interpolation; odd degrees have knots at the data, even degrees half-way; as many control points as data points",
    .square = 1,
    .place = place,
};
