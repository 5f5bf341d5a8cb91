/* Pictures of models and points. */
#include "files.h"

#include "canvas.h"

static const double pi = 3.14159265358979323846;

static void fill_uniform_knots(int degree, pia_index control, double *knots)
{
    for (pia_index i = 0; i < control + degree + 1; i++)
        knots[i] = fmin(fmax((double)(i - degree), 0), (double)(control - degree)) / (double)(control - degree);
}

/* A wavy curve whose first component runs from `origin` to origin + size; further components are scaled alike. */
static pia_model *make_curve(pia_context *context, int degree, pia_index control, int dim, double origin, double size)
{
    double *knots = malloc((size_t)(control + degree + 1) * sizeof *knots), *points = malloc((size_t)(control * dim) * sizeof *points);
    fill_uniform_knots(degree, control, knots);
    for (pia_index i = 0; i < control; i++)
        for (int c = 0; c < dim; c++) points[i * dim + c] = origin + size * 0.5 * (1 + sin((c + 2) * (double)i * 0.7 + c));
    pia_model *model = NULL;
    assert_ok(context, pia_model_create(context, 1, &degree, (const double *const[]){knots}, &control, dim, points, NULL, &model));
    free(knots);
    free(points);
    return model;
}

/* Heights over a rectangle for dim 3 (a tube for tube 1), other dims as make_curve. */
static pia_model *make_surface(pia_context *context, const int *degree, const pia_index *control, int dim, int tube)
{
    double *knots[2], *points = malloc((size_t)(control[0] * control[1] * dim) * sizeof *points);
    for (int d = 0; d < 2; d++) {
        knots[d] = malloc((size_t)(control[d] + degree[d] + 1) * sizeof *knots[d]);
        fill_uniform_knots(degree[d], control[d], knots[d]);
    }
    for (pia_index i = 0; i < control[0]; i++) {
        for (pia_index j = 0; j < control[1]; j++) {
            double u = (double)i / (double)(control[0] - 1), v = (double)j / (double)(control[1] - 1);
            const double terrain[3] = {10 * u, 7 * v, 0.4 * sin(6 * u) * cos(5 * v)};
            const double pipe[3] = {cos(2 * pi * v), sin(2 * pi * v), 2 * u};
            for (int c = 0; c < dim; c++)
                points[(i * control[1] + j) * dim + c] = c > 2 ? 1 : tube ? pipe[c] : dim == 1 ? terrain[2] : terrain[c];
        }
    }
    pia_model *model = NULL;
    assert_ok(context, pia_model_create(context, 2, degree, (const double *const *)knots, control, dim, points, NULL, &model));
    free(knots[0]);
    free(knots[1]);
    free(points);
    return model;
}

/* `count` points on the model, spread over its domain and moved by up to `error`; parameters [count x directions]. */
static void scatter(pia_context *context, const pia_model *model, pia_index count, double error, double *parameters, double *points)
{
    pia_model_info info = {.struct_size = sizeof info};
    pia_model_get_info(model, &info);
    for (pia_index i = 0; i < count; i++)
        for (int d = 0; d < info.directions; d++)
            parameters[i * info.directions + d] =
                fmod((double)i * (d == 0 ? 1.0 : 0.6180339887) / (double)(d == 0 ? count - 1 : 1), 1.0000001);
    assert_ok(context, pia_model_eval(context, model, parameters, count, 0, points));
    for (pia_index i = 0; i < count * info.dim; i++) points[i] += error * sin(17.0 * (double)i);
}

static int is_name(char c)
{
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == ':' || c == '-' || c == '_';
}

