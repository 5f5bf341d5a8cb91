#include "panel.h"

#include "frame.h"
#include "patch.h"
#include "style.h"
#include "thin.h"

#include <math.h>
#include <stdio.h>

enum { MOST_NET = 600, MOST_DOTS_ON_SURFACE = 3000 };

static int all_terrain(const pia_scene *scene)
{
    for (pia_index f = 0; f < scene->figure_count; f++)
        if (scene->figure[f].info.directions != 2 || !pia_figure_is_terrain(&scene->figure[f])) return 0;
    return 1;
}

/* The nearest number of one significant figure. */
static double round_factor(double factor)
{
    double power = pow(10, floor(log10(factor)));
    return power * round(factor / power);
}

/* Heights over a plane are often small or of another unit than the plane: they, and a plane of very uneven sides, are drawn in round
 * multiples. All other shapes keep their proportions. */
static void choose_stretch(const pia_scene *scene, pia_view *view)
{
    double size[3];
    for (int c = 0; c < 3; c++) {
        view->stretch[c] = 1;
        size[c] = scene->high[c] - scene->low[c];
    }
    if (!all_terrain(scene)) return;
    double uneven = size[1] / size[0];
    if (uneven > 8 || uneven < 0.125) view->stretch[1] = round_factor(0.7 / uneven);
    double plane = fmax(size[0], view->stretch[1] * size[1]), ratio = size[2] / plane;
    if (size[2] > 0 && (ratio < 0.2 || ratio > 1.2)) view->stretch[2] = round_factor((ratio < 0.2 ? 0.35 : 0.6) / ratio);
}

static pia_view view_of(const pia_scene *scene)
{
    pia_view view = {.scale = 1};
    double largest = 0;
    for (int c = 0; c < 3; c++) largest = fmax(largest, scene->high[c] - scene->low[c]);
    for (int c = 0; c < 3; c++) {
        double size = scene->high[c] - scene->low[c];
        view.low[c] = scene->low[c];
        view.high[c] = scene->high[c];
        int flat = !(size > 1e-6 * largest);
        pia_range_widen(&view.low[c], &view.high[c], flat ? largest : size, flat ? 0.05 : 0.02);
    }
    choose_stretch(scene, &view);
    pia_view_aim(&view, scene->options.azimuth, scene->options.elevation);
    return view;
}

double pia_space_height(const pia_scene *scene, double width)
{
    pia_view view = view_of(scene);
    return fmin(0.95 * width, fmax(0.45 * width, pia_view_height(&view, width)));
}

static pia_paint paint_of(const pia_scene *scene)
{
    if (scene->deviation != NULL) return PIA_PAINT_DEVIATION;
    return all_terrain(scene) && scene->figure_count == 1 && scene->high[2] > scene->low[2] ? PIA_PAINT_HEIGHT : PIA_PAINT_PLAIN;
}

static int net_shown(const pia_scene *scene, const pia_figure *figure)
{
    int small = figure->info.directions == 1 || figure->info.control[0] * figure->info.control[1] <= MOST_NET;
    return scene->options.control && small && figure->outside == NULL; /* a net goes on where a trimmed surface has ended */
}

/* A polyline in strokes of at least one point on paper. */
static void add_polyline(pia_pieces *pieces, const double *at, pia_index count, double width, pia_colour colour)
{
    const double *from = at;
    for (pia_index i = 1; i < count; i++) {
        const double *const ends[2] = {from, at + 3 * i};
        pia_spot a = pia_view_spot(pieces->view, ends[0]), b = pia_view_spot(pieces->view, ends[1]);
        if (hypot(b.x - a.x, b.y - a.y) < 1 && i + 1 < count) continue;
        pia_piece_add(pieces, ends, 2, width, 0, colour);
        from = ends[1];
    }
}

static void add_knots(pia_pieces *pieces, const pia_figure *figure)
{
    pia_spot last = {-1e9, -1e9};
    for (pia_index i = 0; i < figure->samples[0].count; i++) {
        const double *const at[1] = {figure->at + 3 * i};
        pia_spot spot = pia_view_spot(pieces->view, at[0]);
        if (!figure->samples[0].at_knot[i] || hypot(spot.x - last.x, spot.y - last.y) < 3) continue;
        pia_piece_add(pieces, at, 1, 1.5, 0, pia_style_text);
        last = spot;
    }
}

static void add_comb(pia_pieces *pieces, const pia_scene *scene, const pia_figure *figure)
{
    double last[3] = {0}, tip[3];
    for (pia_index i = 0; i < figure->tooth_count; i++) {
        pia_scene_tip(scene, &figure->tooth[i], tip);
        const double *const tooth[2] = {figure->tooth[i].root, tip}, *const envelope[2] = {last, tip};
        pia_piece_add(pieces, tooth, 2, 0.5, 0, pia_style_tooth.colour);
        if (i > 0) pia_piece_add(pieces, envelope, 2, 0.9, 0, pia_style_comb.colour);
        for (int c = 0; c < 3; c++) last[c] = tip[c];
    }
}

