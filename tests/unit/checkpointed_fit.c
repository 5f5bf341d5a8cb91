/* Saving and resuming a fit: the next steps give the same bits as if it had never stopped. */
#include "check.h"

#include <stdlib.h>
#include <unistd.h>

enum { ROWS = 80 };

static void fill(double *points, int closed)
{
    for (int i = 0; i < ROWS; i++) {
        double a = 6.283185307179586 * i / ROWS * (closed ? 1 : 0.85);
        points[2 * i] = 1e3 + cos(a) * (2 + sin(3 * a));
        points[2 * i + 1] = sin(a) + 0.01 * cos(17 * a);
    }
}

static void compare_models(const pia_model *a, const pia_model *b)
{
    pia_model_info info = {.struct_size = sizeof info};
    pia_model_get_info(a, &info);
    size_t count = (size_t)(info.control[0] * info.control[1] * info.dim);
    double *p = malloc(count * sizeof *p), *q = malloc(count * sizeof *q);
    pia_model_control(a, p, NULL);
    pia_model_control(b, q, NULL);
    assert_memory_equal(p, q, count * sizeof *p);
    free(p);
    free(q);
}

/* Steps 7, saves, steps 9 more; the resumed fit steps the same 9. */
static void check_data(pia_context *context, const pia_data *data, const pia_fit_options *options)
{
    char path[] = "/tmp/pia_checkpoint_XXXXXX";
    close(mkstemp(path));
    pia_fit *fit, *resumed;
    assert_ok(context, pia_fit_open(context, data, options, &fit));
    assert_ok(context, pia_fit_step(fit, 7, NULL));
    assert_ok(context, pia_fit_save(fit, path));
    assert_ok(context, pia_fit_resume(context, path, &resumed));
    pia_report a = {.struct_size = sizeof a}, b = {.struct_size = sizeof b};
    assert_ok(context, pia_fit_step(fit, 9, &a));
    assert_ok(context, pia_fit_step(resumed, 9, &b));
    assert_int_equal(a.iterations, b.iterations);
    assert_true(memcmp(&a.max_error, &b.max_error, sizeof a.max_error) == 0);
    assert_string_equal(a.method, b.method);
    pia_trace_row row;
    assert_true(pia_fit_trace(resumed, a.iterations, &row));
    assert_int_equal(row.iteration, a.iterations);
    pia_model *m, *n;
    assert_ok(context, pia_fit_model(fit, &m));
    assert_ok(context, pia_fit_model(resumed, &n));
    compare_models(m, n);
    pia_model_destroy(m);
    pia_model_destroy(n);
    pia_fit_close(fit);
    pia_fit_close(resumed);
    unlink(path);
}

static void check_fit(const pia_fit_options *options)
{
    pia_context *context;
    double points[2 * ROWS];
    fill(points, options->closed[0]);
    assert_int_equal(pia_context_create(NULL, &context), PIA_OK);
    pia_data data;
    pia_data_init(&data);
    data.points = points;
    data.count[0] = ROWS;
    data.dim = 2;
    check_data(context, &data, options);
    pia_context_destroy(context);
}

static void check_method(const char *method, int closed, pia_index control, int constrained)
{
    pia_index meet[] = {10, 40};
    pia_fit_options options;
    pia_fit_options_init(&options);
    options.method = method;
    options.closed[0] = closed;
    options.control[0] = control;
    options.stop_change = options.stop_gradient = 0;
    options.trace_every = 1;
    options.interpolate = meet;
    options.interpolate_count = constrained ? 2 : 0;
    check_fit(&options);
}

static void every_method_goes_on_with_the_same_bits(void **state)
{
    (void)state;
    pia_entry entry;
    for (pia_index i = 1; pia_list("method", i, &entry); i++) {
        int interpolates = strcmp(entry.name, "pia") == 0 || strcmp(entry.name, "wpia") == 0 || strcmp(entry.name, "local-pia") == 0 ||
                           strcmp(entry.name, "gia") == 0 || strcmp(entry.name, "pia-chebyshev") == 0;
        int constrained = strncmp(entry.name, "clspia", 6) == 0 || strcmp(entry.name, "direct") == 0;
        if (strcmp(entry.name, "cg-kron") == 0 || strcmp(entry.name, "epia") == 0) continue; /* scattered points; below */
        for (int closed = 0; closed < 2; closed++) check_method(entry.name, closed, interpolates ? PIA_AUTO : 20, constrained);
    }
}

