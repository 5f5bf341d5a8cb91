/* [2004] Algorithm 1 and Eq. (11): one factor eps for the whole step, the largest for which every turn of the control polygon keeps its
 * sign. Repaired: eps = 1 is tried first, bisection is on a fraction, and when eps |D| falls below delta the fit is stalled, which the
 * paper's Theorem 2 overlooks (it needs the sum of the eps to be infinite). Signs are those of the start: a turn that has become
 * straight would otherwise be free to bend the other way in the next step. */
#include "limit.h"
#include "polygon.h"

#include <math.h>

enum { DELTA, MAX_HALVINGS = 60 };

typedef struct convex {
    double delta;
    double *sign;  /* [cols] of each turn to keep; 0: free */
    double *scale; /* [cols] */
} convex;

static pia_status begin(pia_iterate *iterate, const pia_values *values, void *state)
{
    convex *c = state;
    c->delta = values->is_word[DELTA] ? 1e-9 * iterate->extent : values->number[DELTA];
    c->sign = pia_take(iterate->context, iterate->op->cols, sizeof *c->sign);
    c->scale = pia_take(iterate->context, iterate->op->cols, sizeof *c->scale);
    if (c->sign == NULL || c->scale == NULL) return pia_take_status(iterate->context, iterate->op->cols, sizeof *c->scale);
    pia_status status = pia_polygon_check(iterate, "convex");
    if (status == PIA_OK) pia_polygon_targets(iterate, NULL, c->sign);
    return status;
}

/* Whether some turn changes its sign at this factor; it may become straight. */
static int bends(const pia_iterate *iterate, convex *c, double factor)
{
    pia_index first, end;
    for (pia_index i = 0; i < iterate->op->cols; i++) c->scale[i] = factor;
    pia_polygon_turns(iterate, &first, &end);
    for (pia_index i = first; i < end; i++)
        if (c->sign[i] * pia_polygon_sign(iterate, c->scale, i) < 0) return 1;
    return 0;
}

static pia_status limit(pia_iterate *iterate, void *state)
{
    convex *c = state;
    double longest = pia_iterate_longest(iterate, iterate->adjust), low = bends(iterate, c, 1) ? 0 : 1, high = 1;
    for (int k = 0; k < MAX_HALVINGS && (high - low) * longest > c->delta; k++) {
        double middle = low + (high - low) / 2;
        if (bends(iterate, c, middle))
            high = middle;
        else
            low = middle;
    }
    for (pia_index i = 0; i < iterate->op->cols; i++) c->scale[i] = low;
    pia_polygon_shorten(iterate, c->scale, c->delta);
    return PIA_OK;
}

static void end(pia_iterate *iterate, void *state)
{
    convex *c = state;
    pia_give(iterate->context, c->sign);
    pia_give(iterate->context, c->scale);
}

static void history(pia_iterate *iterate, void *state, void (*visit)(void *, const char *, double *, pia_index), void *user)
{
    visit(user, "turns", ((convex *)state)->sign, iterate->op->cols);
}

static const pia_parameter parameters[] = {
    {"delta", "auto|number", "auto", 0, 1e300, "accuracy of the step length, units of the points; auto is 1e-9 of the extent"}, {0}};

const pia_limiter pia_limit_convex = {
    .name = "convex",
    .title = "one step length for all, so that no turn of the control polygon changes its sign",
    .reference = "lin2004",
    .detail = "planar curves; convex data may stall before they are interpolated",
    .parameters = parameters,
    .state_size = sizeof(convex),
    .begin = begin,
    .limit = limit,
    .end = end,
    .history = history,
};
