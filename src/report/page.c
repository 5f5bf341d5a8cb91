/* The interactive report: the page built from web/, with the title and the data put in. The data are one JSON object, and the packed
 * numbers that it speaks of, deflated. */
#include "page.h"

#include "options.h"
#include "page_deflate.h"
#include "page_template.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { SCHEMA = 1, MOST_MARKS = 2000, SCENE_CELLS = 60 };

void pia_page_options_init(pia_page_options *options)
{
    *options = (pia_page_options){.struct_size = sizeof *options};
}

/* ---- Arguments ---- */

/* What one list of the options holds. */
static pia_status check_list(pia_context *context, const char *name, const void *item, pia_index count)
{
    if (count >= 0 && (item != NULL || count == 0)) return PIA_OK;
    return pia_fail(context, PIA_E_ARGUMENT, "%s: %lld of them, but no array; give both or neither", name, (long long)count);
}

static pia_status check_rows(pia_context *context, const char *name, const pia_index *row, pia_index count, pia_index limit)
{
    pia_status status = check_list(context, name, row, count);
    for (pia_index i = 0; i < count && status == PIA_OK; i++)
        if (row[i] < 0 || row[i] >= limit)
            status = pia_fail(context, PIA_E_ARGUMENT, "%s: number %lld is %lld; 0 to %lld are there", name, (long long)i,
                              (long long)row[i], (long long)limit - 1);
    return status;
}

static pia_status check_frames(pia_context *context, pia_index model_count, const pia_page_options *o)
{
    pia_status status = check_list(context, "frames", o->frames, o->frame_count);
    for (pia_index i = 0; i < o->frame_count && status == PIA_OK; i++)
        if (o->frames[i] == NULL) status = pia_fail(context, PIA_E_ARGUMENT, "frame %lld is NULL", (long long)i);
    const pia_index *start = o->frame_start;
    for (pia_index k = 0; start != NULL && k < model_count && status == PIA_OK; k++)
        if (start[k] > start[k + 1] || start[0] != 0 || start[model_count] != o->frame_count)
            status = pia_fail(context, PIA_E_ARGUMENT, "frame_start: must rise from 0 to frame_count %lld", (long long)o->frame_count);
    return status;
}

static pia_status check(pia_context *context, const pia_model *const *models, pia_index model_count, const double *points,
                        pia_index count, const pia_page_options *o)
{
    if (models == NULL || model_count < 1) return pia_fail(context, PIA_E_ARGUMENT, "no model to report; give at least one");
    for (pia_index i = 0; i < model_count; i++)
        if (models[i] == NULL) return pia_fail(context, PIA_E_ARGUMENT, "model %lld is NULL", (long long)i);
    pia_status status = check_list(context, "points", points, count);
    if (status == PIA_OK) status = check_list(context, "settings", o->settings, o->setting_count);
    if (status == PIA_OK) status = check_list(context, "trace", o->trace, o->trace_count);
    if (status == PIA_OK) status = check_list(context, "constraint_points", o->constraint_points, o->constraint_point_count);
    if (status == PIA_OK) status = check_frames(context, model_count, o);
    if (status == PIA_OK) status = check_rows(context, "corners", o->corners, o->corner_count, count);
    if (status == PIA_OK) status = check_rows(context, "met", o->met, o->met_count, count);
    if (status != PIA_OK) return status;
    pia_model_info info = {.struct_size = sizeof info};
    pia_model_get_info(models[0], &info);
    return check_rows(context, "unsupported", o->unsupported, o->unsupported_count, info.control[0] * info.control[1]);
}

/* ---- JSON ---- */

pia_status pia_page_lattice(pia_page *page, const char *key, pia_series *series, const double *values, pia_index stride, pia_index rows,
                            pia_index columns)
{
    pia_packed packed;
    pia_status status = pia_series_add(&page->pack, series, values, stride, rows, columns, &packed);
    if (status != PIA_OK) return status;
    pia_json *json = &page->json;
    pia_json_open(json, key, '{');
    pia_json_count(json, "at", packed.at);
    pia_json_counts(json, "size", (const pia_index[]){rows, columns, series->components}, 3);
    pia_json_count(json, "planes", packed.planes);
    pia_json_count(json, "bits", series->bits);
    if (packed.follows) pia_json_truth(json, "follows", 1);
    pia_json_numbers(json, "low", series->low, series->components);
    pia_json_numbers(json, "step", series->step, series->components);
    pia_json_close(json, '}');
    return PIA_OK;
}

