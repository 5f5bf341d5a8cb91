#include "interval.h"
#include "param.h"

static pia_status compute(pia_context *context, const double *points, pia_index count, int dim, int degree, int closed,
                          double *parameters)
{
    (void)degree;
    return pia_interval_accumulate(context, points, count, dim, closed, pia_interval_chords, parameters);
}

const pia_parametrization pia_param_chord = {
    .name = "chord",
    .title = "chord length: proportional to the distance travelled",
    .reference = "piegl1997",
    .detail = "the usual choice; equal neighbours get equal parameters",
    .compute = compute,
};
