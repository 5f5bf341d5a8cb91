/* Conjugate gradients preconditioned by the diagonal of H. */
#include "conjugate.h"
#include "method.h"
#include "normalise.h"
#include "vectors.h"

typedef struct cg {
    pia_conjugate conjugate;
    double *reciprocal; /* [cols] of the diagonal */
} cg;

static pia_status begin(pia_iterate *iterate, const pia_values *values, void *state)
{
    (void)values;
    cg *c = state;
    pia_index cols = iterate->op->cols;
    pia_status status = pia_conjugate_open(iterate, &c->conjugate);
    if (status != PIA_OK) return status;
    c->reciprocal = pia_take(iterate->context, cols, sizeof(double));
    if (c->reciprocal == NULL) return pia_take_status(iterate->context, cols, sizeof(double));
    status = pia_product_diagonal(iterate, c->reciprocal);
    if (status == PIA_OK) pia_reciprocals(cols, c->reciprocal);
    return status;
}

static void condition(pia_iterate *iterate, void *user, double *gradient, double *z)
{
    const cg *c = user;
    pia_vectors_scale(iterate, c->reciprocal, gradient, z);
}

static pia_status adjust(pia_iterate *iterate, void *state)
{
    cg *c = state;
    pia_conjugate_step(iterate, &c->conjugate, condition, c);
    return PIA_OK;
}

static void end(pia_iterate *iterate, void *state)
{
    cg *c = state;
    pia_conjugate_close(iterate, &c->conjugate);
    pia_give(iterate->context, c->reciprocal);
}

static void history(pia_iterate *iterate, void *state, void (*visit)(void *, const char *, double *, pia_index), void *user)
{
    cg *c = state;
    pia_conjugate_visit(iterate, &c->conjugate, visit, user);
}

const pia_method pia_method_cg = {
    .name = "cg",
    .title = "conjugate gradients on the normal equations, preconditioned by their diagonal",
    .reference = "hestenes1952",
    .detail = "least squares; no parameters; the squared error never rises",
    .needs = PIA_LEAST_SQUARES | PIA_NEEDS_NORMAL | PIA_DESCENDS,
    .iterations = 10000,
    .state_size = sizeof(cg),
    .begin = begin,
    .adjust = adjust,
    .end = end,
    .history = history,
};
