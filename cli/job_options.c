#include <string.h>

#include "fit_job.h"
#include "write_options.h"

enum {
    KEY_CURVE = 0x400,
    KEY_SURFACE,
    KEY_FUNCTION,
    KEY_DEGREE,
    KEY_CONTROL,
    KEY_KNOTS,
    KEY_PARAM,
    KEY_CLOSED,
    KEY_START,
    KEY_ORDER,
    KEY_TRIM,
    KEY_TRIM_RADIUS,
    KEY_TOLERANCE,
    KEY_POINT_TOLERANCE,
    KEY_MEASURE,
    KEY_BETWEEN,
    KEY_CORRECT,
    KEY_WEIGHTS,
    KEY_ROBUST,
    KEY_FAIRING,
    KEY_CORNERS,
    KEY_INTERPOLATE,
    KEY_CONSTRAINTS,
    KEY_SOFT,
    KEY_FREEZE,
    KEY_SHAPE,
    KEY_SHAPE_OPTION,
    KEY_METHOD,
    KEY_METHOD_OPTION,
    KEY_ITERATIONS,
    KEY_STOP_CHANGE,
    KEY_STOP_GRADIENT,
    KEY_TIME_LIMIT,
    KEY_LEVELS,
    KEY_CHECKPOINT,
    KEY_RESUME,
    KEY_FORMAT,
    KEY_OUTPUT_FORMAT,
    KEY_TRACE,
    KEY_TRACE_EVERY,
    KEY_REPORT,
    KEY_DRY_RUN
};

/* The next word of the command line when it is one of `words` (separated by blanks); options with an optional value take it. */
static const char *take_word(struct argp_state *state, const char *words)
{
    if (state->next >= state->argc) return NULL;
    const char *word = state->argv[state->next];
    size_t length = strlen(word);
    for (const char *at = words; length && (at = strstr(at, word)); at++) {
        int whole = (at == words || at[-1] == ' ') && (at[length] == ' ' || !at[length]);
        if (whole) return state->argv[state->next++];
    }
    return NULL;
}

/* ---- The model wanted ---- */

static const struct argp_option model_options[] = {
    {NULL, 0, NULL, 0, "The model:", 20},
    {"curve", KEY_CURVE, NULL, 0, "a curve through the rows in order (default for rows of points)", 0},
    {"surface", KEY_SURFACE, NULL, 0, "a surface over scattered points", 0},
    {"fit-function", KEY_FUNCTION, NULL, 0, "a function graph: the first column is the parameter, in any order", 0},
    {"degree", KEY_DEGREE, "P[,Q]", 0, "degree, of a surface in u and v (default 3)", 0},
    {"control", KEY_CONTROL, "N[,M]", 0, "number of control points (least squares)", 0},
    {"param", KEY_PARAM, "NAME|FILE", 0,
     "parameters of the points: chord, centripetal, ... ('pia list params'), or a file: a curve one a row, scattered points u,v a row, "
     "a grid two rows (all u, all v); scattered points: auto (default), plane, cylinder, sphere, xy, or a model file, their base "
     "surface",
     0},
    {"knots", KEY_KNOTS, "NAME|FILE", 0, "auto, average, lsq, ... ('pia list placements'), or a file of knots; a surface: two rows", 0},
    {"closed", KEY_CLOSED, "u|v|uv", OPTION_ARG_OPTIONAL, "periodic, a surface in u, v or both; a repeated last point is accepted", 0},
    {"start", KEY_START, "MODEL", 0, "begin with the knots, degrees and control points of this model", 0},
    {"order", KEY_ORDER, "given|nearest|tree", 0,
     "order of the points of a curve: as given (default), by nearest neighbours, or along their spanning tree", 0},
    {"trim", KEY_TRIM, "alpha|hull|none", 0,
     "where a surface over scattered points ends: at their alpha shape, with holes (default), at their convex hull, or not at all", 0},
    {"trim-radius", KEY_TRIM_RADIUS, "R", 0, "a gap between points wider than 2 R is a hole; default from their spacing", 0},
    {0}};

