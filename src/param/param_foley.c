#include <math.h>

#include "interval.h"
#include "param.h"

static const double half_pi = 1.57079632679489661923;

/* Chord of an interval of any index: the open curve has none before its first and after its last one. */
static double chord_of(const pia_interval_source *s, pia_index i)
{
    if (i >= 0 && i + 1 < s->count) return pia_interval_chord(s, i);
    return s->closed ? pia_interval_chord(s, i < 0 ? s->count - 1 : i % s->count) : 0;
}

/* Angle between the edges before and after point i (pi minus the angle at the point), at most pi/2; 0 where an edge has no length.
 * Kahan's form keeps its digits for small angles. */
static double turn(const pia_interval_source *s, pia_index i, double before, double after)
{
    if (!(before > 0 && after > 0)) return 0;
    const double *p = s->points + (i > 0 ? i - 1 : s->count - 1) * s->dim;
    const double *q = s->points + (i < s->count ? i : 0) * s->dim;
    const double *r = s->points + (i + 1 < s->count ? i + 1 : i + 1 - s->count) * s->dim;
    double difference = 0, sum = 0;
    for (int c = 0; c < s->dim; c++) {
        double a = (q[c] - p[c]) * s->scale / before, b = (r[c] - q[c]) * s->scale / after;
        difference += (b - a) * (b - a);
        sum += (b + a) * (b + a);
    }
    double angle = 2 * atan2(sqrt(difference), sqrt(sum));
    return angle < half_pi ? angle : half_pi;
}

/* What a turn adds to the weight of a chord: the more, the longer the neighbour behind it. */
static double bonus(double angle, double chord, double neighbour)
{
    return neighbour > 0 ? 1.5 * angle * neighbour / (neighbour + chord) : 0;
}

/* Foley and Nielson: a chord counts for more where the polygon turns at its ends. */
static void intervals(const pia_interval_source *s, pia_index begin, pia_index end, double *length)
{
    double before = chord_of(s, begin - 1), chord = chord_of(s, begin), turn_before = turn(s, begin, before, chord);
    for (pia_index i = begin; i < end; i++) {
        double after = chord_of(s, i + 1), turn_after = turn(s, i + 1, chord, after);
        length[i - begin] = chord * (1 + bonus(turn_before, chord, before) + bonus(turn_after, chord, after));
        before = chord;
        chord = after;
        turn_before = turn_after;
    }
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
