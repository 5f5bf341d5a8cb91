#include <math.h>

#include "interval.h"
#include "param.h"

enum { PREVIOUS, HERE, NEXT };

/* Interval i and its two neighbours; 0 where there is none. */
static void three_chords(const pia_interval_source *s, pia_index i, double chord[3])
{
    pia_index last = s->closed ? s->count - 1 : s->count - 2;
    pia_index previous = i > 0 ? i - 1 : s->closed ? last : -1;
    pia_index next = i < last ? i + 1 : s->closed ? 0 : -1;
    chord[PREVIOUS] = previous >= 0 ? pia_interval_chord(s, previous) : 0;
    chord[HERE] = pia_interval_chord(s, i);
    chord[NEXT] = next >= 0 ? pia_interval_chord(s, next) : 0;
}

/* Angle between the edges before and after point i, both of positive length (pi minus the angle at the point), at most pi/2. Kahan's
 * form keeps its digits for small angles. */
static double turn(const pia_interval_source *s, pia_index i, double before, double after)
{
    const double *p = s->points + (i > 0 ? i - 1 : s->count - 1) * s->dim;
    const double *q = s->points + i * s->dim;
    const double *r = s->points + (i + 1 < s->count ? i + 1 : 0) * s->dim;
    double difference = 0, sum = 0;
    for (int c = 0; c < s->dim; c++) {
        double a = (q[c] - p[c]) * s->scale / before, b = (r[c] - q[c]) * s->scale / after;
        difference += (b - a) * (b - a);
        sum += (b + a) * (b + a);
    }
    return fmin(2 * atan2(sqrt(difference), sqrt(sum)), acos(0));
}

/* Foley and Nielson: a chord counts for more where the polygon turns at its ends. */
static double interval(const pia_interval_source *s, pia_index i)
{
    double chord[3], factor = 1;
    three_chords(s, i, chord);
    if (chord[HERE] == 0) return 0;
    if (chord[PREVIOUS] > 0)
        factor += 1.5 * turn(s, i, chord[PREVIOUS], chord[HERE]) * chord[PREVIOUS] / (chord[PREVIOUS] + chord[HERE]);
    if (chord[NEXT] > 0)
        factor += 1.5 * turn(s, i + 1 < s->count ? i + 1 : 0, chord[HERE], chord[NEXT]) * chord[NEXT] / (chord[HERE] + chord[NEXT]);
    return chord[HERE] * factor;
}

static void intervals(const pia_interval_source *source, pia_index begin, pia_index end, double *length)
{
    for (pia_index i = begin; i < end; i++) length[i - begin] = interval(source, i);
}

static pia_status compute(pia_context *context, const double *points, pia_index count, int dim, int degree, int closed,
                          double *parameters)
{
    (void)degree;
    return pia_interval_accumulate(context, points, count, dim, closed, intervals, parameters);
}

const pia_parametrization pia_param_foley = {
    .name = "foley",
    .title = "Foley-Nielson: chords weighted by the angles at their ends",
    .reference = "foley1989",
    .detail = "gives sharp turns more room than chord length does; equal neighbours get equal parameters",
    .compute = compute,
};
