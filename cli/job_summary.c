#include <math.h>
#include <string.h>

#include "fit_job.h"
#include "json_writer.h"

static const pia_report *last_report(const struct fit_result *result)
{
    return &result->report[result->level_done - 1];
}

static pia_index file_row_of(const struct fit_result *result, const pia_report *report)
{
    return report->max_error_index < 0 ? report->max_error_index : row_in_file(&result->span, report->max_error_index);
}

const char *fit_tolerance_text(struct session *session, const pia_fit_options *options)
{
    const char *text = options->tolerance > 0 ? session_text(session, "%g", options->tolerance) : NULL;
    for (pia_index d = 0; d < options->axis_tolerance_count; d++)
        text = session_text(session, "%s%s%g", text ? text : "", text ? "," : "", options->axis_tolerances[d]);
    return text;
}

static void join_axes(const pia_fit_options *options, const pia_report *part, pia_report *all)
{
    const double *tolerance = options->axis_tolerances;
    for (int d = 0; d < options->axis_tolerance_count; d++) {
        all->axis_error[d] = fmax(all->axis_error[d], part->axis_error[d]);
        if (all->axis_error[d] / tolerance[d] > all->axis_error[all->worst_axis] / tolerance[all->worst_axis]) all->worst_axis = d;
    }
}

/* The parts of a file told as one fit: counts add up, errors are the worst, the words are those of the part that did worst. */
static pia_report join_parts(const struct fit_job *job)
{
    const struct fit_result *first = &job->result[0];
    pia_report all = *last_report(first);
    double squares = all.rms_error * all.rms_error * (double)all.point_count;
    all.max_error_index = file_row_of(first, &all);
    for (pia_index k = 1; k < job->part_done; k++) {
        const pia_report *part = last_report(&job->result[k]);
        all.control_count += part->control_count;
        all.point_count += part->point_count;
        all.iterations = part->iterations > all.iterations ? part->iterations : all.iterations;
        all.constraint_error = fmax(all.constraint_error, part->constraint_error);
        all.between_error = fmax(all.between_error, part->between_error);
        join_axes(&job->request->options, part, &all);
        squares += part->rms_error * part->rms_error * (double)part->point_count;
        if (part->reached == 0 && all.reached != 0) {
            all.reached = 0;
            all.stop = part->stop;
        }
        if (part->max_error > all.max_error) {
            all.max_error = part->max_error;
            all.max_error_index = file_row_of(&job->result[k], part);
        }
    }
    all.rms_error = all.point_count ? sqrt(squares / (double)all.point_count) : all.rms_error;
    return all;
}

static const char *kind_name(pia_kind kind)
{
    return kind == PIA_CURVE ? "curve" : kind == PIA_GRID ? "grid" : "surface";
}

/* Note `index` of the fit of part k, NULL past the end: what was repaired, warned of or chosen. */
static const char *note_at(const struct fit_job *job, pia_index k, pia_index index)
{
    const struct fit_result *result = &job->result[k];
    return pia_model_note(result->model[result->level_done - 1], index);
}

/* A choice of the library belongs to the summary; it is no warning. */
static int is_choice(const char *note)
{
    return strncmp(note, "method: ", 8) == 0;
}

/* ---- JSON ---- */

static void put_axes(struct json_writer *json, const pia_report *report)
{
    int axes = 0;
    while (axes < PIA_MAX_DIM && !isnan(report->axis_error[axes])) axes++;
    if (!axes) return;
    json_numbers(json, "axis_errors", report->axis_error, axes);
    json_count(json, "worst_axis", report->worst_axis);
}

static void put_report(struct json_writer *json, const pia_report *report, pia_index max_error_row)
{
    json_text(json, "kind", kind_name(report->kind));
    json_text(json, "method", report->method);
    if (report->kind == PIA_CURVE)
        json_count(json, "degree", report->degree[0]);
    else
        json_numbers(json, "degree", (const double[]){report->degree[0], report->degree[1]}, 2);
    json_count(json, "control_count", report->control_count);
    json_count(json, "point_count", report->point_count);
    json_count(json, "iterations", report->iterations);
    json_text(json, "stop", pia_stop_name(report->stop));
    json_truth(json, "reached", report->reached);
    json_number(json, "max_error", report->max_error);
    json_count(json, "max_error_index", max_error_row);
    json_number(json, "rms_error", report->rms_error);
    put_axes(json, report);
    json_number(json, "constraint_error", report->constraint_error);
    if (!isnan(report->between_error)) json_number(json, "between_error", report->between_error);
    json_text(json, "measure", report->measure_distance ? "distance" : "parametric");
}

