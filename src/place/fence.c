#include "fence.h"

#include <math.h>

static const double EQUAL = 1e-12; /* differences this near, relative to the whole, are a tie */

/* The weight of line j in the interval from line s to line e: its term of lambda. */
static double term(pia_fence_rule rule, const double *parameters, const double *curvature, pia_index s, pia_index e, double low,
                   double range, pia_index j)
{
    double k = range > 0 ? (curvature[j] - low) / range : 0;
    double from = rule == PIA_FENCE_PRINTED ? parameters[s] : parameters[j], to = parameters[rule == PIA_FENCE_PRINTED ? j : j + 1];
    return exp(k) * ((to - from) / (parameters[e] - parameters[s]));
}

/* The line s < w < e that minimises |lambda(s, w) - lambda(w, e)|, the smallest of equals. */
static pia_index marker(pia_fence_rule rule, const double *parameters, const double *curvature, pia_index s, pia_index e)
{
    double low = curvature[s], high = curvature[s], total = 0, before = 0, best = INFINITY;
    for (pia_index j = s; j <= e; j++) {
        low = fmin(low, curvature[j]);
        high = fmax(high, curvature[j]);
    }
    double range = high - low > EQUAL * high ? high - low : 0;
    for (pia_index j = s; j < e; j++) total += term(rule, parameters, curvature, s, e, low, range, j);
    pia_index at = s + 1;
    for (pia_index w = s + 1; w < e; w++) {
        before += term(rule, parameters, curvature, s, e, low, range, w - 1);
        double difference = fabs(2 * before - total);
        if (difference < best - EQUAL * total) {
            best = difference;
            at = w;
        }
    }
    return at;
}

void pia_fence_place(pia_fence_rule rule, const double *parameters, const double *curvature, pia_index count, const pia_index *chosen,
                     pia_index control, pia_index *first)
{
    first[0] = 0;
    first[control] = count;
    for (pia_index i = 1; i < control; i++) {
        pia_index s = chosen[i - 1], e = chosen[i];
        first[i] = e == s + 1 ? e : marker(rule, parameters, curvature, s, e);
    }
}

void pia_fence_groups(const pia_index *first, const pia_index *chosen, pia_index control, const unsigned char *own, pia_index *begin,
                      pia_index *end)
{
    for (pia_index i = 0; i < control; i++) {
        int alone = own[chosen[i]];
        begin[i] = alone ? chosen[i] : first[i];
        end[i] = alone ? chosen[i] + 1 : first[i + 1];
        if (!alone && i > 0 && own[chosen[i - 1]]) begin[i] = chosen[i - 1] + 1;
        if (!alone && i + 1 < control && own[chosen[i + 1]]) end[i] = chosen[i + 1];
    }
}
