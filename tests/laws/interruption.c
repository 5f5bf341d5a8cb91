#include "pia/pia.h"

#include "check.h"

#include <math.h>

enum { POINTS = 400 };

/* Answers "stop" from the request after `patience` on. */
typedef struct asked {
    pia_index patience, count;
} asked;

static int when_patience_ends(void *user)
{
    asked *a = user;
    return ++a->count > a->patience;
}

static pia_context *context_of(asked *user)
{
    pia_context_options options;
    pia_context_options_init(&options);
    options.interrupted = when_patience_ends;
    options.user = user;
    pia_context *context = NULL;
    assert_ok(NULL, pia_context_create(&options, &context));
    return context;
}

static pia_data wave(double points[2 * POINTS])
{
    for (int i = 0; i < POINTS; i++) {
        points[2 * i] = i;
        points[2 * i + 1] = 20 * sin(1e-3 * i * i);
    }
    pia_data data;
    pia_data_init(&data);
    data.points = points;
    data.count[0] = POINTS;
    data.dim = 2;
    return data;
}

static void an_iteration_stops_where_it_is_and_goes_on_later(void **state)
{
    (void)state;
    double points[2 * POINTS];
    pia_data data = wave(points);
    pia_fit_options options;
    pia_fit_options_init(&options);
    options.method = "lspia";
    options.control[0] = 60;
    options.stop_change = options.stop_gradient = 0;
    options.max_iterations = 50;
    asked user = {10, 0};
    pia_context *context = context_of(&user);
    pia_fit *fit;
    pia_report report;
    assert_ok(context, pia_fit_open(context, &data, &options, &fit));
    report.struct_size = sizeof report;
    assert_ok(context, pia_fit_run(fit, &report));
    assert_int_equal(report.stop, PIA_STOP_CANCELLED);
    assert_int_equal(report.iterations, 10);
    user.patience = INT64_MAX;
    assert_ok(context, pia_fit_run(fit, &report));
    assert_int_equal(report.stop, PIA_STOP_ITERATIONS);
    assert_int_equal(report.iterations, 50);
    pia_fit_close(fit);
    pia_context_destroy(context);
}

static void a_search_for_knots_keeps_the_model_it_has(void **state)
{
    (void)state;
    double points[2 * POINTS];
    pia_data data = wave(points);
    pia_fit_options options;
    pia_fit_options_init(&options);
    options.tolerance = 1e-3;
    asked user = {2, 0};
    pia_context *context = context_of(&user);
    pia_model *model = NULL;
    pia_report report;
    report.struct_size = sizeof report;
    assert_ok(context, pia_fit_data(context, &data, &options, &model, &report));
    assert_int_equal(report.stop, PIA_STOP_CANCELLED);
    assert_int_equal(report.reached, 0);
    double end[2], last = POINTS;
    assert_ok(context, pia_model_eval(context, model, &last, 1, 0, end));
    assert_true(isfinite(end[0]) && isfinite(end[1]));
    pia_model_destroy(model);
    pia_context_destroy(context);
}

static int stop_once(void *user, const pia_report *so_far)
{
    (void)so_far;
    return ++*(int *)user == 3;
}

/* What stopped from outside does not bind the next call: knots are looked for on. */
static void a_refinement_goes_on_after_it_was_cancelled(void **state)
{
    (void)state;
    pia_context *context;
    pia_data data;
    pia_fit_options options;
    pia_fit *fit;
    pia_report report = {.struct_size = sizeof report};
    double points[400];
    int calls = 0;
    for (int i = 0; i < 200; i++) {
        points[2 * i] = i;
        points[2 * i + 1] = sin(0.2 * i) + 0.3 * sin(1.7 * i);
    }
    pia_data_init(&data);
    pia_fit_options_init(&options);
    data.points = points;
    data.count[0] = 200;
    data.dim = 2;
    options.tolerance = 0.01;
    options.progress = stop_once;
    options.user = &calls;
    assert_ok(NULL, pia_context_create(NULL, &context));
    assert_ok(context, pia_fit_open(context, &data, &options, &fit));
    assert_ok(context, pia_fit_run(fit, &report));
    assert_int_equal(report.stop, PIA_STOP_CANCELLED);
    assert_int_equal(report.reached, 0);
    assert_ok(context, pia_fit_run(fit, &report));
    assert_int_equal(report.stop, PIA_STOP_TOLERANCE);
    assert_int_equal(report.reached, 1);
    pia_fit_close(fit);
    pia_context_destroy(context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_refinement_goes_on_after_it_was_cancelled),
        cmocka_unit_test(an_iteration_stops_where_it_is_and_goes_on_later),
        cmocka_unit_test(a_search_for_knots_keeps_the_model_it_has),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
