/* --order: the points of a curve, part by part, as they stand along it. */
#include <string.h>

#include "fit_job.h"
#include "order_hint.h"

static int check_request(const struct fit_job *job)
{
    const struct fit_request *request = job->request;
    if (job->kind != PIA_CURVE) return fail(EXIT_USAGE, "--order %s: is for curves; leave it out for a surface", request->order);
    if (request->function_graph)
        return fail(EXIT_USAGE, "--order %s: a function graph is ordered by its parameter; leave it out", request->order);
    if (job->points.weights)
        return fail(EXIT_USAGE, "--order %s: weights from a column stay with their rows; give them as a file", request->order);
    return EXIT_DONE;
}

static void tell(struct fit_job *job, const struct row_span *span, const pia_order_report *report)
{
    struct fit_request *request = job->request;
    if (report->break_count)
        session_warn(job->session,
                     strcmp(request->order, "tree") == 0
                         ? "--order tree: the points branch %lld times, farthest at row %lld, over %g; they may be no single curve"
                         : "--order nearest: the order jumps %lld times, farthest behind row %lld, over %g; --order tree may do better",
                     (long long)report->break_count, (long long)row_in_file(span, report->break_row), report->break_length);
    if (!report->closed || request->closed) return;
    session_warn(job->session, "--order %s: the ends are neighbours, so the curve is closed", request->order);
    request->options.closed[0] = 1;
}

/* Rows of one part of points and of row, the number in the file. */
static int order_part(struct fit_job *job, pia_index part, double *points, pia_index *row)
{
    const pia_points_info *info = &job->points.info;
    struct row_span span = points_span(&job->points, part);
    const double *from = info->points + span.first * info->dim;
    pia_order_report report = {.struct_size = sizeof report};
    pia_index *order = session_keep(job->session, (size_t)span.count, sizeof *order);
    pia_status status = pia_points_order(job->session->context, from, span.count, info->dim, job->request->order, order, &report);
    int code = session_check(job->session, status, job->request->source.path);
    if (code) return code;
    tell(job, &span, &report);
    for (pia_index i = 0; i < span.count; i++) {
        memcpy(points + (span.first + i) * info->dim, from + order[i] * info->dim, (size_t)info->dim * sizeof *points);
        row[span.first + i] = row_in_file(&span, order[i]);
    }
    return EXIT_DONE;
}

static void hint(struct fit_job *job)
{
    const pia_points_info *info = &job->points.info;
    for (pia_index k = 0; k < job->part_count && !job->request->function_graph; k++) {
        struct row_span span = points_span(&job->points, job->part_first + k);
        double ratio = order_ratio(job->session, info->points + span.first * info->dim, span.count, info->dim);
        if (ratio >= ORDER_LOOKS_RANDOM)
            session_warn(job->session,
                         "the way through the points is %.3g times as long as their spanning tree: they seem to be in no order; "
                         "--order tree finds one",
                         ratio);
    }
}

int fit_order(struct fit_job *job)
{
    pia_points_info *info = &job->points.info;
    int given = !job->request->order || strcmp(job->request->order, "given") == 0;
    if (given) {
        if (job->kind == PIA_CURVE) hint(job);
        return EXIT_DONE;
    }
    int code = check_request(job);
    if (code) return code;
    double *points = session_keep(job->session, (size_t)info->count[0], (size_t)info->dim * sizeof *points);
    pia_index *row = session_keep(job->session, (size_t)info->count[0], sizeof *row);
    memcpy(points, info->points, (size_t)(info->count[0] * info->dim) * sizeof *points);
    for (pia_index i = 0; i < info->count[0]; i++) row[i] = info->row ? info->row[i] : i;
    for (pia_index k = 0; !code && k < job->part_count; k++) code = order_part(job, job->part_first + k, points, row);
    info->points = points;
    info->row = row;
    job->points.any_order = 1;
    return code;
}
