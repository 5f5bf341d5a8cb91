/* What the parametrizations share: an interval a pair of neighbours, summed and scaled to [0, 1] at memory speed. */
#ifndef PIA_PARAM_INTERVAL_H
#define PIA_PARAM_INTERVAL_H

#include "context.h"

typedef struct pia_interval_source {
    const double *points; /* [count x dim] */
    pia_index count;
    int dim, closed;
    double scale; /* coordinate differences are multiplied by it, so that squares neither overflow nor vanish */
} pia_interval_source;

/* Lengths >= 0 of the intervals [begin, end): interval i lies between point i and point i + 1, interval count - 1 closes the curve. */
typedef void pia_interval_rule(const pia_interval_source *source, pia_index begin, pia_index end, double *length);

/* Distance of two neighbours, scaled. */
double pia_interval_chord(const pia_interval_source *source, pia_index i);
/* Those of [begin, end). */
void pia_interval_chords(const pia_interval_source *source, pia_index begin, pia_index end, double *length);

/* Parameters from a rule: sums of intervals over their total. The order of summation depends on the count alone. Errors: PIA_E_DATA
 * when all points are equal or a coordinate is not finite, PIA_E_MEMORY. */
pia_status pia_interval_accumulate(pia_context *context, const double *points, pia_index count, int dim, int closed,
                                   pia_interval_rule *rule, double *parameters);

/* PIA_E_DATA when all points are equal; reads as far as the first that differs. */
pia_status pia_interval_check_distinct(pia_context *context, const double *points, pia_index count, int dim);

#endif
