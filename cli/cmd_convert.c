#include <string.h>

#include "arguments.h"
#include "command.h"
#include "file_name.h"
#include "json_writer.h"
#include "model_source.h"
#include "number_file.h"
#include "write_options.h"

/* What may be done to a model, in the order in which the command line asks for it. */
enum step_kind { REFINE, INSERT, ELEVATE, REMOVE, SPLIT, BEZIER, UNTRIM };

struct step {
    enum step_kind kind;
    const char *option, *text;
};

enum { MOST_STEPS = 32 };

struct request {
    struct session *session;
    const char *model, *input_format, *output_format;
    struct texts outputs;
    struct step step[MOST_STEPS];
    int steps;
    pia_write_options options;
    pia_index part;
};

enum {
    KEY_REFINE = 0x400,
    KEY_INSERT,
    KEY_ELEVATE,
    KEY_REMOVE,
    KEY_SPLIT,
    KEY_BEZIER,
    KEY_UNTRIM,
    KEY_SAMPLES,
    KEY_PART,
    KEY_FORMAT,
    KEY_INPUT_FORMAT
};

static const struct argp_option options[] = {
    {NULL, 0, NULL, 0, "What is done, in the order given (D: is u: or v:, of a surface; default u):", 10},
    {"refine", KEY_REFINE, "[D:]N", 0, "N more knots in each span; a surface without D: in both directions", 0},
    {"insert", KEY_INSERT, "[D:]LIST|FILE", 0, "these knots more, such as 0.25,0.5", 0},
    {"elevate", KEY_ELEVATE, "[D:]K", 0, "degree raised by K; a surface without D: in both directions", 0},
    {"remove", KEY_REMOVE, "BOUND", 0, "knots removed as long as no point moves by more than BOUND", 0},
    {"split", KEY_SPLIT, "[D:]T", 0, "split at the parameter T; both halves are written", 0},
    {"untrim", KEY_UNTRIM, NULL, 0, "trim loops taken away: the whole surface", 0},
    {"bezier", KEY_BEZIER, NULL, 0, "inside knots raised to full multiplicity: Bezier pieces", 0},
    {NULL, 0, NULL, 0, "Files:", 20},
    {"output", 'o', "FILE", 0, "file to write; repeat for several; - is stdout", 0},
    {"samples", KEY_SAMPLES, "N", 0, "points a direction in formats that hold samples (.csv .npy .obj)", 0},
    {"part", KEY_PART, "K", 0, "only model K, from 0, of a file with several", 0},
    {"format", KEY_FORMAT, "NAME", 0, "format to write, whatever the file is called", 0},
    {"input-format", KEY_INPUT_FORMAT, "NAME", 0, "format to read, whatever the file is called", 0},
    {0}};

static error_t add_step(struct request *request, enum step_kind kind, const char *option, const char *text)
{
    if (request->steps == MOST_STEPS) return usage_error("%s: more than %d steps; convert twice", option, MOST_STEPS);
    request->step[request->steps++] = (struct step){kind, option, text};
    return 0;
}

static error_t parse_file(struct request *request, int key, char *arg)
{
    switch (key) {
    case 'o': session_append(request->session, &request->outputs, arg); return 0;
    case KEY_SAMPLES: return option_count("--samples", arg, 2, &request->options.samples);
    case KEY_PART: return option_count("--part", arg, 0, &request->part);
    case KEY_FORMAT: request->output_format = arg; return 0;
    case KEY_INPUT_FORMAT: request->input_format = arg; return 0;
    default: return ARGP_ERR_UNKNOWN;
    }
}

static error_t parse(int key, char *arg, struct argp_state *state)
{
    struct request *request = state->input;
    switch (key) {
    case KEY_REFINE: return add_step(request, REFINE, "--refine", arg);
    case KEY_INSERT: return add_step(request, INSERT, "--insert", arg);
    case KEY_ELEVATE: return add_step(request, ELEVATE, "--elevate", arg);
    case KEY_REMOVE: return add_step(request, REMOVE, "--remove", arg);
    case KEY_SPLIT: return add_step(request, SPLIT, "--split", arg);
    case KEY_BEZIER: return add_step(request, BEZIER, "--bezier", "");
    case KEY_UNTRIM: return add_step(request, UNTRIM, "--untrim", "");
    case ARGP_KEY_INIT:
        state->child_inputs[0] = &request->options;
        state->child_inputs[1] = request->session;
        return 0;
    case ARGP_KEY_ARG:
        if (request->model) return usage_error("one model at a time; '%s' is one too many", arg);
        request->model = arg;
        return 0;
    case ARGP_KEY_END:
        if (!request->model || !request->outputs.count) return usage_error("write 'pia convert MODEL -o FILE'");
        return 0;
    default: return parse_file(request, key, arg);
    }
}

