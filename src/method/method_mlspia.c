/* LSPIA with memory (Huang, Wang 2020). The paper keeps L_k for every data row, L_(k+1) = (1 - om) L_k - om nu A a_k - om e_k with
 * e = A P - Q and a = A'W L. Since e_(k+1) = e_k + nu A a_k, that is L_(k+1) = (1 - om) L_k - om e_(k+1), and applying A'W gives the
 * same iterates from n numbers instead of m: a_(k+1) = (1 - om) a_k + om g_(k+1). */
#include "method.h"
#include "spectrum.h"
#include "vectors.h"

#include <math.h>

typedef struct memory {
    double omega, nu;
    double *mean; /* a [cols x dim] */
} memory;

static pia_status begin(pia_iterate *iterate, const pia_values *values, void *state)
{
    (void)values;
    memory *m = state;
    pia_spectrum spectrum;
    pia_status status = pia_vectors_take(iterate, 1, &m->mean);
    if (status == PIA_OK) status = pia_spectrum_of_gradient(iterate, &spectrum);
    if (status != PIA_OK || !(spectrum.largest > 0)) return status;
    double first = sqrt(spectrum.largest), last = sqrt(spectrum.smallest);
    m->omega = 4 * first * last / ((first + last) * (first + last));
    m->nu = 1 / (first * last);
    return PIA_OK;
}

static pia_status adjust(pia_iterate *iterate, void *state)
{
    memory *m = state;
    pia_iterate_gradient(iterate, iterate->adjust);
    pia_vectors_mix(iterate, m->omega, iterate->adjust, 1 - m->omega, m->mean);
    pia_vectors_mix(iterate, m->nu, m->mean, 0, iterate->adjust);
    return PIA_OK;
}

static void end(pia_iterate *iterate, void *state)
{
    pia_give(iterate->context, ((memory *)state)->mean);
}

static void history(pia_iterate *iterate, void *state, void (*visit)(void *, const char *, double *, pia_index), void *user)
{
    visit(user, "mean", ((memory *)state)->mean, iterate->op->cols * iterate->dim);
}

const pia_method pia_method_mlspia = {
    .name = "mlspia",
    .title = "LSPIA with memory: steps along a running mean of the gradients",
    .reference = "huang2020",
    .detail = "least squares; iterations grow with the square root of the condition; estimates two eigenvalues first",
    .needs = PIA_LEAST_SQUARES | PIA_NEEDS_NORMAL,
    .iterations = 10000,
    .state_size = sizeof(memory),
    .begin = begin,
    .adjust = adjust,
    .end = end,
    .history = history,
};