/* One pass over an XML text: every tag closed in order, every attribute quoted, no stray markup. */
static int is_well_formed(const char *text)
{
    char open[32][32];
    int depth = 0, roots = 0;
    for (const char *p = text; *p != '\0'; p++) {
        if (*p == '&' && strncmp(p, "&amp;", 5) != 0 && strncmp(p, "&lt;", 4) != 0 && strncmp(p, "&gt;", 4) != 0) return 0;
        if (*p != '<') continue;
        if (strncmp(p, "<?", 2) == 0) {
            p = strstr(p, "?>");
            if (p == NULL) return 0;
            continue;
        }
        int closing = *++p == '/';
        p += closing;
        size_t length = 0;
        while (is_name(p[length])) length++;
        if (length == 0 || length >= sizeof open[0]) return 0;
        const char *name = p;
        p += length;
        for (int quoted = 0; quoted || *p != '>'; p++) {
            if (*p == '\0' || (*p == '<')) return 0;
            if (*p == '"') quoted = !quoted;
        }
        if (closing) {
            if (depth == 0 || strlen(open[depth - 1]) != length || strncmp(open[--depth], name, length) != 0) return 0;
        } else if (p[-1] != '/') {
            if (depth == 32) return 0;
            roots += depth == 0;
            snprintf(open[depth++], sizeof open[0], "%.*s", (int)length, name);
        }
    }
    return depth == 0 && roots == 1;
}

static void the_xml_scanner_tells_good_from_bad(void **state)
{
    (void)state;
    assert_true(is_well_formed("<?xml?><a><b c=\"d>\"/><e>x</e></a>"));
    assert_false(is_well_formed("<a><b></a></b>"));
    assert_false(is_well_formed("<a><b c=\"d/></a>"));
    assert_false(is_well_formed("<a></a><b></b>"));
    assert_false(is_well_formed("<a>&</a>"));
    assert_false(is_well_formed("<a>"));
}

static size_t size_of(const char *path)
{
    FILE *file = fopen(path, "rb");
    assert_non_null(file);
    fseek(file, 0, SEEK_END);
    long size = ftell(file);
    fclose(file);
    return (size_t)size;
}

/* Draws into an SVG, which must be well formed and hold finite numbers only, and returns its text; the caller frees it. */
static char *draw(pia_context *context, const pia_model *model, const double *points, pia_index count, const pia_plot_options *options)
{
    assert_ok(context, pia_plot(context, path_of("picture.svg"), &model, 1, points, count, options));
    char *text = read_text(path_of("picture.svg"));
    assert_true(is_well_formed(text));
    assert_null(strstr(text, "nan"));
    assert_null(strstr(text, "inf"));
    return text;
}

static int occurrences(const char *text, const char *what)
{
    int count = 0;
    for (const char *p = strstr(text, what); p != NULL; p = strstr(p + 1, what)) count++;
    return count;
}

static void every_format_begins_with_its_signature(void **state)
{
    static const struct {
        const char *name, *format, *begins;
    } file[] = {{"a.svg", NULL, "<?xml"},
                {"a.png", NULL, "\x89PNG"},
                {"a.pdf", NULL, "%PDF-"},
                {"a.PNG", NULL, "\x89PNG"},
                {"a", "svg", "<?xml"}};
    pia_model *model = make_curve(*state, 3, 12, 2, 0, 1);
    for (size_t i = 0; i < sizeof file / sizeof *file; i++) {
        pia_plot_options options;
        pia_plot_options_init(&options);
        options.format = file[i].format;
        assert_ok(*state, pia_plot(*state, path_of(file[i].name), (const pia_model *const *)&model, 1, NULL, 0, &options));
        char *text = read_text(path_of(file[i].name));
        assert_memory_equal(text, file[i].begins, strlen(file[i].begins));
        free(text);
    }
    assert_ok(*state, pia_plot(*state, path_of("default.svg"), (const pia_model *const *)&model, 1, NULL, 0, NULL));
    pia_model_destroy(model);
}

static unsigned big_endian(const char *bytes)
{
    const unsigned char *b = (const unsigned char *)bytes;
    return (unsigned)b[0] << 24 | (unsigned)b[1] << 16 | (unsigned)b[2] << 8 | b[3];
}