static error_t parse_degree(struct fit_request *request, const char *arg)
{
    pia_index degree[2];
    if (option_pair("--degree", arg, 0, degree)) return ERROR_IS_TOLD;
    for (int d = 0; d < 2; d++)
        if (degree[d] < 1 || degree[d] > PIA_MAX_DEGREE)
            return usage_error("--degree: %lld is impossible; 1 to %d", (long long)degree[d], PIA_MAX_DEGREE);
    for (int d = 0; d < 2; d++) request->options.degree[d] = (int)degree[d];
    return 0;
}

static error_t parse_closed(struct fit_request *request, const char *arg, struct argp_state *state)
{
    if (!arg) arg = take_word(state, "u v uv");
    request->closed = arg ? arg : "";
    for (const char *c = request->closed; *c; c++) {
        if (*c != 'u' && *c != 'v') return usage_error("--closed: '%s' is no direction; write u, v or uv", arg);
        request->options.closed[*c == 'v'] = 1;
    }
    if (!arg) request->options.closed[0] = 1;
    return 0;
}

static error_t parse_kind(struct fit_request *request, enum fit_kind kind)
{
    if (request->kind != KIND_BY_FILE && request->kind != kind)
        return usage_error("--curve and --surface contradict each other; choose one");
    request->kind = kind;
    return 0;
}

static error_t parse_trim(struct fit_request *request, const char *arg)
{
    request->trim = arg;
    if (strcmp(arg, "alpha") == 0 || strcmp(arg, "hull") == 0 || strcmp(arg, "none") == 0) return 0;
    return usage_error("--trim: '%s' is unknown; alpha, hull or none", arg);
}

static error_t parse_order(struct fit_request *request, const char *arg)
{
    request->order = arg;
    if (strcmp(arg, "given") == 0 || strcmp(arg, "nearest") == 0 || strcmp(arg, "tree") == 0) return 0;
    return usage_error("--order: '%s' is unknown; given, nearest or tree", arg);
}

static error_t parse_model(int key, char *arg, struct argp_state *state)
{
    struct fit_request *request = state->input;
    switch (key) {
    case KEY_CURVE: return parse_kind(request, KIND_CURVE);
    case KEY_SURFACE: return parse_kind(request, KIND_SURFACE);
    case KEY_FUNCTION: request->function_graph = 1; return 0;
    case KEY_DEGREE: return parse_degree(request, arg);
    case KEY_CONTROL: return option_pair("--control", arg, 1, request->options.control);
    case KEY_PARAM: request->parameters = arg; return 0;
    case KEY_KNOTS: request->knots = arg; return 0;
    case KEY_CLOSED: return parse_closed(request, arg, state);
    case KEY_START: request->start = arg; return 0;
    case KEY_ORDER: return parse_order(request, arg);
    case KEY_TRIM: return parse_trim(request, arg);
    case KEY_TRIM_RADIUS: return option_number("--trim-radius", arg, 1e-300, &request->trim_radius);
    default: return ARGP_ERR_UNKNOWN;
    }
}

/* ---- How close, how smooth ---- */

static const struct argp_option goal_options[] = {
    {NULL, 0, NULL, 0, "How close, how smooth:", 30},
    {"tolerance", KEY_TOLERANCE, "T|TX,TY,...", 0,
     "largest deviation wanted, in the units of the points, or one for each axis; knots are added until it holds", 0},
    {"point-tolerance", KEY_POINT_TOLERANCE, "FILE", 0,
     "a tolerance for each point, one a row, in place of T; a point keeps those of the axes as well", 0},
    {"measure", KEY_MEASURE, "parametric|distance", 0, "what the tolerance measures: deviation at the parameters, or true distance", 0},
    {"between", KEY_BETWEEN, "F", 0,
     "how far from the straight line between far points, in tolerances, beside what their bend explains; 0: no matter", 0},
    {"correct", KEY_CORRECT, "N", 0, "rounds of foot-point correction of the parameters", 0},
    {"weights", KEY_WEIGHTS, "COLUMN|FILE", 0, "a weight for each point: a column of the points or a file, one a row", 0},
    {"robust", KEY_ROBUST, "huber|tukey[:K]", 0, "robust loss, so that outliers pull less", 0},
    {"fairing", KEY_FAIRING, "L", 0, "weight of the fairing energy; 1 makes it as strong as the data", 0},
    {"corners", KEY_CORNERS, "auto|none|LIST", 0, "rows that are corners of the curve", 0},
    {0}};

