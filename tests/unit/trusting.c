/* Long curves on given parameters and knots are checked by the solve alone, grids by the sums of least squares; what is wrong with them
 * is told as with any other, and holes are found. */
#include "problems.h"

enum { ROWS = 9000, DEGREE = 3 };

typedef struct curve {
    double points[2 * ROWS], parameters[ROWS], knots[ROWS + DEGREE + 1];
    pia_data data;
    pia_fit_options options;
    pia_context *context;
} curve;

static curve *make(void)
{
    curve *c = malloc(sizeof *c);
    assert_non_null(c);
    assert_ok(NULL, pia_context_create(NULL, &c->context));
    for (int i = 0; i < ROWS; i++) {
        c->parameters[i] = i;
        c->points[2 * i] = cos(1e-3 * i);
        c->points[2 * i + 1] = sin(3e-3 * i);
    }
    for (int k = 0; k <= DEGREE; k++) {
        c->knots[k] = 0;
        c->knots[ROWS + k] = ROWS - 1;
    }
    for (int k = DEGREE + 1; k < ROWS; k++) c->knots[k] = k - 2;
    pia_data_init(&c->data);
    pia_fit_options_init(&c->options);
    c->data.points = c->points;
    c->data.parameters = c->parameters;
    c->data.count[0] = ROWS;
    c->data.dim = 2;
    c->options.method = "direct";
    c->options.knots[0] = c->knots;
    c->options.knot_count[0] = ROWS + DEGREE + 1;
    return c;
}

static void drop(curve *c)
{
    pia_context_destroy(c->context);
    free(c);
}

static void check_refused(curve *c, const char *message)
{
    pia_model *model = NULL;
    assert_status(c->context, pia_fit_data(c->context, &c->data, &c->options, &model, NULL), PIA_E_DATA);
    assert_null(model);
    assert_string_equal(pia_message(c->context), message);
    drop(c);
}

static void a_good_curve_meets_its_points(void **state)
{
    (void)state;
    curve *c = make();
    pia_model *model;
    pia_report report = {.struct_size = sizeof report};
    double point[2];
    assert_ok(c->context, pia_fit_data(c->context, &c->data, &c->options, &model, &report));
    assert_true(report.max_error < 1e-15 && report.start_error > 1e-7 && report.point_count == ROWS);
    const double t = 4321;
    assert_ok(c->context, pia_model_eval(c->context, model, &t, 1, 0, point));
    assert_near(point[1], sin(3e-3 * 4321), 1e-14);
    pia_model_destroy(model);
    drop(c);
}

static void the_row_that_is_no_point_is_named(void **state)
{
    (void)state;
    curve *c = make();
    c->points[2 * 7654 + 1] = NAN;
    check_refused(c, "row 7654: component 1 is nan, not a finite number; drop such rows (--skip-invalid)");
    c = make();
    c->points[2 * 8999] = INFINITY;
    check_refused(c, "row 8999: component 0 is inf, not a finite number; drop such rows (--skip-invalid)");
}

static void parameters_that_do_not_rise_are_named(void **state)
{
    (void)state;
    curve *c = make();
    c->parameters[5000] = 4998.5;
    check_refused(c, "parameter 5000 is 4998.5, less than 4999 before it; sort the rows by parameter");
    c = make();
    c->parameters[10] = NAN;
    check_refused(c, "parameter 10 is nan; parameters are finite");
    c = make();
    c->parameters[5000] = 4999;
    check_refused(c, "parameters 4999 and 5000 are equal (4999) but their points differ; least squares (--control) can fit them");
}

static void rows_that_cannot_be_met_are_named(void **state)
{
    (void)state;
    curve *c = make();
    for (int i = 3000; i < 3004; i++) c->parameters[i] = 3003.5 + 0.01 * i - 30;
    check_refused(c, "knots and parameters do not belong together: control point 3000 of direction u has no hold on its data point "
                     "(Schoenberg-Whitney); place knots by --knots average");
}

static void equal_points_cannot_be_met(void **state)
{
    (void)state;
    curve *c = make();
    for (int i = 0; i < 2 * ROWS; i++) c->points[i] = 1;
    check_refused(c, "all 9000 points are equal; there is no curve to fit");
}

