#include <math.h>

#include "interval.h"
#include "param.h"

static void roots(const pia_interval_source *source, pia_index begin, pia_index end, double *length)
{
    pia_interval_chords(source, begin, end, length);
    for (pia_index i = 0; i < end - begin; i++) length[i] = sqrt(length[i]);
}

static pia_status compute(pia_context *context, const double *points, pia_index count, int dim, int degree, int closed,
                          double *parameters)
{
    (void)degree;
    return pia_interval_accumulate(context, points, count, dim, closed, roots, parameters);
}

const pia_parametrization pia_param_centripetal = {
    .name = "centripetal",
    .title = "centripetal: square roots of the chords",
    .reference = "lee1989",
    .detail = "fewer loops where chords are very uneven or turns are sharp; equal neighbours get equal parameters",
    .compute = compute,
};
