/* Nesterov's momentum for LSPIA: P_(k+1) = P_k + z (g_k + eta (g_k - g_(k-1))) + eta (P_k - P_(k-1)). */
#include "method.h"
#include "spectrum.h"
#include "vectors.h"

#include <math.h>
#include <string.h>

enum { GRADIENT, MOVE, VECTORS }; /* g_(k-1), P_k - P_(k-1) */

typedef struct momentum {
    double step, eta, begun;
    double *vector[VECTORS];
} momentum;

static pia_status begin(pia_iterate *iterate, const pia_values *values, void *state)
{
    (void)values;
    momentum *m = state;
    pia_spectrum spectrum;
    pia_status status = pia_vectors_take(iterate, VECTORS, m->vector);
    if (status == PIA_OK) status = pia_spectrum_of_gradient(iterate, &spectrum);
    if (status != PIA_OK || !(spectrum.largest > 0)) return status;
    double root = sqrt(spectrum.largest / spectrum.smallest);
    m->step = 1 / spectrum.largest;
    m->eta = (root - 1) / (root + 1);
    return PIA_OK;
}

static pia_status adjust(pia_iterate *iterate, void *state)
{
    momentum *m = state;
    pia_index size = iterate->op->cols * iterate->dim;
    double *previous = m->vector[GRADIENT], *move = m->vector[MOVE], *d = iterate->adjust;
    pia_iterate_gradient(iterate, d);
    if (m->begun == 0) memcpy(previous, d, (size_t)size * sizeof *d);
    m->begun = 1;
    for (pia_index i = 0; i < size; i++) {
        move[i] = m->step * (d[i] + m->eta * (d[i] - previous[i])) + m->eta * move[i];
        previous[i] = d[i];
        d[i] = move[i];
    }
    return PIA_OK;
}

static void end(pia_iterate *iterate, void *state)
{
    pia_give(iterate->context, ((momentum *)state)->vector[0]);
}

static void history(pia_iterate *iterate, void *state, void (*visit)(void *, const char *, double *, pia_index), void *user)
{
    momentum *m = state;
    pia_index size = iterate->op->cols * iterate->dim;
    visit(user, "begun", &m->begun, 1);
    visit(user, "gradient", m->vector[GRADIENT], size);
    visit(user, "move", m->vector[MOVE], size);
}

const pia_method pia_method_nmlspia = {
    .name = "nmlspia",
    .title = "LSPIA with Nesterov's momentum",
    .reference = "nesterov1983",
    .detail = "least squares; iterations grow with the square root of the condition; estimates two eigenvalues first",
    .needs = PIA_LEAST_SQUARES | PIA_NEEDS_NORMAL,
    .iterations = 10000,
    .state_size = sizeof(momentum),
    .begin = begin,
    .adjust = adjust,
    .end = end,
    .history = history,
};
