#include "io.h"
#include "options.h"

#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

void pia_points_options_init(pia_points_options *options)
{
    *options = (pia_points_options){.struct_size = sizeof *options};
}

/* The format asked for, by name or extension; `otherwise` for standard streams. */
static const pia_format *find_format(pia_context *context, const char *path, const char *name, const char *otherwise)
{
    const pia_format *format = pia_format_find(name, path);
    if (format == NULL && name == NULL && path != NULL && strcmp(path, "-") == 0) format = pia_format_find(otherwise, NULL);
    if (format != NULL) return format;
    if (name != NULL)
        pia_fail(context, PIA_E_ARGUMENT, "there is no format '%.60s'; take one that `pia list formats` names", name);
    else
        pia_fail(context, PIA_E_ARGUMENT, "%s: no format has this extension; name the format", path != NULL ? path : "");
    return NULL;
}

static pia_status refuse_use(pia_context *context, const char *path, const pia_format *format, const char *use)
{
    return pia_fail(context, PIA_E_ARGUMENT, "%s: the format %s %s; take another", path, format->name, use);
}

static pia_status read_points(pia_context *context, const char *path, const pia_input *input, const pia_points_options *options,
                              pia_points **out)
{
    const pia_format *format = find_format(context, path, options->format, "text");
    if (format == NULL) return PIA_E_ARGUMENT;
    if (format->read_points == NULL) return refuse_use(context, path, format, "holds no points that can be read");
    pia_points *points = pia_take_zero(context, 1, sizeof *points);
    if (points == NULL) return pia_take_status(context, 1, sizeof *points);
    points->memory = *pia_memory_of(context);
    pia_status status = format->read_points(context, input, options, points);
    if (status != PIA_OK) {
        pia_points_destroy(points);
        return status;
    }
    points->format = format->name;
    points->whole[1] = points->count[0];
    *out = points;
    return PIA_OK;
}

pia_status pia_points_read(pia_context *context, const char *path, const pia_points_options *options, pia_points **out)
{
    pia_points_options o;
    pia_points_options_init(&o);
    pia_status status = pia_options_read(context, "pia_points_options", &o, sizeof o, options);
    if (status != PIA_OK) return status;
    if (out == NULL || path == NULL) return pia_fail(context, PIA_E_ARGUMENT, "a path and an output are needed");
    char file[PATH_MAX];
    const char *inside = pia_format_inside(o.format, path);
    pia_input input;
    snprintf(file, sizeof file, "%.*s", inside != NULL ? (int)(inside - 1 - path) : (int)strlen(path), path);
    status = pia_input_open(context, inside != NULL ? file : path, &input);
    if (status != PIA_OK) return status;
    input.inside = inside;
    status = read_points(context, inside != NULL ? file : path, &input, &o, out);
    pia_input_close(context, &input);
    return status;
}

void pia_points_get_info(const pia_points *points, pia_points_info *out)
{
    const char *const *names;
    memcpy(&names, &points->names, sizeof names);
    *out = (pia_points_info){.struct_size = sizeof *out,
                             .kind = points->kind,
                             .points = points->points,
                             .count = {points->count[0], points->count[1]},
                             .dim = points->dim,
                             .part_count = points->part != NULL ? points->part_count : 1,
                             .part = points->part != NULL ? points->part : points->whole,
                             .skipped = points->skipped,
                             .row = points->row,
                             .names = names,
                             .format = points->format};
}

void pia_points_destroy(pia_points *points)
{
    if (points == NULL) return;
    pia_memory memory = points->memory;
    pia_points_clear(points);
    pia_memory_give(&memory, points);
}

pia_status pia_table_write(pia_context *context, const char *path, const char *format, const char *header, const double *values,
                           pia_index rows, int columns)
{
    pia_index count;
    if (path == NULL || columns < 1 || rows < 0 || (values == NULL && rows > 0) || !pia_multiply(rows, columns, &count))
        return pia_fail(context, PIA_E_ARGUMENT, "a table of %lld rows and %d columns cannot be written", (long long)rows, columns);
    const pia_format *writer = find_format(context, path, format, "text");
    if (writer == NULL) return PIA_E_ARGUMENT;
    if (writer->write_table == NULL) return refuse_use(context, path, writer, "holds no tables");
    pia_output *output;
    pia_status status = pia_output_open(context, path, &output);
    if (status != PIA_OK) return status;
    status = writer->write_table(context, output, header, values, rows, columns);
    if (status == PIA_OK) return pia_output_commit(output);
    pia_output_abandon(output);
    return status;
}

pia_status pia_model_read(pia_context *context, const char *path, const char *format, pia_model ***out, pia_index *count)
{
    if (path == NULL || out == NULL || count == NULL) return pia_fail(context, PIA_E_ARGUMENT, "a path and two outputs are needed");
    pia_input input;
    pia_status status = pia_input_open(context, path, &input);
    if (status != PIA_OK) return status;
    const pia_format *reader = find_format(context, path, format, "json");
    if (reader == NULL)
        status = PIA_E_ARGUMENT;
    else if (reader->read_models == NULL)
        status = refuse_use(context, path, reader, "holds no models that can be read");
    else
        status = reader->read_models(context, &input, out, count);
    pia_input_close(context, &input);
    return status;
}