static void a_png_has_the_size_asked_for(void **state)
{
    static const double asked[][2] = {{800, 600}, {100, 100}, {1501, 333}, {0, 0}, {0, 400}, {2000, 0}};
    pia_model *model = make_curve(*state, 3, 12, 2, 0, 1);
    for (size_t i = 0; i < sizeof asked / sizeof *asked; i++) {
        pia_plot_options options;
        pia_plot_options_init(&options);
        options.width = asked[i][0];
        options.height = asked[i][1];
        assert_ok(*state, pia_plot(*state, path_of("a.png"), (const pia_model *const *)&model, 1, NULL, 0, &options));
        char *bytes = read_text(path_of("a.png"));
        unsigned width = big_endian(bytes + 16), height = big_endian(bytes + 20);
        if (asked[i][0] > 0) assert_int_equal(width, asked[i][0]);
        if (asked[i][1] > 0) assert_int_equal(height, asked[i][1]);
        assert_in_range(width, 100, 2000);
        assert_in_range(height, 100, 2000);
        free(bytes);
    }
    pia_model_destroy(model);
}

static void a_png_holds_more_than_blank_paper(void **state)
{
    pia_output *output = NULL;
    pia_canvas *canvas = NULL;
    assert_ok(*state, pia_output_open(*state, path_of("blank.png"), &output));
    assert_ok(*state, pia_canvas_open(*state, output, PIA_PICTURE_PNG, 640, 480, 1, &canvas));
    assert_ok(*state, canvas->close(canvas));
    assert_ok(*state, pia_output_commit(output));
    pia_model *model = make_curve(*state, 3, 12, 2, 0, 1);
    pia_plot_options options;
    pia_plot_options_init(&options);
    options.width = 640;
    options.height = 480;
    assert_ok(*state, pia_plot(*state, path_of("a.png"), (const pia_model *const *)&model, 1, NULL, 0, &options));
    assert_true(size_of(path_of("a.png")) > 8 * size_of(path_of("blank.png")));
    pia_model_destroy(model);
}

static void equal_pictures_are_equal_bytes(void **state)
{
    double parameters[600], points[600];
    const int degree[2] = {3, 3};
    const pia_index control[2] = {8, 9};
    for (int surface = 0; surface < 2; surface++) {
        pia_model *model = surface ? make_surface(*state, degree, control, 3, 0) : make_curve(*state, 3, 12, 2, 0, 1);
        scatter(*state, model, 200, 0.01, parameters, points);
        char *first = draw(*state, model, points, 200, NULL), *second = draw(*state, model, points, 200, NULL);
        assert_string_equal(first, second);
        free(first);
        free(second);
        pia_model_destroy(model);
    }
}

static void curves_of_every_degree_and_dimension_are_drawn(void **state)
{
    for (int dim = 1; dim <= 5; dim++) {
        for (int degree = 1; degree <= 7; degree += 2) {
            pia_model *model = make_curve(*state, degree, 20, dim, -3, 10);
            pia_plot_options options;
            pia_plot_options_init(&options);
            options.comb = 1;
            options.title = "A < B & \"C\"";
            free(draw(*state, model, NULL, 0, &options));
            pia_model_destroy(model);
        }
    }
}

static void surfaces_of_every_dimension_are_drawn(void **state)
{
    for (int dim = 1; dim <= 4; dim++) {
        const int degree[2] = {dim, 4 - dim / 2};
        const pia_index control[2] = {7, 11};
        pia_model *model = make_surface(*state, degree, control, dim, 0);
        free(draw(*state, model, NULL, 0, NULL));
        pia_model_destroy(model);
    }
}

/* A quarter of the domain: facets are fewer in that proportion, and the net is left out. */
static void a_trimmed_surface_ends_at_its_loops(void **state)
{
    static const double loop[] = {0.25, 0.25, 0.75, 0.25, 0.75, 0.75, 0.25, 0.75};
    const int degree[2] = {3, 3};
    const pia_index control[2] = {9, 9}, corners = 4;
    pia_model *whole = make_surface(*state, degree, control, 3, 0), *face = NULL;
    assert_ok(*state, pia_model_trim(*state, whole, 1, &corners, loop, &face));
    pia_plot_options options;
    pia_plot_options_init(&options);
    options.knots = options.control = 0;
    char *all = draw(*state, whole, NULL, 0, &options), *part = draw(*state, face, NULL, 0, &options);
    assert_true(occurrences(part, "<path") < occurrences(all, "<path") / 3);
    assert_true(occurrences(part, "<path") > occurrences(all, "<path") / 6);
    options.control = 1;
    char *with_net = draw(*state, face, NULL, 0, &options);
    assert_string_equal(part, with_net);
    free(all);
    free(part);
    free(with_net);
    pia_model_destroy(whole);
    pia_model_destroy(face);
}

