#include "step.h"

/* "(4,1,4),(0.,0.5,1.)": multiplicities, or the distinct values. */
static void put_runs(pia_step *s, const double *knots, pia_index count, int values)
{
    pia_output_bytes(s->output, "(", 1);
    for (pia_index i = 0, length; i < count; i += length) {
        length = pia_cad_run(knots, count, i);
        if (i > 0) pia_output_bytes(s->output, ",", 1);
        if (values)
            pia_step_real(s, knots[i]);
        else
            pia_output_text(s->output, "%lld", (long long)length);
    }
    pia_output_bytes(s->output, ")", 1);
}

pia_step_line pia_step_whole(const pia_model *curve)
{
    return (pia_step_line){0, 1, curve->control[0], curve->degree[0], pia_cad_is_closed_alike(curve, 0), curve->knots[0]};
}

static void put_weights(pia_step *s, const pia_model *model, const pia_step_line *l)
{
    double xyz[3], w;
    for (pia_index i = 0; i < l->count; i++) {
        pia_cad_point(model, l->first + i * l->stride, xyz, &w);
        if (i > 0) pia_output_bytes(s->output, ",", 1);
        pia_step_real(s, w);
    }
}

/* points: the instance of the model's first control point; the others follow in order. */
long long pia_step_curve(pia_step *s, const pia_model *model, long long points, const pia_step_line *l)
{
    pia_index knots = l->count + l->degree + 1;
    long long number = pia_step_begin(s);
    if (!model->rational) {
        pia_output_text(s->output, "B_SPLINE_CURVE_WITH_KNOTS('',%d,", l->degree);
        pia_step_references(s, points + (long long)l->first, l->count, l->stride);
        pia_output_text(s->output, ",.UNSPECIFIED.,%s,.F.,", pia_step_logical(l->closed));
        put_runs(s, l->knots, knots, 0);
        pia_output_bytes(s->output, ",", 1);
        put_runs(s, l->knots, knots, 1);
        pia_output_text(s->output, ",.UNSPECIFIED.);\n");
        return number;
    }
    pia_output_text(s->output, "(BOUNDED_CURVE()B_SPLINE_CURVE(%d,", l->degree);
    pia_step_references(s, points + (long long)l->first, l->count, l->stride);
    pia_output_text(s->output, ",.UNSPECIFIED.,%s,.F.)B_SPLINE_CURVE_WITH_KNOTS(", pia_step_logical(l->closed));
    put_runs(s, l->knots, knots, 0);
    pia_output_bytes(s->output, ",", 1);
    put_runs(s, l->knots, knots, 1);
    pia_output_text(s->output, ",.UNSPECIFIED.)CURVE()GEOMETRIC_REPRESENTATION_ITEM()RATIONAL_B_SPLINE_CURVE((");
    put_weights(s, model, l);
    pia_output_text(s->output, "))REPRESENTATION_ITEM(''));\n");
    return number;
}

static void put_surface_knots(pia_step *s, const pia_model *model)
{
    for (int values = 0; values < 2; values++)
        for (int d = 0; d < 2; d++) {
            put_runs(s, model->knots[d], model->control[d] + model->degree[d] + 1, values);
            pia_output_bytes(s->output, ",", 1);
        }
    pia_output_text(s->output, ".UNSPECIFIED.");
}

static void put_net(pia_step *s, const pia_model *model, long long points)
{
    pia_output_bytes(s->output, "(", 1);
    for (pia_index i = 0; i < model->control[0]; i++) {
        if (i > 0) pia_output_bytes(s->output, ",", 1);
        pia_step_references(s, points + (long long)(i * model->control[1]), model->control[1], 1);
    }
    pia_output_bytes(s->output, ")", 1);
}

long long pia_step_surface(pia_step *s, const pia_model *model, long long points)
{
    long long number = pia_step_begin(s);
    const char *u = pia_step_logical(pia_cad_is_closed_alike(model, 0)), *v = pia_step_logical(pia_cad_is_closed_alike(model, 1));
    if (!model->rational) {
        pia_output_text(s->output, "B_SPLINE_SURFACE_WITH_KNOTS('',%d,%d,", model->degree[0], model->degree[1]);
        put_net(s, model, points);
        pia_output_text(s->output, ",.UNSPECIFIED.,%s,%s,.F.,", u, v);
        put_surface_knots(s, model);
        pia_output_text(s->output, ");\n");
        return number;
    }
    pia_output_text(s->output, "(BOUNDED_SURFACE()B_SPLINE_SURFACE(%d,%d,", model->degree[0], model->degree[1]);
    put_net(s, model, points);
    pia_output_text(s->output, ",.UNSPECIFIED.,%s,%s,.F.)B_SPLINE_SURFACE_WITH_KNOTS(", u, v);
    put_surface_knots(s, model);
    pia_output_text(s->output, ")GEOMETRIC_REPRESENTATION_ITEM()RATIONAL_B_SPLINE_SURFACE((");
    for (pia_index i = 0; i < model->control[0]; i++) {
        pia_step_line row = {i * model->control[1], 1, model->control[1], 0, 0, NULL};
        pia_output_text(s->output, i > 0 ? ",(" : "(");
        put_weights(s, model, &row);
        pia_output_bytes(s->output, ")", 1);
    }
    pia_output_text(s->output, "))REPRESENTATION_ITEM('')SURFACE());\n");
    return number;
}

/* All control points, one instance each, in the order of the model. */
long long pia_step_points(pia_step *s, const pia_model *model)
{
    double xyz[3], w;
    long long first = s->last + 1;
    for (pia_index i = 0; i < model->control[0] * model->control[1]; i++) {
        pia_cad_point(model, i, xyz, &w);
        pia_step_coordinates(s, "CARTESIAN_POINT", xyz, 3);
    }
    return first;
}
