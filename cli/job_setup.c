#include <string.h>

#include "file_name.h"
#include "fit_job.h"
#include "holes.h"
#include "registry.h"

/* ---- Files ---- */

static int decide_kind(struct fit_job *job)
{
    const struct fit_request *request = job->request;
    pia_points_info *info = &job->points.info;
    job->kind = info->kind;
    if (info->kind == PIA_GRID && request->kind == KIND_CURVE)
        return fail(EXIT_USAGE, "%s: is a grid, through which no curve runs; leave out --curve", request->source.path);
    if (request->kind == KIND_SURFACE) {
        struct solid solid = points_without_holes(job->session, info, NULL);
        job->kind = PIA_SCATTERED;
        info->points = solid.points;
        info->count[0] = solid.count;
        info->count[1] = 1;
        if (solid.row) info->row = solid.row;
    }
    if (job->kind != PIA_CURVE && request->function_graph)
        return fail(EXIT_USAGE, "--fit-function is for curves; leave it out for a surface");
    if (job->kind == PIA_CURVE && request->closed && strchr(request->closed, 'v'))
        return fail(EXIT_USAGE, "--closed: a curve has no direction v; write --closed");
    const pia_fit_options *options = &request->options;
    if (job->kind == PIA_CURVE && (options->degree[0] != options->degree[1] || options->control[0] != options->control[1]))
        return fail(EXIT_USAGE,
                    "a curve has one degree and one number of control points; leave out the second, or say --grid or --surface");
    return EXIT_DONE;
}

/* Parameters of a curve and of the two directions of a grid never decrease; those of function graphs and scattered points may. */
static int check_parameters(struct fit_job *job)
{
    const struct numbers *numbers = &job->parameters;
    const pia_points_info *info = &job->points.info;
    if (!numbers->count || job->kind == PIA_SCATTERED) return EXIT_DONE;
    if (job->kind == PIA_CURVE) {
        int code = EXIT_DONE;
        for (pia_index k = 0; !code && k < job->part_count && numbers->count == info->count[0]; k++) {
            struct row_span span = points_span(&job->points, job->part_first + k);
            code = numbers_check_order(job->session, numbers, span.first, span.count, "parameter");
        }
        return code;
    }
    if (numbers->rows != 2 || numbers->first_row != info->count[0] || numbers->count != info->count[0] + info->count[1])
        return fail(EXIT_DATA, "%s: a grid of %lld x %lld needs two rows; write %lld values of u and %lld of v", numbers->path,
                    (long long)info->count[0], (long long)info->count[1], (long long)info->count[0], (long long)info->count[1]);
    int code = numbers_check_order(job->session, numbers, 0, info->count[0], "parameter");
    return code ? code : numbers_check_order(job->session, numbers, info->count[0], info->count[1], "parameter");
}

static int check_knots(struct fit_job *job)
{
    const struct numbers *knots = &job->knots;
    if (!knots->count) return EXIT_DONE;
    if (job->kind == PIA_CURVE) return numbers_check_order(job->session, knots, 0, knots->count, "knot");
    if (knots->rows != 2)
        return fail(EXIT_DATA, "%s: a surface needs two rows of knots, u and v; it has %lld", knots->path, (long long)knots->rows);
    int code = numbers_check_order(job->session, knots, 0, knots->first_row, "knot");
    return code ? code : numbers_check_order(job->session, knots, knots->first_row, knots->count - knots->first_row, "knot");
}

/* Reads the file of an option that takes a name or a file; a name goes to *name. "auto" leaves the choice to the library. */
static int read_named(struct fit_job *job, const char *option, const char *registry, const char *text, const char **name,
                      struct numbers *out)
{
    const char *file;
    if (!text || strcmp(text, "auto") == 0) return EXIT_DONE;
    int code = name_or_file(job->session, option, registry, text, &file);
    if (!code && !file) *name = text;
    return code || !file ? code : numbers_read(job->session, file, out);
}