static const struct argp_child children[] = {{&write_options_argp, 0, NULL, 0}, {&common_argp, 0, NULL, 0}, {0}};
static const char manual[] = "A model in another format, and the same shape with other knots or another degree.\v"
                             "Examples:\n"
                             "  pia convert model.json -o model.igs\n"
                             "  pia convert model.json --samples 500 -o curve.csv\n"
                             "  pia convert model.json --elevate 1 --refine 2 -o finer.json\n"
                             "  pia convert surface.json --split v:0.5 -o halves.json\n"
                             "  pia convert model.json --remove 1e-3 -o lean.json";
static const struct argp argp = {options, parse, "MODEL -o FILE", manual, children, NULL, NULL};

/* ---- Steps ---- */

/* Takes "u:" or "v:" from the front of a text; -1: neither is there. */
static int take_direction(const char **text)
{
    if (((*text)[0] != 'u' && (*text)[0] != 'v') || (*text)[1] != ':') return -1;
    *text += 2;
    return (*text)[-2] == 'v';
}

/* N knots in each span of a direction that is not empty, equally spaced. */
static pia_status refine(struct session *session, const pia_model *model, int direction, pia_index more, pia_model **out)
{
    pia_model_info info = {.struct_size = sizeof info};
    pia_model_get_info(model, &info);
    const double *knots = pia_model_knots(model, direction);
    pia_index first = info.degree[direction], spans = info.control[direction] - first, count = 0;
    double *values = session_keep(session, (size_t)spans, (size_t)more * sizeof *values);
    for (pia_index i = first; i < first + spans; i++)
        for (pia_index k = 1; knots[i + 1] > knots[i] && k <= more; k++)
            values[count++] = knots[i] + (knots[i + 1] - knots[i]) * ((double)k / (double)(more + 1));
    return pia_model_insert_knots(session->context, model, direction, values, count, out);
}

/* A list of numbers in text or a file; non-decreasing in a file, sorted by the user in a list. */
static int read_knots(struct session *session, const char *text, struct numbers *out)
{
    char *copy = session_text(session, "%s", text), *rest = copy, *word;
    *out = (struct numbers){.path = text, .rows = 1};
    out->value = session_keep(session, strlen(text) / 2 + 1, sizeof *out->value);
    while ((word = strsep(&rest, ",")))
        if (!text_is_number(word, &out->value[out->count++])) return numbers_read(session, text, out);
    return EXIT_DONE;
}

static int insert(struct session *session, const char *text, int direction, const pia_model *model, pia_model **out)
{
    struct numbers knots;
    int code = read_knots(session, text, &knots);
    if (!code) code = numbers_check_order(session, &knots, 0, knots.count, "knot");
    if (code) return code;
    return session_check(session, pia_model_insert_knots(session->context, model, direction, knots.value, knots.count, out), NULL);
}

/* A step of whole numbers in one direction, or in both when none is named: `more` knots a span, or degree raised by `more`. */
static int change_directions(struct session *session, const struct step *step, const char *text, int direction, const pia_model *model,
                             pia_model **out)
{
    pia_index more;
    pia_model_info info = {.struct_size = sizeof info};
    pia_model_get_info(model, &info);
    if (!text_is_count(text, &more) || more < 1 || (step->kind == ELEVATE && more > PIA_MAX_DEGREE))
        return fail(EXIT_USAGE, "%s: '%s' is no count; write 1, 2, ...", step->option, step->text);
    int first = direction < 0 ? 0 : direction, last = direction < 0 ? info.directions - 1 : direction;
    pia_model *now = NULL;
    pia_status status = PIA_OK;
    for (int d = first; status == PIA_OK && d <= last; d++) {
        pia_model *next = NULL;
        const pia_model *from = now ? now : model;
        status = step->kind == REFINE ? refine(session, from, d, more, &next)
                                      : pia_model_elevate(session->context, from, d, (int)more, &next);
        pia_model_destroy(now);
        now = next;
    }
    *out = now;
    return session_check(session, status, NULL);
}

static int split(struct session *session, const struct step *step, const char *text, int direction, const pia_model *model,
                 pia_model *out[2])
{
    double at;
    if (!text_is_number(text, &at)) return fail(EXIT_USAGE, "%s: '%s' is no parameter; write a number", step->option, step->text);
    return session_check(session, pia_model_split(session->context, model, direction, at, &out[0], &out[1]), NULL);
}