static error_t parse_measure(struct fit_request *request, const char *arg)
{
    request->options.measure_distance = strcmp(arg, "distance") == 0;
    if (request->options.measure_distance || strcmp(arg, "parametric") == 0) return 0;
    return usage_error("--measure: '%s' is unknown; parametric or distance", arg);
}

static error_t parse_robust(struct fit_request *request, char *arg)
{
    char *colon = strchr(arg, ':');
    if (colon) {
        *colon = 0;
        if (option_number("--robust", colon + 1, 1e-6, &request->options.robust_scale)) return ERROR_IS_TOLD;
    }
    if (strcmp(arg, "huber") != 0 && strcmp(arg, "tukey") != 0)
        return usage_error("--robust: '%s' is unknown; huber or tukey, with :K for another constant", arg);
    request->options.robust = arg;
    return 0;
}

static error_t parse_axis_tolerances(struct fit_request *request, char *arg)
{
    pia_fit_options *options = &request->options;
    pia_index count = 0;
    for (char *word; (word = strsep(&arg, ",")); count++) {
        double value;
        if (count == PIA_MAX_DIM)
            return usage_error("--tolerance: more than %d axes are not possible; give one for each column", PIA_MAX_DIM);
        if (option_number("--tolerance", word, 0, &value)) return ERROR_IS_TOLD;
        if (!(value > 0)) return usage_error("--tolerance: 0 cannot be reached; give a positive number for each axis");
        request->axis_tolerances[count] = value;
    }
    options->axis_tolerances = request->axis_tolerances;
    options->axis_tolerance_count = count;
    options->tolerance = 0;
    return 0;
}

static error_t parse_tolerance(struct fit_request *request, char *arg)
{
    if (strchr(arg, ',')) return parse_axis_tolerances(request, arg);
    request->options.axis_tolerance_count = 0;
    if (option_number("--tolerance", arg, 0, &request->options.tolerance)) return ERROR_IS_TOLD;
    return request->options.tolerance > 0 ? 0 : usage_error("--tolerance: 0 cannot be reached; give a positive number");
}

static error_t parse_goal(int key, char *arg, struct argp_state *state)
{
    struct fit_request *request = state->input;
    switch (key) {
    case KEY_TOLERANCE: return parse_tolerance(request, arg);
    case KEY_POINT_TOLERANCE: request->tolerances = arg; return 0;
    case KEY_MEASURE: return parse_measure(request, arg);
    case KEY_BETWEEN: return option_number("--between", arg, 0, &request->options.between);
    case KEY_CORRECT: return option_count("--correct", arg, 0, &request->options.correct);
    case KEY_WEIGHTS: request->weights = arg; return 0;
    case KEY_ROBUST: return parse_robust(request, arg);
    case KEY_FAIRING: return option_number("--fairing", arg, 0, &request->options.fairing);
    case KEY_CORNERS: request->corners = arg; return 0;
    default: return ARGP_ERR_UNKNOWN;
    }
}

/* ---- What must hold ---- */