static void epia_goes_on_inserting_the_same_knots(void **state)
{
    (void)state;
    pia_index meet[] = {10, 41};
    pia_fit_options options;
    pia_fit_options_init(&options);
    options.method = "epia";
    options.tolerance = 1e-4;
    options.trace_every = 1;
    options.interpolate = meet;
    options.interpolate_count = 2;
    check_fit(&options);
}

/* How a fit is held up after every iteration: it is stepped by one, or may make only so many. */
typedef enum hold { BY_STEP, BY_RULE } hold;

/* One iteration, then the fit is saved, closed and resumed. Returns whether it has work left. */
static int step_and_resume(pia_context *context, pia_fit **fit, const char *path, hold how, pia_report *report)
{
    char next[32];
    snprintf(next, sizeof next, "%d", (int)report->iterations + 1);
    if (how == BY_RULE) assert_ok(context, pia_fit_set(*fit, "max_iterations", next));
    assert_ok(context, pia_fit_step(*fit, how == BY_RULE ? 1000 : 1, report));
    assert_ok(context, pia_fit_save(*fit, path));
    pia_fit_close(*fit);
    assert_ok(context, pia_fit_resume(context, path, fit));
    return report->stop == (how == BY_RULE ? PIA_STOP_ITERATIONS : PIA_STOP_NONE);
}

/* What has ended stays as it is, though more iterations are allowed. */
static void check_end(pia_context *context, pia_fit *fit, const pia_report *end)
{
    pia_report more = {.struct_size = sizeof more};
    assert_ok(context, pia_fit_set(fit, "max_iterations", "1000"));
    assert_ok(context, pia_fit_step(fit, 1000, &more));
    assert_int_equal(more.stop, end->stop);
    assert_int_equal(more.iterations, end->iterations);
}

/* A fit that is saved, closed and resumed after every iteration ends with the bits of one that is not. */
static void check_held(const pia_data *data, const pia_fit_options *options, hold how, pia_report *a)
{
    pia_context *context;
    assert_int_equal(pia_context_create(NULL, &context), PIA_OK);
    char path[] = "/tmp/pia_checkpoint_XXXXXX";
    close(mkstemp(path));
    pia_fit *whole, *paused;
    pia_report b = {.struct_size = sizeof b};
    *a = b;
    assert_ok(context, pia_fit_open(context, data, options, &whole));
    assert_ok(context, pia_fit_step(whole, 1000, a));
    assert_ok(context, pia_fit_open(context, data, options, &paused));
    while (step_and_resume(context, &paused, path, how, &b))
        ;
    check_end(context, paused, &b);
    assert_int_equal(b.stop, a->stop);
    assert_int_equal(b.iterations, a->iterations);
    assert_int_equal(b.control_count, a->control_count);
    pia_model *m, *n;
    assert_ok(context, pia_fit_model(whole, &m));
    assert_ok(context, pia_fit_model(paused, &n));
    compare_models(m, n);
    pia_model_destroy(m);
    pia_model_destroy(n);
    pia_fit_close(whole);
    pia_fit_close(paused);
    pia_context_destroy(context);
    unlink(path);
}

static void check_pauses(const pia_data *data, const pia_fit_options *options, pia_report *report)
{
    check_held(data, options, BY_STEP, report);
    check_held(data, options, BY_RULE, report);
}

static void refining_a_curve_goes_on_with_the_same_bits(void **state)
{
    (void)state;
    pia_index corner[] = {20}, meet[] = {10, 41};
    double points[2 * ROWS];
    for (int closed = 0; closed < 2; closed++)
        for (int variant = 0; variant < 5; variant++) {
            fill(points, closed);
            pia_data data;
            pia_data_init(&data);
            data.points = points;
            data.count[0] = ROWS;
            data.dim = 2;
            pia_fit_options options;
            pia_fit_options_init(&options);
            options.closed[0] = closed;
            options.tolerance = 0.01;
            options.measure_distance = variant == 1;
            options.corners = corner;
            options.corner_count = variant == 2;
            options.interpolate = meet;
            options.interpolate_count = variant == 3 ? 2 : 0;
            options.correct = variant == 4 ? 2 : 0;
            pia_report report;
            check_pauses(&data, &options, &report);
            assert_int_equal(report.stop, PIA_STOP_TOLERANCE);
        }
}

