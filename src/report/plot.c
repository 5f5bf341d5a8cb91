/* A picture from top to bottom: title, one line of numbers, legend, main panel with its colour scale, convergence panel. */
#include "frame.h"
#include "options.h"
#include "panel.h"
#include "style.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

enum { USUAL_WIDTH = 640, LEAST_SIDE = 100, LEAST_PANEL = 25, MOST_SIDE = 20000, TRACE_HEIGHT = 170, HEAD_ROW = 16 };
enum { VECTOR_CELLS = 90, PIXEL_CELLS = 200 }; /* samples a direction of a surface */
static const double usual_pixels = 2;          /* a point, of a PNG */

void pia_plot_options_init(pia_plot_options *options)
{
    *options =
        (pia_plot_options){.struct_size = sizeof *options, .control = 1, .knots = 1, .deviation = 1, .azimuth = -60, .elevation = 30};
}

/* The name of the format asked for, by the extension where none is. */
static const char *wanted_format(const char *path, const char *name)
{
    const char *dot = strrchr(path, '.');
    return name != NULL ? name : dot != NULL ? dot + 1 : "";
}

static pia_status find_format(pia_context *context, const char *path, const char *name, pia_picture *out)
{
    static const struct {
        const char *name;
        pia_picture picture;
    } known[] = {{"svg", PIA_PICTURE_SVG}, {"png", PIA_PICTURE_PNG}, {"pdf", PIA_PICTURE_PDF}};
    const char *wanted = wanted_format(path, name);
    for (size_t i = 0; i < sizeof known / sizeof *known; i++) {
        if (strcasecmp(wanted, known[i].name) != 0) continue;
        *out = known[i].picture;
        return PIA_OK;
    }
    return pia_fail(context, PIA_E_ARGUMENT, "\"%s\" is no picture format for %s; use svg, png, pdf or html", wanted, path);
}

static int valid_side(double side)
{
    return side == 0 || (side >= LEAST_SIDE && side <= MOST_SIDE);
}

static pia_status check(pia_context *context, const pia_model *const *models, pia_index model_count, const double *points,
                        pia_index count, const pia_plot_options *o)
{
    if (models == NULL || model_count < 1) return pia_fail(context, PIA_E_ARGUMENT, "no model to draw; give at least one");
    for (pia_index i = 0; i < model_count; i++)
        if (models[i] == NULL) return pia_fail(context, PIA_E_ARGUMENT, "model %lld is NULL", (long long)i);
    if (count < 0 || (points == NULL && count > 0))
        return pia_fail(context, PIA_E_ARGUMENT, "%lld points, but no array; give both or neither", (long long)count);
    if (!valid_side(o->width) || !valid_side(o->height))
        return pia_fail(context, PIA_E_ARGUMENT, "a picture of %g by %g; each side is 0 (chosen) or %d to %d", o->width, o->height,
                        LEAST_SIDE, MOST_SIDE);
    if (!isfinite(o->azimuth) || !(fabs(o->elevation) <= 90))
        return pia_fail(context, PIA_E_ARGUMENT, "azimuth %g, elevation %g; give degrees, elevation -90 to 90", o->azimuth,
                        o->elevation);
    if (o->trace_count < 0 || (o->trace == NULL && o->trace_count > 0))
        return pia_fail(context, PIA_E_ARGUMENT, "%lld rows of a trace, but no array", (long long)o->trace_count);
    return PIA_OK;
}

/* "269 points · 24 control points · degree 3 · max deviation 1.2×10⁻³, rms 3.4×10⁻⁴ at closest points" */
static void describe(const pia_scene *scene, char *text, size_t size)
{
    const pia_model_info *info = &scene->figure[0].info;
    size_t used = 0;
    text[0] = '\0';
    if (scene->point_count > 0) used += (size_t)snprintf(text, size, "%lld points \u00b7 ", (long long)scene->point_count);
    if (scene->figure_count > 1)
        used += (size_t)snprintf(text + used, size - used, "%lld models", (long long)scene->figure_count);
    else if (info->directions == 2)
        used += (size_t)snprintf(text + used, size - used, "%lld \u00d7 %lld control points \u00b7 degree %d \u00d7 %d",
                                 (long long)info->control[0], (long long)info->control[1], info->degree[0], info->degree[1]);
    else
        used += (size_t)snprintf(text + used, size - used, "%lld control points \u00b7 degree %d", (long long)info->control[0],
                                 info->degree[0]);
    if (scene->deviation == NULL) return;
    char largest[PIA_LABEL_SIZE], rms[PIA_LABEL_SIZE];
    pia_label_significant(scene->largest, 3, largest);
    pia_label_significant(scene->rms, 3, rms);
    snprintf(text + used, size - used, " \u00b7 max deviation %s, rms %s at %s", largest, rms,
             scene->parametric ? "given parameters" : "closest points");
}

static pia_shade shade_of(const pia_scene *scene)
{
    if (scene->deviation != NULL && scene->largest > 0)
        return (pia_shade){1, PIA_RAMP_ERROR, 0, scene->largest, "deviation, units of the data"};
    return scene->space ? pia_space_shade(scene) : (pia_shade){0};
}

/* Height of a page whose main panel has the shape that suits the scene. */
static double page_height(const pia_scene *scene, double width)
{
    double panel = width - 2 * PIA_MARGIN - (shade_of(scene).shown ? PIA_SCALE_ROOM : 0);
    double head = 2 * PIA_MARGIN + (scene->options.title != NULL ? HEAD_ROW + 6 : 0) + 3 * HEAD_ROW;
    double body = scene->space ? pia_space_height(scene, panel) : pia_plane_height(scene, panel);
    return ceil(head + body + (scene->options.trace_count > 0 ? TRACE_HEIGHT : 0));
}

