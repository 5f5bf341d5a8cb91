#include "io.h"

static pia_status read_points(pia_context *context, const pia_input *input, const pia_points_options *options, pia_points *out)
{
    (void)options;
    (void)out;
    return pia_input_fail(context, input, NULL,
                          "LAZ is not read; decompress it first, with 'laszip' or 'pdal translate IN.laz OUT.las'");
}

const pia_format pia_format_laz = {
    .name = "laz",
    .title = "compressed LAS",
    .detail = "not read: an error names the converters to LAS",
    .extensions = "laz",
    .read_points = read_points,
};
