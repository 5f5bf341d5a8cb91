/* Wu, Liu 2024: scalar steps that run through the reciprocals of the roots of a Chebyshev polynomial on the spectrum [ln, l1], from the
 * shortest step to the longest. The long ones at the end of a period amplify rounding without bound, so that the period starts over
 * where the gradient has grown. The singular form needs no ln: its polynomial is 1 at zero and has its other extremes up to l1. */
#include "method.h"
#include "spectrum.h"
#include "vectors.h"

#include <math.h>

static const double pi = 3.14159265358979323846;

enum { FORM, PERIOD, DEFINITE = 0, GROWTH = 10 };

typedef struct alternating {
    pia_spectrum spectrum;
    double period, definite;
    double count, lowest; /* steps of this period, the smallest |gradient| in it */
} alternating;

static pia_status begin(pia_iterate *iterate, const pia_values *values, void *state)
{
    alternating *a = state;
    a->definite = values->number[FORM] == DEFINITE;
    a->period = floor(values->number[PERIOD]);
    return pia_spectrum_of_gradient(iterate, &a->spectrum);
}

static double step_length(const alternating *a)
{
    double l = a->count, first = a->spectrum.largest, last = a->spectrum.smallest, next = a->period + 1;
    if (!(first > 0)) return 0;
    if (a->definite != 0) return 2 / (first + last + (first - last) * cos((2 * l + 1) * pi / (2 * a->period)));
    double lowest = cos((2 * a->period + 1) * pi / (2 * next));
    return (1 - lowest) / (first * (cos((2 * l + 1) * pi / (2 * next)) - lowest));
}

static pia_status adjust(pia_iterate *iterate, void *state)
{
    alternating *a = state;
    pia_iterate_gradient(iterate, iterate->adjust);
    double size = iterate->relative_gradient;
    if (a->count >= a->period || size > GROWTH * a->lowest) a->count = 0;
    a->lowest = a->count == 0 ? size : fmin(size, a->lowest);
    pia_vectors_mix(iterate, 0, iterate->adjust, step_length(a), iterate->adjust);
    a->count++;
    return PIA_OK;
}

static void history(pia_iterate *iterate, void *state, void (*visit)(void *, const char *, double *, pia_index), void *user)
{
    (void)iterate;
    alternating *a = state;
    visit(user, "count", &a->count, 1);
    visit(user, "lowest", &a->lowest, 1);
}

static const pia_parameter parameters[] = {
    {"form", "definite|singular", "definite", 0, 1, "steps for a spectrum [ln, l1], or for one that reaches down to 0"},
    {"period", NULL, "10000", 1, 1e6, "steps until the sequence of step lengths repeats"},
    {0}};

const pia_method pia_method_alspia = {
    .name = "alspia",
    .title = "LSPIA with step lengths from the roots of Chebyshev polynomials",
    .reference = "wu2024",
    .detail = "least squares; estimates two eigenvalues first",
    .needs = PIA_LEAST_SQUARES | PIA_NEEDS_NORMAL,
    .iterations = 10000,
    .parameters = parameters,
    .state_size = sizeof(alternating),
    .begin = begin,
    .adjust = adjust,
    .history = history,
};