/* Title, numbers, legend; returns where the panels may begin. */
static double draw_head(pia_canvas *canvas, const pia_scene *scene)
{
    char text[512];
    double y = PIA_MARGIN, left = PIA_MARGIN, room = canvas->width - 2 * PIA_MARGIN;
    if (scene->options.title != NULL && scene->options.title[0] != '\0') {
        canvas->text(canvas, (pia_spot){left, y}, scene->options.title,
                     (pia_type){.size = PIA_TITLE_SIZE, .colour = pia_style_text, .bold = 1, .room = room});
        y += HEAD_ROW + 5;
    }
    describe(scene, text, sizeof text);
    canvas->text(canvas, (pia_spot){left, y}, text, (pia_type){.size = PIA_TEXT_SIZE, .colour = pia_style_axis.colour, .room = room});
    y += HEAD_ROW;
    pia_legend legend = {.count = 0};
    if (scene->space)
        pia_space_legend(scene, &legend);
    else
        pia_plane_legend(scene, &legend);
    return y + pia_legend_draw(canvas, &legend, left, canvas->width - PIA_MARGIN, y) + 8;
}

static pia_status draw_page(pia_canvas *canvas, const pia_scene *scene)
{
    pia_shade shade = shade_of(scene);
    const pia_plot_options *o = &scene->options;
    double room = shade.shown ? PIA_SCALE_ROOM : 0;
    pia_box main = {PIA_MARGIN, draw_head(canvas, scene), canvas->width - PIA_MARGIN - room, canvas->height - PIA_MARGIN};
    pia_box below = {main.left, main.bottom, canvas->width - PIA_MARGIN - fmax(room, 24), main.bottom};
    if (o->trace_count > 0) {
        main.bottom -= fmin(TRACE_HEIGHT, 0.4 * (main.bottom - main.top));
        below.top = main.bottom + 10;
    }
    if (main.bottom - main.top < LEAST_PANEL + PIA_FRAME_BELOW) return PIA_OK; /* a stamp: only its head fits */
    if (shade.shown) {
        pia_box scale = {main.right + 16, main.top, main.right + 16 + PIA_SCALE_WIDTH, main.bottom - PIA_FRAME_BELOW};
        pia_scale_draw(canvas, &scale, shade.ramp, shade.low, shade.high, shade.title);
    }
    pia_status status = scene->space ? pia_space_draw(canvas, scene, main) : pia_plane_draw(canvas, scene, main);
    if (status == PIA_OK && o->trace_count > 0) status = pia_trace_draw(canvas, scene->context, o->trace, o->trace_count, below);
    return status;
}

static pia_status draw_into(pia_output *output, const pia_scene *scene, pia_picture picture)
{
    const pia_plot_options *o = &scene->options;
    double scale = 1;
    if (picture == PIA_PICTURE_PNG) scale = o->width > 0 ? fmax(1, o->width / USUAL_WIDTH) : o->height > 0 ? 1 : usual_pixels;
    double width = o->width > 0 ? o->width / scale : USUAL_WIDTH;
    double height = o->height > 0 ? o->height / scale : page_height(scene, width);
    pia_canvas *canvas = NULL;
    pia_status status = pia_canvas_open(scene->context, output, picture, width, height, scale, &canvas);
    if (status != PIA_OK) return status;
    status = draw_page(canvas, scene);
    pia_status closed = canvas->close(canvas);
    return status != PIA_OK ? status : closed;
}

static pia_status write_picture(const pia_scene *scene, const char *path, pia_picture picture)
{
    pia_output *output = NULL;
    pia_status status = pia_output_open(scene->context, path, &output);
    if (status != PIA_OK) return status;
    status = draw_into(output, scene, picture);
    if (status == PIA_OK) return pia_output_commit(output);
    pia_output_abandon(output);
    return status;
}

/* A picture that can be asked: what the options say of looks, the page's reader chooses. */
static pia_status write_report(pia_context *context, const char *path, const pia_model *const *models, pia_index model_count,
                               const double *points, pia_index count, const pia_plot_options *o)
{
    pia_page_options page;
    pia_page_options_init(&page);
    page.title = o->title;
    page.parameters = o->parameters;
    page.trace = o->trace;
    page.trace_count = o->trace_count;
    return pia_page_write(context, path, models, model_count, points, count, &page);
}

pia_status pia_plot(pia_context *context, const char *path, const pia_model *const *models, pia_index model_count, const double *points,
                    pia_index count, const pia_plot_options *options)
{
    pia_plot_options o;
    pia_picture picture = PIA_PICTURE_SVG;
    pia_plot_options_init(&o);
    pia_status status = pia_options_read(context, "pia_plot_options", &o, sizeof o, options);
    if (status != PIA_OK) return status;
    if (path == NULL) return pia_fail(context, PIA_E_ARGUMENT, "no path to write the picture to");
    if (strcasecmp(wanted_format(path, o.format), "html") == 0)
        return write_report(context, path, models, model_count, points, count, &o);
    status = find_format(context, path, o.format, &picture);
    if (status == PIA_OK) status = check(context, models, model_count, points, count, &o);
    if (status != PIA_OK) return status;
    pia_scene scene;
    status = pia_scene_take(context, models, model_count, points, count, &o, picture == PIA_PICTURE_PNG ? PIXEL_CELLS : VECTOR_CELLS,
                            &scene);
    if (status != PIA_OK) return status;
    status = write_picture(&scene, path, picture);
    pia_scene_give(&scene);
    return status;
}
