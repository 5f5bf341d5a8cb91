#include "conjugate.h"

#include "vectors.h"

#include <math.h>
#include <string.h>

/* LONG: steps without a lower gradient, and so many for each unknown, after which there is none to be found. */
enum { MAX_AGE = 10, LONG = 500, LONG_EACH = 20 };

static const double LOWER = 0.9; /* what counts as lower */

pia_status pia_conjugate_open(pia_iterate *iterate, pia_conjugate *out)
{
    out->lowest = INFINITY;
    pia_status status = pia_product_open(iterate, &out->product);
    return status == PIA_OK ? pia_vectors_take(iterate, PIA_CG_VECTORS, out->vector) : status;
}

void pia_conjugate_close(pia_iterate *iterate, pia_conjugate *c)
{
    pia_product_close(&c->product);
    pia_give(iterate->context, c->vector[0]);
}

/* Sums over the unknowns of each component of x times that of y; coupled: their sum in every component. */
static void dot_components(const pia_iterate *iterate, const pia_conjugate *c, const double *x, const double *y, double *sums)
{
    int dim = iterate->dim;
    double total = 0;
    for (int d = 0; d < dim; d++) sums[d] = 0;
    for (pia_index k = 0; k < iterate->op->cols; k++)
        for (int d = 0; d < dim; d++) sums[d] += x[k * dim + d] * y[k * dim + d];
    for (int d = 0; d < dim; d++) total += sums[d];
    for (int d = 0; d < dim && c->coupled; d++) sums[d] = total;
}

static void divide(int dim, double *numerator, const double *denominator)
{
    for (int d = 0; d < dim; d++) numerator[d] = denominator[d] > 0 ? numerator[d] / denominator[d] : 0;
}

/* y = x + diag(factor per component) y */
static void combine(const pia_iterate *iterate, const double *x, const double *factor, double *y)
{
    int dim = iterate->dim;
    for (pia_index k = 0; k < iterate->op->cols; k++)
        for (int d = 0; d < dim; d++) y[k * dim + d] = x[k * dim + d] + factor[d] * y[k * dim + d];
}

/* p = z + factor p, and slope = (g, p) of it, which is (g, z) while directions stay conjugate. Rounding ends that near the limit; there
 * the search begins anew along z, so that steps go downhill however many are asked for. */
static void turn_search(const pia_iterate *iterate, const pia_conjugate *c, const double *z, double *factor, const double *gamma,
                        double *slope)
{
    double *search = c->vector[PIA_CG_SEARCH], lost = 0;
    const double *g = c->vector[PIA_CG_GRADIENT];
    combine(iterate, z, factor, search);
    dot_components(iterate, c, g, search, slope);
    for (int d = 0; d < iterate->dim; d++) {
        int kept = fabs(slope[d] - gamma[d]) <= 0.5 * gamma[d];
        factor[d] = kept;
        lost += !kept;
    }
    if (lost == 0) return;
    for (pia_index k = 0; k < iterate->op->cols; k++)
        for (int d = 0; d < iterate->dim; d++)
            if (factor[d] == 0) search[k * iterate->dim + d] = z[k * iterate->dim + d];
    dot_components(iterate, c, g, search, slope);
}

static void renew_gradient(pia_iterate *iterate, pia_conjugate *c)
{
    double *g = c->vector[PIA_CG_GRADIENT];
    if (c->age == 0) {
        pia_iterate_gradient(iterate, g);
        return;
    }
    double norm = sqrt(pia_iterate_dot(iterate, g, g));
    iterate->relative_gradient = iterate->right_norm > 0 ? norm / iterate->right_norm : norm;
}

/* In exact numbers there are no more steps than unknowns; rounding makes them some times as many, and sets the floor. */
static void watch_gradient(pia_iterate *iterate, pia_conjugate *c)
{
    c->still++;
    if (!(iterate->relative_gradient >= LOWER * c->lowest)) {
        c->lowest = iterate->relative_gradient;
        c->still = 0;
    }
    iterate->stalled = c->still > LONG + LONG_EACH * (double)iterate->op->cols;
}

void pia_conjugate_step(pia_iterate *iterate, pia_conjugate *c, pia_condition *condition, void *user)
{
    int dim = iterate->dim;
    double gamma[PIA_MAX_DIM] = {0}, factor[PIA_MAX_DIM], slope[PIA_MAX_DIM], curvature[PIA_MAX_DIM];
    double *g = c->vector[PIA_CG_GRADIENT], *search = c->vector[PIA_CG_SEARCH], *image = c->vector[PIA_CG_IMAGE], *z = iterate->adjust;
    renew_gradient(iterate, c);
    condition(iterate, user, g, z);
    watch_gradient(iterate, c);
    dot_components(iterate, c, g, z, gamma);
    memcpy(factor, gamma, sizeof gamma);
    divide(dim, factor, c->gamma);
    turn_search(iterate, c, z, factor, gamma, slope);
    memcpy(c->gamma, gamma, sizeof gamma);
    pia_product_apply(&c->product, search, dim, image);
    dot_components(iterate, c, search, image, curvature);
    divide(dim, slope, curvature);
    for (pia_index k = 0; k < iterate->op->cols; k++)
        for (int d = 0; d < dim; d++) {
            iterate->adjust[k * dim + d] = slope[d] * search[k * dim + d];
            g[k * dim + d] -= slope[d] * image[k * dim + d];
        }
    c->age = c->age + 1 < MAX_AGE ? c->age + 1 : 0;
}

void pia_conjugate_visit(pia_iterate *iterate, pia_conjugate *c, void (*visit)(void *, const char *, double *, pia_index), void *user)
{
    visit(user, "search", c->vector[PIA_CG_SEARCH], iterate->op->cols * iterate->dim);
    visit(user, "gradient", c->vector[PIA_CG_GRADIENT], iterate->op->cols * iterate->dim);
    visit(user, "age", &c->age, 1);
    visit(user, "gamma", c->gamma, PIA_MAX_DIM);
    visit(user, "lowest", &c->lowest, 1);
    visit(user, "still", &c->still, 1);
}