static void put_levels(struct json_writer *json, const struct fit_job *job)
{
    const struct fit_result *result = &job->result[0];
    json_open(json, "levels", '[');
    for (pia_index i = 0; i < result->level_done; i++) {
        json_open(json, NULL, '{');
        json_text(json, "level", job->request->levels.item[i]);
        put_report(json, &result->report[i], file_row_of(result, &result->report[i]));
        json_close(json, '}');
    }
    json_close(json, ']');
}

static void put_parts(struct json_writer *json, const struct fit_job *job)
{
    json_open(json, "parts", '[');
    for (pia_index k = 0; k < job->part_done; k++) {
        const pia_report *report = last_report(&job->result[k]);
        json_open(json, NULL, '{');
        put_report(json, report, file_row_of(&job->result[k], report));
        json_close(json, '}');
    }
    json_close(json, ']');
}

static void put_notes(struct json_writer *json, const struct fit_job *job)
{
    json_open(json, "warnings", '[');
    for (pia_index k = 0; k < job->part_done; k++) {
        const char *note;
        for (pia_index i = 0; (note = note_at(job, k, i)); i++) json_text(json, NULL, note);
    }
    if (job->points.info.skipped) {
        char text[80];
        snprintf(text, sizeof text, "%lld invalid rows were dropped", (long long)job->points.info.skipped);
        json_text(json, NULL, text);
    }
    json_close(json, ']');
}

static void print_json(FILE *stream, const struct fit_job *job, const pia_report *report)
{
    struct json_writer writer = {.stream = stream}, *json = &writer;
    json_open(json, NULL, '{');
    put_report(json, report, report->max_error_index);
    json_open(json, "seconds", '{');
    json_number(json, "read", job->read_seconds);
    json_number(json, "fit", job->fit_seconds);
    json_number(json, "write", job->write_seconds);
    json_close(json, '}');
    put_notes(json, job);
    json_texts(json, "outputs", &job->outputs);
    if (job->request->levels.count) put_levels(json, job);
    if (job->part_count > 1) put_parts(json, job);
    json_close(json, '}');
    json_end(json);
}

/* ---- Text ---- */

static const char *stop_sentence(pia_stop stop)
{
    switch (stop) {
    case PIA_STOP_TOLERANCE: return "the tolerance is reached";
    case PIA_STOP_CHANGE: return "the control points no longer move";
    case PIA_STOP_GRADIENT: return "the gradient is as good as zero";
    case PIA_STOP_ITERATIONS: return "the iterations asked for are done";
    case PIA_STOP_TIME: return "the time is over";
    case PIA_STOP_CANCELLED: return "interrupted";
    case PIA_STOP_STALLED: return "further steps do not reduce the error";
    case PIA_STOP_FINITE: return "the method is finite and done";
    case PIA_STOP_NO_KNOT_LEFT: return "the data cannot hold more knots";
    case PIA_STOP_INFEASIBLE: return "constraints and shape leave no step";
    case PIA_STOP_NONE: break;
    }
    return "still running";
}

/* What to do about a tolerance that is not reached. */
static const char *advice(pia_stop stop)
{
    switch (stop) {
    case PIA_STOP_ITERATIONS: return "raise --iterations, or leave it out";
    case PIA_STOP_TIME: return "raise --time-limit, or --checkpoint the fit and --resume it";
    case PIA_STOP_CANCELLED: return "run again, or --checkpoint the fit and --resume it";
    case PIA_STOP_INFEASIBLE: return "loosen the constraints or the limiter (--soft, --shape none)";
    case PIA_STOP_NO_KNOT_LEFT: return "raise --tolerance to the error above, or give more points";
    case PIA_STOP_STALLED: return "try --method auto, another --param, or a larger --tolerance";
    default: return "raise --control, or leave it out so that knots are added";
    }
}

static void print_model_line(FILE *stream, const struct fit_job *job, const pia_report *report)
{
    int surface = report->kind != PIA_CURVE;
    fprintf(stream, "%-12s %lld points", kind_name(report->kind), (long long)report->point_count);
    if (job->request->source.path) fprintf(stream, " of %s", job->request->source.path);
    if (job->part_done > 1) fprintf(stream, " in %lld parts", (long long)job->part_done);
    fprintf(stream, "\nmodel        degree %d", report->degree[0]);
    if (surface) fprintf(stream, " x %d", report->degree[1]);
    fprintf(stream, ", %lld control points", (long long)report->control_count);
    if (surface && job->part_done == 1) fprintf(stream, " (%lld x %lld)", (long long)report->control[0], (long long)report->control[1]);
    fprintf(stream, "\nmethod       %s", report->method);
    if (*report->parametrization) fprintf(stream, ", parameters %s", report->parametrization);
    if (*report->placement) fprintf(stream, ", knots %s", report->placement);
    if (*report->limiter && strcmp(report->limiter, "none") != 0) fprintf(stream, ", shape %s", report->limiter);
    fputc('\n', stream);
    const char *note;
    for (pia_index i = 0; (note = note_at(job, 0, i)); i++)
        if (is_choice(note)) fprintf(stream, "             %s\n", note + strlen("method: "));
}

