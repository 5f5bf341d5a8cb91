#include <string.h>

#include "command.h"
#include "file_name.h"
#include "holes.h"
#include "json_writer.h"
#include "model_source.h"
#include "point_source.h"
#include "stored_parameters.h"

struct request {
    struct session *session;
    struct point_source source;
    const char *model, *model_format, *trace;
    struct texts outputs;
    pia_plot_options options;
    const char *command; /* the command line, as a shell takes it */
};

enum {
    KEY_COMB = 0x400,
    KEY_NO_CONTROL,
    KEY_NO_KNOTS,
    KEY_NO_DEVIATION,
    KEY_TRACE,
    KEY_SIZE,
    KEY_VIEW,
    KEY_TITLE,
    KEY_FORMAT,
    KEY_MODEL_FORMAT
};

static const struct argp_option options[] = {
    {NULL, 0, NULL, 0, "The picture:", 20},
    {"output", 'o', "FILE", 0, ".svg, .png, .pdf or .html; repeat for several", 0},
    {"comb", KEY_COMB, NULL, 0, "with the curvature comb", 0},
    {"no-control", KEY_NO_CONTROL, NULL, 0, "without the control polygon or net", 0},
    {"no-knots", KEY_NO_KNOTS, NULL, 0, "without the marks of the knots", 0},
    {"no-deviation", KEY_NO_DEVIATION, NULL, 0, "points in one colour, not coloured by their deviation", 0},
    {"trace", KEY_TRACE, "FILE.csv", 0, "with the history that 'pia fit --trace' wrote", 0},
    {"size", KEY_SIZE, "WxH", 0, "in points of 1/72 inch, pixels for .png", 0},
    {"view", KEY_VIEW, "AZ,EL", 0, "viewing direction in space: azimuth and elevation in degrees", 0},
    {"title", KEY_TITLE, "TEXT", 0, "a title", 0},
    {"format", KEY_FORMAT, "NAME", 0, "svg, png, pdf or html, whatever the file is called", 0},
    {"model-format", KEY_MODEL_FORMAT, "NAME", 0, "format of the model, whatever it is called", 0},
    {0}};

/* Two numbers with one of `between` between them. */
static error_t parse_two(const char *option, const char *arg, const char *between, double *first, double *second)
{
    char text[64];
    size_t length = strcspn(arg, between);
    if (length < sizeof text && arg[length]) {
        memcpy(text, arg, length);
        text[length] = 0;
        if (text_is_number(text, first) && text_is_number(arg + length + 1, second)) return 0;
    }
    return usage_error("%s: '%s' is no pair of numbers; write two with '%c' between", option, arg, between[0]);
}

static error_t parse_size(struct request *request, const char *arg)
{
    pia_plot_options *plot = &request->options;
    if (parse_two("--size", arg, "x,", &plot->width, &plot->height)) return ERROR_IS_TOLD;
    int fits = plot->width >= 16 && plot->height >= 16 && plot->width <= 20000 && plot->height <= 20000;
    return fits ? 0 : usage_error("--size: %s is out of range; 16 to 20000", arg);
}

static error_t parse_look(struct request *request, int key, const char *arg)
{
    pia_plot_options *plot = &request->options;
    switch (key) {
    case KEY_COMB: plot->comb = 1; return 0;
    case KEY_NO_CONTROL: plot->control = 0; return 0;
    case KEY_NO_KNOTS: plot->knots = 0; return 0;
    case KEY_NO_DEVIATION: plot->deviation = 0; return 0;
    case KEY_SIZE: return parse_size(request, arg);
    case KEY_VIEW: return parse_two("--view", arg, ",", &plot->azimuth, &plot->elevation);
    case KEY_TITLE: plot->title = arg; return 0;
    case KEY_FORMAT: plot->format = arg; return 0;
    default: return ARGP_ERR_UNKNOWN;
    }
}

static error_t parse(int key, char *arg, struct argp_state *state)
{
    struct request *request = state->input;
    switch (key) {
    case 'o': session_append(request->session, &request->outputs, arg); return 0;
    case KEY_TRACE: request->trace = arg; return 0;
    case KEY_MODEL_FORMAT: request->model_format = arg; return 0;
    case ARGP_KEY_INIT:
        state->child_inputs[0] = &request->source;
        state->child_inputs[1] = request->session;
        return 0;
    case ARGP_KEY_ARG:
        if (request->source.path) return usage_error("a model and a file of points are enough; '%s' is one too many", arg);
        *(request->model ? &request->source.path : &request->model) = arg;
        return 0;
    case ARGP_KEY_END:
        if (!request->model || !request->outputs.count) return usage_error("write 'pia plot MODEL [POINTS] -o FILE.svg'");
        return 0;
    default: return parse_look(request, key, arg);
    }
}

static const struct argp_child children[] = {{&point_source_argp, 0, NULL, 0}, {&common_argp, 0, NULL, 0}, {0}};
static const char manual[] =
    "A picture of a model with the points it stands for: curve, knots, control polygon, deviation in colours; a\n"
    "surface as a shaded wireframe. A file .html is the interactive report, which shows whatever its reader asks.\v"
    "Examples:\n"
    "  pia plot model.json points.csv -o picture.svg\n"
    "  pia plot model.json --comb --no-control -o comb.pdf\n"
    "  pia plot model.json points.csv -o report.html\n"
    "  pia plot surface.json grid.csv --grid 11x11 --view 30,40 --size 1200x900 -o view.png";
