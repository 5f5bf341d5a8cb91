#include <string.h>
#include <unistd.h>

#include "arguments.h"
#include "command.h"
#include "file_name.h"
#include "json_writer.h"
#include "model_source.h"
#include "number_file.h"

struct request {
    struct session *session;
    const char *model, *at, *output, *input_format, *output_format;
    pia_index samples[2], part, derivative;
    int curvature, heading;
};

enum { KEY_SAMPLES = 0x400, KEY_AT, KEY_DERIVATIVE, KEY_CURVATURE, KEY_HEADING, KEY_PART, KEY_FORMAT, KEY_INPUT_FORMAT };

static const struct argp_option options[] = {
    {NULL, 0, NULL, 0, "Where and what:", 10},
    {"samples", KEY_SAMPLES, "N[,M]", 0, "equally spaced parameters (default 101; a surface 33 x 33)", 0},
    {"at", KEY_AT, "LIST|FILE", 0, "at these parameters: 0,0.5,1 (a surface: u,v,u,v,...), or a file with one or two a row", 0},
    {"derivative", KEY_DERIVATIVE, "K", 0, "the derivatives up to order K after the point; a surface: Su, Sv, Suu, Suv, Svv, ...", 0},
    {"curvature", KEY_CURVATURE, NULL, 0, "the curvature as last column; a surface: mean and Gaussian", 0},
    {"part", KEY_PART, "K", 0, "model K, from 0, of a file with several", 0},
    {NULL, 0, NULL, 0, "Output:", 20},
    {"output", 'o', "FILE", 0, "table to write, .csv or .npy (default: standard output)", 0},
    {"header", KEY_HEADING, NULL, 0, "begin with a line of column names", 0},
    {"format", KEY_FORMAT, "NAME", 0, "format of the table, whatever it is called", 0},
    {"input-format", KEY_INPUT_FORMAT, "NAME", 0, "format of the model, whatever it is called", 0},
    {0}};

static error_t parse(int key, char *arg, struct argp_state *state)
{
    struct request *request = state->input;
    switch (key) {
    case KEY_SAMPLES: return option_pair("--samples", arg, 1, request->samples);
    case KEY_AT: request->at = arg; return 0;
    case KEY_DERIVATIVE: return option_count("--derivative", arg, 0, &request->derivative);
    case KEY_CURVATURE: request->curvature = 1; return 0;
    case KEY_PART: return option_count("--part", arg, 0, &request->part);
    case 'o': request->output = arg; return 0;
    case KEY_HEADING: request->heading = 1; return 0;
    case KEY_FORMAT: request->output_format = arg; return 0;
    case KEY_INPUT_FORMAT: request->input_format = arg; return 0;
    case ARGP_KEY_INIT: state->child_inputs[0] = request->session; return 0;
    case ARGP_KEY_ARG:
        if (request->model) return usage_error("only one model can be evaluated; '%s' is one too many", arg);
        request->model = arg;
        return 0;
    case ARGP_KEY_END:
        if (!request->model) return usage_error("no model to evaluate; write 'pia eval MODEL'");
        if (request->samples[0] && request->at) return usage_error("--samples contradicts --at; choose one");
        if (request->derivative > PIA_MAX_DEGREE) return usage_error("--derivative: at most %d; lower it", PIA_MAX_DEGREE);
        return 0;
    default: return ARGP_ERR_UNKNOWN;
    }
}

static const struct argp_child children[] = {{&common_argp, 0, NULL, 0}, {0}};
static const char manual[] = "Points, derivatives and curvature of a model, one row a parameter: u[,v],x,y,z,...\v"
                             "Examples:\n"
                             "  pia eval model.json --samples 500 -o curve.csv\n"
                             "  pia eval model.json --at 0,0.5,1 --derivative 2 --header\n"
                             "  pia eval surface.json --samples 50,80 -o mesh.npy";
