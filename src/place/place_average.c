/* Knots as means of `degree` consecutive parameters. The basis function on knots k .. k + degree + 1 is then centred on one parameter,
 * so every control point has its data point, and Schoenberg-Whitney holds (de Boor 2001; The NURBS Book, Eq. 9.8). */
#include "spacing.h"

/* Mean of t[0 .. degree - 1], as t[0] plus the mean difference: equal parameters give their own value. */
static double mean(const double *t, int degree)
{
    double sum = 0;
    for (int k = 1; k < degree; k++) sum += t[k] - t[0];
    return t[0] + sum / degree;
}

static double cyclic_mean(const pia_place_problem *p, pia_index first)
{
    double t[PIA_MAX_DEGREE];
    if (first >= 0 && first + p->degree <= p->count) return mean(p->parameters + first, p->degree);
    t[0] = pia_spacing_cyclic(p, first);
    for (int k = 1; k < p->degree; k++) t[k] = pia_spacing_cyclic(p, first + k);
    return mean(t, p->degree);
}

static pia_status place(pia_context *context, const pia_place_problem *p, double *knots)
{
    pia_status status = pia_spacing_check_square(context, p);
    if (status != PIA_OK) return status;
    if (p->closed) {
        for (pia_index i = 0; i < p->control; i++) knots[p->degree + i] = cyclic_mean(p, i - p->degree / 2);
    } else {
        pia_spacing_clamp(p, knots);
        for (pia_index j = 1; j < p->control - p->degree; j++) knots[p->degree + j] = mean(p->parameters + j, p->degree);
    }
    return pia_spacing_finish(context, p, knots);
}

const pia_placement pia_place_average = {
    .name = "average",
    .title = "averaging: knots are means of as many parameters as the degree",
    .reference = "deboor2001",
    .detail = "interpolation of any parameters; as many control points as data points",
    .square = 1,
    .place = place,
};