static int at_once(void *user)
{
    (void)user;
    return 1;
}

static void an_interrupted_fit_is_where_it_began(void **state)
{
    (void)state;
    curve *c = make();
    pia_model *model;
    pia_report report = {.struct_size = sizeof report};
    pia_context_options options;
    double *control = malloc(sizeof c->points);
    assert_non_null(control);
    pia_context_destroy(c->context);
    pia_context_options_init(&options);
    options.interrupted = at_once;
    assert_ok(NULL, pia_context_create(&options, &c->context));
    assert_ok(c->context, pia_fit_data(c->context, &c->data, &c->options, &model, &report));
    assert_int_equal(report.stop, PIA_STOP_CANCELLED);
    assert_true(report.max_error > 1e-7);
    pia_model_control(model, control, NULL);
    for (int i = 0; i < 2 * ROWS; i++) assert_near(control[i], c->points[i], 1e-15);
    free(control);
    pia_model_destroy(model);
    drop(c);
}

enum { LINES = 60, CONTROL = 12 };

typedef struct grid {
    double points[LINES * LINES * 2], parameters[2 * LINES];
    pia_data data;
    pia_fit_options options;
    pia_context *context;
} grid;

static void make_grid(grid *g)
{
    assert_ok(NULL, pia_context_create(NULL, &g->context));
    for (int i = 0; i < LINES; i++) {
        g->parameters[i] = g->parameters[LINES + i] = i / (LINES - 1.0);
        for (int j = 0; j < LINES; j++) {
            g->points[2 * (i * LINES + j)] = 1e3 + i + 0.1 * j;
            g->points[2 * (i * LINES + j) + 1] = sin(0.05 * i) * cos(0.07 * j);
        }
    }
    pia_data_init(&g->data);
    pia_fit_options_init(&g->options);
    g->data.kind = PIA_GRID;
    g->data.points = g->points;
    g->data.parameters = g->parameters;
    g->data.dim = 2;
    for (int d = 0; d < 2; d++) {
        g->data.count[d] = LINES;
        g->options.control[d] = CONTROL;
    }
}

static void check_grid_refused(grid *g, const char *message)
{
    pia_model *model = NULL;
    assert_status(g->context, pia_fit_data(g->context, &g->data, &g->options, &model, NULL), PIA_E_DATA);
    assert_null(model);
    assert_string_equal(pia_message(g->context), message);
    pia_context_destroy(g->context);
}

/* By the one call, and by a fit that looks before it chooses. */
static void check_both_ways(grid *g)
{
    pia_report once = {.struct_size = sizeof once}, careful = {.struct_size = sizeof careful};
    pia_model *model;
    pia_fit *fit;
    assert_ok(g->context, pia_fit_data(g->context, &g->data, &g->options, &model, &once));
    assert_ok(g->context, pia_fit_open(g->context, &g->data, &g->options, &fit));
    assert_ok(g->context, pia_fit_run(fit, NULL));
    assert_ok(g->context, pia_fit_report(fit, &careful));
    assert_string_equal(once.method, careful.method);
    assert_near(once.rms_error, careful.rms_error, 1e-12);
    assert_near(once.max_error, careful.max_error, 1e-12);
    assert_true(once.max_error < 1e-3);
    pia_fit_close(fit);
    pia_model_destroy(model);
    pia_context_destroy(g->context);
}

static void a_grid_is_seen_by_its_sums(void **state)
{
    (void)state;
    grid g;
    make_grid(&g);
    check_both_ways(&g);
}

static void holes_and_weights_of_a_grid_are_known_in_time(void **state)
{
    (void)state;
    static double weights[LINES * LINES];
    grid g;
    make_grid(&g);
    g.points[2 * 777 + 1] = NAN;
    check_both_ways(&g);
    make_grid(&g);
    for (int i = 0; i < LINES * LINES; i++) weights[i] = 1 + i % 3;
    g.data.weights = weights;
    check_both_ways(&g);
}

