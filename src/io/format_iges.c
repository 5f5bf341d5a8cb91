/* IGES 5.3: entity 126 for curves, 128 for surfaces, 144 for trimmed surfaces with 142, 102 and 126 for their loops; numbers with all
 * the digits a double has. Fixed 80-column lines in the sections start, global, directory, parameters, terminate. */
#include "cad.h"
#include "iges.h"
#include "occt.h"

static pia_status write_models(pia_context *context, pia_output *output, const pia_model *const *models, pia_index count,
                               const pia_write_options *options)
{
    pia_iges_plan plan = {.context = context};
    pia_status status = pia_cad_check(context, "IGES", models, count);
    for (pia_index i = 0; i < count && status == PIA_OK; i++) status = pia_iges_plan_add(&plan, models[i]);
    pia_write_options o = *options;
    o.tolerance = pia_cad_tolerance(options, models, count);
    if (status == PIA_OK) pia_iges_write(output, &plan, &o);
    pia_iges_plan_clear(&plan);
    return status;
}

static pia_status read_models(pia_context *context, const pia_input *input, pia_model ***out, pia_index *count)
{
    return pia_occt_read(context, input, "iges", out, count);
}

const pia_format pia_format_iges = {
    .name = "iges",
    .title = "IGES 5.3, entities 126, 128 and 144",
    .detail = "reads and writes curves, surfaces and trimmed surfaces, exact to the bit; several in a file",
    .extensions = "igs iges",
    .read_models = read_models,
    .plugin = &pia_plugin_occt,
    .write_models = write_models,
};