static const struct argp_option condition_options[] = {
    {NULL, 0, NULL, 0, "What must hold:", 40},
    {"interpolate", KEY_INTERPOLATE, "LIST|FILE", 0,
     "rows met exactly, from 0: 0,40,80-90 or every:50 or ends, or a file with one a row", 0},
    {"constraints", KEY_CONSTRAINTS, "FILE.json", 0,
     "a list of {\"at\": row or t or [u,v], \"derivative\": k or [k,l], \"value\": [...], \"direction\": true}", 0},
    {"soft", KEY_SOFT, "W", OPTION_ARG_OPTIONAL, "constraints are heavy weights W instead (default 1e6)", 0},
    {"freeze", KEY_FREEZE, "LIST", 0, "control points that stay where they start", 0},
    {"shape", KEY_SHAPE, "NAME", 0, "limiter: none, convex, convex-local, ...", 0},
    {"shape-option", KEY_SHAPE_OPTION, "NAME=VALUE", 0, "parameter of the limiter: delta, alpha", 0},
    {0}};

static error_t parse_soft(struct fit_request *request, const char *arg)
{
    request->options.soft = 1e6;
    return arg ? option_number("--soft", arg, 1e-300, &request->options.soft) : 0;
}

static error_t add_setting(struct fit_request *request, struct texts *texts, const char *option, const char *arg)
{
    const char *equals = strchr(arg, '=');
    if (!equals || equals == arg) return usage_error("%s: '%s' is no setting; write NAME=VALUE", option, arg);
    session_append(request->session, texts, arg);
    return 0;
}

static error_t parse_condition(int key, char *arg, struct argp_state *state)
{
    struct fit_request *request = state->input;
    switch (key) {
    case KEY_INTERPOLATE: request->interpolate = arg; return 0;
    case KEY_CONSTRAINTS: request->constraints = arg; return 0;
    case KEY_SOFT: return parse_soft(request, arg);
    case KEY_FREEZE: request->freeze = arg; return 0;
    case KEY_SHAPE: request->options.limiter = arg; return 0;
    case KEY_SHAPE_OPTION: return add_setting(request, &request->shape_options, "--shape-option", arg);
    default: return ARGP_ERR_UNKNOWN;
    }
}

/* ---- Method and stops ---- */

static const struct argp_option method_options[] = {
    {NULL, 0, NULL, 0, "Method and stops:", 50},
    {"method", KEY_METHOD, "NAME", 0, "auto (default), pia, direct, ... ('pia list methods')", 0},
    {"method-option", KEY_METHOD_OPTION, "NAME=VALUE", 0, "parameter of the method; 'pia list methods' shows them", 0},
    {"iterations", KEY_ITERATIONS, "N", 0,
     "most iterations, with --tolerance rounds of adding and sparing knots; 0 writes the initial model", 0},
    {"stop-change", KEY_STOP_CHANGE, "X", 0, "stop when no control point moves more than X; 0: run exactly the iterations asked", 0},
    {"stop-gradient", KEY_STOP_GRADIENT, "X", 0, "stop when the relative gradient is at most X", 0},
    {"time-limit", KEY_TIME_LIMIT, "S", 0, "stop after S seconds", 0},
    {"levels", KEY_LEVELS, "E1,E2,...", 0,
     "one run, a model at each of these errors, or with it:K1,K2,... at each of these iterations; the level is put before the "
     "extension",
     0},
    {"checkpoint", KEY_CHECKPOINT, "FILE", 0, "save the state now and then and at the end", 0},
    {"resume", KEY_RESUME, "FILE", 0, "go on from a checkpoint; POINTS are then not needed", 0},
    {0}};

static error_t parse_levels(struct fit_request *request, char *arg)
{
    double level, last = 0;
    int iterations = strncmp(arg, "it:", 3) == 0;
    char *rest = arg + (iterations ? 3 : 0), *word;
    for (request->levels_are_iterations = iterations; (word = strsep(&rest, ","));) {
        pia_index count;
        int number = iterations ? text_is_count(word, &count) : text_is_number(word, &level) && level > 0;
        if (!number) return usage_error("--levels: '%s' is no level; write 1e-1,1e-2 or it:0,2,4", word);
        if (iterations) level = (double)count;
        int ordered = !request->levels.count || (iterations ? level > last : level < last);
        if (!ordered) return usage_error("--levels: %s is out of order; errors fall, iterations rise", word);
        session_append(request->session, &request->levels, word);
        last = level;
    }
    return 0;
}

