/* Conjugate gradients for H x = b, preconditioned by the diagonal of H (Hestenes, Stiefel 1952). The components of the points are
 * independent systems with one matrix: each has its own scalars. The gradient is that of the iterate, never a recurrence of it, so
 * that what is reported is true. */
#include "method.h"
#include "normalise.h"
#include "product.h"
#include "vectors.h"

#include <string.h>

enum { GRADIENT, SEARCH, IMAGE, VECTORS };

typedef struct cg {
    pia_product product;
    double *preconditioner;    /* [cols] */
    double *vector[VECTORS];   /* g, p, H p */
    double gamma[PIA_MAX_DIM]; /* (g, z) of the step before; 0: none */
} cg;

static pia_status begin(pia_iterate *iterate, const pia_values *values, void *state)
{
    (void)values;
    cg *c = state;
    pia_context *context = iterate->context;
    pia_index cols = iterate->op->cols;
    pia_status status = pia_product_open(iterate, &c->product);
    if (status != PIA_OK) return status;
    c->preconditioner = pia_take(context, cols, sizeof(double));
    if (c->preconditioner == NULL) return pia_take_status(context, cols, sizeof(double));
    status = pia_vectors_take(iterate, VECTORS, c->vector);
    if (status == PIA_OK) status = pia_product_diagonal(iterate, c->preconditioner);
    if (status == PIA_OK) pia_reciprocals(cols, c->preconditioner);
    return status;
}

/* Sums over the unknowns of each component of x times that of y. */
static void dot_components(const pia_iterate *iterate, const double *x, const double *y, double *sums)
{
    int dim = iterate->dim;
    for (int d = 0; d < dim; d++) sums[d] = 0;
    for (pia_index c = 0; c < iterate->op->cols; c++)
        for (int d = 0; d < dim; d++) sums[d] += x[c * dim + d] * y[c * dim + d];
}

static void divide(int dim, double *numerator, const double *denominator)
{
    for (int d = 0; d < dim; d++) numerator[d] = denominator[d] > 0 ? numerator[d] / denominator[d] : 0;
}

/* y = x + diag(factor per component) y */
static void combine(const pia_iterate *iterate, const double *x, const double *factor, double *y)
{
    int dim = iterate->dim;
    for (pia_index c = 0; c < iterate->op->cols; c++)
        for (int d = 0; d < dim; d++) y[c * dim + d] = x[c * dim + d] + factor[d] * y[c * dim + d];
}

static pia_status adjust(pia_iterate *iterate, void *state)
{
    cg *c = state;
    int dim = iterate->dim;
    double gamma[PIA_MAX_DIM] = {0}, factor[PIA_MAX_DIM], curvature[PIA_MAX_DIM], *z = iterate->adjust;
    pia_iterate_gradient(iterate, c->vector[GRADIENT]);
    pia_vectors_scale(iterate, c->preconditioner, c->vector[GRADIENT], z);
    dot_components(iterate, c->vector[GRADIENT], z, gamma);
    memcpy(factor, gamma, sizeof gamma);
    divide(dim, factor, c->gamma);
    combine(iterate, z, factor, c->vector[SEARCH]);
    memcpy(c->gamma, gamma, sizeof gamma);
    pia_product_apply(&c->product, c->vector[SEARCH], dim, c->vector[IMAGE]);
    dot_components(iterate, c->vector[SEARCH], c->vector[IMAGE], curvature);
    divide(dim, gamma, curvature);
    for (pia_index k = 0; k < iterate->op->cols; k++)
        for (int d = 0; d < dim; d++) iterate->adjust[k * dim + d] = gamma[d] * c->vector[SEARCH][k * dim + d];
    return PIA_OK;
}

static void end(pia_iterate *iterate, void *state)
{
    cg *c = state;
    pia_product_close(&c->product);
    pia_give(iterate->context, c->preconditioner);
    pia_give(iterate->context, c->vector[0]);
}

static void history(pia_iterate *iterate, void *state, void (*visit)(void *, const char *, double *, pia_index), void *user)
{
    cg *c = state;
    visit(user, "search", c->vector[SEARCH], iterate->op->cols * iterate->dim);
    visit(user, "gamma", c->gamma, PIA_MAX_DIM);
}

const pia_method pia_method_cg = {
    .name = "cg",
    .title = "conjugate gradients on the normal equations, preconditioned by their diagonal",
    .reference = "hestenes1952",
    .detail = "least squares; no parameters; the squared error never rises",
    .needs = PIA_LEAST_SQUARES | PIA_NEEDS_NORMAL,
    .iterations = 10000,
    .state_size = sizeof(cg),
    .begin = begin,
    .adjust = adjust,
    .end = end,
    .history = history,
};
