#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "command.h"
#include "file_name.h"
#include "holes.h"
#include "json_writer.h"
#include "model_source.h"
#include "number_file.h"
#include "point_source.h"
#include "registry.h"
#include "stored_parameters.h"

struct request {
    struct session *session;
    struct point_source source;
    const char *model, *parameters, *model_format, *output;
    double tolerance;
    int foot_points;
};

enum { KEY_PARAM = 0x400, KEY_FOOT_POINTS, KEY_TOLERANCE, KEY_FORMAT };

static const struct argp_option options[] = {
    {NULL, 0, NULL, 0, "What is measured:", 20},
    {"param", KEY_PARAM, "NAME|FILE", 0, "deviation at these parameters (default: those of the fit, where the model has them)", 0},
    {"foot-points", KEY_FOOT_POINTS, NULL, 0, "distance to the closest point of the model", 0},
    {"tolerance", KEY_TOLERANCE, "T", 0, "exit with 1 when a point deviates more", 0},
    {"output", 'o', "FILE", 0, "the deviation of each point, one a row, .csv or .npy", 0},
    {"format", KEY_FORMAT, "NAME", 0, "format of the model, whatever it is called", 0},
    {0}};

static error_t parse(int key, char *arg, struct argp_state *state)
{
    struct request *request = state->input;
    switch (key) {
    case KEY_PARAM: request->parameters = arg; return 0;
    case KEY_FOOT_POINTS: request->foot_points = 1; return 0;
    case KEY_TOLERANCE: return option_number("--tolerance", arg, 0, &request->tolerance);
    case KEY_FORMAT: request->model_format = arg; return 0;
    case 'o': request->output = arg; return 0;
    case ARGP_KEY_INIT:
        state->child_inputs[0] = &request->source;
        state->child_inputs[1] = request->session;
        return 0;
    case ARGP_KEY_ARG:
        if (request->source.path) return usage_error("a model and a file of points are enough; '%s' is one too many", arg);
        *(request->model ? &request->source.path : &request->model) = arg;
        return 0;
    case ARGP_KEY_END:
        if (!request->source.path) return usage_error("a model and points are needed; write 'pia check MODEL POINTS'");
        if (request->parameters && request->foot_points) return usage_error("--param contradicts --foot-points; choose one");
        return 0;
    default: return ARGP_ERR_UNKNOWN;
    }
}

static const struct argp_child children[] = {{&point_source_argp, 0, NULL, 0}, {&common_argp, 0, NULL, 0}, {0}};
static const char manual[] =
    "How far points deviate from a model.\v"
    "Without --param the parameters stored in the model are used when it was fitted to as many points; else the\n"
    "closest points of the model are found.\n"
    "\n"
    "Examples:\n"
    "  pia check model.json points.csv\n"
    "  pia check model.json points.csv --foot-points --tolerance 0.01 --json\n"
    "  pia check surface.json grid.csv --grid 11x11 -o deviations.csv";
static const struct argp argp = {options, parse, "MODEL POINTS", manual, children, NULL, NULL};

static int file_parameters(struct request *request, const char *file, const struct point_set *points, int directions,
                           const double **out)
{
    struct numbers numbers;
    int code = numbers_read(request->session, file, &numbers);
    if (code) return code;
    const pia_index *count = points->info.count, all = count[0] * count[1], wanted = all * directions;
    *out = numbers.value;
    if (numbers.count == wanted) return EXIT_DONE;
    if (points->info.kind != PIA_GRID || numbers.count != count[0] + count[1])
        return fail(EXIT_DATA, "%s: holds %lld numbers, but %lld points need %lld; write a row for each point", file,
                    (long long)numbers.count, (long long)all, (long long)wanted);
    *out = grid_parameters(request->session, numbers.value, numbers.value + count[0], count);
    return EXIT_DONE;
}

/* NULL stands for foot points. */
static int find_parameters(struct request *request, const struct point_set *points, const pia_model *model, const double **out)
{
    const char *file;
    pia_model_info info = {.struct_size = sizeof info};
    pia_model_get_info(model, &info);
    *out = NULL;
    if (info.dim != points->info.dim)
        return fail(EXIT_DATA, "%s: points have %d components, the model has %d; choose with --columns", request->source.path,
                    points->info.dim, info.dim);
    if (request->foot_points) return EXIT_DONE;
    if (!request->parameters) {
        *out = stored_parameters(request->session, model, &points->info);
        return EXIT_DONE;
    }
    int code = name_or_file(request->session, "--param", "parametrization", request->parameters, &file);
    if (code) return code;
    if (file) return file_parameters(request, file, points, info.directions, out);
    pia_status status = named_parameters(request->session, model, &points->info, request->parameters, out);
    if (status == PIA_OK && !*out)
        return fail(EXIT_DATA, "%s: points repeat and have no parameters of their own; use --foot-points", request->source.path);
    return session_check(request->session, status, request->source.path);
}

/* ---- Results ---- */

static void print_text(const pia_deviation *deviation, pia_index row)
{
    printf("points       %lld\n", (long long)deviation->point_count);
    printf("max error    %.6g at row %lld (%s)\n", deviation->max_error, (long long)row,
           deviation->foot_points ? "distance to the closest point" : "at the parameters");
    printf("rms error    %.6g\n", deviation->rms_error);
    printf("percentiles  50 %%: %.6g, 90 %%: %.6g, 99 %%: %.6g\n", deviation->percentile[0], deviation->percentile[1],
           deviation->percentile[2]);
}