static int read_files(struct fit_job *job)
{
    struct fit_request *request = job->request;
    struct session *session = job->session;
    int based = request->parameters && is_model_name(request->parameters, NULL);
    int code =
        based ? fit_base_open(job, request->parameters)
              : read_named(job, "--param", "parametrization", request->parameters, &request->options.parametrization, &job->parameters);
    if (!code) code = read_named(job, "--knots", "placement", request->knots, &request->options.placement, &job->knots);
    if (!code && request->weights && !request->source.weights) code = numbers_read(session, request->weights, &job->weights);
    if (!code && request->tolerances) code = numbers_read(session, request->tolerances, &job->tolerances);
    if (!code) code = check_parameters(job);
    return code ? code : check_knots(job);
}

/* --weights is a file where there is one, a column otherwise. */
static void tell_weights(struct fit_request *request)
{
    FILE *file = request->weights ? fopen(request->weights, "r") : NULL;
    if (file)
        fclose(file);
    else
        request->source.weights = request->weights;
}

int fit_inputs_open(struct fit_job *job)
{
    struct fit_request *request = job->request;
    tell_weights(request);
    int code = points_open(&request->source, &job->points);
    if (code) return code;
    int all = request->source.part == PIA_AUTO || job->points.info.kind != PIA_CURVE;
    job->part_first = all ? 0 : request->source.part;
    job->part_count = all ? job->points.info.part_count : 1;
    code = decide_kind(job);
    if (!code) code = fit_order(job);
    if (job->kind != PIA_CURVE) job->part_count = 1;
    if (!code) code = read_files(job);
    if (!code && job->points.info.skipped)
        session_warn(job->session, "%s: %lld invalid rows were dropped", request->source.path, (long long)job->points.info.skipped);
    if (code) fit_inputs_close(job);
    return code;
}

void fit_inputs_close(struct fit_job *job)
{
    points_close(&job->points);
}

/* ---- One task ---- */

/* The `width` numbers a row of the span, from a file that has them for every row of the points or for every row kept. */
static int choose_rows(struct fit_job *job, const struct numbers *numbers, const struct row_span *span, pia_index width,
                       const char *what, const double **out)
{
    if (!numbers->count) return EXIT_DONE;
    pia_index kept = job->points.info.count[0] * job->points.info.count[1];
    pia_index wanted = kept * width;
    if (numbers->count == wanted && !span->any_order) {
        *out = numbers->value + span->first * width;
        return EXIT_DONE;
    }
    if (numbers->count != span->total * width)
        return fail(EXIT_DATA, "%s: holds %lld numbers, but %lld points need %lld %s; write a row for each point", numbers->path,
                    (long long)numbers->count, (long long)kept, (long long)wanted, what);
    double *chosen = session_keep(job->session, (size_t)span->count, (size_t)width * sizeof *chosen);
    for (pia_index i = 0; i < span->count; i++)
        memcpy(chosen + i * width, numbers->value + row_in_file(span, i) * width, (size_t)width * sizeof *chosen);
    *out = chosen;
    return EXIT_DONE;
}

static int fill_data(struct fit_job *job, struct fit_task *task)
{
    const pia_points_info *info = &job->points.info;
    pia_data *data = &task->data;
    pia_data_init(data);
    data->kind = job->kind;
    data->dim = info->dim;
    data->points = info->points + task->span.first * info->dim;
    data->count[0] = job->kind == PIA_CURVE ? task->span.count : info->count[0];
    data->count[1] = info->count[1];
    data->function_graph = job->request->function_graph;
    if (job->points.weights) data->weights = job->points.weights + task->span.first;
    int code = choose_rows(job, &job->weights, &task->span, 1, "weights", &data->weights);
    if (!code) code = choose_rows(job, &job->tolerances, &task->span, 1, "tolerances", &data->tolerances);
    if (code) return code;
    if (job->kind == PIA_GRID) {
        data->parameters = job->parameters.value;
        return EXIT_DONE;
    }
    return choose_rows(job, &job->parameters, &task->span, job->kind == PIA_SCATTERED ? 2 : 1, "parameters", &data->parameters);
}