static void add_curve(pia_pieces *pieces, const pia_scene *scene, pia_index index)
{
    const pia_figure *figure = &scene->figure[index];
    if (net_shown(scene, figure)) {
        add_polyline(pieces, figure->control, figure->info.control[0], 0.6, pia_style_control.colour);
        for (pia_index i = 0; figure->info.control[0] <= PIA_MOST_MARKS && i < figure->info.control[0]; i++)
            pia_piece_add(pieces, (const double *const[]){figure->control + 3 * i}, 1, 1.5, 0, pia_style_control.colour);
    }
    add_comb(pieces, scene, figure);
    add_polyline(pieces, figure->at, figure->samples[0].count, pia_curve_width(figure), pia_curve_colour(scene, index));
    if (pia_knots_shown(scene, figure)) add_knots(pieces, figure);
}

/* Where a curve stands over the floor: without it a line in space cannot be read. */
static void draw_shadow(pia_canvas *canvas, const pia_view *view, const pia_figure *curve, pia_spot *spots)
{
    for (pia_index i = 0; i < curve->samples[0].count; i++) {
        const double floor_at[3] = {curve->at[3 * i], curve->at[3 * i + 1], view->low[2]};
        spots[i] = pia_view_spot(view, floor_at);
    }
    canvas->line(canvas, spots, pia_thin_line(spots, curve->samples[0].count, 0.25), (pia_pen){pia_colour_grey(0.8), 1, 0});
}

static void project(const pia_view *view, const double *at, pia_index count, pia_spot *spots)
{
    for (pia_index i = 0; i < count; i++) spots[i] = pia_view_spot(view, at + 3 * i);
}

/* All points and curves on the page; returns how many spots a label had better leave visible. A surface may be covered a little. */
static pia_index find_busy(const pia_scene *scene, const pia_view *view, pia_spot *spots)
{
    pia_index count = scene->point_count;
    project(view, scene->point, count, spots);
    for (pia_index f = 0; f < scene->figure_count; f++) {
        if (scene->figure[f].info.directions == 2) continue;
        project(view, scene->figure[f].at, scene->figure[f].samples[0].count, spots + count);
        count += scene->figure[f].samples[0].count;
    }
    return scene->surface ? 0 : count;
}

/* On a surface many dots would hide its colours. */
static int dots_shown(const pia_scene *scene)
{
    return scene->point_count > 0 && (!scene->surface || scene->point_count <= MOST_DOTS_ON_SURFACE);
}

static void add_dots(pia_pieces *pieces, const pia_scene *scene, const pia_index *order, pia_index count)
{
    double radius = scene->surface ? 0.8 : pia_dot_radius(scene->point_count);
    int coloured = scene->deviation != NULL && !scene->surface;
    double lift = radius / pieces->view->scale;
    for (pia_index k = 0; k < count; k++) {
        double share = coloured && scene->largest > 0 ? scene->deviation[order[k]] / scene->largest : 0;
        pia_piece_add(pieces, (const double *const[]){scene->point + 3 * order[k]}, 1, radius, lift,
                      coloured ? pia_ramp_colour(PIA_RAMP_ERROR, share) : pia_style_data);
    }
}

static pia_status add_points(pia_pieces *pieces, const pia_scene *scene, const pia_box *page, pia_spot *spots)
{
    pia_index count = scene->point_count, kept = 0;
    pia_index *order = pia_take(scene->context, count, sizeof *order);
    if (order == NULL) return PIA_E_MEMORY;
    project(pieces->view, scene->point, count, spots);
    pia_status status = pia_thin_dots(scene->context, spots, scene->deviation, count, page, count > 5000 ? 2 : 0.5, order, &kept);
    if (status == PIA_OK) add_dots(pieces, scene, order, kept);
    pia_give(scene->context, order);
    return status;
}

static pia_status add_all(pia_pieces *pieces, const pia_scene *scene, const pia_box *page, pia_spot *spots)
{
    pia_status status = PIA_OK;
    for (pia_index f = 0; status == PIA_OK && f < scene->figure_count; f++) {
        if (scene->figure[f].info.directions == 1)
            add_curve(pieces, scene, f);
        else
            status = pia_patch_add(pieces, scene, f, paint_of(scene), net_shown(scene, &scene->figure[f]));
    }
    if (status == PIA_OK && dots_shown(scene)) status = add_points(pieces, scene, page, spots);
    return status == PIA_OK && pieces->failed
               ? pia_fail(scene->context, PIA_E_MEMORY, "out of memory for %lld pieces of a picture", (long long)pieces->count)
               : status;
}

