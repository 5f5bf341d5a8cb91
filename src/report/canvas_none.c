#include "canvas.h"

pia_status pia_canvas_open(pia_context *context, pia_output *output, pia_picture picture, double width, double height, double scale,
                           pia_canvas **out)
{
    (void)output, (void)picture, (void)width, (void)height, (void)scale, (void)out;
    return pia_fail(context, PIA_E_UNAVAILABLE, "this build draws no pictures; install libcairo2-dev and build again");
}