static int fill_conditions(struct fit_job *job, struct fit_task *task)
{
    const struct fit_request *request = job->request;
    struct session *session = job->session;
    pia_fit_options *options = &task->options;
    struct index_list list = {NULL, 0};
    int code = EXIT_DONE;
    if (request->interpolate) code = index_list_read(session, "--interpolate", request->interpolate, &task->span, &list);
    options->interpolate = list.item;
    options->interpolate_count = list.count;
    if (!code && request->constraints)
        code = constraint_file_read(session, request->constraints, &task->span, task->data.dim, &task->constraints);
    options->constraints = task->constraints.constraint;
    options->constraint_count = task->constraints.constraint_count;
    options->joins = task->constraints.join;
    options->join_count = task->constraints.join_count;
    if (code || !request->corners) return code;
    if (strcmp(request->corners, "auto") == 0 || strcmp(request->corners, "none") == 0) {
        options->corner_count = strcmp(request->corners, "auto") == 0 ? PIA_AUTO : 0;
        return EXIT_DONE;
    }
    code = index_list_read(session, "--corners", request->corners, &task->span, &list);
    options->corners = list.item;
    options->corner_count = list.count;
    return code;
}

/* "ends" and "every:K" need the number of control points, so they need --control. */
static int fill_freeze(struct fit_job *job, struct fit_task *task)
{
    const struct fit_request *request = job->request;
    pia_fit_options *options = &task->options;
    if (!request->freeze) return EXIT_DONE;
    int surface = job->kind != PIA_CURVE, counted = options->control[0] != PIA_AUTO;
    pia_index count = counted ? options->control[0] * (surface ? options->control[1] : 1) : INT32_MAX;
    if (!counted && strpbrk(request->freeze, "ey"))
        return fail(EXIT_USAGE, "--freeze %s: needs --control, which says how many there are", request->freeze);
    struct row_span span = {.count = count, .total = count};
    struct index_list list;
    int code = index_list_read(job->session, "--freeze", request->freeze, &span, &list);
    if (code) return code;
    options->freeze = list.item;
    options->freeze_count = list.count;
    return EXIT_DONE;
}

static void fill_knots(const struct fit_job *job, pia_fit_options *options)
{
    const struct numbers *knots = &job->knots;
    if (!knots->count) return;
    int surface = job->kind != PIA_CURVE;
    options->knots[0] = knots->value;
    options->knot_count[0] = surface ? knots->first_row : knots->count;
    options->knots[1] = surface ? knots->value + knots->first_row : NULL;
    options->knot_count[1] = surface ? knots->count - knots->first_row : 0;
}

static int open_start(struct fit_job *job, pia_index part, struct fit_task *task)
{
    const char *path = job->request->start;
    if (!path) return EXIT_DONE;
    int code = session_check(job->session, pia_model_read(job->session->context, path, NULL, &task->start, &task->start_count), path);
    if (code) return code;
    if (task->start_count != 1 && part >= task->start_count)
        return fail(EXIT_DATA, "%s: holds %lld models, none for part %lld; give one model, or one for each part", path,
                    (long long)task->start_count, (long long)part);
    task->options.start = task->start[task->start_count == 1 ? 0 : part];
    return EXIT_DONE;
}

int fit_task_open(struct fit_job *job, pia_index part, struct fit_task *out)
{
    const struct fit_request *request = job->request;
    *out = (struct fit_task){.span = points_span(&job->points, job->kind == PIA_CURVE ? part : PIA_AUTO), .options = request->options};
    pia_fit_options *options = &out->options;
    options->method_options = request->method_options.item;
    options->method_option_count = request->method_options.count;
    options->limiter_options = request->shape_options.item;
    options->limiter_option_count = request->shape_options.count;
    options->progress = progress_tell;
    options->user = &job->progress;
    if (request->trace && !options->trace_every) options->trace_every = 1;
    if (job->kind == PIA_CURVE) options->control[1] = PIA_AUTO;
    fill_knots(job, options);
    int code = fill_data(job, out);
    if (!code) code = fill_conditions(job, out);
    if (!code) code = fill_freeze(job, out);
    if (!code) code = open_start(job, part, out);
    if (code) fit_task_close(out);
    return code;
}

void fit_task_close(struct fit_task *task)
{
    constraint_file_close(&task->constraints);
    pia_models_destroy(task->start, task->start_count);
    task->start = NULL;
    task->start_count = 0;
}
