/* The scalar step that contracts fastest: 2 / (l1 + ln), l1 and ln the ends of the spectrum of H (Deng, Lin 2014, section 3). */
#include "method.h"
#include "spectrum.h"
#include "vectors.h"

typedef struct optimal {
    double step;
} optimal;

static pia_status begin(pia_iterate *iterate, const pia_values *values, void *state)
{
    (void)values;
    optimal *o = state;
    pia_spectrum spectrum;
    pia_status status = pia_spectrum_of_gradient(iterate, &spectrum);
    if (status == PIA_OK && spectrum.largest > 0) o->step = 2 / (spectrum.largest + spectrum.smallest);
    return status;
}

static pia_status adjust(pia_iterate *iterate, void *state)
{
    const optimal *o = state;
    pia_iterate_gradient(iterate, iterate->adjust);
    pia_vectors_mix(iterate, 0, iterate->adjust, o->step, iterate->adjust);
    return PIA_OK;
}

const pia_method pia_method_lspia_opt = {
    .name = "lspia-opt",
    .title = "LSPIA with the best scalar step, from the ends of the spectrum",
    .reference = "deng2014",
    .detail = "least squares; estimates two eigenvalues first",
    .needs = PIA_LEAST_SQUARES | PIA_NEEDS_NORMAL,
    .iterations = 10000,
    .state_size = sizeof(optimal),
    .begin = begin,
    .adjust = adjust,
};