static void views_from_everywhere_are_drawn(void **state)
{
    static const double view[][2] = {{0, 0}, {90, 90}, {-90, -90}, {180, -20}, {1234, 35}};
    const int degree[2] = {1, 1};
    const pia_index control[2] = {5, 4};
    pia_model *model = make_surface(*state, degree, control, 3, 1);
    for (size_t i = 0; i < sizeof view / sizeof *view; i++) {
        pia_plot_options options;
        pia_plot_options_init(&options);
        options.azimuth = view[i][0];
        options.elevation = view[i][1];
        free(draw(*state, model, NULL, 0, &options));
    }
    pia_model_destroy(model);
}

static void layers_come_and_go_with_their_options(void **state)
{
    pia_model *model = make_curve(*state, 3, 30, 2, 0, 1);
    pia_plot_options options;
    pia_plot_options_init(&options);
    char *full = draw(*state, model, NULL, 0, &options);
    options.knots = 0;
    char *without_knots = draw(*state, model, NULL, 0, &options);
    options.control = 0;
    char *bare = draw(*state, model, NULL, 0, &options);
    assert_true(occurrences(full, "<path") >= occurrences(without_knots, "<path") + 26);
    assert_true(occurrences(without_knots, "<path") >= occurrences(bare, "<path") + 30);
    free(full);
    free(without_knots);
    free(bare);
    pia_model_destroy(model);
}

static void shapes_without_extent_and_of_extreme_size_are_drawn(void **state)
{
    static const double shape[][2] = {{0, 0}, {7, 0}, {0, 1e-200}, {5e6, 1e-3}, {-1e140, 1e140}, {0, 1e140}, {1, 1e-15}, {3, 5e-324}};
    for (size_t i = 0; i < sizeof shape / sizeof *shape; i++) {
        for (int dim = 1; dim <= 3; dim++) {
            double parameters[30], points[90];
            pia_model *model = make_curve(*state, 3, 9, dim, shape[i][0], shape[i][1]);
            scatter(*state, model, 30, 0, parameters, points);
            pia_plot_options options;
            pia_plot_options_init(&options);
            options.comb = 1;
            options.parameters = parameters;
            free(draw(*state, model, points, 30, &options));
            pia_model_destroy(model);
        }
    }
}

static void a_straight_line_is_drawn_in_any_direction(void **state)
{
    static const double along[][2] = {{1, 0}, {0, 1}, {1, 1}, {1, 1e-9}, {-1, 0}};
    for (size_t i = 0; i < sizeof along / sizeof *along; i++) {
        const int degree = 1;
        const pia_index control = 2;
        const double knots[] = {0, 0, 1, 1}, points[] = {500, 500, 500 + along[i][0], 500 + along[i][1]};
        pia_model *model = NULL;
        assert_ok(*state, pia_model_create(*state, 1, &degree, (const double *const[]){knots}, &control, 2, points, NULL, &model));
        free(draw(*state, model, NULL, 0, NULL));
        pia_model_destroy(model);
    }
}

static void several_models_share_one_picture(void **state)
{
    const int degree[2] = {3, 3};
    const pia_index control[2] = {6, 6};
    pia_model *models[9];
    for (int i = 0; i < 8; i++) models[i] = make_curve(*state, 3, 10, 3, i, 1);
    models[8] = make_surface(*state, degree, control, 3, 1);
    double points[30];
    for (int i = 0; i < 30; i++) points[i] = 0.1 * i;
    for (pia_index count = 2; count <= 9; count += 7)
        assert_ok(*state, pia_plot(*state, path_of("a.svg"), (const pia_model *const *)models, count, points, 10, NULL));
    for (int i = 0; i < 9; i++) pia_model_destroy(models[i]);
}

