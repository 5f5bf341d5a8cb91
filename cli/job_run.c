#include <string.h>

#include "fit_job.h"
#include "stored_parameters.h"

static void result_open(struct fit_job *job, const struct row_span *span, struct fit_result *out)
{
    pia_index levels = job->request->levels.count ? job->request->levels.count : 1;
    *out = (struct fit_result){.span = *span};
    out->report = session_keep(job->session, (size_t)levels, sizeof *out->report);
    out->model = session_keep(job->session, (size_t)levels, sizeof(pia_model *));
    for (pia_index i = 0; i < levels; i++) out->report[i].struct_size = sizeof *out->report;
    recording_open(&out->recording);
}

void fit_result_close(struct fit_result *result)
{
    for (pia_index i = 0; i < result->level_done; i++) pia_model_destroy(result->model[i]);
    result->level_done = 0;
    recording_close(&result->recording);
}

static pia_status run_once(struct fit_job *job, const struct fit_task *task, struct fit_result *result)
{
    pia_status status = pia_fit_data(job->session->context, &task->data, &task->options, result->model, result->report);
    result->level_done = status == PIA_OK;
    return status;
}

/* ---- A fit that is stepped ---- */

/* How far the next piece of a run goes. */
struct piece {
    pia_index saving; /* iterations between checkpoints, grown until they take some seconds */
    double began;
};

static pia_status save_piece(const struct fit_request *request, pia_fit *fit, struct piece *piece)
{
    static const double PIECE_SECONDS = 10;
    if (!request->checkpoint) return PIA_OK;
    if (seconds_now() - piece->began < PIECE_SECONDS / 2 && piece->saving < INT32_MAX) piece->saving *= 2;
    return pia_fit_save(fit, request->checkpoint);
}

static pia_index piece_length(const struct fit_request *request, const struct piece *piece, const struct recording *recording,
                              pia_index iteration)
{
    pia_index length = request->report ? recording_due(recording, iteration) : INT64_MAX;
    return request->checkpoint && piece->saving < length ? piece->saving : length;
}

/* Runs to a stop: at once, or in pieces, each followed by a look for the report and by a checkpoint. */
static pia_status run_to_stop(struct fit_job *job, pia_fit *fit, pia_report *report, struct recording *recording)
{
    const struct fit_request *request = job->request;
    struct piece piece = {.saving = 16};
    pia_status status = request->report ? pia_fit_report(fit, report) : PIA_OK;
    if (status == PIA_OK && request->report) status = recording_look(recording, job->session, fit, report);
    do {
        piece.began = seconds_now();
        if (status == PIA_OK) status = pia_fit_step(fit, piece_length(request, &piece, recording, report->iterations), report);
        if (status == PIA_OK && request->report) status = recording_look(recording, job->session, fit, report);
        if (status == PIA_OK) status = save_piece(request, fit, &piece);
    } while (status == PIA_OK && report->stop == PIA_STOP_NONE);
    return status;
}

/* One run through all levels: each sets its goal and goes on from the model of the one before. */
static pia_status run_levels(struct fit_job *job, pia_fit *fit, struct fit_result *result)
{
    const struct fit_request *request = job->request;
    const char *goal = request->levels_are_iterations ? "max_iterations" : "tolerance";
    pia_index levels = request->levels.count ? request->levels.count : 1;
    pia_status status = PIA_OK;
    for (pia_index i = 0; status == PIA_OK && i < levels && !progress_interrupted(); i++) {
        if (request->levels.count) status = pia_fit_set(fit, goal, request->levels.item[i]);
        if (status == PIA_OK) status = run_to_stop(job, fit, &result->report[i], &result->recording);
        if (status == PIA_OK) status = pia_fit_model(fit, &result->model[i]);
        if (status == PIA_OK) result->level_done++;
    }
    return status;
}

static void keep_trace(struct fit_job *job, const pia_fit *fit, struct fit_result *result)
{
    pia_trace_row row;
    pia_index count = 0;
    while (pia_fit_trace(fit, count, &row)) count++;
    double *to = result->trace = session_keep(job->session, (size_t)count, TRACE_COLUMNS * sizeof *to);
    for (result->trace_count = 0; pia_fit_trace(fit, result->trace_count, &row); result->trace_count++) {
        const double values[TRACE_COLUMNS] = {(double)row.iteration, (double)row.control_count, row.max_error, row.rms_error,
                                              row.adjust_max,        row.constraint_error,      row.seconds};
        memcpy(to, values, sizeof values);
        to += TRACE_COLUMNS;
    }
}

static const double *parameters_used(struct fit_job *job, pia_fit *fit, const struct fit_result *result)
{
    pia_points_info points = job->points.info;
    points.kind = job->kind;
    if (job->kind == PIA_CURVE) points.count[0] = result->span.count;
    return fit_parameters(job->session, fit, &points);
}