static error_t parse_stop_change(struct fit_request *request, const char *arg)
{
    if (option_number("--stop-change", arg, 0, &request->options.stop_change)) return ERROR_IS_TOLD;
    if (request->options.stop_change == 0 && request->options.stop_gradient == PIA_AUTO) request->options.stop_gradient = 0;
    return 0;
}

static error_t parse_method(int key, char *arg, struct argp_state *state)
{
    struct fit_request *request = state->input;
    pia_fit_options *options = &request->options;
    switch (key) {
    case KEY_METHOD: options->method = arg; return 0;
    case KEY_METHOD_OPTION: return add_setting(request, &request->method_options, "--method-option", arg);
    case KEY_ITERATIONS: return option_count("--iterations", arg, 0, &options->max_iterations);
    case KEY_STOP_CHANGE: return parse_stop_change(request, arg);
    case KEY_STOP_GRADIENT: return option_number("--stop-gradient", arg, 0, &options->stop_gradient);
    case KEY_TIME_LIMIT: return option_number("--time-limit", arg, 0, &options->time_limit);
    case KEY_LEVELS: return parse_levels(request, arg);
    case KEY_CHECKPOINT: request->checkpoint = arg; return 0;
    case KEY_RESUME: request->resume = arg; return 0;
    default: return ARGP_ERR_UNKNOWN;
    }
}

/* ---- Outputs ---- */

static const struct argp_option output_options[] = {
    {NULL, 0, NULL, 0, "Outputs:", 60},
    {"output", 'o', "FILE", 0,
     "a model (.json and others, 'pia list formats') or a picture (.svg .png .pdf); repeat for several; - is stdout", 0},
    {"format", KEY_FORMAT, "NAME", 0, "format of whichever of POINTS and FILE has no telling name", 0},
    {"output-format", KEY_OUTPUT_FORMAT, "NAME", 0, "format of FILE, whatever it is called", 0},
    {"trace", KEY_TRACE, "FILE.csv", 0, "the history of the fit, one row an iteration", 0},
    {"trace-every", KEY_TRACE_EVERY, "K", 0, "every K-th iteration only, and the last", 0},
    {"report", KEY_REPORT, "FILE.html", 0, "the interactive report", 0},
    {"dry-run", KEY_DRY_RUN, NULL, 0, "say method, control points, memory and stops; fit nothing", 0},
    {0}};

static error_t parse_output(int key, char *arg, struct argp_state *state)
{
    struct fit_request *request = state->input;
    switch (key) {
    case 'o': session_append(request->session, &request->outputs, arg); return 0;
    case KEY_REPORT: request->report = arg; return 0;
    case KEY_FORMAT: request->format = arg; return 0;
    case KEY_OUTPUT_FORMAT: request->output_format = arg; return 0;
    case KEY_TRACE: request->trace = arg; return 0;
    case KEY_TRACE_EVERY: return option_count("--trace-every", arg, 1, &request->options.trace_every);
    case KEY_DRY_RUN: request->dry_run = 1; return 0;
    default: return ARGP_ERR_UNKNOWN;
    }
}

/* ---- The whole ---- */

static error_t check_request(const struct fit_request *request)
{
    if (!request->source.path && !request->resume)
        return usage_error("no points to fit; write 'pia fit POINTS -o MODEL', or see 'pia fit --help'");
    if (request->source.grid && request->kind != KIND_BY_FILE)
        return usage_error("--grid contradicts --curve and --surface; choose one");
    if (request->resume && request->levels.count) return usage_error("--resume and --levels cannot be joined; leave one out");
    return 0;
}