static const char *kind_name(pia_kind kind)
{
    static const char *const name[] = {[PIA_CURVE] = "curve", [PIA_GRID] = "grid", [PIA_SCATTERED] = "scattered"};
    return name[kind];
}

/* What the fit of a model said, as an element of "fits"; null for a model that no fit made. */
static void put_fit(pia_json *json, const pia_model *model)
{
    pia_report r = {.struct_size = sizeof r};
    if (!pia_model_report(model, &r)) {
        pia_json_text(json, NULL, NULL);
        return;
    }
    pia_json_open(json, NULL, '{');
    pia_json_text(json, "kind", kind_name(r.kind));
    pia_json_text(json, "method", r.method);
    pia_json_text(json, "parametrization", r.parametrization);
    pia_json_text(json, "placement", r.placement);
    pia_json_text(json, "limiter", r.limiter);
    pia_json_count(json, "control_count", r.control_count);
    pia_json_count(json, "point_count", r.point_count);
    pia_json_count(json, "iterations", r.iterations);
    pia_json_text(json, "stop", pia_stop_name(r.stop));
    pia_json_truth(json, "reached", r.reached);
    pia_json_number(json, "max_error", r.max_error);
    pia_json_count(json, "max_error_index", r.max_error_index);
    pia_json_number(json, "rms_error", r.rms_error);
    pia_json_number(json, "constraint_error", r.constraint_error);
    pia_json_number(json, "start_error", r.start_error);
    pia_json_truth(json, "measure_distance", r.measure_distance);
    pia_json_count(json, "repaired_count", r.repaired_count);
    pia_json_count(json, "unsupported_count", r.unsupported_count);
    pia_json_count(json, "outlier_count", r.outlier_count);
    pia_json_count(json, "round_count", r.round_count);
    pia_json_number(json, "seconds", r.seconds);
    pia_json_open(json, "notes", '[');
    const char *note;
    for (pia_index i = 0; (note = pia_model_note(model, i)) != NULL; i++) pia_json_text(json, NULL, note);
    pia_json_close(json, ']');
    pia_json_close(json, '}');
}

static void put_settings(pia_json *json, const pia_page_options *o)
{
    pia_json_open(json, "settings", '[');
    for (pia_index i = 0; i < o->setting_count; i++) {
        pia_json_open(json, NULL, '[');
        pia_json_text(json, NULL, o->settings[i].name);
        pia_json_text(json, NULL, o->settings[i].value);
        pia_json_text(json, NULL, o->settings[i].initial);
        pia_json_close(json, ']');
    }
    pia_json_close(json, ']');
}

/* A long history keeps rows of equal ratios of the iteration: as many as a chart can show. */
static void put_trace(pia_json *json, const pia_trace_row *row, pia_index count)
{
    static const double ratio = 1.02;
    double next = 0;
    pia_json_open(json, "trace", '[');
    for (pia_index i = 0; i < count; i++) {
        if ((double)row[i].iteration < next && i + 1 < count && row[i].control_count == row[i + 1].control_count) continue;
        next = count > MOST_MARKS ? (double)row[i].iteration * ratio : 0;
        pia_json_open(json, NULL, '[');
        pia_json_count(json, NULL, row[i].iteration);
        pia_json_count(json, NULL, row[i].control_count);
        pia_json_number(json, NULL, row[i].max_error);
        pia_json_number(json, NULL, row[i].rms_error);
        pia_json_close(json, ']');
    }
    pia_json_close(json, ']');
}

/* Drawn positions of rows of the points; `kept` [scene.point_count] are the rows that the scene has, NULL: all. */
static void put_marks(pia_page *page, const char *key, const pia_index *row, pia_index count, const pia_index *kept)
{
    pia_json_open(&page->json, key, '[');
    for (pia_index i = 0; i < count && i < MOST_MARKS; i++) {
        pia_index low = 0, high = page->scene.point_count;
        while (kept != NULL && high - low > 1) {
            pia_index middle = low + (high - low) / 2;
            *(kept[middle] <= row[i] ? &low : &high) = middle;
        }
        pia_index at = kept != NULL ? low : row[i];
        if (kept == NULL || kept[at] == row[i]) pia_json_numbers(&page->json, NULL, page->scene.point + 3 * at, page->components);
    }
    pia_json_close(&page->json, ']');
}

