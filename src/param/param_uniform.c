#include "interval.h"
#include "param.h"

static pia_status compute(pia_context *context, const double *points, pia_index count, int dim, int degree, int closed,
                          double *parameters)
{
    (void)degree;
    pia_index intervals = closed ? count : count - 1;
    for (pia_index i = 0; i < count; i++) parameters[i] = (double)i / (double)intervals;
    return pia_interval_check_distinct(context, points, count, dim);
}

const pia_parametrization pia_param_uniform = {
    .name = "uniform",
    .title = "uniform: equal steps, whatever the distances",
    .reference = "piegl1997",
    .detail = "for points taken at equal times or on a regular grid",
    .compute = compute,
};
