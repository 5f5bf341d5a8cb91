/* A curve fitted to a tolerance between points that are far apart: it stays near the straight line where more control points can do
 * that, and takes none where the points are smooth. */
#include <stdlib.h>

#include "check.h"

enum { MOST = 600 };

typedef struct problem {
    pia_data data;
    pia_fit_options options;
    double points[MOST * 3];
} problem;

static void begin(problem *p, int dim, double tolerance)
{
    memset(p, 0, sizeof *p);
    pia_data_init(&p->data);
    pia_fit_options_init(&p->options);
    p->data.points = p->points;
    p->data.dim = dim;
    p->options.tolerance = tolerance;
}

static void add_point(problem *p, double x, double y, double z)
{
    double point[] = {x, y, z};
    memcpy(p->points + p->data.count[0]++ * p->data.dim, point, (size_t)p->data.dim * sizeof *point);
}

/* The largest distance of the model from the polygon of the points, by dense sampling of both. */
static double swing_of(pia_context *context, const problem *p, const pia_model *model)
{
    enum { SAMPLES = 20000 };
    pia_index rows = p->data.count[0], last = p->options.closed[0] ? rows : rows - 1;
    int dim = p->data.dim;
    double *t = malloc(SAMPLES * sizeof *t), *value = malloc((size_t)(SAMPLES * dim) * sizeof *value), worst = 0;
    for (int i = 0; i < SAMPLES; i++) t[i] = i / (SAMPLES - 1.0);
    assert_ok(context, pia_model_eval(context, model, t, SAMPLES, 0, value));
    for (int i = 0; i < SAMPLES; i++) {
        double nearest = INFINITY;
        for (pia_index row = 0; row < last; row++) {
            const double *a = p->points + row * dim, *b = p->points + (row + 1) % rows * dim;
            double along = 0, length = 0, square = 0;
            for (int d = 0; d < dim; d++) {
                along += (value[i * dim + d] - a[d]) * (b[d] - a[d]);
                length += (b[d] - a[d]) * (b[d] - a[d]);
            }
            double share = fmin(fmax(along / length, 0), 1);
            for (int d = 0; d < dim; d++) square += pow(value[i * dim + d] - a[d] - share * (b[d] - a[d]), 2);
            nearest = fmin(nearest, square);
        }
        worst = fmax(worst, nearest);
    }
    free(t);
    free(value);
    return sqrt(worst);
}

/* Fits with the points held between, or not; what the curve swings out is measured on the model, too. */
static pia_report fit(problem *p, double between, double *swing)
{
    pia_context *context;
    pia_model *model;
    pia_report report = {.struct_size = sizeof report};
    assert_ok(NULL, pia_context_create(NULL, &context));
    p->options.between = between;
    assert_ok(context, pia_fit_data(context, &p->data, &p->options, &model, &report));
    assert_int_equal(report.reached, 1);
    *swing = swing_of(context, p, model);
    assert_true(*swing <= report.between_error * 1.5 + p->options.tolerance);
    pia_model_destroy(model);
    pia_context_destroy(context);
    return report;
}

static void a_corner_between_far_points_is_followed(void **state)
{
    (void)state;
    for (int closed = 0; closed < 2; closed++) {
        problem p;
        double swing, loose;
        begin(&p, 2, 0.01);
        p.options.closed[0] = closed;
        for (int i = 0; i < 4; i++) add_point(&p, i, 0, 0);
        add_point(&p, 13, 0, 0);
        for (int i = 0; i < 5; i++) add_point(&p, 13 + i * !closed, 10 + i * closed, 0);
        if (closed) add_point(&p, 0, 14, 0);
        fit(&p, 0, &loose);
        fit(&p, 3, &swing);
        assert_true(loose > 0.3);
        assert_true(swing <= 0.04);
    }
}

/* A square of few points a side, closed, so short that the whole curve is one window, and longer. */
static void an_outline_of_sharp_corners_is_followed(void **state)
{
    (void)state;
    static const int counts[] = {3, 12};
    for (int c = 0; c < 2; c++) {
        problem p;
        double swing, loose;
        begin(&p, 2, 0.02);
        p.options.closed[0] = 1;
        for (int side = 0; side < 4; side++)
            for (int i = 0; i < counts[c]; i++) {
                double along = 10.0 * i / counts[c], x = side % 2 == 0 ? along : 10, y = side % 2 == 0 ? 0 : along;
                add_point(&p, side < 2 ? x : 10 - x, side < 2 ? y : 10 - y, 0);
            }
        fit(&p, 0, &loose);
        fit(&p, 3, &swing);
        assert_true(loose > 0.08);
        assert_true(swing <= 0.07);
    }
}

