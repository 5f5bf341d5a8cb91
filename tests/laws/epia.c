/* Laws of method epia and of the knots at dominant points, over the public interface. */
#include <stdlib.h>

#include "check.h"

enum { COUNT = 150, ROWS = 22, COLUMNS = 27, MOST = 16384 };

typedef struct outcome {
    pia_report report;
    pia_model_info info;
    double control[MOST], knots[2][1024];
    pia_index traced;
    pia_trace_row trace[4096];
} outcome;

static double random_number(uint64_t *seed)
{
    *seed = *seed * 6364136223846793005u + 1442695040888963407u;
    return (double)(*seed >> 11) * 0x1p-53;
}

/* A line with bends of all sizes and a little noise. */
static void bends(double *points, int dim)
{
    uint64_t seed = 77;
    for (int i = 0; i < COUNT; i++) {
        double t = 0.06 * i;
        for (int d = 0; d < dim; d++)
            points[i * dim + d] =
                (d == 0) * t + sin((1.3 + d) * t + d) + 0.4 * cos(0.5 * t * t / (1 + d)) + 1e-3 * random_number(&seed);
    }
}

static void hills(double *points)
{
    for (int i = 0; i < ROWS; i++)
        for (int j = 0; j < COLUMNS; j++) {
            double *p = points + (i * COLUMNS + j) * 3, x = 0.2 * i + 0.03 * sin(j), y = 0.15 * j;
            p[0] = x;
            p[1] = y;
            p[2] = sin(2.1 * x + 0.3) * cos(1.7 * y) + 0.3 * sin(4 * x * y);
        }
}

static pia_data curve_data(const double *points, int dim)
{
    pia_data data;
    pia_data_init(&data);
    data.points = points;
    data.count[0] = COUNT;
    data.dim = dim;
    return data;
}

static pia_data grid_data(const double *points)
{
    pia_data data = curve_data(points, 3);
    data.kind = PIA_GRID;
    data.count[0] = ROWS;
    data.count[1] = COLUMNS;
    return data;
}

static pia_fit_options epia_options(double tolerance)
{
    pia_fit_options options;
    pia_fit_options_init(&options);
    options.method = "epia";
    options.tolerance = tolerance;
    options.trace_every = 1;
    return options;
}

static outcome *run(pia_context *context, const pia_data *data, const pia_fit_options *options)
{
    outcome *o = calloc(1, sizeof *o);
    pia_fit *fit;
    pia_model *model;
    o->report.struct_size = sizeof o->report;
    o->info.struct_size = sizeof o->info;
    assert_ok(context, pia_fit_open(context, data, options, &fit));
    assert_ok(context, pia_fit_run(fit, &o->report));
    assert_ok(context, pia_fit_model(fit, &model));
    pia_model_get_info(model, &o->info);
    assert_true(o->info.control[0] * o->info.control[1] * o->info.dim <= MOST);
    pia_model_control(model, o->control, NULL);
    for (int d = 0; d < o->info.directions; d++)
        memcpy(o->knots[d], pia_model_knots(model, d), (size_t)o->info.knot_count[d] * sizeof(double));
    while (o->traced < 4096 && pia_fit_trace(fit, o->traced, &o->trace[o->traced])) o->traced++;
    pia_model_destroy(model);
    pia_fit_close(fit);
    return o;
}

static pia_index control_size(const outcome *o)
{
    return o->info.control[0] * o->info.control[1] * o->info.dim;
}

static void curves_and_patches_end_within_the_tolerance(void **state)
{
    for (int degree = 1; degree <= 5; degree++)
        for (int dim = 2; dim <= 4; dim++) {
            double points[4 * COUNT], grid[3 * ROWS * COLUMNS];
            bends(points, dim);
            hills(grid);
            pia_data curve = curve_data(points, dim), patch = grid_data(grid);
            pia_fit_options options = epia_options(0.02);
            options.degree[0] = options.degree[1] = degree;
            outcome *o = run(*state, &curve, &options);
            assert_true(o->report.stop == PIA_STOP_TOLERANCE && o->report.reached == 1 && o->report.max_error <= 0.02);
            assert_true(o->report.control_count < COUNT);
            free(o);
            if (dim > 2) continue;
            o = run(*state, &patch, &options);
            assert_true(o->report.stop == PIA_STOP_TOLERANCE && o->report.max_error <= 0.02);
            free(o);
        }
}