static void put_constraint_points(pia_page *page)
{
    const pia_page_options *o = page->options;
    const pia_model_info *info = &page->scene.figure[0].info;
    pia_json_open(&page->json, "constraint_points", '[');
    for (pia_index i = 0; i < o->constraint_point_count && i < MOST_MARKS && info->dim > 1; i++) {
        double at[3];
        pia_figure_place(info, NULL, o->constraint_points + i * info->dim, at);
        pia_json_numbers(&page->json, NULL, at, page->components);
    }
    pia_json_close(&page->json, ']');
}

/* Loops of a trimmed surface in its parameter plane, each u, v, u, v, ... */
static void put_trim(pia_json *json, const pia_model *model)
{
    pia_json_open(json, "trim", '[');
    for (pia_index i = 0; i < pia_model_trim_loop_count(model); i++) {
        pia_index count;
        const double *loop = pia_model_trim_loop(model, i, &count);
        pia_json_numbers(json, NULL, loop, 2 * count);
    }
    pia_json_close(json, ']');
}

static pia_status put_figures(pia_page *page)
{
    pia_status status = PIA_OK;
    pia_json_open(&page->json, "figures", '[');
    for (pia_index f = 0; f < page->scene.figure_count && status == PIA_OK; f++) {
        const pia_figure *figure = &page->scene.figure[f];
        pia_json_open(&page->json, NULL, '{');
        pia_json_count(&page->json, "dim", figure->info.dim);
        pia_json_truth(&page->json, "periodic", figure->info.periodic[0] || figure->info.periodic[1]);
        if (figure->info.directions == 1) pia_json_truth(&page->json, "graph", pia_figure_is_graph(figure));
        put_trim(&page->json, figure->model);
        status = pia_page_model(page, f);
        pia_json_close(&page->json, '}');
    }
    pia_json_close(&page->json, ']');
    return status;
}

static pia_status put_head(pia_page *page, const pia_index *kept)
{
    const pia_page_options *o = page->options;
    const pia_scene *scene = &page->scene;
    pia_json *json = &page->json;
    pia_json_open(json, NULL, '{');
    pia_json_count(json, "schema", SCHEMA);
    pia_json_text(json, "version", pia_version());
    pia_json_text(json, "title", o->title);
    pia_json_text(json, "source", o->source);
    pia_json_text(json, "command", o->command);
    pia_json_number(json, "tolerance", o->tolerance > 0 ? o->tolerance : NAN);
    pia_json_truth(json, "space", scene->space);
    pia_json_numbers(json, "low", scene->low, page->components);
    pia_json_numbers(json, "high", scene->high, page->components);
    pia_json_open(json, "fits", '[');
    for (pia_index f = 0; f < scene->figure_count; f++) put_fit(json, scene->figure[f].model);
    pia_json_close(json, ']');
    put_settings(json, o);
    put_trace(json, o->trace, o->trace_count);
    put_marks(page, "corners", o->corners, o->corner_count, kept);
    put_marks(page, "met", o->met, o->met_count, kept);
    put_constraint_points(page);
    pia_json_counts(json, "unsupported", o->unsupported, o->unsupported_count < MOST_MARKS ? o->unsupported_count : MOST_MARKS);
    pia_status status = put_figures(page);
    if (status == PIA_OK && scene->point_count > 0) status = pia_page_points(page);
    pia_json_close(json, '}');
    return status;
}

/* ---- The file ---- */

static pia_status put_page(pia_page *page, pia_output *output, const pia_index *kept)
{
    const pia_page_options *o = page->options;
    const char *slash = o->source != NULL ? strrchr(o->source, '/') : NULL;
    const char *title = o->title != NULL ? o->title : slash != NULL ? slash + 1 : o->source != NULL ? o->source : "Report";
    pia_slice part[3];
    pia_page_template(part);
    page->json.output = output;
    pia_output_bytes(output, part[0].text, part[0].size);
    pia_html_text(output, title);
    pia_output_bytes(output, part[1].text, part[1].size);
    pia_output_text(output, "<script type=\"application/json\" id=\"pia-head\">");
    pia_status status = put_head(page, kept);
    if (status != PIA_OK) return status;
    pia_output_text(output, "</script>\n<script type=\"application/octet-stream\" id=\"pia-data\">");
    status = pia_page_deflate(page->context, output, page->pack.byte, page->pack.count);
    pia_output_text(output, "</script>");
    pia_output_bytes(output, part[2].text, part[2].size);
    return status;
}

