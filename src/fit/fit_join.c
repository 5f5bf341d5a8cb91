/* Continuation of a neighbouring model: along the common edge the fit has its values and, across the edge, its derivatives. Conditions
 * stand at the Greville abscissas of the edge's own control points, as many as can be met: an edge curve that the knots can hold is met
 * everywhere, another one is interpolated. */
#include "fit.h"

#include "knots.h"
#include "options.h"

#include <math.h>
#include <string.h>

void pia_join_init(pia_join *join)
{
    memset(join, 0, sizeof *join);
    join->struct_size = sizeof *join;
    join->edge = PIA_EDGE_U_START;
    join->neighbour_edge = PIA_EDGE_U_END;
    join->continuity = PIA_CONTINUITY_G1;
}

typedef struct seam {
    const pia_fit *fit;
    const pia_join *join;
    pia_model_info neighbour;
    int across, their_across; /* directions that leave the edge */
    double sign;              /* of their derivative, to have it point from the neighbour into the fit as ours does */
} seam;

static int direction_of(pia_edge edge)
{
    return edge == PIA_EDGE_V_START || edge == PIA_EDGE_V_END;
}

static int is_end(pia_edge edge)
{
    return edge == PIA_EDGE_U_END || edge == PIA_EDGE_V_END;
}

static pia_status check(const pia_fit *fit, const pia_join *join, const pia_model_info *info)
{
    pia_context *context = fit->context;
    int highest = fit->directions == 1 ? PIA_EDGE_U_END : PIA_EDGE_V_END;
    if ((int)join->edge < 0 || (int)join->edge > highest || (int)join->neighbour_edge < 0 || (int)join->neighbour_edge > highest)
        return pia_fail(context, PIA_E_ARGUMENT, "a join names an edge that a %s does not have",
                        fit->directions == 1 ? "curve" : "surface");
    if ((unsigned)join->continuity > PIA_CONTINUITY_C1)
        return pia_fail(context, PIA_E_ARGUMENT, "continuity %d of a join is none of C0, G1, C1", (int)join->continuity);
    if (info->directions != fit->directions || info->dim != fit->dim || fit->function_graph)
        return pia_fail(context, PIA_E_SHAPE, "the neighbour is a %s of dimension %d; what joins it must be one as well",
                        info->directions == 1 ? "curve" : "surface", info->dim);
    if (fit->closed[direction_of(join->edge)] || info->periodic[direction_of(join->neighbour_edge)])
        return pia_fail(context, PIA_E_ARGUMENT, "a closed direction has no edge to join");
    return PIA_OK;
}

/* Place i of the edge in the parameters of both. */
static void find_place(const seam *s, pia_index i, double *ours, double *theirs)
{
    const pia_fit *fit = s->fit;
    int across = s->across, their_along = 1 - s->their_across;
    ours[across] = fit->knots[across][is_end(s->join->edge) ? fit->full[across] : fit->degree[across]];
    theirs[s->their_across] = s->neighbour.domain[s->their_across][is_end(s->join->neighbour_edge)];
    if (fit->directions == 1) return;
    int along = 1 - across;
    double low = fit->knots[along][fit->degree[along]], high = fit->knots[along][fit->full[along]];
    double t = pia_knots_greville(fit->knots[along], fit->degree[along], i);
    if (fit->closed[along]) t -= (high - low) * floor((t - low) / (high - low));
    t = fmin(fmax(t, low), high);
    double part = (t - low) / (high - low);
    const double *domain = s->neighbour.domain[their_along];
    ours[along] = t;
    theirs[their_along] = s->join->reversed ? domain[1] - part * (domain[1] - domain[0]) : domain[0] + part * (domain[1] - domain[0]);
}

static pia_status add_place(pia_fit *fit, const seam *s, pia_index i)
{
    double theirs[2], value[3 * PIA_MAX_DIM]; /* S, Su, Sv */
    pia_constraint c;
    pia_constraint_init(&c);
    find_place(s, i, c.at_parameter, theirs);
    c.value = value;
    pia_status status = pia_model_eval(fit->context, s->join->neighbour, theirs, 1, 1, value);
    if (status == PIA_OK) status = pia_fit_add_constraint(fit, &c);
    if (status != PIA_OK || s->join->continuity == PIA_CONTINUITY_C0) return status;
    double *derivative = value + (1 + s->their_across) * fit->dim;
    for (int d = 0; d < fit->dim; d++) derivative[d] *= s->sign;
    c.value = derivative;
    c.derivative[s->across] = 1;
    c.direction_only = s->join->continuity == PIA_CONTINUITY_G1 && fit->dim > 1;
    return pia_fit_add_constraint(fit, &c);
}

pia_status pia_fit_add_join(pia_fit *fit, const pia_join *given)
{
    pia_join join;
    pia_join_init(&join);
    pia_status status = pia_options_read(fit->context, "pia_join", &join, sizeof join, given);
    if (status != PIA_OK) return status;
    if (join.neighbour == NULL) return pia_fail(fit->context, PIA_E_ARGUMENT, "a join has no neighbour");
    seam s = {.fit = fit, .join = &join, .neighbour = {.struct_size = sizeof s.neighbour}};
    pia_model_get_info(join.neighbour, &s.neighbour);
    status = check(fit, &join, &s.neighbour);
    s.across = direction_of(join.edge);
    s.their_across = direction_of(join.neighbour_edge);
    s.sign = is_end(join.edge) == is_end(join.neighbour_edge) ? -1 : 1;
    pia_index places = fit->directions == 1 ? 1 : fit->op->count[1 - s.across];
    for (pia_index i = 0; i < places && status == PIA_OK; i++) status = add_place(fit, &s, i);
    return status;
}