static const struct argp argp = {options, parse, "MODEL", manual, children, NULL, NULL};

/* ---- Parameters ---- */

static double spaced(const double domain[2], pia_index index, pia_index count)
{
    if (count == 1) return 0.5 * (domain[0] + domain[1]);
    return index == count - 1 ? domain[1] : domain[0] + (domain[1] - domain[0]) * ((double)index / (double)(count - 1));
}

static int space_parameters(struct request *request, const pia_model_info *info, double **out, pia_index *count)
{
    int surface = info->directions == 2;
    pia_index nu = request->samples[0] ? request->samples[0] : surface ? 33 : 101;
    pia_index nv = !surface ? 1 : request->samples[0] ? request->samples[1] : 33;
    if (__builtin_mul_overflow(nu, nv, count)) return fail(EXIT_USAGE, "--samples: too many; use fewer");
    double *to = *out = session_keep(request->session, (size_t)*count, (size_t)info->directions * sizeof *to);
    for (pia_index i = 0; i < nu; i++)
        for (pia_index j = 0; j < nv; j++) {
            *to++ = spaced(info->domain[0], i, nu);
            if (surface) *to++ = spaced(info->domain[1], j, nv);
        }
    return EXIT_DONE;
}

/* "0,0.5,1"; 0 when it is no list of numbers. */
static int list_parameters(struct request *request, double **out, pia_index *count)
{
    char *copy = session_text(request->session, "%s", request->at), *rest = copy, *word;
    double *value = *out = session_keep(request->session, strlen(copy) / 2 + 1, sizeof *value);
    for (*count = 0; (word = strsep(&rest, ","));)
        if (!text_is_number(word, &value[(*count)++])) return 0;
    return 1;
}

static int read_parameters(struct request *request, const pia_model_info *info, double **out, pia_index *count)
{
    if (!request->at) return space_parameters(request, info, out, count);
    if (!list_parameters(request, out, count)) {
        struct numbers numbers;
        if (strcmp(request->at, "-") != 0 && access(request->at, F_OK) != 0 && !strpbrk(request->at, "./"))
            return fail(EXIT_USAGE, "--at: '%s' is neither a list nor a file; write 0,0.5,1", request->at);
        int code = numbers_read(request->session, request->at, &numbers);
        if (code) return code;
        *out = numbers.value;
        *count = numbers.count;
    }
    if (*count % info->directions) return fail(EXIT_DATA, "--at: a surface needs pairs u,v; %lld numbers are none", (long long)*count);
    *count /= info->directions;
    return EXIT_DONE;
}

static void tell_outside(const struct request *request, const pia_model_info *info, const double *at, pia_index rows)
{
    pia_index outside = 0;
    for (pia_index i = 0; i < rows * info->directions; i++) {
        const double *domain = info->domain[i % info->directions];
        outside += at[i] < domain[0] || at[i] > domain[1];
    }
    if (outside)
        session_warn(request->session, "%lld parameters outside the domain were taken at its nearest end; 'pia info %s' tells it",
                     (long long)outside, request->model);
}

/* ---- The table ---- */

struct table {
    double *value;
    pia_index rows;
    int columns;
    const char *heading;
};

/* Orders of the derivatives of a surface: S, Su, Sv, Suu, Suv, Svv, ...; of a curve: 0, 1, 2, ... */
static const char *name_columns(struct session *session, const struct request *request, const pia_model_info *info)
{
    int surface = info->directions == 2;
    const char *names = surface ? "u,v" : "u";
    for (int order = 0; order <= request->derivative; order++)
        for (int in_v = 0; in_v <= (surface ? order : 0); in_v++)
            for (int k = 0; k < info->dim; k++) {
                const char *axis = info->dim <= 3 ? session_text(session, "%c", "xyz"[k]) : session_text(session, "x%d", k + 1);
                const char *suffix = order ? "_" : "";
                for (int d = 0; d < order; d++) suffix = session_text(session, "%s%c", suffix, d < order - in_v ? 'u' : 'v');
                names = session_text(session, "%s,%s%s", names, axis, suffix);
            }
    if (!request->curvature) return names;
    return session_text(session, "%s,%s", names, surface ? "mean_curvature,gaussian_curvature" : "curvature");
}

