/* Lu 2010: D = omega R; the best omega is 2 / (1 + smallest eigenvalue), because the largest is 1. */
#include "method.h"
#include "owner.h"

typedef struct weighted {
    double omega;
} weighted;

enum { OMEGA, PASSES = 100 };

static pia_status begin(pia_iterate *iterate, const pia_values *values, void *state)
{
    weighted *w = state;
    w->omega = values->number[OMEGA];
    if (!values->is_word[OMEGA]) return PIA_OK;
    double smallest;
    pia_status status = pia_owner_smallest(iterate, PASSES, &smallest);
    if (status == PIA_OK) w->omega = 2 / (1 + smallest);
    return status;
}

static pia_status adjust(pia_iterate *iterate, void *state)
{
    const weighted *w = state;
    pia_owner_adjust(iterate, w->omega * iterate->damping);
    return PIA_OK;
}

static pia_status step(pia_iterate *iterate, void *state)
{
    const weighted *w = state;
    pia_owner_step(iterate, w->omega * iterate->damping);
    return PIA_OK;
}

static void history(pia_iterate *iterate, void *state, void (*visit)(void *, const char *, double *, pia_index), void *user)
{
    (void)iterate;
    weighted *w = state;
    visit(user, "omega", &w->omega, 1);
}

static const pia_parameter parameters[] = {
    {"omega", "auto|number", "auto", 1e-6, 2, "weight of every step; auto estimates the best one, 2/(1 + smallest eigenvalue)"}, {0}};

const pia_method pia_method_wpia = {
    .name = "wpia",
    .title = "weighted PIA: steps as long as the spectrum allows",
    .reference = "lu2010",
    .detail = "interpolates; converges up to twice as fast as pia",
    .needs = PIA_NEEDS_SQUARE | PIA_NEEDS_ROWS | PIA_IS_LIMITABLE,
    .iterations = 1000,
    .parameters = parameters,
    .state_size = sizeof(weighted),
    .begin = begin,
    .adjust = adjust,
    .step = step,
    .history = history,
};
