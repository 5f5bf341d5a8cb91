#include <string.h>

#include "file_name.h"
#include "fit_job.h"
#include "holes.h"
#include "stored_parameters.h"

static int check_one(const struct fit_request *request, const char *path)
{
    const char *input = request->source.path;
    if (input && strcmp(path, "-") != 0 && strcmp(path, input) == 0)
        return fail(EXIT_USAGE, "%s: is the file of points; choose another name for the output", path);
    return output_check(path);
}

static const char *format_to_write(const struct fit_request *request, const char *path)
{
    return format_of(path, request->output_format, "json");
}

static int check_format(const struct fit_request *request, const char *path)
{
    const char *format = format_to_write(request, path);
    if (is_picture(path, format)) return EXIT_DONE;
    return session_check(request->session, pia_model_write_check(request->session->context, path, format), path);
}

int fit_outputs_check(struct fit_request *request)
{
    const struct texts *outputs = &request->outputs;
    const char *const others[] = {request->report, request->trace, request->checkpoint};
    int code = EXIT_DONE;
    for (pia_index i = 0; !code && i < outputs->count; i++) {
        code = check_one(request, outputs->item[i]);
        if (!code) code = check_format(request, outputs->item[i]);
        if (!code && request->levels.count && strcmp(outputs->item[i], "-") == 0)
            code = fail(EXIT_USAGE, "-o -: several levels need files; name one");
        for (pia_index j = 0; !code && j < i; j++)
            if (strcmp(outputs->item[i], outputs->item[j]) == 0)
                code = fail(EXIT_USAGE, "-o %s: is given twice; name each file once", outputs->item[i]);
    }
    for (size_t i = 0; !code && i < sizeof others / sizeof *others; i++)
        if (others[i]) code = check_one(request, others[i]);
    return code;
}

pia_points_info fit_points_shown(const struct fit_job *job, pia_index *count)
{
    pia_points_info shown = job->points.info;
    *count = 0;
    if (!job->points.file) return shown;
    shown.points += job->result[0].span.first * shown.dim;
    for (pia_index k = 0; k < job->part_done; k++) *count += job->result[k].span.count;
    shown.kind = job->kind;
    if (job->kind != PIA_GRID) shown.count[0] = *count;
    return shown;
}

static pia_status draw(struct fit_job *job, const char *path, const char *format, const pia_model *const *models)
{
    pia_plot_options options;
    pia_plot_options_init(&options);
    options.format = format;
    pia_index count;
    pia_points_info shown = fit_points_shown(job, &count);
    struct solid solid = {.count = 0};
    if (count) {
        solid =
            points_without_holes(job->session, &shown, job->part_done == 1 ? stored_parameters(job->session, models[0], &shown) : NULL);
        options.parameters = solid.parameters;
    }
    return pia_plot(job->session->context, path, models, job->part_done, solid.points, solid.count, &options);
}

static int write_models(struct fit_job *job, const char *path, const char *format, const pia_model *const *models)
{
    pia_write_options options = job->request->writing;
    options.format = format;
    pia_status status = is_picture(path, format) ? draw(job, path, format, models)
                                                 : pia_model_write_as(job->session->context, path, models, job->part_done, &options);
    int code = session_check(job->session, status, path);
    if (!code) session_append(job->session, &job->outputs, path);
    return code;
}

static int write_level(struct fit_job *job, pia_index level)
{
    const struct fit_request *request = job->request;
    const char *name = NULL;
    if (request->levels.count)
        name = session_text(job->session, "%s%s", request->levels_are_iterations ? "it" : "", request->levels.item[level]);
    const pia_model **models = session_keep(job->session, (size_t)job->part_done, sizeof(pia_model *));
    for (pia_index k = 0; k < job->part_done; k++) models[k] = job->result[k].model[level];
    int code = EXIT_DONE;
    for (pia_index i = 0; !code && i < request->outputs.count; i++) {
        const char *path = request->outputs.item[i];
        const char *written = name ? output_at_level(job->session, path, name) : path;
        code = write_models(job, written, format_to_write(request, path), models);
    }
    int last = level + 1 == job->result[0].level_done;
    if (code || !last || !request->report) return code;
    code = session_check(job->session, fit_report_write(job, models), request->report);
    if (!code) session_append(job->session, &job->outputs, request->report);
    return code;
}

static int write_trace(struct fit_job *job)
{
    static const char heading[] = "iteration,control_count,max_error,rms_error,adjust_max,constraint_error,seconds";
    const char *path = job->request->trace;
    const struct fit_result *result = &job->result[0];
    const char *format = format_of(path, NULL, "csv");
    pia_status status =
        pia_table_write(job->session->context, path, format, heading, result->trace, result->trace_count, TRACE_COLUMNS);
    int code = session_check(job->session, status, path);
    if (!code) session_append(job->session, &job->outputs, path);
    return code;
}

int fit_outputs_write(struct fit_job *job)
{
    pia_index levels = job->part_done ? job->result[0].level_done : 0;
    for (pia_index k = 1; k < job->part_done; k++)
        if (job->result[k].level_done < levels) levels = job->result[k].level_done;
    int code = EXIT_DONE;
    for (pia_index level = 0; !code && level < levels; level++) code = write_level(job, level);
    if (!code && levels && job->request->trace) code = write_trace(job);
    return code;
}