static void print_json(const pia_deviation *deviation, pia_index row)
{
    struct json_writer json = {.stream = stdout};
    json_open(&json, NULL, '{');
    json_count(&json, "point_count", deviation->point_count);
    json_number(&json, "max_error", deviation->max_error);
    json_count(&json, "max_error_index", row);
    json_number(&json, "rms_error", deviation->rms_error);
    json_open(&json, "percentiles", '{');
    json_number(&json, "50", deviation->percentile[0]);
    json_number(&json, "90", deviation->percentile[1]);
    json_number(&json, "99", deviation->percentile[2]);
    json_close(&json, '}');
    json_text(&json, "measure", deviation->foot_points ? "foot-points" : "parametric");
    json_close(&json, '}');
    json_end(&json);
}

/* Distances of the solid points to the places of all; holes have none. */
static void spread_distances(double *distances, pia_index all, const struct solid *solid)
{
    pia_index left = solid->count;
    for (pia_index i = all; i-- > 0;) distances[i] = left > 0 && solid->row[left - 1] == i ? distances[--left] : NAN;
}

static int measure(struct request *request, const struct point_set *points, const pia_model *model, pia_deviation *out,
                   double *distances)
{
    struct session *session = request->session;
    const pia_points_info *info = &points->info;
    const double *parameters;
    int code = find_parameters(request, points, model, &parameters);
    if (code) return code;
    struct solid solid = points_without_holes(session, info, parameters);
    *out = (pia_deviation){.struct_size = sizeof *out};
    code = session_check(session,
                         pia_model_deviation(session->context, model, solid.points, solid.count, solid.parameters, out, distances),
                         request->source.path);
    if (code || !solid.row) return code;
    spread_distances(distances, info->count[0] * info->count[1], &solid);
    out->max_error_index = solid.row[out->max_error_index];
    return EXIT_DONE;
}

static int compare(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Percentile by rank: the least distance that so many percent of the points do not exceed. */
static void find_percentiles(struct session *session, const double *distances, pia_index count, double out[3])
{
    static const double share[3] = {0.5, 0.9, 0.99};
    double *sorted = session_keep(session, (size_t)count, sizeof *sorted);
    memcpy(sorted, distances, (size_t)count * sizeof *sorted);
    qsort(sorted, (size_t)count, sizeof *sorted, compare);
    for (int k = 0; k < 3; k++) out[k] = sorted[(pia_index)ceil(share[k] * (double)count) - 1];
}

/* Each part against its own model, told as one. Indices are those of all points. */
static int measure_parts(struct request *request, const struct point_set *points, const struct model_set *models, pia_deviation *out,
                         double *distances)
{
    double squares = 0;
    *out = (pia_deviation){.max_error = -1};
    for (pia_index k = 0; k < models->count; k++) {
        pia_index first = points->info.part[k];
        struct point_set set = points_of_part(points, k);
        pia_deviation part;
        int code = measure(request, &set, models->model[k], &part, distances + first);
        if (code) return code;
        out->point_count += part.point_count;
        out->foot_points |= part.foot_points;
        squares += part.rms_error * part.rms_error * (double)part.point_count;
        if (part.max_error > out->max_error) {
            out->max_error = part.max_error;
            out->max_error_index = first + part.max_error_index;
        }
    }
    out->rms_error = sqrt(squares / (double)out->point_count);
    find_percentiles(request->session, distances, out->point_count, out->percentile);
    return EXIT_DONE;
}

static int write_distances(struct request *request, const double *distances, pia_index count)
{
    const char *path = request->output;
    if (!path) return EXIT_DONE;
    pia_status status = pia_table_write(request->session->context, path, format_of(path, NULL, "csv"), NULL, distances, count, 1);
    return session_check(request->session, status, path);
}

static int check(struct request *request, const struct point_set *points, const struct model_set *models)
{
    struct session *session = request->session;
    pia_index part = request->source.part;
    struct row_span span = points_span(points, part);
    double *distances = session_keep(session, (size_t)span.count, sizeof *distances);
    pia_deviation deviation;
    const pia_model *model;
    int code, parted = part == PIA_AUTO && models->count > 1 && models->count == points->info.part_count;
    if (parted)
        code = measure_parts(request, points, models, &deviation, distances);
    else {
        struct point_set set = points_of_part(points, part);
        code = models_choose(models, models->count == 1 ? 0 : part, &model);
        if (!code) code = measure(request, &set, model, &deviation, distances);
    }
    if (!code) code = write_distances(request, distances, span.count);
    if (code) return code;
    (session->json ? print_json : print_text)(&deviation, row_in_file(&span, deviation.max_error_index));
    return request->tolerance > 0 && !(deviation.max_error <= request->tolerance) ? EXIT_TOLERANCE : EXIT_DONE;
}

int cmd_check(struct session *session, int argc, char **argv)
{
    struct request request = {.session = session};
    struct model_set models = {0};
    struct point_set points = {0};
    point_source_init(&request.source, session);
    int code = arguments_parse(session, "check", &argp, argc, argv, &request);
    if (!code && request.output) code = output_check(request.output);
    if (!code) code = session_open(session);
    if (!code) code = models_open(session, request.model, request.model_format, &models);
    if (!code) code = points_open(&request.source, &points);
    if (!code) code = check(&request, &points, &models);
    points_close(&points);
    models_close(&models);
    return code;
}