static error_t parse_whole(int key, char *arg, struct argp_state *state)
{
    struct fit_request *request = state->input;
    switch (key) {
    case ARGP_KEY_INIT:
        for (int i = 1; i <= 5; i++) state->child_inputs[i] = request;
        state->child_inputs[0] = &request->source;
        state->child_inputs[6] = &request->writing;
        state->child_inputs[7] = request->session;
        return 0;
    case ARGP_KEY_ARG:
        if (request->source.path) return usage_error("only one file of points can be fitted; '%s' is one too many", arg);
        request->source.path = arg;
        return 0;
    case ARGP_KEY_END: return check_request(request);
    default: return ARGP_ERR_UNKNOWN;
    }
}

static const struct argp model_argp = {model_options, parse_model, NULL, NULL, NULL, NULL, NULL};
static const struct argp goal_argp = {goal_options, parse_goal, NULL, NULL, NULL, NULL, NULL};
static const struct argp condition_argp = {condition_options, parse_condition, NULL, NULL, NULL, NULL, NULL};
static const struct argp method_argp = {method_options, parse_method, NULL, NULL, NULL, NULL, NULL};
static const struct argp output_argp = {output_options, parse_output, NULL, NULL, NULL, NULL, NULL};

static const struct argp_child children[] = {{&point_source_argp, 0, NULL, 0},  {&model_argp, 0, NULL, 0},  {&goal_argp, 0, NULL, 0},
                                             {&condition_argp, 0, NULL, 0},     {&method_argp, 0, NULL, 0}, {&output_argp, 0, NULL, 0},
                                             {&write_options_argp, 0, NULL, 0}, {&common_argp, 0, NULL, 0}, {0}};

static const char manual[] =
    "Fit a B-spline curve or surface to points.\v"
    "Examples:\n"
    "  pia fit rae2822.dat -o wing.json                    the interpolating curve\n"
    "  pia fit coast.csv --closed --tolerance 0.01 -o coast.json -o coast.svg\n"
    "  pia fit scan.csv --control 40 --interpolate ends -o scan.igs\n"
    "  pia fit dem.asc --control 30,40 -o dem.json         a surface of 30 x 40 control points\n"
    "  pia fit peaks.csv --grid 11x11 --method pia --iterations 30 --trace history.csv\n"
    "  pia fit scan.ply --surface --tolerance 0.05 --measure distance -o scan.step\n"
    "  pia fit path.csv --tolerance 0.1,0.1,0.02 -o path.json   a tolerance for each axis\n"
    "  pia fit signal.csv --fit-function --tolerance 0.1 -o signal.json\n"
    "  pia fit part.csv --levels 1e-1,1e-2,1e-3 -o part.json   writes part.1e-1.json, ...\n"
    "  cat points.csv | pia fit - -o - | pia eval - --samples 500\n"
    "\n"
    "Exit status: 0 done, 1 the tolerance was not reached, 2 usage, 3 bad data, 4 file error, 5 out of memory, 6 internal error, 130 "
    "stopped by Ctrl-C with the outputs written.";

static const struct argp fit_argp = {NULL, parse_whole, "POINTS", manual, children, NULL, NULL};

/* --format speaks of the file whose name tells nothing: the one that is a standard stream, else the points. */
static void apply_format(struct fit_request *request)
{
    int piped_out = 0, piped_in = request->source.path && strcmp(request->source.path, "-") == 0;
    for (pia_index i = 0; i < request->outputs.count; i++) piped_out |= strcmp(request->outputs.item[i], "-") == 0;
    const char **format = piped_out && !piped_in ? &request->output_format : &request->source.format;
    if (!*format) *format = request->format;
}

int fit_request_parse(struct fit_request *request, struct session *session, int argc, char **argv)
{
    *request = (struct fit_request){.session = session, .command = command_line(session, "fit", argc, argv)};
    pia_fit_options_init(&request->options);
    pia_write_options_init(&request->writing);
    point_source_init(&request->source, session);
    int code = arguments_parse(session, "fit", &fit_argp, argc, argv, request);
    if (!code && request->format) apply_format(request);
    return code;
}
