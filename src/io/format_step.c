/* STEP AP214 (ISO 10303-21): curves as a geometric curve set; surfaces as advanced faces with four boundary curves, the form CAD
 * systems read best, or as a geometric set where an edge is closed or shrinks to a point (a sphere's pole, a tube), which faces do not
 * survive. Millimetres. Numbers with all the digits a double has. */
#include "cad.h"
#include "io.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

typedef struct step {
    pia_output *output;
    long long last; /* the number of the last instance written */
} step;

/* "#n=" and the text; returns n. */
static long long put(step *s, const char *format, ...) __attribute__((format(printf, 2, 3)));
static long long put(step *s, const char *format, ...)
{
    char text[512];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    pia_output_text(s->output, "#%lld=%s;\n", ++s->last, text);
    return s->last;
}

static void put_real(step *s, double value)
{
    char text[PIA_CAD_REAL_SIZE];
    int length = pia_cad_real(value, text);
    pia_output_bytes(s->output, text, (size_t)length);
}

static long long put_xyz(step *s, const char *entity, const double xyz[3])
{
    pia_output_text(s->output, "#%lld=%s('',(", ++s->last, entity);
    for (int d = 0; d < 3; d++) {
        if (d > 0) pia_output_bytes(s->output, ",", 1);
        put_real(s, xyz[d]);
    }
    pia_output_text(s->output, "));\n");
    return s->last;
}

/* "(4,1,4),(0.,0.5,1.)": multiplicities, or the distinct values. */
static void put_runs(step *s, const double *knots, pia_index count, int values)
{
    pia_output_bytes(s->output, "(", 1);
    for (pia_index i = 0, length; i < count; i += length) {
        length = pia_cad_run(knots, count, i);
        if (i > 0) pia_output_bytes(s->output, ",", 1);
        if (values)
            put_real(s, knots[i]);
        else
            pia_output_text(s->output, "%lld", (long long)length);
    }
    pia_output_bytes(s->output, ")", 1);
}

static const char *logical(int value)
{
    return value ? ".T." : ".F.";
}

/* A row of references #first, #first + stride, ... */
static void put_references(step *s, long long first, pia_index count, pia_index stride)
{
    pia_output_bytes(s->output, "(", 1);
    for (pia_index i = 0; i < count; i++) pia_output_text(s->output, i > 0 ? ",#%lld" : "#%lld", first + (long long)(i * stride));
    pia_output_bytes(s->output, ")", 1);
}

/* A line of control points: of a curve all, of a surface an edge. */
typedef struct line {
    pia_index first, stride, count;
    int degree, closed;
    const double *knots;
} line;

static line line_of(const pia_model *model, int along, int last)
{
    pia_index columns = model->control[1], stride = along == 0 ? columns : 1, across = along == 0 ? 1 : columns;
    pia_index first = last ? (model->control[1 - along] - 1) * across : 0;
    return (line){first, stride, model->control[along], model->degree[along], 0, model->knots[along]};
}

static void put_weights(step *s, const pia_model *model, const line *l)
{
    double xyz[3], w;
    for (pia_index i = 0; i < l->count; i++) {
        pia_cad_point(model, l->first + i * l->stride, xyz, &w);
        if (i > 0) pia_output_bytes(s->output, ",", 1);
        put_real(s, w);
    }
}