enum { SIDE = 40 };

typedef enum sheet { WAVE, ROUGH_WAVE, NOISE } sheet;

/* Points over the unit square, in lines or not. */
static void fill_sheet(double *points, int in_lines, sheet what)
{
    unsigned long long random = 1;
    for (int i = 0; i < SIDE * SIDE; i++) {
        double *p = points + 3 * i;
        for (int d = 0; d < 3; d++) {
            random = random * 6364136223846793005ULL + 1442695040888963407ULL;
            p[d] = (double)(random >> 33) / 2147483648.0;
        }
        if (in_lines) p[0] = i / SIDE, p[1] = i % SIDE;
        double wave = sin(5 * p[0] / (in_lines ? SIDE : 1)) * cos(4 * p[1] / (in_lines ? SIDE : 1));
        if (what != NOISE) p[2] = wave + (what == ROUGH_WAVE ? 0.1 * p[2] : 0);
    }
}

/* Noise has no knots to find: growth is given up after some rounds that do not help, however often they are interrupted. */
static void refining_a_surface_goes_on_with_the_same_bits(void **state)
{
    (void)state;
    static double points[3 * SIDE * SIDE];
    for (int scattered = 0; scattered < 2; scattered++)
        for (int distance = 0; distance < 2; distance++)
            for (sheet what = WAVE; what <= NOISE; what += scattered ? 2 : 1) {
                fill_sheet(points, !scattered, what);
                pia_data data;
                pia_data_init(&data);
                data.points = points;
                data.kind = scattered ? PIA_SCATTERED : PIA_GRID;
                data.count[0] = scattered ? SIDE * SIDE : SIDE;
                data.count[1] = scattered ? 1 : SIDE;
                data.dim = 3;
                pia_fit_options options;
                pia_fit_options_init(&options);
                options.parametrization = scattered ? "xy" : NULL;
                options.measure_distance = distance;
                options.tolerance = what == WAVE ? 0.001 : 0.05;
                pia_report report;
                check_pauses(&data, &options, &report);
                assert_true(report.control_count <= SIDE * SIDE);
            }
}

static void tolerances_of_axes_go_on_as_well(void **state)
{
    (void)state;
    static const double axes[] = {1e-2, 1e-4};
    pia_fit_options options;
    pia_fit_options_init(&options);
    options.method = "epia";
    options.axis_tolerances = axes;
    options.axis_tolerance_count = 2;
    options.trace_every = 1;
    check_fit(&options);
}

/* The loop of a method knew no axes when it was opened. */
static void axes_are_asked_exchanged_and_dropped_on_the_way(void **state)
{
    pia_context *context;
    (void)state;
    assert_int_equal(pia_context_create(NULL, &context), PIA_OK);
    double points[2 * ROWS];
    fill(points, 0);
    pia_data data;
    pia_data_init(&data);
    data.points = points;
    data.count[0] = ROWS;
    data.dim = 2;
    pia_fit_options options;
    pia_fit_options_init(&options);
    options.method = "lspia";
    options.control[0] = 40;
    pia_fit *fit;
    pia_report report = {.struct_size = sizeof report};
    assert_ok(context, pia_fit_open(context, &data, &options, &fit));
    assert_ok(context, pia_fit_run(fit, &report));
    assert_int_equal(report.reached, PIA_AUTO);
    assert_true(isnan(report.axis_error[0]));
    double error = report.max_error;
    char text[80];
    snprintf(text, sizeof text, "%.17g,%.17g", error, error);
    assert_ok(context, pia_fit_set(fit, "axis_tolerances", text));
    assert_ok(context, pia_fit_run(fit, &report));
    assert_int_equal(report.stop, PIA_STOP_TOLERANCE);
    assert_int_equal(report.reached, 1);
    assert_true(report.axis_error[0] <= error && report.axis_error[1] <= error);
    assert_ok(context, pia_fit_set(fit, "axis_tolerances", "1,1e-12"));
    assert_ok(context, pia_fit_report(fit, &report));
    assert_int_equal(report.reached, 0);
    assert_int_equal(report.worst_axis, 1);
    assert_ok(context, pia_fit_set(fit, "axis_tolerances", "none"));
    assert_ok(context, pia_fit_report(fit, &report));
    assert_int_equal(report.reached, 1); /* within the ball, which stays */
    const char *const bad[] = {"", "1", "1,2,3", "1,0", "1,-1", "1,x", "1,2,"};
    for (size_t k = 0; k < sizeof bad / sizeof *bad; k++) assert_int_not_equal(pia_fit_set(fit, "axis_tolerances", bad[k]), PIA_OK);
    pia_fit_close(fit);
    pia_context_destroy(context);
}

