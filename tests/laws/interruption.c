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

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(an_iteration_stops_where_it_is_and_goes_on_later),
        cmocka_unit_test(a_search_for_knots_keeps_the_model_it_has),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