/* points: the instance of the model's first control point; the others follow in order. */
static long long put_curve(step *s, const pia_model *model, long long points, const line *l)
{
    pia_index knots = l->count + l->degree + 1;
    long long number = ++s->last;
    if (!model->rational) {
        pia_output_text(s->output, "#%lld=B_SPLINE_CURVE_WITH_KNOTS('',%d,", number, l->degree);
        put_references(s, points + (long long)l->first, l->count, l->stride);
        pia_output_text(s->output, ",.UNSPECIFIED.,%s,.F.,", logical(l->closed));
        put_runs(s, l->knots, knots, 0);
        pia_output_bytes(s->output, ",", 1);
        put_runs(s, l->knots, knots, 1);
        pia_output_text(s->output, ",.UNSPECIFIED.);\n");
        return number;
    }
    pia_output_text(s->output, "#%lld=(BOUNDED_CURVE()B_SPLINE_CURVE(%d,", number, l->degree);
    put_references(s, points + (long long)l->first, l->count, l->stride);
    pia_output_text(s->output, ",.UNSPECIFIED.,%s,.F.)B_SPLINE_CURVE_WITH_KNOTS(", logical(l->closed));
    put_runs(s, l->knots, knots, 0);
    pia_output_bytes(s->output, ",", 1);
    put_runs(s, l->knots, knots, 1);
    pia_output_text(s->output, ",.UNSPECIFIED.)CURVE()GEOMETRIC_REPRESENTATION_ITEM()RATIONAL_B_SPLINE_CURVE((");
    put_weights(s, model, l);
    pia_output_text(s->output, "))REPRESENTATION_ITEM(''));\n");
    return number;
}

static void put_surface_knots(step *s, const pia_model *model)
{
    for (int values = 0; values < 2; values++)
        for (int d = 0; d < 2; d++) {
            put_runs(s, model->knots[d], model->control[d] + model->degree[d] + 1, values);
            pia_output_bytes(s->output, ",", 1);
        }
    pia_output_text(s->output, ".UNSPECIFIED.");
}

static void put_net(step *s, const pia_model *model, long long points)
{
    pia_output_bytes(s->output, "(", 1);
    for (pia_index i = 0; i < model->control[0]; i++) {
        if (i > 0) pia_output_bytes(s->output, ",", 1);
        put_references(s, points + (long long)(i * model->control[1]), model->control[1], 1);
    }
    pia_output_bytes(s->output, ")", 1);
}

static long long put_surface(step *s, const pia_model *model, long long points)
{
    long long number = ++s->last;
    const char *u = logical(pia_cad_is_closed(model, 0)), *v = logical(pia_cad_is_closed(model, 1));
    if (!model->rational) {
        pia_output_text(s->output, "#%lld=B_SPLINE_SURFACE_WITH_KNOTS('',%d,%d,", number, model->degree[0], model->degree[1]);
        put_net(s, model, points);
        pia_output_text(s->output, ",.UNSPECIFIED.,%s,%s,.F.,", u, v);
        put_surface_knots(s, model);
        pia_output_text(s->output, ");\n");
        return number;
    }
    pia_output_text(s->output, "#%lld=(BOUNDED_SURFACE()B_SPLINE_SURFACE(%d,%d,", number, model->degree[0], model->degree[1]);
    put_net(s, model, points);
    pia_output_text(s->output, ",.UNSPECIFIED.,%s,%s,.F.)B_SPLINE_SURFACE_WITH_KNOTS(", u, v);
    put_surface_knots(s, model);
    pia_output_text(s->output, ")GEOMETRIC_REPRESENTATION_ITEM()RATIONAL_B_SPLINE_SURFACE((");
    for (pia_index i = 0; i < model->control[0]; i++) {
        line row = {i * model->control[1], 1, model->control[1], 0, 0, NULL};
        pia_output_text(s->output, i > 0 ? ",(" : "(");
        put_weights(s, model, &row);
        pia_output_bytes(s->output, ")", 1);
    }
    pia_output_text(s->output, "))REPRESENTATION_ITEM('')SURFACE());\n");
    return number;
}

/* All control points, one instance each, in the order of the model. */
static long long put_points(step *s, const pia_model *model)
{
    double xyz[3], w;
    long long first = s->last + 1;
    for (pia_index i = 0; i < model->control[0] * model->control[1]; i++) {
        pia_cad_point(model, i, xyz, &w);
        put_xyz(s, "CARTESIAN_POINT", xyz);
    }
    return first;
}