static pia_status write_page(pia_page *page, const char *path, const pia_index *kept)
{
    pia_output *output = NULL;
    pia_status status = pia_output_open(page->context, path, &output);
    if (status != PIA_OK) return status;
    status = put_page(page, output, kept);
    if (status == PIA_OK) return pia_output_commit(output);
    pia_output_abandon(output);
    return status;
}

/* The points that are numbers, with their parameters and names; `row` is NULL where nothing had to be left out. */
typedef struct kept {
    pia_index count;
    pia_index *row, *name;
    double *point, *parameter;
} kept;

static void kept_give(pia_context *context, kept *k)
{
    pia_give(context, k->row);
    pia_give(context, k->name);
    pia_give(context, k->point);
    pia_give(context, k->parameter);
}

static int is_hole(const double *point, int dim)
{
    for (int c = 0; c < dim; c++)
        if (isnan(point[c])) return 1;
    return 0;
}

static pia_status keep_numbers(pia_context *context, const pia_model_info *info, const double *points, pia_index count,
                               const pia_page_options *o, kept *out)
{
    pia_index holes = 0;
    for (pia_index i = 0; i < count; i++) holes += is_hole(points + i * info->dim, info->dim);
    *out = (kept){.count = count - holes};
    if (holes == 0) return PIA_OK;
    int width = o->parameters != NULL ? info->directions : 0;
    out->row = pia_take(context, out->count, sizeof *out->row);
    out->name = pia_take(context, out->count, sizeof *out->name);
    out->point = pia_take(context, out->count, (size_t)info->dim * sizeof *out->point);
    out->parameter = pia_take(context, out->count, (size_t)(width + 1) * sizeof *out->parameter);
    if (out->row == NULL || out->name == NULL || out->point == NULL || out->parameter == NULL) return PIA_E_MEMORY;
    pia_index k = 0;
    for (pia_index i = 0; i < count; i++) {
        if (is_hole(points + i * info->dim, info->dim)) continue;
        out->row[k] = i;
        out->name[k] = o->rows != NULL ? o->rows[i] : i;
        memcpy(out->point + k * info->dim, points + i * info->dim, (size_t)info->dim * sizeof *points);
        for (int d = 0; d < width; d++) out->parameter[k * width + d] = o->parameters[i * width + d];
        k++;
    }
    return PIA_OK;
}

static pia_status write_scene(pia_context *context, const char *path, const pia_model *const *models, pia_index model_count,
                              const double *points, const kept *k, const pia_page_options *o)
{
    pia_page page = {.context = context, .options = o, .pack.context = context, .rows = k->row != NULL ? k->name : o->rows};
    pia_plot_options plot;
    pia_plot_options_init(&plot);
    plot.control = 0;
    plot.parameters = k->row != NULL && o->parameters != NULL ? k->parameter : o->parameters;
    pia_status status =
        pia_scene_take(context, models, model_count, k->row != NULL ? k->point : points, k->count, &plot, SCENE_CELLS, &page.scene);
    if (status != PIA_OK) return status;
    page.components = page.scene.space ? 3 : 2;
    status = write_page(&page, path, k->row);
    pia_scene_give(&page.scene);
    pia_pack_close(&page.pack);
    return status;
}

pia_status pia_page_write(pia_context *context, const char *path, const pia_model *const *models, pia_index model_count,
                          const double *points, pia_index count, const pia_page_options *options)
{
    pia_page_options o;
    pia_page_options_init(&o);
    pia_status status = pia_options_read(context, "pia_page_options", &o, sizeof o, options);
    if (status != PIA_OK) return status;
    if (path == NULL) return pia_fail(context, PIA_E_ARGUMENT, "no path to write the report to");
    status = check(context, models, model_count, points, count, &o);
    if (status != PIA_OK) return status;
    pia_model_info info = {.struct_size = sizeof info};
    pia_model_get_info(models[0], &info);
    kept numbers;
    status = keep_numbers(context, &info, points, count, &o, &numbers);
    if (status == PIA_OK) status = write_scene(context, path, models, model_count, points, &numbers, &o);
    kept_give(context, &numbers);
    return status;
}
