#include "step.h"

#include "cad_loop.h"

/* What every face becomes: bounded, on its surface, in a shell of its own. */
static long long put_shell(pia_step *s, const long long *bound, pia_index bounds, long long surface)
{
    long long face = pia_step_begin(s);
    pia_output_text(s->output, "ADVANCED_FACE('',");
    pia_step_list(s, bound, bounds);
    pia_output_text(s->output, ",#%lld,.T.);\n", surface);
    long long shell = pia_step_put(s, "OPEN_SHELL('',(#%lld))", face);
    return pia_step_put(s, "SHELL_BASED_SURFACE_MODEL('',(#%lld))", shell);
}

static long long put_bound(pia_step *s, const long long *oriented, pia_index count, int outer)
{
    long long loop = pia_step_begin(s);
    pia_output_text(s->output, "EDGE_LOOP('',");
    pia_step_list(s, oriented, count);
    pia_output_text(s->output, ");\n");
    return pia_step_put(s, "FACE_%sBOUND('',#%lld,.T.)", outer ? "OUTER_" : "", loop);
}

/* ---- the whole surface ---- */

static pia_step_line edge_line(const pia_model *model, int along, int last)
{
    pia_index columns = model->control[1], stride = along == 0 ? columns : 1, across = along == 0 ? 1 : columns;
    pia_index first = last ? (model->control[1 - along] - 1) * across : 0;
    return (pia_step_line){first, stride, model->control[along], model->degree[along], 0, model->knots[along]};
}

/* The four edges, counter-clockwise seen along the normal: v = 0 forth, u = 1 forth, v = 1 back, u = 0 back. */
static long long put_border(pia_step *s, const pia_model *model, long long points)
{
    static const struct {
        int along, last, back;
    } side[4] = {{0, 0, 0}, {1, 1, 0}, {0, 1, 1}, {1, 0, 1}};
    pia_index rows = model->control[0], columns = model->control[1];
    pia_index corner[4] = {0, (rows - 1) * columns, rows * columns - 1, columns - 1};
    long long vertex[4], oriented[4];
    for (int k = 0; k < 4; k++) vertex[k] = pia_step_put(s, "VERTEX_POINT('',#%lld)", points + (long long)corner[k]);
    for (int k = 0; k < 4; k++) {
        pia_step_line l = edge_line(model, side[k].along, side[k].last);
        long long curve = pia_step_curve(s, model, points, &l);
        long long from = vertex[side[k].back ? (k + 1) % 4 : k], to = vertex[side[k].back ? k : (k + 1) % 4];
        long long edge = pia_step_put(s, "EDGE_CURVE('',#%lld,#%lld,#%lld,.T.)", from, to, curve);
        oriented[k] = pia_step_put(s, "ORIENTED_EDGE('',*,*,#%lld,%s)", edge, pia_step_logical(!side[k].back));
    }
    return put_bound(s, oriented, 4, 1);
}

int pia_step_has_edges(const pia_model *surface)
{
    for (int d = 0; d < 2; d++)
        if (pia_cad_is_closed(surface, d) || pia_cad_is_degenerate(surface, d, 0) || pia_cad_is_degenerate(surface, d, 1)) return 0;
    return 1;
}

/* ---- trim loops ---- */

/* The segment in the parameter plane, over [0, 1] as its image is. */
static long long put_segment(pia_step *s, const pia_cad_edge *edge, long long surface)
{
    if (s->plane == 0)
        s->plane =
            pia_step_put(s, "(GEOMETRIC_REPRESENTATION_CONTEXT(2)PARAMETRIC_REPRESENTATION_CONTEXT()REPRESENTATION_CONTEXT('',''))");
    long long from = pia_step_coordinates(s, "CARTESIAN_POINT", edge->from, 2),
              to = pia_step_coordinates(s, "CARTESIAN_POINT", edge->to, 2);
    long long line =
        pia_step_put(s, "B_SPLINE_CURVE_WITH_KNOTS('',1,(#%lld,#%lld),.UNSPECIFIED.,.F.,.F.,(2,2),(0.,1.),.UNSPECIFIED.)", from, to);
    long long definition = pia_step_put(s, "DEFINITIONAL_REPRESENTATION('',(#%lld),#%lld)", line, s->plane);
    return pia_step_put(s, "PCURVE('',#%lld,#%lld)", surface, definition);
}

static long long put_loop(pia_step *s, const pia_cad_edge *edges, pia_index count, long long surface, int outer, long long *number)
{
    long long *vertex = number, *oriented = number + count;
    long long *points = oriented; /* until the edges are written */
    for (pia_index k = 0; k < count; k++) points[k] = pia_step_points(s, edges[k].curve);
    for (pia_index k = 0; k < count; k++) vertex[k] = pia_step_put(s, "VERTEX_POINT('',#%lld)", points[k]);
    for (pia_index k = 0; k < count; k++) {
        pia_step_line whole = pia_step_whole(edges[k].curve);
        long long curve = pia_step_curve(s, edges[k].curve, points[k], &whole);
        long long segment = put_segment(s, &edges[k], surface);
        long long both = pia_step_put(s, "SURFACE_CURVE('',#%lld,(#%lld),.CURVE_3D.)", curve, segment);
        long long edge = pia_step_put(s, "EDGE_CURVE('',#%lld,#%lld,#%lld,.T.)", vertex[k], vertex[(k + 1) % count], both);
        oriented[k] = pia_step_put(s, "ORIENTED_EDGE('',*,*,#%lld,.T.)", edge);
    }
    return put_bound(s, oriented, count, outer);
}

static pia_status put_trim_loop(pia_context *context, pia_step *s, const pia_model *model, pia_index loop, long long surface,
                                long long *bound)
{
    pia_cad_edge *edges;
    pia_index count;
    pia_status status = pia_cad_loop(context, model, loop, &edges, &count);
    if (status != PIA_OK) return status;
    long long *number = pia_take(context, count, 2 * sizeof *number);
    if (number == NULL)
        status = pia_take_status(context, count, 2 * sizeof *number);
    else
        *bound = put_loop(s, edges, count, surface, loop == 0, number);
    pia_give(context, number);
    pia_cad_loop_destroy(context, edges, count);
    return status;
}

pia_status pia_step_shell(pia_context *context, pia_step *s, const pia_model *model, long long surface, long long points,
                          long long *shell)
{
    pia_index loops = pia_model_trim_loop_count(model);
    if (loops == 0) {
        long long border = put_border(s, model, points);
        *shell = put_shell(s, &border, 1, surface);
        return PIA_OK;
    }
    long long *bound = pia_take(context, loops, sizeof *bound);
    if (bound == NULL) return pia_take_status(context, loops, sizeof *bound);
    pia_status status = PIA_OK;
    for (pia_index l = 0; l < loops && status == PIA_OK; l++) status = put_trim_loop(context, s, model, l, surface, &bound[l]);
    if (status == PIA_OK) *shell = put_shell(s, bound, loops, surface);
    pia_give(context, bound);
    return status;
}
