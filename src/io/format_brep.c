/* BREP, the format of OpenCASCADE's own shapes: read by the plug-in. */
#include "occt.h"

static pia_status read_models(pia_context *context, const pia_input *input, pia_model ***out, pia_index *count)
{
    return pia_occt_read(context, input, "brep", out, count);
}

const pia_format pia_format_brep = {
    .name = "brep",
    .title = "OpenCASCADE BREP",
    .detail = "reads every curve and surface, with trim loops",
    .extensions = "brep brp",
    .read_models = read_models,
    .plugin = &pia_plugin_occt,
};
