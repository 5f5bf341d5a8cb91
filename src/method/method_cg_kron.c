/* Conjugate gradients preconditioned by what the data would be on a full grid: the Kronecker product of the Gram matrices of both
 * directions alone, banded and quick to solve. For curves and full grids that is H itself, and one step is enough. */
#include "conjugate.h"
#include "method.h"

#include <string.h>

typedef struct cg_kron {
    pia_conjugate conjugate;
    void (*precondition)(const pia_normal *normal, double *b, int dim);
} cg_kron;

static pia_status begin(pia_iterate *iterate, const pia_values *values, void *state)
{
    (void)values;
    cg_kron *c = state;
    pia_normal *normal = iterate->normal;
    if (normal == NULL)
        return pia_fail(iterate->context, PIA_E_ARGUMENT, "cg-kron needs normal equations, and there are none here; use cg");
    int close = normal->class->precondition != NULL;
    c->precondition = close ? normal->class->precondition : normal->class->solve;
    pia_status status = close ? normal->class->approximate(normal) : normal->class->factor(normal);
    return status == PIA_OK ? pia_conjugate_open(iterate, &c->conjugate) : status;
}

static void condition(pia_iterate *iterate, void *user, double *gradient, double *z)
{
    const cg_kron *c = user;
    memcpy(z, gradient, (size_t)(iterate->op->cols * iterate->dim) * sizeof *z);
    c->precondition(iterate->normal, z, iterate->dim);
}

static pia_status adjust(pia_iterate *iterate, void *state)
{
    cg_kron *c = state;
    pia_conjugate_step(iterate, &c->conjugate, condition, c);
    return PIA_OK;
}

static void end(pia_iterate *iterate, void *state)
{
    cg_kron *c = state;
    pia_conjugate_close(iterate, &c->conjugate);
}

static void history(pia_iterate *iterate, void *state, void (*visit)(void *, const char *, double *, pia_index), void *user)
{
    cg_kron *c = state;
    pia_conjugate_visit(iterate, &c->conjugate, visit, user);
}

const pia_method pia_method_cg_kron = {
    .name = "cg-kron",
    .title = "conjugate gradients preconditioned by the Kronecker product of both directions",
    .reference = "hestenes1952",
    .detail = "least squares; made for scattered points and grids with holes or weights",
    .needs = PIA_LEAST_SQUARES | PIA_NEEDS_NORMAL | PIA_DESCENDS,
    .iterations = 1000,
    .state_size = sizeof(cg_kron),
    .begin = begin,
    .adjust = adjust,
    .end = end,
    .history = history,
};