static const struct argp argp = {options, parse, "MODEL [POINTS]", manual, children, NULL, NULL};

static int read_trace(struct request *request)
{
    enum { COLUMNS = 7 };
    struct session *session = request->session;
    pia_points_options wanted;
    pia_points *table;
    pia_points_info info = {.struct_size = sizeof info};
    if (!request->trace) return EXIT_DONE;
    pia_points_options_init(&wanted);
    wanted.allow_nan = 1;
    int code = session_check(session, pia_points_read(session->context, request->trace, &wanted, &table), request->trace);
    if (code) return code;
    pia_points_get_info(table, &info);
    pia_trace_row *rows = session_keep(session, (size_t)info.count[0], sizeof *rows);
    if (info.dim != COLUMNS) code = fail(EXIT_DATA, "%s: is no trace; 'pia fit --trace FILE.csv' writes one", request->trace);
    for (pia_index i = 0; !code && i < info.count[0]; i++) {
        const double *row = info.points + i * COLUMNS;
        rows[i] = (pia_trace_row){(pia_index)row[0], (pia_index)row[1], row[2], row[3], row[4], row[5], row[6]};
    }
    request->options.trace = rows;
    request->options.trace_count = info.count[0];
    pia_points_destroy(table);
    return code;
}

/* A page tells more than a picture: where its points are from, what each is called, and how it was made. */
static pia_status write_page(const struct request *request, const char *path, const pia_model *const *models, pia_index count,
                             const struct solid *solid, const struct row_span *span)
{
    const pia_plot_options *plot = &request->options;
    pia_page_options page;
    pia_page_options_init(&page);
    page.title = plot->title;
    page.source = request->source.path ? request->source.path : request->model;
    page.command = request->command;
    page.parameters = plot->parameters;
    page.trace = plot->trace;
    page.trace_count = plot->trace_count;
    pia_index *rows = session_keep(request->session, (size_t)solid->count, sizeof *rows);
    for (pia_index i = 0; i < solid->count; i++) rows[i] = row_in_file(span, solid->row ? solid->row[i] : i);
    page.rows = rows;
    return pia_page_write(request->session->context, path, models, count, solid->points, solid->count, &page);
}

static int check_components(const struct request *request, const pia_model *const *models, pia_index count, int dim)
{
    for (pia_index m = 0; m < count; m++) {
        pia_model_info info = {.struct_size = sizeof info};
        pia_model_get_info(models[m], &info);
        if (info.dim != dim)
            return fail(EXIT_DATA, "%s: points have %d components, the model has %d; choose with --columns", request->source.path, dim,
                        info.dim);
    }
    return EXIT_DONE;
}

/* The models and points of one part, or all of them. */
static int draw(struct request *request, const struct model_set *set, const struct point_set *points)
{
    struct session *session = request->session;
    const pia_model *const *models = (const pia_model *const *)set->model, *only = NULL;
    pia_index count = set->count, part = request->source.part;
    int code = EXIT_DONE;
    if (part != PIA_AUTO && set->count > 1) {
        code = models_choose(set, part, &only);
        models = &only;
        count = 1;
    }
    if (code) return code;
    struct solid solid = {.count = 0};
    struct row_span span = {.count = 0};
    if (request->source.path) {
        span = points_span(points, part);
        struct point_set shown = points_of_part(points, part);
        code = check_components(request, models, count, shown.info.dim);
        if (code) return code;
        solid = points_without_holes(session, &shown.info, count == 1 ? stored_parameters(session, models[0], &shown.info) : NULL);
        request->options.parameters = solid.parameters;
    }
    for (pia_index i = 0; !code && i < request->outputs.count; i++) {
        const char *path = request->outputs.item[i];
        pia_status status = is_page(path, request->options.format)
                                ? write_page(request, path, models, count, &solid, &span)
                                : pia_plot(session->context, path, models, count, solid.points, solid.count, &request->options);
        code = session_check(session, status, path);
    }
    return code;
}

int cmd_plot(struct session *session, int argc, char **argv)
{
    struct request request = {.session = session, .command = command_line(session, "plot", argc, argv)};
    struct model_set models = {0};
    struct point_set points = {0};
    point_source_init(&request.source, session);
    pia_plot_options_init(&request.options);
    int code = arguments_parse(session, "plot", &argp, argc, argv, &request);
    for (pia_index i = 0; !code && i < request.outputs.count; i++) code = output_check(request.outputs.item[i]);
    if (!code) code = session_open(session);
    if (!code) code = models_open(session, request.model, request.model_format, &models);
    if (!code && request.source.path) code = points_open(&request.source, &points);
    if (!code) code = read_trace(&request);
    if (!code) code = draw(&request, &models, &points);
    if (!code && session->json) json_outputs(stdout, &request.outputs);
    points_close(&points);
    models_close(&models);
    return code;
}