static void a_damaged_checkpoint_is_refused(void **state)
{
    (void)state;
    pia_context *context;
    char path[] = "/tmp/pia_checkpoint_XXXXXX";
    assert_int_equal(pia_context_create(NULL, &context), PIA_OK);
    int file = mkstemp(path);
    assert_true(write(file, "PIACKPT\n garbage", 16) == 16);
    close(file);
    pia_fit *fit;
    assert_status(context, pia_fit_resume(context, path, &fit), PIA_E_FORMAT);
    unlink(path);
    assert_status(context, pia_fit_resume(context, path, &fit), PIA_E_FILE);
    pia_context_destroy(context);
}

/* What a fit has besides its method: a shape to keep, weights of a loss, fairing, control points that the data do not hold. */
static void limiters_losses_fairing_and_gaps_go_on_as_well(void **state)
{
    (void)state;
    static const char *const limiter[] = {"convex", "convex-local", "inflection", "inflection-paper"}, *const loss[] = {"huber",
                                                                                                                        "tukey"};
    pia_context *context;
    double points[2 * ROWS], parameters[ROWS], knots[24];
    assert_int_equal(pia_context_create(NULL, &context), PIA_OK);
    for (int k = 0; k < 8; k++) {
        pia_data data;
        pia_fit_options options;
        pia_data_init(&data);
        pia_fit_options_init(&options);
        fill(points, 0);
        for (int i = 0; i < ROWS; i++) parameters[i] = (i < ROWS / 2 ? 0.3 : 0.7 - 0.3) * i / (ROWS / 2) + (i < ROWS / 2 ? 0 : 0.2);
        for (int i = 0; i < 24; i++) knots[i] = i < 4 ? 0 : i > 19 ? 1 : (i - 3) / 17.0;
        data.points = points;
        data.count[0] = ROWS;
        data.dim = 2;
        options.method = k < 6 ? "lspia" : "cg";
        options.control[0] = 20;
        options.limiter = k < 4 ? limiter[k] : NULL;
        options.robust = k == 4 || k == 5 ? loss[k - 4] : NULL;
        options.fairing = k == 6 ? 0.1 : 0;
        options.stop_gradient = k == 4 || k == 5 ? 1e-2 : 0;
        options.stop_change = 0;
        options.trace_every = 1;
        if (k == 7) {
            data.parameters = parameters;
            options.knots[0] = knots;
            options.knot_count[0] = 24;
        }
        check_data(context, &data, &options);
    }
    pia_context_destroy(context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(limiters_losses_fairing_and_gaps_go_on_as_well),
        cmocka_unit_test(every_method_goes_on_with_the_same_bits),
        cmocka_unit_test(epia_goes_on_inserting_the_same_knots),
        cmocka_unit_test(tolerances_of_axes_go_on_as_well),
        cmocka_unit_test(refining_a_curve_goes_on_with_the_same_bits),
        cmocka_unit_test(refining_a_surface_goes_on_with_the_same_bits),
        cmocka_unit_test(axes_are_asked_exchanged_and_dropped_on_the_way),
        cmocka_unit_test(a_damaged_checkpoint_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
