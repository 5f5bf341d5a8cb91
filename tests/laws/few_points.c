/* A tolerance can be had wherever a curve or surface can go through all points, however few those are. */
#include "context_fixture.h"

static double random_number(uint64_t *seed)
{
    *seed = *seed * 6364136223846793005u + 1442695040888963407u;
    return (double)(*seed >> 11) * 0x1p-53;
}

enum { MOST = 20 };

static void is_reached(pia_context *context, const pia_data *data, pia_fit_options *options)
{
    pia_report report = {.struct_size = sizeof report};
    options->tolerance = 1e-9;
    assert_ok(context, pia_fit_data(context, data, options, NULL, &report));
    if (report.stop != PIA_STOP_TOLERANCE)
        fail_msg("%s: %g of %lld x %lld points, degree %d, %d, closed %d, %d", pia_stop_name(report.stop), report.max_error,
                 (long long)data->count[0], (long long)data->count[1], options->degree[0], options->degree[1], options->closed[0],
                 options->closed[1]);
    assert_int_equal(report.reached, 1);
    assert_true(report.max_error <= 1e-9);
}

static void few_points_of_a_curve_are_met(void **state)
{
    double points[2 * MOST];
    uint64_t seed = 1;
    for (int degree = 1; degree <= 8; degree++)
        for (int count = degree + 2; count <= MOST; count++)
            for (int closed = 0; closed < 2; closed++) {
                pia_data data;
                pia_fit_options options;
                pia_data_init(&data);
                pia_fit_options_init(&options);
                for (int i = 0; i < 2 * count; i++) points[i] = random_number(&seed);
                data.points = points;
                data.count[0] = count;
                data.dim = 2;
                options.degree[0] = degree;
                options.closed[0] = closed;
                is_reached(*state, &data, &options);
            }
}

static void few_points_of_a_grid_are_met(void **state)
{
    double points[MOST * MOST], t[2 * MOST];
    uint64_t seed = 1;
    for (int d = 0; d < 2 * MOST; d++) t[d] = d % MOST;
    for (int p = 1; p <= 4; p++)
        for (int u = p + 1; u <= 10; u++)
            for (int v = 4; v <= 10; v++) {
                pia_data data;
                pia_fit_options options;
                pia_data_init(&data);
                pia_fit_options_init(&options);
                for (int i = 0; i < u * v; i++) points[i] = random_number(&seed);
                double parameters[2 * MOST];
                memcpy(parameters, t, (size_t)u * sizeof *t);
                memcpy(parameters + u, t, (size_t)v * sizeof *t);
                data.kind = PIA_GRID;
                data.points = points;
                data.parameters = parameters;
                data.count[0] = u;
                data.count[1] = v;
                data.dim = 1;
                options.degree[0] = p;
                is_reached(*state, &data, &options);
            }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(few_points_of_a_curve_are_met),
        cmocka_unit_test(few_points_of_a_grid_are_met),
    };
    return cmocka_run_group_tests(tests, open_context, close_context);
}