/* Says which directions are not drawn to the scale of x. */
static void draw_note(pia_canvas *canvas, const pia_view *view, const pia_box *page)
{
    static const char *const name[] = {"x", "y", "z"};
    char text[3 * PIA_LABEL_SIZE], factor[PIA_LABEL_SIZE];
    int length = 0;
    for (int c = 1; c < 3; c++) {
        if (view->stretch[c] == 1) continue;
        pia_label_significant(view->stretch[c], 1, factor);
        length += snprintf(text + length, PIA_LABEL_SIZE, "%s%s drawn \u00d7 %s", length > 0 ? ", " : "", name[c], factor);
    }
    if (length > 0)
        canvas->text(canvas, (pia_spot){page->right, page->bottom - 2}, text,
                     (pia_type){.size = PIA_TEXT_SIZE, .colour = pia_style_text, .across = 1, .down = 1});
}

pia_status pia_space_draw(pia_canvas *canvas, const pia_scene *scene, pia_box page)
{
    pia_view view = view_of(scene);
    pia_view_fit(&view, &page);
    pia_spot *spots = pia_take(scene->context, pia_spot_room(scene), sizeof *spots);
    if (spots == NULL) return PIA_E_MEMORY;
    pia_pieces pieces = {.memory = pia_memory_of(scene->context), .view = &view};
    int values = scene->figure[0].info.dim == 1 && scene->figure[0].info.directions == 2;
    pia_view_draw_box(canvas, &view, values ? (const char *const[]){"u", "v", "value"} : (const char *const[]){"x", "y", "z"});
    for (pia_index f = 0; view.toward[2] > 0 && f < scene->figure_count; f++)
        if (scene->figure[f].info.directions == 1) draw_shadow(canvas, &view, &scene->figure[f], spots);
    pia_status status = add_all(&pieces, scene, &page, spots);
    if (status == PIA_OK) pia_pieces_draw(canvas, &pieces);
    pia_pieces_clear(&pieces);
    pia_worst_draw(canvas, scene, spots, find_busy(scene, &view, spots), &page);
    pia_give(scene->context, spots);
    draw_note(canvas, &view, &page);
    return status;
}

pia_shade pia_space_shade(const pia_scene *scene)
{
    if (!scene->surface || paint_of(scene) != PIA_PAINT_HEIGHT) return (pia_shade){0};
    return (pia_shade){1, PIA_RAMP_HEIGHT, scene->low[2], scene->high[2], scene->figure[0].info.dim == 1 ? "value" : "height z"};
}

static void surface_legend(const pia_scene *scene, pia_legend *legend)
{
    const pia_pen none = {.width = 0};
    const pia_figure *figure = &scene->figure[0];
    pia_paint paint = paint_of(scene);
    pia_colour fill = paint == PIA_PAINT_PLAIN    ? pia_colour_lit(pia_colour_cycle(0), 1.45)
                      : paint == PIA_PAINT_HEIGHT ? pia_ramp_colour(PIA_RAMP_HEIGHT, 0.6)
                                                  : pia_ramp_colour(PIA_RAMP_ERROR, 0.25);
    pia_legend_add(legend, none, PIA_MARK_PATCH, fill,
                   paint == PIA_PAINT_DEVIATION ? "surface, by deviation of the data"
                   : paint == PIA_PAINT_HEIGHT  ? "surface, by height"
                                                : "surface");
    if (!scene->options.knots || figure->info.directions == 1) return;
    pia_index stride[2] = {pia_patch_knot_stride(figure, 0), pia_patch_knot_stride(figure, 1)};
    pia_index larger = stride[0] > stride[1] ? stride[0] : stride[1];
    pia_pen pen = {pia_colour_grey(0.35), 0.6, 0};
    if (larger > 1)
        pia_legend_add(legend, pen, PIA_MARK_NONE, pia_style_text, "knot lines (1 in %lld)", (long long)larger);
    else
        pia_legend_add(legend, pen, PIA_MARK_NONE, pia_style_text, "knot lines");
}

static void curve_legend(const pia_scene *scene, pia_legend *legend)
{
    pia_curves_legend(scene, legend);
    pia_legend_add(legend, (pia_pen){pia_colour_grey(0.8), 1, 0}, PIA_MARK_NONE, pia_style_text,
                   scene->figure_count > 1 ? "their shadows" : "its shadow");
    if (pia_knots_shown(scene, &scene->figure[0]))
        pia_legend_add(legend, (pia_pen){.width = 0}, PIA_MARK_DISC, pia_style_text, "knots");
}

void pia_space_legend(const pia_scene *scene, pia_legend *legend)
{
    int coloured = scene->deviation != NULL && !scene->surface;
    if (dots_shown(scene))
        pia_legend_add(legend, (pia_pen){.width = 0}, PIA_MARK_DISC, coloured ? pia_ramp_colour(PIA_RAMP_ERROR, 0.4) : pia_style_data,
                       coloured ? "data, by deviation" : "data");
    if (scene->surface)
        surface_legend(scene, legend);
    else
        curve_legend(scene, legend);
    if (net_shown(scene, &scene->figure[0]))
        pia_legend_add(legend, pia_style_control, scene->surface ? PIA_MARK_NONE : PIA_MARK_DISC, pia_style_control.colour,
                       scene->surface ? "control net" : "control polygon");
    pia_comb_legend(scene, legend);
}
