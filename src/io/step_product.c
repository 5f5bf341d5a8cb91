#include "step.h"

/* What tells one application protocol from another. */
static const struct {
    const char *schema, *application, *protocol;
    int year;
} schema[] = {
    [PIA_STEP_AP214] = {"AUTOMOTIVE_DESIGN { 1 0 10303 214 1 1 1 1 }", "core data for automotive mechanical design processes",
                        "automotive_design", 2000},
    [PIA_STEP_AP242] = {"AP242_MANAGED_MODEL_BASED_3D_ENGINEERING_MIM_LF { 1 0 10303 442 1 1 4 }", "managed model based 3d engineering",
                        "ap242_managed_model_based_3d_engineering", 2014},
};

void pia_step_header(pia_step *s)
{
    pia_output_text(s->output, "ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION(('B-spline models'),'2;1');\n"
                               "FILE_NAME('','',(''),(''),'libpia','libpia','');\n");
    pia_output_text(s->output, "FILE_SCHEMA(('%s'));\nENDSEC;\nDATA;\n", schema[s->options->step_schema].schema);
}

static long long put_length_unit(pia_step *s)
{
    long long millimetre = 0;
    switch (s->options->unit) {
    case PIA_UNIT_METRE: return pia_step_put(s, "(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT($,.METRE.))");
    case PIA_UNIT_MILLIMETRE:
    case PIA_UNIT_INCH: millimetre = pia_step_put(s, "(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.))");
    }
    if (s->options->unit == PIA_UNIT_MILLIMETRE) return millimetre;
    long long dimensions = pia_step_put(s, "DIMENSIONAL_EXPONENTS(1.,0.,0.,0.,0.,0.,0.)");
    long long length = pia_step_put(s, "LENGTH_MEASURE_WITH_UNIT(LENGTH_MEASURE(25.4),#%lld)", millimetre);
    return pia_step_put(s, "(CONVERSION_BASED_UNIT('INCH',#%lld)LENGTH_UNIT()NAMED_UNIT(#%lld))", length, dimensions);
}

long long pia_step_context(pia_step *s)
{
    long long application = pia_step_put(s, "APPLICATION_CONTEXT('%s')", schema[s->options->step_schema].application);
    pia_step_put(s, "APPLICATION_PROTOCOL_DEFINITION('international standard','%s',%d,#%lld)", schema[s->options->step_schema].protocol,
                 schema[s->options->step_schema].year, application);
    long long length = put_length_unit(s);
    long long radian = pia_step_put(s, "(NAMED_UNIT(*)PLANE_ANGLE_UNIT()SI_UNIT($,.RADIAN.))");
    long long steradian = pia_step_put(s, "(NAMED_UNIT(*)SI_UNIT($,.STERADIAN.)SOLID_ANGLE_UNIT())");
    long long uncertainty = pia_step_begin(s);
    pia_output_text(s->output, "UNCERTAINTY_MEASURE_WITH_UNIT(LENGTH_MEASURE(");
    pia_step_real(s, s->options->tolerance);
    pia_output_text(s->output, "),#%lld,'distance_accuracy_value','');\n", length);
    s->space = pia_step_put(s,
                            "(GEOMETRIC_REPRESENTATION_CONTEXT(3)GLOBAL_UNCERTAINTY_ASSIGNED_CONTEXT((#%lld))"
                            "GLOBAL_UNIT_ASSIGNED_CONTEXT((#%lld,#%lld,#%lld))REPRESENTATION_CONTEXT('',''))",
                            uncertainty, length, radian, steradian);
    return application;
}

static long long put_axes(pia_step *s)
{
    static const double origin[3] = {0, 0, 0}, z[3] = {0, 0, 1}, x[3] = {1, 0, 0};
    long long at = pia_step_coordinates(s, "CARTESIAN_POINT", origin, 3), up = pia_step_coordinates(s, "DIRECTION", z, 3);
    long long right = pia_step_coordinates(s, "DIRECTION", x, 3);
    return pia_step_put(s, "AXIS2_PLACEMENT_3D('',#%lld,#%lld,#%lld)", at, up, right);
}

static long long put_part(pia_step *s, long long application, const char *name)
{
    long long context = pia_step_put(s, "PRODUCT_CONTEXT('',#%lld,'mechanical')", application);
    long long product = pia_step_put(s, "PRODUCT('%s','%s','',(#%lld))", name, name, context);
    pia_step_put(s, "PRODUCT_RELATED_PRODUCT_CATEGORY('part','',(#%lld))", product);
    long long formation = pia_step_put(s, "PRODUCT_DEFINITION_FORMATION('','',#%lld)", product);
    long long stage = pia_step_put(s, "PRODUCT_DEFINITION_CONTEXT('part definition',#%lld,'design')", application);
    long long design = pia_step_put(s, "PRODUCT_DEFINITION('design','',#%lld,#%lld)", formation, stage);
    return pia_step_put(s, "PRODUCT_DEFINITION_SHAPE('','',#%lld)", design);
}

void pia_step_product(pia_step *s, long long application, const char *name, const char *kind, long long item)
{
    long long definition = put_part(s, application, name), axes = put_axes(s);
    long long shape = pia_step_put(s, "%s('%s',(#%lld,#%lld),#%lld)", kind, name, axes, item, s->space);
    pia_step_put(s, "SHAPE_DEFINITION_REPRESENTATION(#%lld,#%lld)", definition, shape);
}
