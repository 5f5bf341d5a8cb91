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
        cmocka_unit_test(a_damaged_checkpoint_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
