/* STEP AP214 and AP242 (ISO 10303-21), a part a model: curves as geometric curve sets; surfaces as advanced faces, the form CAD systems
 * read best, with a seam where they are closed and no edge where they shrink to a point (a sphere's pole). Numbers with all the digits
 * a double has. */
#include "occt.h"
#include "step.h"

/* What represents a model: one item, and the kind of representation it belongs to. */
static pia_status put_shape(pia_context *context, pia_step *s, const pia_model *model, const char **kind, long long *item)
{
    long long points = pia_step_points(s, model);
    if (model->directions == 1) {
        pia_step_line whole = pia_step_whole(model);
        *kind = "GEOMETRICALLY_BOUNDED_WIREFRAME_SHAPE_REPRESENTATION";
        *item = pia_step_curve(s, model, points, &whole);
        *item = pia_step_put(s, "GEOMETRIC_CURVE_SET('',(#%lld))", *item);
        return PIA_OK;
    }
    long long surface = pia_step_surface(s, model, points);
    if (pia_model_trim_loop_count(model) > 0 || pia_step_has_edges(model)) {
        *kind = "MANIFOLD_SURFACE_SHAPE_REPRESENTATION";
        return pia_step_shell(context, s, model, surface, points, item);
    }
    *kind = "GEOMETRICALLY_BOUNDED_SURFACE_SHAPE_REPRESENTATION";
    *item = pia_step_put(s, "GEOMETRIC_SET('',(#%lld))", surface);
    return PIA_OK;
}

static pia_status write_models(pia_context *context, pia_output *output, const pia_model *const *models, pia_index count,
                               const pia_write_options *options)
{
    pia_status status = pia_cad_check(context, "STEP", models, count);
    if (status != PIA_OK) return status;
    pia_write_options o = *options;
    o.tolerance = pia_cad_tolerance(options, models, count);
    pia_step s = {.output = output, .options = &o};
    pia_step_header(&s);
    long long application = pia_step_context(&s);
    for (pia_index i = 0; i < count && status == PIA_OK; i++) {
        const char *kind;
        char name[PIA_CAD_NAME_SIZE];
        long long item;
        pia_cad_name(&o, i, count, name);
        status = put_shape(context, &s, models[i], &kind, &item);
        if (status == PIA_OK) pia_step_product(&s, application, name, kind, item);
    }
    pia_output_text(output, "ENDSEC;\nEND-ISO-10303-21;\n");
    return status;
}

static pia_status read_models(pia_context *context, const pia_input *input, pia_model ***out, pia_index *count)
{
    return pia_occt_read(context, input, "step", out, count);
}

const pia_format pia_format_step = {
    .name = "step",
    .title = "STEP AP214 and AP242 (ISO 10303-21)",
    .detail = "reads and writes curves, surfaces and trimmed faces, exact to the bit; several in a file",
    .extensions = "stp step",
    .read_models = read_models,
    .plugin = &pia_plugin_occt,
    .write_models = write_models,
};
