/* Lin 2010: only some control points move. The active ones are those whose point is off by more than a share of the largest error;
 * they iterate until they are below that share, then the set is chosen anew, so that in the limit every point is met. What the user
 * froze stays frozen (the operator's mask). */
#include "method.h"
#include "owner.h"

#include <math.h>
#include <string.h>

enum { ABOVE };

typedef struct local {
    double above, threshold;
    double *active; /* [cols] 1 or 0 */
} local;

static double owned_error(const pia_iterate *iterate, pia_index c)
{
    const double *r = iterate->residual + c * iterate->dim;
    double square = 0;
    for (int d = 0; d < iterate->dim; d++) square += r[d] * r[d];
    return iterate->op->frozen != NULL && iterate->op->frozen[c] ? 0 : sqrt(square);
}

static pia_status begin(pia_iterate *iterate, const pia_values *values, void *state)
{
    local *l = state;
    l->above = values->number[ABOVE];
    l->threshold = -1;
    l->active = pia_take_zero(iterate->context, iterate->op->cols, sizeof *l->active);
    return l->active != NULL ? PIA_OK : PIA_E_MEMORY;
}

static pia_status adjust(pia_iterate *iterate, void *state)
{
    local *l = state;
    double worst_active = 0, worst = 0;
    for (pia_index c = 0; c < iterate->op->cols; c++) {
        double error = owned_error(iterate, c);
        worst = fmax(worst, error);
        if (l->active[c] > 0) worst_active = fmax(worst_active, error);
    }
    if (worst_active <= l->threshold || l->threshold < 0) {
        l->threshold = l->above * worst;
        for (pia_index c = 0; c < iterate->op->cols; c++) l->active[c] = owned_error(iterate, c) > l->threshold;
    }
    pia_owner_adjust(iterate, iterate->damping);
    for (pia_index c = 0; c < iterate->op->cols; c++)
        if (!(l->active[c] > 0)) memset(iterate->adjust + c * iterate->dim, 0, (size_t)iterate->dim * sizeof *iterate->adjust);
    return PIA_OK;
}

static void end(pia_iterate *iterate, void *state)
{
    pia_give(iterate->context, ((local *)state)->active);
}

static void history(pia_iterate *iterate, void *state, void (*visit)(void *, const char *, double *, pia_index), void *user)
{
    local *l = state;
    visit(user, "threshold", &l->threshold, 1);
    visit(user, "active", l->active, iterate->op->cols);
}

static const pia_parameter parameters[] = {
    {"above", NULL, "0.1", 0, 0.999, "only points off by more than this share of the largest error are worked on; 0: all"}, {0}};

const pia_method pia_method_local_pia = {
    .name = "local-pia",
    .title = "local PIA: only the control points whose data points are worst move",
    .reference = "lin2010",
    .detail = "interpolates; after an edit only the neighbourhood is worked on",
    .needs = PIA_NEEDS_SQUARE | PIA_NEEDS_ROWS | PIA_IS_LIMITABLE,
    .iterations = 2000,
    .parameters = parameters,
    .state_size = sizeof(local),
    .begin = begin,
    .adjust = adjust,
    .end = end,
    .history = history,
};