static void a_trace_adds_a_panel_and_may_hold_any_number(void **state)
{
    pia_trace_row rows[50];
    for (int i = 0; i < 50; i++)
        rows[i] = (pia_trace_row){
            .iteration = i, .control_count = 10 + i / 20, .max_error = pow(10, -i / 5.0), .rms_error = pow(10, -i / 4.0)};
    rows[3].max_error = NAN;
    rows[4].rms_error = 0;
    rows[5].max_error = INFINITY;
    rows[6].rms_error = -1;
    pia_model *model = make_curve(*state, 3, 12, 2, 0, 1);
    pia_plot_options options;
    pia_plot_options_init(&options);
    char *plain = draw(*state, model, NULL, 0, &options);
    options.trace = rows;
    for (pia_index count = 1; count <= 50; count += 7) {
        options.trace_count = count;
        char *text = draw(*state, model, NULL, 0, &options);
        assert_true(strlen(text) > strlen(plain));
        free(text);
    }
    for (int i = 0; i < 50; i++) rows[i].max_error = rows[i].rms_error = i % 2 == 0 ? 0 : NAN;
    free(draw(*state, model, NULL, 0, &options));
    free(plain);
    pia_model_destroy(model);
}

static void a_million_points_are_thinned(void **state)
{
    enum { COUNT = 1000000 };
    double *parameters = malloc(COUNT * sizeof *parameters), *points = malloc(2 * COUNT * sizeof *points);
    pia_model *model = make_curve(*state, 3, 40, 2, 0, 1);
    scatter(*state, model, COUNT, 1e-3, parameters, points);
    pia_plot_options options;
    pia_plot_options_init(&options);
    options.parameters = parameters;
    assert_ok(*state, pia_plot(*state, path_of("a.svg"), (const pia_model *const *)&model, 1, points, COUNT, &options));
    assert_true(size_of(path_of("a.svg")) < 5000000);
    free(parameters);
    free(points);
    pia_model_destroy(model);
}

static void long_signals_and_large_nets_stay_small(void **state)
{
    const int degree[2] = {3, 3};
    const pia_index control[2] = {700, 300};
    pia_model *signal = make_curve(*state, 3, 100000, 1, 0, 1), *surface = make_surface(*state, degree, control, 3, 0);
    char *text = draw(*state, signal, NULL, 0, NULL);
    assert_true(strlen(text) < 4000000);
    free(text);
    text = draw(*state, surface, NULL, 0, NULL);
    assert_true(strlen(text) < 8000000);
    free(text);
    pia_model_destroy(signal);
    pia_model_destroy(surface);
}

static void assert_no_picture(pia_context *context, const char *name, const pia_model *model, const double *points, pia_index count,
                              const pia_plot_options *options, pia_status expected, const char *what)
{
    assert_status(context, pia_plot(context, path_of(name), &model, 1, points, count, options), expected);
    if (strstr(pia_message(context), what) == NULL)
        fail_msg("the message is \"%s\", it should hold \"%s\"", pia_message(context), what);
    assert_int_equal(file_count(), 0);
}

static void wrong_arguments_are_named_and_leave_no_file(void **state)
{
    pia_model *model = make_curve(*state, 3, 12, 2, 0, 1), *value = make_curve(*state, 3, 12, 1, 0, 1);
    const double good[] = {0, 0, 1, 1}, bad[] = {0, 0, 1, NAN}, far[] = {0, 0, 1e200, 1};
    pia_plot_options options;
    pia_plot_options_init(&options);
    assert_no_picture(*state, "a.jpg", model, NULL, 0, &options, PIA_E_ARGUMENT, "svg, png, pdf or html");
    assert_no_picture(*state, "a", model, NULL, 0, &options, PIA_E_ARGUMENT, "svg, png, pdf or html");
    assert_no_picture(*state, "a.svg", NULL, NULL, 0, &options, PIA_E_ARGUMENT, "model 0");
    assert_no_picture(*state, "a.svg", model, NULL, 3, &options, PIA_E_ARGUMENT, "3 points");
    assert_no_picture(*state, "a.svg", model, good, -1, &options, PIA_E_ARGUMENT, "-1 points");
    assert_no_picture(*state, "a.svg", model, bad, 2, &options, PIA_E_DATA, "point 1 component 1");
    assert_no_picture(*state, "a.svg", model, far, 2, &options, PIA_E_DATA, "point 1 component 0");
    assert_no_picture(*state, "a.svg", value, good, 4, &options, PIA_E_ARGUMENT, "parameters");
    assert_no_picture(*state, "no/folder/a.svg", model, NULL, 0, &options, PIA_E_FILE, "no/folder");
    options.width = 20;
    assert_no_picture(*state, "a.svg", model, NULL, 0, &options, PIA_E_ARGUMENT, "20");
    options.width = NAN;
    assert_no_picture(*state, "a.svg", model, NULL, 0, &options, PIA_E_ARGUMENT, "picture");
    options.width = 0;
    options.elevation = 100;
    assert_no_picture(*state, "a.svg", model, NULL, 0, &options, PIA_E_ARGUMENT, "elevation");
    options.elevation = 0;
    options.trace_count = 2;
    assert_no_picture(*state, "a.svg", model, NULL, 0, &options, PIA_E_ARGUMENT, "trace");
    options.struct_size = 0;
    assert_no_picture(*state, "a.svg", model, NULL, 0, &options, PIA_E_ARGUMENT, "pia_plot_options_init");
    assert_status(*state, pia_plot(*state, NULL, (const pia_model *const *)&model, 1, NULL, 0, NULL), PIA_E_ARGUMENT);
    assert_status(*state, pia_plot(*state, "a.svg", NULL, 0, NULL, 0, NULL), PIA_E_ARGUMENT);
    pia_model_destroy(model);
    pia_model_destroy(value);
}