/* One step on one model; two models come out of a split. */
static int apply(struct session *session, const struct step *step, const pia_model *model, pia_model *out[2])
{
    const char *text = step->text;
    int direction = take_direction(&text), given = direction < 0 ? 0 : direction;
    pia_model_info info = {.struct_size = sizeof info};
    double bound;
    pia_model_get_info(model, &info);
    if (given >= info.directions) return fail(EXIT_USAGE, "%s %s: a curve has no direction v; leave it out", step->option, step->text);
    switch (step->kind) {
    case REFINE:
    case ELEVATE: return change_directions(session, step, text, direction, model, &out[0]);
    case INSERT: return insert(session, text, given, model, &out[0]);
    case SPLIT: return split(session, step, text, given, model, out);
    case BEZIER: return session_check(session, pia_model_bezier(session->context, model, &out[0]), NULL);
    case UNTRIM: return session_check(session, pia_model_trim(session->context, model, 0, NULL, NULL, &out[0]), NULL);
    case REMOVE: break;
    }
    if (!text_is_number(text, &bound) || bound < 0)
        return fail(EXIT_USAGE, "%s: '%s' is no bound; write a number such as 1e-3", step->option, text);
    return session_check(session, pia_model_remove_knots(session->context, model, bound, &out[0], NULL), NULL);
}

/* One step on all models; `set` then holds the new ones. */
static int apply_to_all(struct session *session, const struct step *step, pia_model ***models, pia_index *count)
{
    pia_model **made = session_keep(session, 2 * (size_t)*count, sizeof(pia_model *));
    pia_index made_count = 0;
    int code = EXIT_DONE;
    for (pia_index i = 0; !code && i < *count; i++) {
        pia_model *out[2] = {NULL, NULL};
        code = apply(session, step, (*models)[i], out);
        for (int k = 0; k < 2; k++)
            if (out[k]) made[made_count++] = out[k];
    }
    for (pia_index i = 0; i < *count; i++) pia_model_destroy((*models)[i]);
    *models = made;
    *count = made_count;
    return code;
}

/* ---- Files ---- */

static const char *format_to_write(const struct request *request, const char *path)
{
    return format_of(path, request->output_format, "json");
}

static int check_format(const struct request *request, const char *path)
{
    return session_check(request->session, pia_model_write_check(request->session->context, path, format_to_write(request, path)),
                         path);
}

static int write_all(struct request *request, pia_model **models, pia_index count)
{
    struct session *session = request->session;
    int code = EXIT_DONE, piped = 0;
    for (pia_index i = 0; !code && i < request->outputs.count; i++) {
        const char *path = request->outputs.item[i];
        request->options.format = format_to_write(request, path);
        piped |= strcmp(path, "-") == 0;
        code = session_check(
            session, pia_model_write_as(session->context, path, (const pia_model *const *)models, count, &request->options), path);
    }
    if (!code && session->json && !piped) json_outputs(stdout, &request->outputs);
    return code;
}

static int convert(struct request *request, const struct model_set *set)
{
    struct session *session = request->session;
    const pia_model *only = NULL;
    if (request->part != PIA_AUTO) {
        int code = models_choose(set, request->part, &only);
        if (code) return code;
    }
    pia_index count = only ? 1 : set->count;
    if (!request->steps) return write_all(request, only ? &set->model[request->part] : set->model, count);
    pia_model **models = session_keep(session, (size_t)count, sizeof(pia_model *));
    pia_status status = PIA_OK;
    for (pia_index i = 0; status == PIA_OK && i < count; i++)
        status = pia_model_insert_knots(session->context, only ? only : set->model[i], 0, NULL, 0, &models[i]);
    int code = session_check(session, status, request->model);
    for (int i = 0; !code && i < request->steps; i++) code = apply_to_all(session, &request->step[i], &models, &count);
    if (!code) code = write_all(request, models, count);
    for (pia_index i = 0; i < count; i++) pia_model_destroy(models[i]);
    return code;
}

int cmd_convert(struct session *session, int argc, char **argv)
{
    struct request request = {.session = session, .part = PIA_AUTO};
    pia_write_options_init(&request.options);
    struct model_set models = {0};
    int code = arguments_parse(session, "convert", &argp, argc, argv, &request);
    for (pia_index i = 0; !code && i < request.outputs.count; i++) code = output_check(request.outputs.item[i]);
    if (!code) code = session_open(session);
    for (pia_index i = 0; !code && i < request.outputs.count; i++) code = check_format(&request, request.outputs.item[i]);
    if (!code) code = models_open(session, request.model, request.input_format, &models);
    if (!code) code = convert(&request, &models);
    models_close(&models);
    return code;
}