/* Pockets milled in small steps, and rapid moves from one to the next. */
static void rapid_moves_of_a_tool_path_are_straight(void **state)
{
    (void)state;
    problem p;
    double swing, loose;
    begin(&p, 3, 0.01);
    for (int pocket = 0; pocket < 4; pocket++) {
        double x = 100 * pocket;
        add_point(&p, x + 5, 0, 20);
        for (int i = 0; i < 60; i++) add_point(&p, x + 5 * cos(0.2 * i), 5 * sin(0.2 * i), -0.02 * i);
        add_point(&p, x + 5 * cos(11.8), 5 * sin(11.8), 20);
    }
    pia_report before = fit(&p, 0, &loose), after = fit(&p, 3, &swing);
    assert_true(loose > 100);
    assert_true(swing <= 1.5);
    assert_true(after.control_count <= 2 * before.control_count);
}

static void smooth_points_cost_no_control_points(void **state)
{
    (void)state;
    static const double tolerances[] = {1e-2, 1e-3, 1e-4};
    for (int k = 0; k < 3; k++) {
        problem p;
        double swing;
        begin(&p, 3, 10 * tolerances[k]);
        for (int i = 0; i < 200; i++) add_point(&p, 5 * cos(0.15 * i), 5 * sin(0.15 * i), 0.05 * i);
        pia_report before = fit(&p, 0, &swing), after = fit(&p, 3, &swing);
        assert_int_equal(after.control_count, before.control_count);
    }
}

static void an_airfoil_costs_no_control_points(void **state)
{
    (void)state;
    static const double tolerances[] = {1e-2, 1e-3, 1e-4};
    pia_context *context;
    pia_points *points;
    pia_points_info info;
    assert_ok(NULL, pia_context_create(NULL, &context));
    assert_ok(context, pia_points_read(context, PIA_DATA "/airfoil/rae2822.dat", NULL, &points));
    pia_points_get_info(points, &info);
    for (int k = 0; k < 3; k++) {
        problem p;
        double swing;
        begin(&p, info.dim, tolerances[k]);
        p.data.count[0] = info.count[0];
        memcpy(p.points, info.points, (size_t)(info.count[0] * info.dim) * sizeof(double));
        pia_report before = fit(&p, 0, &swing), after = fit(&p, 3, &swing);
        assert_true(after.control_count <= before.control_count + 1);
    }
    pia_points_destroy(points);
    pia_context_destroy(context);
}

/* Whatever the degree, and with points met exactly. */
static void constraints_hold_where_a_curve_is_held(void **state)
{
    (void)state;
    for (int degree = 1; degree <= 9; degree += 2) {
        problem p;
        double swing;
        pia_index met[] = {0, 4, 9};
        begin(&p, 2, 0.05);
        p.options.degree[0] = degree;
        p.options.interpolate = met;
        p.options.interpolate_count = 3;
        for (int i = 0; i < 30; i++) add_point(&p, i < 4 ? i : i + 30, i < 4 ? 0 : 3 * sin(i), 0);
        pia_report report = fit(&p, 3, &swing);
        assert_true(report.constraint_error < 1e-9);
    }
}

static void the_number_of_threads_changes_no_bit_of_a_held_curve(void **state)
{
    (void)state;
    enum { ROWS = 600 };
    problem p;
    pia_model *model[2];
    pia_context *context[2];
    pia_report report = {.struct_size = sizeof report};
    begin(&p, 2, 1e-3);
    for (int i = 0; i < ROWS; i++) add_point(&p, i + 20 * (i / 7), i % 7 == 3 ? 4 : sin(i), 0);
    for (int k = 0; k < 2; k++) {
        pia_context_options options;
        pia_context_options_init(&options);
        options.threads = k == 0 ? 1 : 4;
        assert_ok(NULL, pia_context_create(&options, &context[k]));
        assert_ok(context[k], pia_fit_data(context[k], &p.data, &p.options, &model[k], &report));
    }
    double *points[2];
    for (int k = 0; k < 2; k++) {
        pia_model_info info;
        pia_model_get_info(model[k], &info);
        points[k] = malloc((size_t)(report.control_count * 2) * sizeof(double));
        assert_int_equal(info.control[0], report.control_count);
        pia_model_control(model[k], points[k], NULL);
    }
    assert_memory_equal(points[0], points[1], (size_t)(report.control_count * 2) * sizeof(double));
    for (int k = 0; k < 2; k++) free(points[k]);
    for (int k = 0; k < 2; k++) {
        pia_model_destroy(model[k]);
        pia_context_destroy(context[k]);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_corner_between_far_points_is_followed),
        cmocka_unit_test(an_outline_of_sharp_corners_is_followed),
        cmocka_unit_test(rapid_moves_of_a_tool_path_are_straight),
        cmocka_unit_test(smooth_points_cost_no_control_points),
        cmocka_unit_test(an_airfoil_costs_no_control_points),
        cmocka_unit_test(constraints_hold_where_a_curve_is_held),
        cmocka_unit_test(the_number_of_threads_changes_no_bit_of_a_held_curve),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