static pia_status find_writer(pia_context *context, const char *path, const char *format, const pia_format **out)
{
    *out = find_format(context, path, format, "json");
    if (*out == NULL) return PIA_E_ARGUMENT;
    return (*out)->write_models != NULL ? PIA_OK : refuse_use(context, path, *out, "holds no models");
}

pia_status pia_model_write_check(pia_context *context, const char *path, const char *format)
{
    const pia_format *writer;
    if (path == NULL) return pia_fail(context, PIA_E_ARGUMENT, "a path is needed");
    return find_writer(context, path, format, &writer);
}

void pia_write_options_init(pia_write_options *options)
{
    *options = (pia_write_options){.struct_size = sizeof *options, .samples = PIA_AUTO, .tolerance = PIA_AUTO};
}

static pia_status check_write_options(pia_context *context, const pia_write_options *options)
{
    if (options->unit < PIA_UNIT_MILLIMETRE || options->unit > PIA_UNIT_INCH)
        return pia_fail(context, PIA_E_ARGUMENT, "unit %d; choose a PIA_UNIT", (int)options->unit);
    if (options->step_schema < PIA_STEP_AP214 || options->step_schema > PIA_STEP_AP242)
        return pia_fail(context, PIA_E_ARGUMENT, "schema %d; choose PIA_STEP_AP214 or PIA_STEP_AP242", (int)options->step_schema);
    if (options->tolerance != PIA_AUTO && !(options->tolerance > 0 && isfinite(options->tolerance)))
        return pia_fail(context, PIA_E_ARGUMENT, "tolerance %g; it must be finite and above 0", options->tolerance);
    return PIA_OK;
}

/* A file's name without folder and extension. */
static void stem_of(const char *path, char stem[64])
{
    const char *slash = strrchr(path, '/'), *name = slash != NULL ? slash + 1 : path, *dot = strrchr(name, '.');
    int length = dot != NULL && dot > name ? (int)(dot - name) : (int)strlen(name);
    snprintf(stem, 64, "%.*s", length, strcmp(path, "-") != 0 ? name : "model");
}

static void warn_of_trims(pia_context *context, const char *path, const pia_format *writer, const pia_model *const *models,
                          pia_index count)
{
    pia_index trimmed = 0;
    for (pia_index k = 0; k < count; k++) trimmed += pia_model_trim_loop_count(models[k]) > 0;
    if (writer->leaves_trims && trimmed > 0)
        pia_log(context, 2, "%s: the format %s knows no trim loops, surfaces are written whole; STEP, IGES and JSON keep them", path,
                writer->name);
}

static pia_status write_models(pia_context *context, const char *path, const pia_model *const *models, pia_index count,
                               const pia_write_options *options)
{
    const pia_format *writer;
    pia_status status = find_writer(context, path, options->format, &writer);
    if (status != PIA_OK) return status;
    warn_of_trims(context, path, writer, models, count);
    pia_output *output;
    status = pia_output_open(context, path, &output);
    if (status != PIA_OK) return status;
    status = writer->write_models(context, output, models, count, options);
    if (status == PIA_OK) return pia_output_commit(output);
    pia_output_abandon(output);
    return status;
}

pia_status pia_model_write_as(pia_context *context, const char *path, const pia_model *const *models, pia_index count,
                              const pia_write_options *options)
{
    char stem[64];
    pia_write_options o;
    pia_write_options_init(&o);
    pia_status status = pia_options_read(context, "pia_write_options", &o, sizeof o, options);
    if (status == PIA_OK) status = check_write_options(context, &o);
    if (status != PIA_OK) return status;
    if (path == NULL || models == NULL || count < 1)
        return pia_fail(context, PIA_E_ARGUMENT, "a path and at least one model are needed");
    for (pia_index k = 0; k < count; k++)
        if (models[k] == NULL) return pia_fail(context, PIA_E_ARGUMENT, "model %lld is NULL", (long long)k);
    stem_of(path, stem);
    if (o.name == NULL) o.name = stem;
    return write_models(context, path, models, count, &o);
}

pia_status pia_model_write(pia_context *context, const char *path, const char *format, const pia_model *const *models, pia_index count,
                           pia_index samples)
{
    pia_write_options options;
    pia_write_options_init(&options);
    options.format = format;
    options.samples = samples;
    return pia_model_write_as(context, path, models, count, &options);
}

void pia_models_destroy(pia_model **models, pia_index count)
{
    if (models == NULL || count < 1) return;
    const pia_memory memory = models[0]->memory;
    for (pia_index k = 0; k < count; k++) pia_model_destroy(models[k]);
    pia_memory_give(&memory, models);
}