/* Table 1 of [2011]: control points grow, the error falls in the long run. */
static void control_points_grow_along_the_trace_and_the_error_falls(void **state)
{
    double points[2 * COUNT];
    bends(points, 2);
    pia_data data = curve_data(points, 2);
    pia_fit_options options = epia_options(0.004);
    outcome *o = run(*state, &data, &options);
    assert_int_equal(o->traced, o->report.iterations + 1);
    for (pia_index k = 1; k < o->traced; k++) {
        assert_true(o->trace[k].control_count >= o->trace[k - 1].control_count);
        assert_true(o->trace[k].control_count <= o->trace[k - 1].control_count + 1); /* one knot a round */
    }
    assert_true(o->trace[o->traced - 1].control_count > o->trace[0].control_count);
    assert_true(o->trace[o->traced - 1].max_error < o->trace[0].max_error / 10);
    assert_int_equal(o->report.round_count, o->trace[o->traced - 1].control_count - o->trace[0].control_count);
    free(o);
}

static void fitting_commutes_with_similarities(void **state)
{
    double points[2 * COUNT], moved[2 * COUNT];
    double c = 30 * cos(1.1), s = 30 * sin(1.1);
    bends(points, 2);
    for (int i = 0; i < COUNT; i++) {
        moved[2 * i] = c * points[2 * i] - s * points[2 * i + 1] + 100;
        moved[2 * i + 1] = s * points[2 * i] + c * points[2 * i + 1] - 40;
    }
    pia_data one = curve_data(points, 2), other = curve_data(moved, 2);
    pia_fit_options options = epia_options(0.01);
    outcome *a = run(*state, &one, &options);
    options.tolerance = 0.3;
    outcome *b = run(*state, &other, &options);
    assert_int_equal(a->report.control_count, b->report.control_count);
    assert_int_equal(a->report.iterations, b->report.iterations);
    for (pia_index i = 0; i < a->info.control[0]; i++) {
        const double *p = a->control + 2 * i, *q = b->control + 2 * i;
        assert_near(q[0], c * p[0] - s * p[1] + 100, 1e-9);
        assert_near(q[1], s * p[0] + c * p[1] - 40, 1e-9);
    }
    free(a);
    free(b);
}

static void any_number_of_threads_inserts_the_same_knots_and_gives_the_same_bits(void **state)
{
    (void)state;
    double points[3 * COUNT], grid[3 * ROWS * COLUMNS];
    bends(points, 3);
    hills(grid);
    pia_data data[] = {curve_data(points, 3), grid_data(grid)};
    pia_fit_options options = epia_options(0.02);
    for (int k = 0; k < 2; k++) {
        outcome *first = NULL;
        for (int threads = 1; threads <= 8; threads *= 2) {
            pia_context *context;
            assert_ok(NULL, pia_context_create(NULL, &context));
            assert_ok(context, pia_context_set_threads(context, threads));
            outcome *o = run(context, &data[k], &options);
            if (first != NULL) {
                assert_int_equal(o->report.iterations, first->report.iterations);
                assert_int_equal(control_size(o), control_size(first));
                assert_memory_equal(o->control, first->control, (size_t)control_size(o) * sizeof(double));
                free(o);
            } else {
                first = o;
            }
            pia_context_destroy(context);
        }
        free(first);
    }
}

/* As in Fig. 2 of [2011]. */
static void chosen_points_are_met_and_the_ends_are_kept(void **state)
{
    double points[2 * COUNT];
    const pia_index meet[] = {33, 34, 90};
    bends(points, 2);
    pia_data data = curve_data(points, 2);
    pia_fit_options options = epia_options(0);
    options.control[0] = 30;
    options.interpolate = meet;
    options.interpolate_count = 3;
    options.max_iterations = 5000;
    outcome *o = run(*state, &data, &options);
    assert_int_equal(o->report.control_count, 30);
    assert_true(o->report.constraint_error < 1e-12);
    assert_true(o->report.max_error > 1e-3); /* the others are not met */
    for (int d = 0; d < 2; d++) {
        assert_near(o->control[d], points[d], 1e-12);
        assert_near(o->control[2 * 29 + d], points[2 * (COUNT - 1) + d], 1e-12);
    }
    free(o);
}

static void with_all_points_as_control_points_it_is_pia(void **state)
{
    double points[2 * COUNT];
    bends(points, 2);
    pia_data data = curve_data(points, 2);
    pia_fit_options options = epia_options(0);
    options.control[0] = COUNT;
    options.max_iterations = 40;
    options.stop_change = 0;
    outcome *a = run(*state, &data, &options);
    options.method = "pia";
    options.placement = "average";
    outcome *b = run(*state, &data, &options);
    for (int i = 0; i < 2 * COUNT; i++) assert_near(a->control[i], b->control[i], 1e-12);
    free(a);
    free(b);
}