static void what_is_wrong_with_a_grid_is_named(void **state)
{
    (void)state;
    grid g;
    make_grid(&g);
    g.points[2 * 3599] = -INFINITY;
    check_grid_refused(&g, "row 3599: component 0 is -inf, not a finite number; drop such rows (--skip-invalid)");
    make_grid(&g);
    g.points[2 * 1234 + 1] = 1e200;
    check_grid_refused(&g, "component 1 spans 1e+200, more than 1e+130; rescale the points");
    make_grid(&g);
    for (int i = 0; i < 2 * LINES * LINES; i++) g.points[i] = 7;
    check_grid_refused(&g, "all 3600 points are equal; there is no surface to fit");
    make_grid(&g);
    g.parameters[LINES + 30] = 0;
    check_grid_refused(&g, "v parameter 30 is 0, less than 0.49152542372881358 before it; sort the rows by parameter");
}

/* Through every point, on knots at the parameters. */
typedef struct square {
    double points[LINES * LINES * 2], parameters[2 * LINES], knots[2][LINES + DEGREE + 1], control[LINES * LINES * 2];
    pia_data data;
    pia_fit_options options;
    pia_context *context;
} square;

static square *make_square(void)
{
    square *s = malloc(sizeof *s);
    grid *g = malloc(sizeof *g);
    assert_non_null(s);
    assert_non_null(g);
    make_grid(g);
    s->context = g->context;
    s->options = g->options;
    s->data = g->data;
    memcpy(s->points, g->points, sizeof s->points);
    memcpy(s->parameters, g->parameters, sizeof s->parameters);
    s->data.points = s->points;
    s->data.parameters = s->parameters;
    s->options.method = "direct";
    for (int d = 0; d < 2; d++) {
        for (int k = 0; k <= DEGREE; k++) {
            s->knots[d][k] = 0;
            s->knots[d][LINES + k] = 1;
        }
        for (int k = DEGREE + 1; k < LINES; k++) s->knots[d][k] = s->parameters[k - 2];
        s->options.control[d] = PIA_AUTO;
        s->options.knots[d] = s->knots[d];
        s->options.knot_count[d] = LINES + DEGREE + 1;
    }
    free(g);
    return s;
}

static void drop_square(square *s)
{
    pia_context_destroy(s->context);
    free(s);
}

static void a_grid_is_seen_by_its_interpolation(void **state)
{
    (void)state;
    square *s = make_square();
    pia_report once = {.struct_size = sizeof once}, careful = {.struct_size = sizeof careful};
    pia_model *model;
    pia_fit *fit;
    assert_ok(s->context, pia_fit_data(s->context, &s->data, &s->options, &model, &once));
    pia_model_control(model, s->control, NULL);
    assert_ok(s->context, pia_fit_open(s->context, &s->data, &s->options, &fit));
    assert_ok(s->context, pia_fit_run(fit, NULL));
    assert_ok(s->context, pia_fit_report(fit, &careful));
    assert_true(once.max_error < 1e-12 && once.point_count == LINES * LINES);
    assert_near(once.start_error, careful.start_error, 1e-12);
    pia_model_destroy(model);
    assert_ok(s->context, pia_fit_model(fit, &model));
    pia_model_control(model, s->points, NULL);
    for (int i = 0; i < 2 * LINES * LINES; i++) assert_near(s->control[i], s->points[i], 1e-11);
    pia_model_destroy(model);
    pia_fit_close(fit);
    drop_square(s);
}

