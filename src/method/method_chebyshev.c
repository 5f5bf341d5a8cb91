/* Chebyshev semi-iteration (Golub, Varga 1961) on H preconditioned by its diagonal D: with theta the middle and delta half the width of
 * the spectrum of D^-1 H, P_(k+1) - P_k = om_k D^-1 g_k / theta + (om_k - 1) (P_k - P_(k-1)), om from the three-term recurrence. No
 * inner products: the cheapest iteration among the fast ones, and the same steps whatever the data are. */
#include "method.h"
#include "normalise.h"
#include "product.h"
#include "spectrum.h"
#include "vectors.h"

#include <math.h>

typedef struct chebyshev {
    double middle, quotient; /* theta, (delta / theta)^2 */
    double omega;            /* of the step before; 0: none */
    double *inverse;         /* 1 / D [cols] */
    double *move;            /* P_k - P_(k-1) [cols x dim] */
} chebyshev;

/* Row sums of H over its diagonal bound the eigenvalues of D^-1 H. */
static pia_status find_bound(const pia_iterate *iterate, const double *inverse, double *work, double *bound)
{
    pia_status status = pia_column_sums(iterate, work);
    if (status == PIA_OK) {
        for (pia_index c = 0; c < iterate->op->cols; c++) work[c] *= inverse[c];
        *bound = pia_largest(iterate->op->cols, work);
    }
    return status;
}

static pia_status find_spectrum(const pia_iterate *iterate, const double *inverse, pia_spectrum *out)
{
    pia_index cols = iterate->op->cols;
    double bound = 0, *work = pia_take(iterate->context, cols, sizeof *work);
    if (work == NULL) return pia_take_status(iterate->context, cols, sizeof *work);
    pia_status status = find_bound(iterate, inverse, work, &bound);
    for (pia_index c = 0; c < cols; c++) work[c] = sqrt(inverse[c]);
    if (status == PIA_OK) status = pia_spectrum_estimate(iterate, work, bound, out);
    pia_give(iterate->context, work);
    return status;
}

static pia_status begin(pia_iterate *iterate, const pia_values *values, void *state)
{
    (void)values;
    chebyshev *c = state;
    pia_index cols = iterate->op->cols;
    pia_spectrum spectrum;
    c->inverse = pia_take(iterate->context, cols, sizeof *c->inverse);
    if (c->inverse == NULL) return pia_take_status(iterate->context, cols, sizeof *c->inverse);
    pia_status status = pia_vectors_take(iterate, 1, &c->move);
    if (status == PIA_OK) status = pia_product_diagonal(iterate, c->inverse);
    if (status != PIA_OK) return status;
    pia_reciprocals(cols, c->inverse);
    status = find_spectrum(iterate, c->inverse, &spectrum);
    if (status != PIA_OK || !(spectrum.largest > 0)) return status;
    c->middle = 0.5 * (spectrum.largest + spectrum.smallest);
    double half = 0.5 * (spectrum.largest - spectrum.smallest) / c->middle;
    c->quotient = half * half;
    return PIA_OK;
}

static double next_omega(const chebyshev *c)
{
    if (c->omega == 0) return 1;
    return 1 / (1 - c->quotient * (c->omega == 1 ? 0.5 : 0.25 * c->omega));
}

static pia_status adjust(pia_iterate *iterate, void *state)
{
    chebyshev *c = state;
    c->omega = next_omega(c);
    pia_iterate_gradient(iterate, iterate->adjust);
    pia_vectors_scale(iterate, c->inverse, iterate->adjust, iterate->adjust);
    pia_vectors_mix(iterate, c->middle > 0 ? c->omega / c->middle : 0, iterate->adjust, c->omega - 1, c->move);
    pia_vectors_mix(iterate, 1, c->move, 0, iterate->adjust);
    return PIA_OK;
}

static void end(pia_iterate *iterate, void *state)
{
    chebyshev *c = state;
    pia_give(iterate->context, c->inverse);
    pia_give(iterate->context, c->move);
}

static void history(pia_iterate *iterate, void *state, void (*visit)(void *, const char *, double *, pia_index), void *user)
{
    chebyshev *c = state;
    visit(user, "omega", &c->omega, 1);
    visit(user, "move", c->move, iterate->op->cols * iterate->dim);
}

const pia_method pia_method_chebyshev = {
    .name = "chebyshev",
    .title = "Chebyshev semi-iteration on the normal equations, preconditioned by their diagonal",
    .reference = "golub1961",
    .detail = "least squares; no inner products; estimates two eigenvalues first",
    .needs = PIA_LEAST_SQUARES | PIA_NEEDS_NORMAL,
    .iterations = 10000,
    .state_size = sizeof(chebyshev),
    .begin = begin,
    .adjust = adjust,
    .end = end,
    .history = history,
};