/* A face bounded by its four edges, counter-clockwise seen along the normal: v = 0 forth, u = 1 forth, v = 1 back, u = 0 back. */
static long long put_face(step *s, const pia_model *model, long long surface, long long points)
{
    static const struct {
        int along, last, back;
    } side[4] = {{0, 0, 0}, {1, 1, 0}, {0, 1, 1}, {1, 0, 1}};
    pia_index rows = model->control[0], columns = model->control[1];
    pia_index corner[4] = {0, (rows - 1) * columns, rows * columns - 1, columns - 1};
    long long vertex[4], edge[4];
    for (int k = 0; k < 4; k++) vertex[k] = put(s, "VERTEX_POINT('',#%lld)", points + (long long)corner[k]);
    for (int k = 0; k < 4; k++) {
        line l = line_of(model, side[k].along, side[k].last);
        long long curve = put_curve(s, model, points, &l);
        long long from = vertex[side[k].back ? (k + 1) % 4 : k], to = vertex[side[k].back ? k : (k + 1) % 4];
        long long both = put(s, "EDGE_CURVE('',#%lld,#%lld,#%lld,.T.)", from, to, curve);
        edge[k] = put(s, "ORIENTED_EDGE('',*,*,#%lld,%s)", both, logical(!side[k].back));
    }
    long long loop = put(s, "EDGE_LOOP('',(#%lld,#%lld,#%lld,#%lld))", edge[0], edge[1], edge[2], edge[3]);
    long long bound = put(s, "FACE_OUTER_BOUND('',#%lld,.T.)", loop);
    long long face = put(s, "ADVANCED_FACE('',(#%lld),#%lld,.T.)", bound, surface);
    long long shell = put(s, "OPEN_SHELL('',(#%lld))", face);
    return put(s, "SHELL_BASED_SURFACE_MODEL('',(#%lld))", shell);
}

static int has_faces(const pia_model *model)
{
    int good = model->directions == 2;
    for (int d = 0; d < 2 && good; d++)
        good = !pia_cad_is_closed(model, d) && !pia_cad_is_degenerate(model, d, 0) && !pia_cad_is_degenerate(model, d, 1);
    return good;
}

static void put_header(pia_output *output)
{
    pia_output_text(output, "ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION(('B-spline models'),'2;1');\n"
                            "FILE_NAME('','',(''),(''),'libpia','libpia','');\n"
                            "FILE_SCHEMA(('AUTOMOTIVE_DESIGN { 1 0 10303 214 1 1 1 1 }'));\nENDSEC;\nDATA;\n");
}

/* Units, tolerance, coordinate system; returns the context. *definition: the product's shape. */
static long long put_product(step *s, long long *definition)
{
    long long application = put(s, "APPLICATION_CONTEXT('core data for automotive mechanical design processes')");
    put(s, "APPLICATION_PROTOCOL_DEFINITION('international standard','automotive_design',2000,#%lld)", application);
    long long context = put(s, "PRODUCT_CONTEXT('',#%lld,'mechanical')", application);
    long long product = put(s, "PRODUCT('model','model','',(#%lld))", context);
    long long formation = put(s, "PRODUCT_DEFINITION_FORMATION('','',#%lld)", product);
    long long stage = put(s, "PRODUCT_DEFINITION_CONTEXT('part definition',#%lld,'design')", application);
    long long design = put(s, "PRODUCT_DEFINITION('design','',#%lld,#%lld)", formation, stage);
    *definition = put(s, "PRODUCT_DEFINITION_SHAPE('','',#%lld)", design);
    long long millimetre = put(s, "(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.))");
    long long radian = put(s, "(NAMED_UNIT(*)PLANE_ANGLE_UNIT()SI_UNIT($,.RADIAN.))");
    long long steradian = put(s, "(NAMED_UNIT(*)SI_UNIT($,.STERADIAN.)SOLID_ANGLE_UNIT())");
    long long uncertainty =
        put(s, "UNCERTAINTY_MEASURE_WITH_UNIT(LENGTH_MEASURE(1.E-07),#%lld,'distance_accuracy_value','')", millimetre);
    return put(
        s,
        "(GEOMETRIC_REPRESENTATION_CONTEXT(3)GLOBAL_UNCERTAINTY_ASSIGNED_CONTEXT((#%lld))GLOBAL_UNIT_ASSIGNED_CONTEXT((#%lld,#%lld,"
        "#%lld))REPRESENTATION_CONTEXT('',''))",
        uncertainty, millimetre, radian, steradian);
}