/* The one call cuts closed directions open; a careful fit solves them with a border. */
static void a_closed_grid_is_no_different(void **state)
{
    (void)state;
    for (int closed = 1; closed < 4; closed++)
        for (int degree = 1; degree <= 5; degree++) {
            square *s = make_square();
            pia_report once = {.struct_size = sizeof once}, careful = {.struct_size = sizeof careful};
            pia_model *model, *other;
            pia_model_info info = {.struct_size = sizeof info};
            pia_fit *fit;
            for (int d = 0; d < 2; d++) {
                s->options.knots[d] = NULL;
                s->options.knot_count[d] = 0;
                s->options.degree[d] = degree;
                s->options.closed[d] = closed >> d & 1;
                for (int i = 0; i < LINES; i++) s->parameters[d * LINES + i] = i / (LINES - (s->options.closed[d] ? 0.0 : 1.0));
            }
            assert_ok(s->context, pia_fit_data(s->context, &s->data, &s->options, &model, &once));
            assert_ok(s->context, pia_fit_open(s->context, &s->data, &s->options, &fit));
            assert_ok(s->context, pia_fit_run(fit, NULL));
            assert_ok(s->context, pia_fit_report(fit, &careful));
            assert_ok(s->context, pia_fit_model(fit, &other));
            assert_near(once.start_error, careful.start_error, 1e-10);
            assert_true(once.max_error < 1e-10);
            pia_model_get_info(model, &info);
            double *x = malloc((size_t)(info.control[0] * info.control[1] * 2) * sizeof *x),
                   *y = malloc((size_t)(info.control[0] * info.control[1] * 2) * sizeof *y);
            assert_true(x != NULL && y != NULL);
            pia_model_control(model, x, NULL);
            pia_model_control(other, y, NULL);
            for (pia_index i = 0; i < info.control[0] * info.control[1] * 2; i++) assert_near(x[i], y[i], 1e-8);
            free(x), free(y);
            pia_model_destroy(model);
            pia_model_destroy(other);
            pia_fit_close(fit);
            drop_square(s);
        }
}

static void check_square_refused(square *s, const char *message)
{
    pia_model *model = NULL;
    assert_status(s->context, pia_fit_data(s->context, &s->data, &s->options, &model, NULL), PIA_E_DATA);
    assert_null(model);
    assert_string_equal(pia_message(s->context), message);
    drop_square(s);
}

static void what_is_wrong_with_such_a_grid_is_named(void **state)
{
    (void)state;
    square *s = make_square();
    s->points[2 * 3599] = -INFINITY;
    check_square_refused(s, "row 3599: component 0 is -inf, not a finite number; drop such rows (--skip-invalid)");
    s = make_square();
    for (int i = 0; i < 2 * LINES * LINES; i++) s->points[i] = 7;
    check_square_refused(s, "all 3600 points are equal; there is no surface to fit");
    s = make_square();
    s->parameters[LINES + 30] = 0;
    check_square_refused(s, "v parameter 30 is 0, less than 0.49152542372881358 before it; sort the rows by parameter");
    s = make_square();
    s->parameters[30] = s->parameters[31];
    check_square_refused(
        s, "parameters 30 and 31 are equal (0.52542372881355937) but their points differ; least squares (--control) can fit them");
    s = make_square();
    for (int k = 20; k < 30; k++) s->knots[0][k] = s->knots[0][20] + 1e-4 * (k - 20);
    check_square_refused(s,
                         "knots and parameters do not belong together: control point 19 of direction u has no hold on its data point "
                         "(Schoenberg-Whitney); place knots by --knots average");
}

static void holes_of_such_a_grid_are_left_out(void **state)
{
    (void)state;
    square *s = make_square();
    pia_report report = {.struct_size = sizeof report};
    pia_model *model;
    s->points[2 * 777 + 1] = NAN;
    assert_ok(s->context, pia_fit_data(s->context, &s->data, &s->options, &model, &report));
    assert_true(report.max_error < 1e-9);
    pia_model_destroy(model);
    drop_square(s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_good_curve_meets_its_points),
        cmocka_unit_test(the_row_that_is_no_point_is_named),
        cmocka_unit_test(parameters_that_do_not_rise_are_named),
        cmocka_unit_test(rows_that_cannot_be_met_are_named),
        cmocka_unit_test(equal_points_cannot_be_met),
        cmocka_unit_test(an_interrupted_fit_is_where_it_began),
        cmocka_unit_test(a_grid_is_seen_by_its_sums),
        cmocka_unit_test(holes_and_weights_of_a_grid_are_known_in_time),
        cmocka_unit_test(what_is_wrong_with_a_grid_is_named),
        cmocka_unit_test(a_grid_is_seen_by_its_interpolation),
        cmocka_unit_test(a_closed_grid_is_no_different),
        cmocka_unit_test(what_is_wrong_with_such_a_grid_is_named),
        cmocka_unit_test(holes_of_such_a_grid_are_left_out),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
