#include "io.h"

static pia_status read_points(pia_context *context, const pia_input *input, const pia_points_options *options, pia_points *out)
{
    (void)options;
    (void)out;
    return pia_input_fail(context, input, NULL,
                          "E57 is not read; convert it first, with 'pdal translate IN.e57 OUT.las' or CloudCompare");
}

const pia_format pia_format_e57 = {
    .name = "e57",
    .title = "ASTM E57 scans",
    .detail = "not read: an error names the converters to LAS",
    .extensions = "e57",
    .read_points = read_points,
};
