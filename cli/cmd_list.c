#include <string.h>

#include "arguments.h"
#include "command.h"
#include "json_writer.h"

/* Words of the command line for the registries of the library. */
static const struct list {
    const char *name, *registry, *title;
} lists[] = {
    {"methods", "method", "Methods (--method)"},
    {"params", "parametrization", "Parametrizations (--param)"},
    {"placements", "placement", "Knot placements (--knots)"},
    {"limiters", "limiter", "Shape limiters (--shape)"},
    {"formats", "format", "File formats (--format)"},
    {"backends", "backend", "Backends (--backend)"},
    {"parts", "part", "Optional parts of this build"},
};

enum { LIST_COUNT = sizeof lists / sizeof *lists };

struct request {
    struct session *session;
    int wanted[LIST_COUNT], some;
};

static int choose(struct request *request, const char *word)
{
    for (int i = 0; i < LIST_COUNT; i++)
        if (strcmp(word, lists[i].name) == 0 || strcmp(word, lists[i].registry) == 0) {
            request->wanted[i] = request->some = 1;
            return 0;
        }
    return usage_error("there is no list '%s'; methods, params, placements, limiters, formats, backends, parts", word);
}

static error_t parse(int key, char *arg, struct argp_state *state)
{
    struct request *request = state->input;
    switch (key) {
    case ARGP_KEY_INIT: state->child_inputs[0] = request->session; return 0;
    case ARGP_KEY_ARG: return choose(request, arg);
    default: return ARGP_ERR_UNKNOWN;
    }
}

static const struct argp_child children[] = {{&common_argp, 0, NULL, 0}, {0}};
static const char manual[] =
    "Names that options take, and what this build has: methods, params, placements, limiters, formats, backends, "
    "parts. Without a word all of them.\v"
    "Examples:\n"
    "  pia list methods            with the parameters that --method-option sets\n"
    "  pia list formats --json";
static const struct argp argp = {NULL, parse, "[WORD...]", manual, children, NULL, NULL};

/* ---- Text ---- */

static void print_parameters(const char *method)
{
    pia_parameter parameter;
    for (pia_index i = 0; pia_list_parameters(method, i, &parameter); i++) {
        printf("      %s=%s  %s", parameter.name, parameter.initial, parameter.sentence);
        if (parameter.values)
            printf(" (%s)\n", parameter.values);
        else
            printf(" (%g to %g)\n", parameter.minimum, parameter.maximum);
    }
}

static void print_list(const struct list *list)
{
    pia_entry entry;
    printf("%s\n", list->title);
    for (pia_index i = 0; pia_list(list->registry, i, &entry); i++) {
        printf("  %-15s %s\n", entry.name, entry.title ? entry.title : "");
        if (entry.detail && *entry.detail) printf("  %-15s %s\n", "", entry.detail);
        if (strcmp(list->registry, "method") == 0) print_parameters(entry.name);
    }
}

/* ---- JSON ---- */

static void put_parameters(struct json_writer *json, const char *method)
{
    pia_parameter parameter;
    json_open(json, "parameters", '[');
    for (pia_index i = 0; pia_list_parameters(method, i, &parameter); i++) {
        json_open(json, NULL, '{');
        json_text(json, "name", parameter.name);
        json_text(json, "values", parameter.values);
        json_text(json, "default", parameter.initial);
        json_number(json, "minimum", parameter.minimum);
        json_number(json, "maximum", parameter.maximum);
        json_text(json, "sentence", parameter.sentence);
        json_close(json, '}');
    }
    json_close(json, ']');
}

static void put_list(struct json_writer *json, const struct list *list)
{
    pia_entry entry;
    json_open(json, list->name, '[');
    for (pia_index i = 0; pia_list(list->registry, i, &entry); i++) {
        json_open(json, NULL, '{');
        json_text(json, "name", entry.name);
        json_text(json, "title", entry.title);
        json_text(json, "reference", entry.reference);
        json_text(json, "detail", entry.detail);
        if (strcmp(list->registry, "method") == 0) put_parameters(json, entry.name);
        json_close(json, '}');
    }
    json_close(json, ']');
}

int cmd_list(struct session *session, int argc, char **argv)
{
    struct request request = {.session = session};
    struct json_writer json = {.stream = stdout};
    int code = arguments_parse(session, "list", &argp, argc, argv, &request);
    if (code) return code;
    if (session->json) json_open(&json, NULL, '{');
    for (int i = 0, printed = 0; i < LIST_COUNT; i++) {
        if (request.some && !request.wanted[i]) continue;
        if (session->json) {
            put_list(&json, &lists[i]);
            continue;
        }
        if (printed++) putchar('\n');
        print_list(&lists[i]);
    }
    if (session->json) {
        json_close(&json, '}');
        json_end(&json);
    }
    return EXIT_DONE;
}
