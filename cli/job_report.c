#include <string.h>

#include "fit_job.h"

/* Frames of all parts, one part after the other. */
static void gather_frames(struct fit_job *job, pia_page_options *page)
{
    pia_index count = 0, *start = session_keep(job->session, (size_t)job->part_done + 1, sizeof *start);
    for (pia_index k = 0; k < job->part_done; k++) start[k + 1] = count += job->result[k].recording.frame_count;
    const pia_model **frames = session_keep(job->session, (size_t)count, sizeof(pia_model *));
    for (pia_index k = 0; k < job->part_done; k++)
        memcpy(frames + start[k], job->result[k].recording.frame, (size_t)(start[k + 1] - start[k]) * sizeof *frames);
    page->frames = frames;
    page->frame_count = count;
    page->frame_start = start;
}

/* What a reader calls the points: their rows in the file; parts that follow each other have one list. */
static const pia_index *name_rows(struct fit_job *job, pia_index count)
{
    pia_index *rows = session_keep(job->session, (size_t)count, sizeof *rows), at = 0;
    for (pia_index k = 0; k < job->part_done; k++)
        for (pia_index i = 0; i < job->result[k].span.count; i++) rows[at++] = row_in_file(&job->result[k].span, i);
    return rows;
}

/* Points that conditions fix: rows, and values at parameters, of the first part. */
static void gather_conditions(struct fit_job *job, int dim, pia_page_options *page)
{
    const pia_fit_options *options = &job->result[0].options;
    double *value = session_keep(job->session, (size_t)options->constraint_count, (size_t)dim * sizeof *value);
    page->constraint_points = value;
    for (pia_index i = 0; i < options->constraint_count; i++) {
        const pia_constraint *c = &options->constraints[i];
        if (c->derivative[0] || c->derivative[1] || !c->value) continue;
        memcpy(value + page->constraint_point_count++ * dim, c->value, (size_t)dim * sizeof *value);
    }
    page->met = options->interpolate;
    page->met_count = options->interpolate_count;
    page->corners = job->result[0].recording.corners;
    page->corner_count = job->result[0].recording.corner_count;
}

/* The list counts control points as the report does: closed directions without the repeated ones, which a model has. */
static void gather_unsupported(const struct fit_result *result, const pia_model *model, pia_page_options *page)
{
    pia_model_info info = {.struct_size = sizeof info};
    pia_report report = {.struct_size = sizeof report};
    pia_model_get_info(model, &info);
    if (!pia_model_report(model, &report) || report.control_count != info.control[0] * info.control[1]) return;
    page->unsupported = result->recording.unsupported;
    page->unsupported_count = result->recording.unsupported_count;
}

pia_status fit_report_write(struct fit_job *job, const pia_model *const *models)
{
    const struct fit_request *request = job->request;
    const struct fit_result *first = &job->result[0];
    pia_page_options page;
    pia_index count;
    pia_points_info shown = fit_points_shown(job, &count);
    pia_page_options_init(&page);
    page.source = request->source.path;
    page.command = request->command;
    page.tolerance = request->options.tolerance;
    page.setting_count = fit_settings(job, &page.settings);
    page.trace = first->recording.row;
    page.trace_count = first->recording.row_count;
    gather_frames(job, &page);
    if (count) {
        page.rows = name_rows(job, count);
        page.parameters = job->part_done == 1 ? first->recording.parameters : NULL;
        gather_conditions(job, shown.dim, &page);
        gather_unsupported(first, models[0], &page);
    }
    return pia_page_write(job->session->context, request->report, models, job->part_done, count ? shown.points : NULL, count, &page);
}
