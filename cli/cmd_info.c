#include <string.h>
#include <strings.h>

#include "command.h"
#include "file_name.h"
#include "info_model.h"
#include "info_points.h"
#include "stdin_peek.h"

struct request {
    struct session *session;
    struct point_source source;
    const char *format;
    enum { BY_NAME, MODEL, POINTS } as;
};

enum { KEY_MODEL = 0x400, KEY_POINTS, KEY_FORMAT };

static const struct argp_option options[] = {{NULL, 0, NULL, 0, "What the file is:", 20},
                                             {"model", KEY_MODEL, NULL, 0, "a model, whatever the file is called", 0},
                                             {"points", KEY_POINTS, NULL, 0, "points, whatever the file is called", 0},
                                             {"format", KEY_FORMAT, "NAME", 0, "format of the file, whatever it is called", 0},
                                             {0}};

static error_t parse(int key, char *arg, struct argp_state *state)
{
    struct request *request = state->input;
    switch (key) {
    case KEY_MODEL: request->as = MODEL; return 0;
    case KEY_POINTS: request->as = POINTS; return 0;
    case KEY_FORMAT: request->format = arg; return 0;
    case ARGP_KEY_INIT:
        state->child_inputs[0] = &request->source;
        state->child_inputs[1] = request->session;
        return 0;
    case ARGP_KEY_ARG:
        if (request->source.path) return usage_error("one file at a time; '%s' is one too many", arg);
        request->source.path = arg;
        return 0;
    case ARGP_KEY_END:
        if (!request->source.path) return usage_error("no file; write 'pia info FILE'");
        if (!request->source.format) request->source.format = request->format;
        return 0;
    default: return ARGP_ERR_UNKNOWN;
    }
}

static const struct argp_child children[] = {{&point_source_argp, 0, NULL, 0}, {&common_argp, 0, NULL, 0}, {0}};
static const char manual[] = "What a file of points or models holds.\v"
                             "Points: count, parts, components, columns, ranges, spacing, duplicates, whether the curve closes.\n"
                             "Models: degree, control points, knots, domain, bounds, length, and the fit that made them.\n"
                             "\n"
                             "Examples:\n"
                             "  pia info points.csv\n"
                             "  pia info model.json --json";
static const struct argp argp = {options, parse, "FILE", manual, children, NULL, NULL};

/* Others are points unless --model says otherwise. */
static int is_model(const struct request *request)
{
    const char *path = request->source.path;
    if (request->as != BY_NAME) return request->as == MODEL;
    if (strcmp(path, "-") == 0 && !request->format) return stdin_peek() == '{';
    return is_model_name(path, request->format);
}

int cmd_info(struct session *session, int argc, char **argv)
{
    struct request request = {.session = session};
    struct model_set models;
    point_source_init(&request.source, session);
    int code = arguments_parse(session, "info", &argp, argc, argv, &request);
    if (!code) code = session_open(session);
    if (code) return code;
    if (!is_model(&request)) return info_points(&request.source);
    code = models_open(session, request.source.path, request.format, &models);
    if (!code) code = info_models(session, &models);
    models_close(&models);
    return code;
}
