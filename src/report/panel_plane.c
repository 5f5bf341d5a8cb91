#include "panel.h"

#include "frame.h"
#include "style.h"
#include "thin.h"

#include <math.h>

static const double tick = 6;      /* length of a knot mark */
static const double stretched = 8; /* extents further apart than this, of a curve that never turns back, get their own scales */
/* Function graphs and long signals fill the panel; shapes keep their proportions. */
static int has_free_aspect(const pia_scene *scene)
{
    double wide = scene->high[0] - scene->low[0], tall = scene->high[1] - scene->low[1];
    int extreme = wide > stretched * tall || tall > stretched * wide;
    for (pia_index f = 0; f < scene->figure_count; f++) {
        const pia_figure *figure = &scene->figure[f];
        if (figure->info.dim > 1 && !pia_figure_is_graph(figure) && !(extreme && pia_figure_is_monotone(figure))) return 0;
    }
    return 1;
}

double pia_plane_height(const pia_scene *scene, double width)
{
    double wide = scene->high[0] - scene->low[0], tall = scene->high[1] - scene->low[1];
    double aspect = wide > 0 ? fmin(0.95, fmax(0.24, 1.08 * tall / wide)) : tall > 0 ? 0.95 : 0.5;
    return (has_free_aspect(scene) ? 0.5 : aspect) * (width - PIA_FRAME_LEFT) + PIA_FRAME_BELOW;
}

static pia_frame frame_of(const pia_scene *scene, pia_box page)
{
    int values = scene->figure[0].info.dim == 1, free = has_free_aspect(scene);
    pia_frame frame = {.page = {page.left + PIA_FRAME_LEFT, page.top, page.right, page.bottom - PIA_FRAME_BELOW},
                       .name = {values ? "t" : "x", values ? "value" : "y"}};
    double size[2] = {scene->high[0] - scene->low[0], scene->high[1] - scene->low[1]}, larger = fmax(size[0], size[1]);
    for (int c = 0; c < 2; c++) {
        frame.low[c] = scene->low[c];
        frame.high[c] = scene->high[c];
        pia_range_widen(&frame.low[c], &frame.high[c], free ? size[c] : larger, free && c == 0 ? 0.02 : 0.05);
    }
    if (!free) pia_frame_equalise(&frame);
    return frame;
}

static void spots_of(const pia_frame *frame, const double *at, pia_index count, pia_spot *spots)
{
    for (pia_index i = 0; i < count; i++) spots[i] = pia_frame_spot(frame, at[3 * i], at[3 * i + 1]);
}

static void draw_control(pia_canvas *canvas, const pia_frame *frame, const pia_figure *figure, pia_spot *spots)
{
    pia_index count = figure->info.control[0];
    spots_of(frame, figure->control, count, spots);
    if (count > PIA_MOST_MARKS) {
        canvas->line(canvas, spots, pia_thin_line(spots, count, 0.25), pia_style_control);
        return;
    }
    canvas->line(canvas, spots, count, pia_style_control);
    for (pia_index i = 0; i < count; i++)
        pia_mark_draw(canvas, spots[i], PIA_MARK_SQUARE, count > 100 ? 2.4 : 3.4, pia_style_paper, pia_style_control);
}

static void draw_comb(pia_canvas *canvas, const pia_scene *scene, const pia_frame *frame, const pia_figure *figure, pia_spot *spots)
{
    for (pia_index i = 0; i < figure->tooth_count; i++) {
        const pia_tooth *tooth = &figure->tooth[i];
        double tip[3];
        pia_scene_tip(scene, tooth, tip);
        spots[i] = pia_frame_spot(frame, tip[0], tip[1]);
        canvas->line(canvas, (pia_spot[]){pia_frame_spot(frame, tooth->root[0], tooth->root[1]), spots[i]}, 2, pia_style_tooth);
    }
    canvas->line(canvas, spots, figure->tooth_count, pia_style_comb);
}

static void draw_curve(pia_canvas *canvas, const pia_scene *scene, const pia_frame *frame, pia_index index, pia_spot *spots)
{
    const pia_figure *figure = &scene->figure[index];
    pia_index count = figure->samples[0].count;
    spots_of(frame, figure->at, count, spots);
    count = pia_thin_line(spots, count, 0.2);
    canvas->line(canvas, spots, count, (pia_pen){pia_curve_colour(scene, index), pia_curve_width(figure), 0});
}