static void a_full_disk_is_told(void **state)
{
    pia_model *model = make_curve(*state, 3, 12, 2, 0, 1);
    pia_plot_options options;
    pia_plot_options_init(&options);
    options.format = "png";
    assert_status(*state, pia_plot(*state, "/dev/full", (const pia_model *const *)&model, 1, NULL, 0, &options), PIA_E_FILE);
    pia_model_destroy(model);
}

static void without_cairo_the_package_to_install_is_named(void **state)
{
    pia_model *model = make_curve(*state, 3, 12, 2, 0, 1);
    assert_no_picture(*state, "a.svg", model, NULL, 0, NULL, PIA_E_UNAVAILABLE, "libcairo2-dev");
    pia_model_destroy(model);
}

/* Asks the library itself, so that the test serves builds with and without Cairo. */
static int can_draw(void)
{
    void *context = NULL;
    assert_int_equal(enter_folder(&context), 0);
    pia_model *model = make_curve(context, 3, 12, 2, 0, 1);
    pia_status status = pia_plot(context, path_of("a.svg"), (const pia_model *const *)&model, 1, NULL, 0, NULL);
    pia_model_destroy(model);
    leave_folder(&context);
    return status != PIA_E_UNAVAILABLE;
}

int main(void)
{
    const struct CMUnitTest without[] = {IN_FOLDER(without_cairo_the_package_to_install_is_named)};
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_xml_scanner_tells_good_from_bad),
        IN_FOLDER(every_format_begins_with_its_signature),
        IN_FOLDER(a_png_has_the_size_asked_for),
        IN_FOLDER(a_png_holds_more_than_blank_paper),
        IN_FOLDER(equal_pictures_are_equal_bytes),
        IN_FOLDER(curves_of_every_degree_and_dimension_are_drawn),
        IN_FOLDER(surfaces_of_every_dimension_are_drawn),
        IN_FOLDER(a_trimmed_surface_ends_at_its_loops),
        IN_FOLDER(views_from_everywhere_are_drawn),
        IN_FOLDER(layers_come_and_go_with_their_options),
        IN_FOLDER(shapes_without_extent_and_of_extreme_size_are_drawn),
        IN_FOLDER(a_straight_line_is_drawn_in_any_direction),
        IN_FOLDER(several_models_share_one_picture),
        IN_FOLDER(a_trace_adds_a_panel_and_may_hold_any_number),
        IN_FOLDER(a_million_points_are_thinned),
        IN_FOLDER(long_signals_and_large_nets_stay_small),
        IN_FOLDER(wrong_arguments_are_named_and_leave_no_file),
        IN_FOLDER(a_full_disk_is_told),
    };
    return can_draw() ? cmocka_run_group_tests(tests, NULL, NULL) : cmocka_run_group_tests(without, NULL, NULL);
}