static void scattered_points_move_the_nearest_control_points(void **state)
{
    enum { MANY = 3000 };
    double *points = malloc(MANY * 3 * sizeof *points), *parameters = malloc(MANY * 2 * sizeof *parameters);
    uint64_t seed = 3;
    for (int i = 0; i < MANY; i++) {
        double u = random_number(&seed), v = random_number(&seed);
        parameters[2 * i] = u;
        parameters[2 * i + 1] = v;
        points[3 * i] = u;
        points[3 * i + 1] = v;
        points[3 * i + 2] = 0.3 * sin(7 * u) * cos(5 * v);
    }
    pia_data data = curve_data(points, 3);
    data.kind = PIA_SCATTERED;
    data.count[0] = MANY;
    data.parameters = parameters;
    pia_fit_options options = epia_options(0.01);
    options.max_iterations = 300;
    outcome *o = run(*state, &data, &options);
    assert_true(o->report.stop == PIA_STOP_TOLERANCE && o->report.max_error <= 0.01);
    free(o);
    free(points);
    free(parameters);
}

static void dominant_columns_reach_the_tolerance_by_adding_rows_and_columns(void **state)
{
    double grid[3 * ROWS * COLUMNS];
    hills(grid);
    pia_data data = grid_data(grid);
    pia_fit_options options = epia_options(0.01);
    options.method = NULL;
    options.placement = "dominant-columns";
    outcome *o = run(*state, &data, &options);
    assert_true(o->report.stop == PIA_STOP_TOLERANCE && o->report.max_error <= 0.01);
    assert_string_equal(o->report.placement, "dominant-columns");
    for (pia_index k = 1; k < o->traced; k++) assert_true(o->trace[k].control_count > o->trace[k - 1].control_count);
    free(o);
}

static void what_epia_cannot_do_is_refused(void **state)
{
    double points[2 * COUNT];
    pia_fit *fit = NULL;
    const double value[2] = {0, 0};
    pia_constraint tangent;
    bends(points, 2);
    pia_data data = curve_data(points, 2);
    pia_fit_options options = epia_options(0.01);
    options.closed[0] = 1;
    assert_status(*state, pia_fit_open(*state, &data, &options, &fit), PIA_E_ARGUMENT);
    options = epia_options(0.01);
    options.robust = "huber";
    assert_status(*state, pia_fit_open(*state, &data, &options, &fit), PIA_E_ARGUMENT);
    options = epia_options(0.01);
    options.fairing = 1;
    assert_status(*state, pia_fit_open(*state, &data, &options, &fit), PIA_E_ARGUMENT);
    options = epia_options(0.01);
    pia_constraint_init(&tangent);
    tangent.derivative[0] = 1;
    tangent.value = value;
    tangent.at_parameter[0] = 0.5;
    options.constraints = &tangent;
    options.constraint_count = 1;
    assert_status(*state, pia_fit_open(*state, &data, &options, &fit), PIA_E_ARGUMENT);
    options = epia_options(0);
    options.placement = "dominant-columns";
    assert_status(*state, pia_fit_open(*state, &data, &options, &fit), PIA_E_ARGUMENT);
    data.count[0] = 3;
    options = epia_options(0.01);
    assert_status(*state, pia_fit_open(*state, &data, &options, &fit), PIA_E_DATA);
    assert_null(fit);
}

static int setup(void **state)
{
    return pia_context_create(NULL, (pia_context **)state) == PIA_OK ? 0 : 1;
}

static int teardown(void **state)
{
    pia_context_destroy(*state);
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(curves_and_patches_end_within_the_tolerance),
        cmocka_unit_test(control_points_grow_along_the_trace_and_the_error_falls),
        cmocka_unit_test(fitting_commutes_with_similarities),
        cmocka_unit_test(any_number_of_threads_inserts_the_same_knots_and_gives_the_same_bits),
        cmocka_unit_test(chosen_points_are_met_and_the_ends_are_kept),
        cmocka_unit_test(with_all_points_as_control_points_it_is_pia),
        cmocka_unit_test(scattered_points_move_the_nearest_control_points),
        cmocka_unit_test(dominant_columns_reach_the_tolerance_by_adding_rows_and_columns),
        cmocka_unit_test(what_epia_cannot_do_is_refused),
    };
    return cmocka_run_group_tests(tests, setup, teardown);
}