/* Knots as short strokes across the curve; of knots closer than two points on paper only the first is drawn. */
static void draw_knots(pia_canvas *canvas, const pia_frame *frame, const pia_figure *figure)
{
    const pia_samples *samples = &figure->samples[0];
    pia_spot last = {-1e9, -1e9};
    for (pia_index i = 0; i < samples->count; i++) {
        if (!samples->at_knot[i]) continue;
        const double *at = figure->at + 3 * i, *before = i > 0 ? at - 3 : at, *after = i + 1 < samples->count ? at + 3 : at;
        pia_spot spot = pia_frame_spot(frame, at[0], at[1]);
        if (hypot(spot.x - last.x, spot.y - last.y) < 2) continue;
        last = spot;
        pia_spot from = pia_frame_spot(frame, before[0], before[1]), to = pia_frame_spot(frame, after[0], after[1]);
        double along = hypot(to.x - from.x, to.y - from.y);
        if (!(along > 0)) continue;
        double across[2] = {-0.5 * tick * (to.y - from.y) / along, 0.5 * tick * (to.x - from.x) / along};
        canvas->line(canvas, (pia_spot[]){{spot.x - across[0], spot.y - across[1]}, {spot.x + across[0], spot.y + across[1]}}, 2,
                     (pia_pen){pia_style_text, 0.8, 0});
    }
}

static pia_status draw_points(pia_canvas *canvas, const pia_scene *scene, const pia_frame *frame, pia_spot *spots)
{
    pia_index *order = pia_take(scene->context, scene->point_count, sizeof *order), kept = 0;
    if (order == NULL) return PIA_E_MEMORY;
    double radius = pia_dot_radius(scene->point_count);
    spots_of(frame, scene->point, scene->point_count, spots);
    pia_status status = pia_thin_dots(scene->context, spots, scene->deviation, scene->point_count, &frame->page,
                                      scene->point_count > 5000 ? 1.9 * radius : 0.5 * radius, order, &kept);
    for (pia_index k = 0; k < kept; k++) {
        pia_colour colour = scene->deviation == NULL
                                ? pia_style_data
                                : pia_ramp_colour(PIA_RAMP_ERROR, scene->largest > 0 ? scene->deviation[order[k]] / scene->largest : 0);
        canvas->disc(canvas, spots[order[k]], radius, colour, (pia_pen){.width = 0});
    }
    pia_give(scene->context, order);
    return status;
}

static pia_status draw_layers(pia_canvas *canvas, const pia_scene *scene, const pia_frame *frame, pia_spot *spots)
{
    const pia_plot_options *show = &scene->options;
    pia_status status = PIA_OK;
    for (pia_index f = 0; show->control && f < scene->figure_count; f++) draw_control(canvas, frame, &scene->figure[f], spots);
    for (pia_index f = 0; f < scene->figure_count; f++) draw_comb(canvas, scene, frame, &scene->figure[f], spots);
    if (scene->point_count > 0 && scene->deviation == NULL) status = draw_points(canvas, scene, frame, spots);
    for (pia_index f = 0; f < scene->figure_count; f++) draw_curve(canvas, scene, frame, f, spots);
    for (pia_index f = 0; f < scene->figure_count; f++)
        if (pia_knots_shown(scene, &scene->figure[f])) draw_knots(canvas, frame, &scene->figure[f]);
    if (scene->deviation != NULL) status = draw_points(canvas, scene, frame, spots);
    return status;
}

/* All points and curves on the page; returns how many spots that makes. */
static pia_index find_busy(const pia_scene *scene, const pia_frame *frame, pia_spot *spots)
{
    pia_index count = scene->point_count;
    spots_of(frame, scene->point, count, spots);
    for (pia_index f = 0; f < scene->figure_count; f++) {
        spots_of(frame, scene->figure[f].at, scene->figure[f].samples[0].count, spots + count);
        count += scene->figure[f].samples[0].count;
    }
    return count;
}

pia_status pia_plane_draw(pia_canvas *canvas, const pia_scene *scene, pia_box page)
{
    pia_frame frame = frame_of(scene, page);
    pia_spot *spots = pia_take(scene->context, pia_spot_room(scene), sizeof *spots);
    if (spots == NULL) return PIA_E_MEMORY;
    pia_frame_draw(canvas, &frame);
    canvas->clip(canvas, &frame.page);
    pia_status status = draw_layers(canvas, scene, &frame, spots);
    canvas->clip(canvas, NULL);
    pia_worst_draw(canvas, scene, spots, find_busy(scene, &frame, spots), &frame.page);
    pia_give(scene->context, spots);
    return status;
}

void pia_plane_legend(const pia_scene *scene, pia_legend *legend)
{
    const pia_pen none = {.width = 0};
    const pia_figure *first = &scene->figure[0];
    if (scene->point_count > 0)
        pia_legend_add(legend, none, PIA_MARK_DISC, scene->deviation != NULL ? pia_ramp_colour(PIA_RAMP_ERROR, 0.4) : pia_style_data,
                       scene->deviation != NULL ? "data, by deviation" : "data");
    pia_curves_legend(scene, legend);
    if (pia_knots_shown(scene, first)) pia_legend_add(legend, none, PIA_MARK_TICK, pia_style_text, "knots");
    if (scene->options.control)
        pia_legend_add(legend, pia_style_control, first->info.control[0] > PIA_MOST_MARKS ? PIA_MARK_NONE : PIA_MARK_SQUARE,
                       pia_style_paper, "control polygon");
    pia_comb_legend(scene, legend);
}