static pia_status run_stepped(struct fit_job *job, pia_fit *fit, struct fit_result *result)
{
    pia_status status = run_levels(job, fit, result);
    if (status == PIA_OK && job->request->trace) keep_trace(job, fit, result);
    if (status == PIA_OK && job->request->report && job->points.file) result->recording.parameters = parameters_used(job, fit, result);
    return status;
}

static int finish(struct fit_job *job, pia_status status, struct fit_result *result)
{
    progress_end(&job->progress);
    int about_options = status == PIA_E_ARGUMENT || status == PIA_E_UNAVAILABLE;
    int code = session_check(job->session, status, about_options ? NULL : job->request->source.path);
    if (code) fit_result_close(result);
    return code;
}

int fit_run_task(struct fit_job *job, const struct fit_task *task, struct fit_result *result)
{
    const struct fit_request *request = job->request;
    result_open(job, &task->span, result);
    result->options = task->options;
    if (!request->levels.count && !request->trace && !request->checkpoint && !request->report)
        return finish(job, run_once(job, task, result), result);
    pia_fit *fit = NULL;
    pia_fit_options options = task->options;
    if (request->levels.count && request->levels_are_iterations)
        text_is_count(request->levels.item[request->levels.count - 1], &options.max_iterations);
    else if (request->levels.count)
        text_is_number(request->levels.item[0], &options.tolerance);
    pia_status status = pia_fit_open(job->session->context, &task->data, &options, &fit);
    if (status == PIA_OK) status = run_stepped(job, fit, result);
    int code = finish(job, status, result);
    pia_fit_close(fit);
    return code;
}

/* ---- A fit that goes on ---- */

static pia_status set_number(pia_fit *fit, const char *name, double value, double unset)
{
    char text[40];
    if (value == unset) return PIA_OK;
    snprintf(text, sizeof text, "%.17g", value);
    return pia_fit_set(fit, name, text);
}

/* As on a command line without --resume, one tolerance is the distance alone, several are the axes alone. */
static pia_status set_tolerance(struct fit_job *job, pia_fit *fit)
{
    const pia_fit_options *options = &job->request->options;
    if (options->axis_tolerance_count) {
        const char *axes = NULL;
        for (pia_index d = 0; d < options->axis_tolerance_count; d++)
            axes = session_text(job->session, "%s%s%.17g", axes ? axes : "", axes ? "," : "", options->axis_tolerances[d]);
        return pia_fit_set(fit, "axis_tolerances", axes);
    }
    if (!(options->tolerance > 0)) return PIA_OK;
    pia_status status = pia_fit_set(fit, "axis_tolerances", "none");
    return status == PIA_OK ? set_number(fit, "tolerance", options->tolerance, 0) : status;
}

/* What this command line asks for replaces what the checkpoint remembers. */
static pia_status set_again(struct fit_job *job, pia_fit *fit)
{
    const struct fit_request *request = job->request;
    const pia_fit_options *options = &request->options;
    pia_fit_options unset;
    pia_fit_options_init(&unset);
    pia_status status = set_tolerance(job, fit);
    if (!status) status = set_number(fit, "max_iterations", (double)options->max_iterations, (double)unset.max_iterations);
    if (!status) status = set_number(fit, "stop_change", options->stop_change, unset.stop_change);
    if (!status) status = set_number(fit, "stop_gradient", options->stop_gradient, unset.stop_gradient);
    if (!status) status = set_number(fit, "time_limit", options->time_limit, unset.time_limit);
    pia_index every = request->trace && !options->trace_every ? 1 : options->trace_every;
    if (!status) status = set_number(fit, "trace_every", (double)every, (double)unset.trace_every);
    for (pia_index i = 0; !status && i < request->method_options.count; i++) {
        const char *setting = request->method_options.item[i], *equals = strchr(setting, '=');
        status = pia_fit_set(fit, session_text(job->session, "%.*s", (int)(equals - setting), setting), equals + 1);
    }
    return status;
}

int fit_run_resumed(struct fit_job *job, struct fit_result *result)
{
    pia_fit *fit = NULL;
    const struct row_span span = {.count = INT64_MAX, .total = INT64_MAX};
    result_open(job, job->points.file ? &result->span : &span, result);
    int code = session_check(job->session, pia_fit_resume(job->session->context, job->request->resume, &fit), job->request->resume);
    if (code) return code;
    pia_fit_set_progress(fit, progress_tell, &job->progress);
    pia_status status = set_again(job, fit);
    if (status == PIA_OK) status = run_stepped(job, fit, result);
    code = finish(job, status, result);
    pia_fit_close(fit);
    return code;
}