static void print_axes(FILE *stream, const pia_fit_options *options, const pia_report *report)
{
    for (pia_index d = 0; d < options->axis_tolerance_count; d++)
        fprintf(stream, "%s%.6g%s", d ? ", " : "axes         ", report->axis_error[d],
                report->axis_error[d] > options->axis_tolerances[d] ? " (too much)" : "");
    if (options->axis_tolerance_count) fputc('\n', stream);
}

static void print_error_lines(FILE *stream, const struct fit_job *job, const pia_report *report)
{
    fprintf(stream, "iterations   %lld; %s\n", (long long)report->iterations, stop_sentence(report->stop));
    fprintf(stream, "max error    %.6g", report->max_error);
    if (report->max_error_index >= 0) fprintf(stream, " at row %lld", (long long)report->max_error_index);
    fprintf(stream, " (%s)\nrms error    %.6g\n", report->measure_distance ? "true distance" : "at the parameters", report->rms_error);
    if (!isnan(report->constraint_error)) fprintf(stream, "constraints  met within %.3g\n", report->constraint_error);
    if (report->outlier_count) fprintf(stream, "outliers     %lld rows\n", (long long)report->outlier_count);
    print_axes(stream, &job->request->options, report);
    const char *tolerance = fit_tolerance_text(job->session, &job->request->options);
    if (report->reached >= 0 && tolerance)
        fprintf(stream, "tolerance    %s %s\n", tolerance, report->reached ? "reached" : "NOT reached");
}

static void print_levels(FILE *stream, const struct fit_job *job)
{
    const struct fit_result *result = &job->result[0];
    for (pia_index i = 0; i < result->level_done; i++)
        fprintf(stream, "%-12s %s: %lld iterations, %lld control points, max error %.6g\n", i ? "" : "levels",
                job->request->levels.item[i], (long long)result->report[i].iterations, (long long)result->report[i].control_count,
                result->report[i].max_error);
}

static void print_parts(FILE *stream, const struct fit_job *job)
{
    for (pia_index k = 0; k < job->part_done; k++) {
        const pia_report *report = last_report(&job->result[k]);
        pia_index part = job->part_first + k;
        fprintf(stream, "%-12s %lld: %lld points, %lld control points, max error %.6g at row %lld\n", k ? "" : "parts", (long long)part,
                (long long)report->point_count, (long long)report->control_count, report->max_error,
                (long long)file_row_of(&job->result[k], report));
    }
}

static void print_text(FILE *stream, const struct fit_job *job, const pia_report *report)
{
    print_model_line(stream, job, report);
    if (job->part_done > 1) print_parts(stream, job);
    print_error_lines(stream, job, report);
    if (job->request->levels.count) print_levels(stream, job);
    fprintf(stream, "seconds      %.3f read, %.3f fit, %.3f write\n", job->read_seconds, job->fit_seconds, job->write_seconds);
    for (pia_index i = 0; i < job->outputs.count; i++) fprintf(stream, "%-12s %s\n", i ? "" : "written", job->outputs.item[i]);
    if (!job->outputs.count) fprintf(stream, "written      nothing; add -o FILE to keep the model\n");
    if (report->reached == 0) fprintf(stream, "next         %s\n", advice(report->stop));
}

static void warn_of_notes(const struct fit_job *job)
{
    const char *note;
    for (pia_index k = 0; k < job->part_done; k++)
        for (pia_index i = 0; (note = note_at(job, k, i)); i++)
            if (!is_choice(note)) session_warn(job->session, "%s", note);
}

int fit_summary_print(const struct fit_job *job)
{
    pia_report report = join_parts(job);
    FILE *stream = stdout;
    for (pia_index i = 0; i < job->outputs.count; i++)
        if (strcmp(job->outputs.item[i], "-") == 0) stream = stderr;
    warn_of_notes(job);
    if (job->session->json)
        print_json(stream, job, &report);
    else if (stream == stdout || !job->session->quiet)
        print_text(stream, job, &report);
    if (progress_interrupted()) return EXIT_INTERRUPTED;
    return report.reached == 0 ? EXIT_TOLERANCE : EXIT_DONE;
}
