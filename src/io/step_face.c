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

/* The straight line between two points of the parameter plane, over [first, last]. */
static long long put_segment(pia_step *s, const double from[2], const double to[2], double first, double last, long long surface)
{
    if (s->plane == 0)
        s->plane =
            pia_step_put(s, "(GEOMETRIC_REPRESENTATION_CONTEXT(2)PARAMETRIC_REPRESENTATION_CONTEXT()REPRESENTATION_CONTEXT('',''))");
    long long a = pia_step_coordinates(s, "CARTESIAN_POINT", from, 2), b = pia_step_coordinates(s, "CARTESIAN_POINT", to, 2);
    long long line = pia_step_begin(s);
    pia_output_text(s->output, "B_SPLINE_CURVE_WITH_KNOTS('',1,(#%lld,#%lld),.UNSPECIFIED.,.F.,.F.,(2,2),(", a, b);
    pia_step_real(s, first);
    pia_output_bytes(s->output, ",", 1);
    pia_step_real(s, last);
    pia_output_text(s->output, "),.UNSPECIFIED.);\n");
    long long definition = pia_step_put(s, "DEFINITIONAL_REPRESENTATION('',(#%lld),#%lld)", line, s->plane);
    return pia_step_put(s, "PCURVE('',#%lld,#%lld)", surface, definition);
}

/* ---- the whole surface ---- */

/* The border, counter-clockwise: v first forth, u last forth, v last back, u first back. Side k ends at corner k + 1. */
static const struct {
    int along, last, back;
} side[4] = {{0, 0, 0}, {1, 1, 0}, {0, 1, 1}, {1, 0, 1}};

static pia_step_line side_line(const pia_model *model, int k)
{
    int along = side[k].along;
    pia_index columns = model->control[1], stride = along == 0 ? columns : 1, across = along == 0 ? 1 : columns;
    pia_index first = side[k].last ? (model->control[1 - along] - 1) * across : 0;
    return (pia_step_line){first, stride, model->control[along], model->degree[along], 0, model->knots[along]};
}

static double end_of(const pia_model *model, int d, int last)
{
    return model->knots[d][last ? model->control[d] : model->degree[d]];
}

/* A side in the parameter plane, forth. */
static long long put_side_segment(pia_step *s, const pia_model *model, int k, long long surface)
{
    int d = side[k].along;
    double from[2], to[2], first = end_of(model, d, 0), last = end_of(model, d, 1);
    from[1 - d] = to[1 - d] = end_of(model, 1 - d, side[k].last);
    from[d] = first;
    to[d] = last;
    return put_segment(s, from, to, first, last, surface);
}

/* What is known of the border of a surface. */
typedef struct border {
    int shrunk[4]; /* the side is a point */
    int seam[2];   /* sides k and k + 2 are one edge */
    int corner[4]; /* the first of the corners that are the same point */
} border;

static void join(border *b, int i, int j)
{
    int low = b->corner[i] < b->corner[j] ? b->corner[i] : b->corner[j], high = b->corner[i] + b->corner[j] - low;
    for (int k = 0; k < 4; k++)
        if (b->corner[k] == high) b->corner[k] = low;
}

static border border_of(const pia_model *model)
{
    border b = {.corner = {0, 1, 2, 3}};
    for (int k = 0; k < 4; k++) b.shrunk[k] = pia_cad_is_degenerate(model, side[k].along, side[k].last);
    for (int k = 0; k < 2; k++) b.seam[k] = pia_cad_is_closed_alike(model, 1 - side[k].along) && !b.shrunk[k] && !b.shrunk[k + 2];
    for (int k = 0; k < 4; k++)
        if (b.shrunk[k]) join(&b, k, (k + 1) % 4);
    if (b.seam[0]) join(&b, 0, 3), join(&b, 1, 2);
    if (b.seam[1]) join(&b, 0, 1), join(&b, 3, 2);
    return b;
}

int pia_step_has_edges(const pia_model *surface)
{
    border b = border_of(surface);
    return 4 - b.shrunk[0] - b.shrunk[1] - b.shrunk[2] - b.shrunk[3] >= 2;
}

static long long put_side(pia_step *s, const pia_model *model, int k, const border *b, const long long vertex[4], long long points,
                          long long surface)
{
    pia_step_line l = side_line(model, k);
    long long curve = pia_step_curve(s, model, points, &l), plane[2];
    int seam = k < 2 && b->seam[k], from = side[k].back ? (k + 1) % 4 : k, to = side[k].back ? k : (k + 1) % 4;
    for (int i = 0; i <= seam; i++) plane[i] = put_side_segment(s, model, k + 2 * i, surface);
    long long both = pia_step_begin(s);
    pia_output_text(s->output, "%s_CURVE('',#%lld,", seam ? "SEAM" : "SURFACE", curve);
    pia_step_list(s, plane, 1 + seam);
    pia_output_text(s->output, ",.CURVE_3D.);\n");
    return pia_step_put(s, "EDGE_CURVE('',#%lld,#%lld,#%lld,.T.)", vertex[b->corner[from]], vertex[b->corner[to]], both);
}

/* Sides that are points have no edge, sides of a seam share theirs. */
static long long put_border(pia_step *s, const pia_model *model, long long points, long long surface)
{
    border b = border_of(model);
    pia_index rows = model->control[0], columns = model->control[1], count = 0;
    const pia_index corner[4] = {0, (rows - 1) * columns, rows * columns - 1, columns - 1};
    long long vertex[4] = {0}, edge[4], oriented[4];
    for (int k = 0; k < 4; k++)
        if (b.corner[k] == k) vertex[k] = pia_step_put(s, "VERTEX_POINT('',#%lld)", points + (long long)corner[k]);
    for (int k = 0; k < 4; k++) {
        if (b.shrunk[k]) continue;
        edge[k] = k >= 2 && b.seam[k - 2] ? edge[k - 2] : put_side(s, model, k, &b, vertex, points, surface);
        oriented[count++] = pia_step_put(s, "ORIENTED_EDGE('',*,*,#%lld,%s)", edge[k], pia_step_logical(!side[k].back));
    }
    return put_bound(s, oriented, count, 1);
}

/* ---- trim loops ---- */

static long long put_loop(pia_step *s, const pia_cad_edge *edges, pia_index count, long long surface, int outer, long long *number)
{
    long long *vertex = number, *oriented = number + count;
    long long *points = oriented; /* until the edges are written */
    for (pia_index k = 0; k < count; k++) points[k] = pia_step_points(s, edges[k].curve);
    for (pia_index k = 0; k < count; k++) vertex[k] = pia_step_put(s, "VERTEX_POINT('',#%lld)", points[k]);
    for (pia_index k = 0; k < count; k++) {
        pia_step_line whole = pia_step_whole(edges[k].curve);
        long long curve = pia_step_curve(s, edges[k].curve, points[k], &whole);
        long long segment = put_segment(s, edges[k].from, edges[k].to, 0, 1, surface);
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
        long long whole = put_border(s, model, points, surface);
        *shell = put_shell(s, &whole, 1, surface);
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