static long long put_axes(step *s)
{
    static const double origin[3] = {0, 0, 0}, z[3] = {0, 0, 1}, x[3] = {1, 0, 0};
    long long at = put_xyz(s, "CARTESIAN_POINT", origin), up = put_xyz(s, "DIRECTION", z), right = put_xyz(s, "DIRECTION", x);
    return put(s, "AXIS2_PLACEMENT_3D('',#%lld,#%lld,#%lld)", at, up, right);
}

static void put_list(step *s, const long long *item, pia_index count)
{
    pia_output_bytes(s->output, "(", 1);
    for (pia_index i = 0; i < count; i++) pia_output_text(s->output, i > 0 ? ",#%lld" : "#%lld", item[i]);
    pia_output_bytes(s->output, ")", 1);
}

/* Each model's geometry; item[i] is what represents it. */
static void put_items(step *s, const pia_model *const *models, pia_index count, int faces, long long *item)
{
    for (pia_index i = 0; i < count; i++) {
        long long points = put_points(s, models[i]);
        if (models[i]->directions == 1) {
            line l = line_of(models[i], 0, 0);
            l.closed = pia_cad_is_closed(models[i], 0);
            item[i] = put_curve(s, models[i], points, &l);
        } else {
            item[i] = put_surface(s, models[i], points);
            if (faces) item[i] = put_face(s, models[i], item[i], points);
        }
    }
}

static void put_representation(step *s, const long long *item, pia_index count, int faces, int curves)
{
    long long definition, context = put_product(s, &definition), axes = put_axes(s), set = 0;
    const char *kind = faces    ? "MANIFOLD_SURFACE_SHAPE_REPRESENTATION"
                       : curves ? "GEOMETRICALLY_BOUNDED_WIREFRAME_SHAPE_REPRESENTATION"
                                : "GEOMETRICALLY_BOUNDED_SURFACE_SHAPE_REPRESENTATION";
    if (!faces) {
        set = ++s->last;
        pia_output_text(s->output, "#%lld=%s('',", set, curves ? "GEOMETRIC_CURVE_SET" : "GEOMETRIC_SET");
        put_list(s, item, count);
        pia_output_text(s->output, ");\n");
    }
    long long shape = ++s->last;
    pia_output_text(s->output, "#%lld=%s('',", shape, kind);
    if (faces) {
        pia_output_text(s->output, "(#%lld,", axes);
        for (pia_index i = 0; i < count; i++) pia_output_text(s->output, i > 0 ? ",#%lld" : "#%lld", item[i]);
        pia_output_bytes(s->output, ")", 1);
    } else {
        pia_output_text(s->output, "(#%lld,#%lld)", axes, set);
    }
    pia_output_text(s->output, ",#%lld);\n", context);
    put(s, "SHAPE_DEFINITION_REPRESENTATION(#%lld,#%lld)", definition, shape);
}

static pia_status write_models(pia_context *context, pia_output *output, const pia_model *const *models, pia_index count,
                               pia_index samples)
{
    (void)samples;
    pia_status status = pia_cad_check(context, "STEP", models, count);
    if (status != PIA_OK) return status;
    long long *item = pia_take(context, count, sizeof *item);
    if (item == NULL) return PIA_E_MEMORY;
    int faces = count > 0, curves = 1;
    for (pia_index i = 0; i < count; i++) {
        faces &= has_faces(models[i]);
        curves &= models[i]->directions == 1;
    }
    step s = {output, 0};
    put_header(output);
    put_items(&s, models, count, faces, item);
    put_representation(&s, item, count, faces, curves);
    pia_output_text(output, "ENDSEC;\nEND-ISO-10303-21;\n");
    pia_give(context, item);
    return PIA_OK;
}

const pia_format pia_format_step = {
    .name = "step",
    .title = "STEP AP214 (ISO 10303-21)",
    .detail = "writes curves and surfaces, exact to the bit, in millimetres; several in a file",
    .extensions = "stp step",
    .write_models = write_models,
};