static int build_table(struct request *request, const pia_model *model, struct table *out)
{
    struct session *session = request->session;
    pia_model_info info = {.struct_size = sizeof info};
    pia_model_get_info(model, &info);
    double *at = NULL;
    int code = read_parameters(request, &info, &at, &out->rows);
    if (code || !at) return code;
    tell_outside(request, &info, at, out->rows);
    pia_index rows = out->rows, K = request->derivative;
    int per_point = info.dim * (int)(info.directions == 1 ? K + 1 : (K + 1) * (K + 2) / 2), d = info.directions;
    int bent = request->curvature ? d : 0;
    double *values = session_keep(session, (size_t)rows, (size_t)per_point * sizeof *values);
    double *curvature = session_keep(session, (size_t)rows, (size_t)bent * sizeof *curvature);
    code = session_check(session, pia_model_eval(session->context, model, at, rows, (int)K, values), request->model);
    if (!code && bent) code = session_check(session, pia_model_curvature(session->context, model, at, rows, curvature), request->model);
    if (code) return code;
    out->columns = d + per_point + bent;
    out->value = session_keep(session, (size_t)rows, (size_t)out->columns * sizeof *out->value);
    double *to = out->value;
    for (pia_index i = 0; i < rows; i++, to += out->columns) {
        memcpy(to, at + i * d, (size_t)d * sizeof *to);
        memcpy(to + d, values + i * per_point, (size_t)per_point * sizeof *to);
        memcpy(to + d + per_point, curvature + i * bent, (size_t)bent * sizeof *to);
    }
    out->heading = name_columns(session, request, &info);
    return EXIT_DONE;
}

static void print_json(struct session *session, const struct table *table)
{
    struct json_writer json = {.stream = stdout};
    char *names = session_text(session, "%s", table->heading), *name;
    json_open(&json, NULL, '{');
    json_open(&json, "columns", '[');
    while ((name = strsep(&names, ","))) json_text(&json, NULL, name);
    json_close(&json, ']');
    json_open(&json, "rows", '[');
    for (pia_index i = 0; i < table->rows; i++) json_numbers(&json, NULL, table->value + i * table->columns, table->columns);
    json_close(&json, ']');
    json_close(&json, '}');
    json_end(&json);
}

static int write_table(struct request *request, const struct table *table)
{
    struct session *session = request->session;
    const char *path = request->output ? request->output : "-";
    const char *format = format_of(path, request->output_format, "csv");
    if (session->json && strcmp(path, "-") == 0) {
        print_json(session, table);
        return EXIT_DONE;
    }
    pia_status status = pia_table_write(session->context, path, format, request->heading ? table->heading : NULL, table->value,
                                        table->rows, table->columns);
    int code = session_check(session, status, path);
    if (code || !session->json) return code;
    struct texts outputs = {0};
    session_append(session, &outputs, path);
    json_outputs(stdout, &outputs);
    return EXIT_DONE;
}

int cmd_eval(struct session *session, int argc, char **argv)
{
    struct request request = {.session = session, .part = PIA_AUTO};
    struct model_set models = {0};
    struct table table = {0};
    const pia_model *model;
    int code = arguments_parse(session, "eval", &argp, argc, argv, &request);
    if (!code && request.output) code = output_check(request.output);
    if (!code) code = session_open(session);
    if (!code) code = models_open(session, request.model, request.input_format, &models);
    if (!code) code = models_choose(&models, request.part, &model);
    if (!code) code = build_table(&request, model, &table);
    if (!code) code = write_table(&request, &table);
    models_close(&models);
    return code;
}
