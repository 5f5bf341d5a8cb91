/* Constraints, weights and fairing together with a tolerance: all of them hold in the result. */
#include <stdlib.h>

#include "check.h"

enum { ROWS = 300, U = 24, V = 30, MOST = 64 };

typedef struct problem {
    pia_data data;
    pia_fit_options options;
    double points[U * V * 3];
    pia_index interpolate[MOST];
    pia_constraint constraints[2];
    double slope[2][2];
} problem;

static double random_number(uint64_t *seed)
{
    *seed = *seed * 6364136223846793005u + 1442695040888963407u;
    return (double)(*seed >> 11) * 0x1p-53;
}

static problem *curve(int degree, int closed)
{
    problem *p = calloc(1, sizeof *p);
    uint64_t seed = 11;
    pia_data_init(&p->data);
    pia_fit_options_init(&p->options);
    for (int i = 0; i < ROWS; i++) {
        double u = 6.283185307179586 * i / (closed ? ROWS : ROWS - 1);
        p->points[2 * i] = 500 + 10 * cos(u) + sin(5 * u) + 0.01 * random_number(&seed);
        p->points[2 * i + 1] = -300 + 8 * sin(u) + cos(4 * u) + 0.01 * random_number(&seed);
    }
    p->data.points = p->points;
    p->data.count[0] = ROWS;
    p->data.dim = 2;
    p->options.degree[0] = degree;
    p->options.closed[0] = closed;
    p->options.tolerance = 0.1;
    p->options.interpolate = p->interpolate;
    return p;
}

static problem *sheet(pia_kind kind)
{
    problem *p = calloc(1, sizeof *p);
    uint64_t seed = 5;
    pia_data_init(&p->data);
    pia_fit_options_init(&p->options);
    for (int i = 0; i < U * V; i++) {
        double *q = p->points + 3 * i;
        q[0] = i / V;
        q[1] = i % V;
        q[2] = 3 * sin(0.3 * q[0]) * cos(0.2 * q[1]) + 0.01 * random_number(&seed);
    }
    p->data.kind = kind;
    p->data.points = p->points;
    p->data.count[0] = kind == PIA_GRID ? U : U * V;
    p->data.count[1] = kind == PIA_GRID ? V : 1;
    p->data.dim = 3;
    p->options.tolerance = 0.1;
    p->options.interpolate = p->interpolate;
    if (kind == PIA_SCATTERED) p->options.parametrization = "xy";
    return p;
}

/* Whether the points that are to be met are, by evaluating the model, and all others are within the tolerance. */
static void check_points(pia_context *context, const problem *p, pia_fit *fit, const pia_report *report)
{
    const double *parameters;
    const pia_index *row;
    pia_index count, used[U * V];
    int dim = p->data.dim;
    double *residual = malloc(U * V * 3 * sizeof *residual);
    pia_model *model;
    assert_ok(context, pia_fit_model(fit, &model));
    assert_ok(context, pia_fit_parameters(fit, &parameters, &count, &row));
    for (pia_index i = 0; i < report->point_count; i++) used[row != NULL ? row[i] : i] = i;
    assert_ok(context, pia_fit_residuals(fit, residual));
    double *all = malloc((size_t)count * 3 * sizeof *all);
    for (pia_index i = 0; i < report->point_count; i++) {
        double length = 0;
        for (int d = 0; d < dim; d++) length = hypot(length, residual[i * dim + d]);
        assert_true(length <= p->options.tolerance);
    }
    if (p->data.kind == PIA_CURVE) assert_ok(context, pia_model_eval(context, model, parameters, count, 0, all));
    for (pia_index k = 0; k < p->options.interpolate_count; k++)
        for (int d = 0; d < dim; d++) {
            pia_index at = used[p->interpolate[k]] * dim + d;
            assert_near(residual[at], 0, 1e-11);
            if (p->data.kind == PIA_CURVE) assert_near(all[at], p->points[p->interpolate[k] * dim + d], 1e-11);
        }
    pia_model_destroy(model);
    free(residual);
    free(all);
}

/* Returns the control points. */
static pia_index check(const problem *p)
{
    pia_context *context;
    pia_fit *fit;
    pia_report report = {.struct_size = sizeof report};
    assert_ok(NULL, pia_context_create(NULL, &context));
    assert_ok(context, pia_fit_open(context, &p->data, &p->options, &fit));
    assert_ok(context, pia_fit_run(fit, &report));
    assert_string_equal(pia_stop_name(report.stop), "tolerance");
    assert_int_equal(report.reached, 1);
    if (p->options.interpolate_count + p->options.constraint_count > 0) assert_true(report.constraint_error <= 1e-11);
    check_points(context, p, fit, &report);
    pia_fit_close(fit);
    pia_context_destroy(context);
    return report.control_count;
}

/* every-th row from the first. */
static void meet_every(problem *p, pia_index every)
{
    pia_index rows = p->data.count[0] * p->data.count[1];
    for (pia_index row = 0; row < rows; row += every) p->interpolate[p->options.interpolate_count++] = row;
}

static void points_of_curves_are_met(void **state)
{
    (void)state;
    for (int degree = 1; degree <= 6; degree++)
        for (int closed = 0; closed < 2; closed++) {
            problem *p = curve(degree, closed);
            pia_index without = check(p);
            meet_every(p, 97);
            pia_index some = check(p);
            assert_true(some <= without + (degree == 1 ? 8 : 5));
            p->options.interpolate_count = 0;
            meet_every(p, 5); /* more than are needed for the tolerance */
            pia_index many = check(p);
            assert_true(many >= ROWS / 5 && many <= ROWS / 5 + 2 * degree + 8);
            free(p);
        }
}

static void points_of_surfaces_are_met(void **state)
{
    (void)state;
    for (int scattered = 0; scattered < 2; scattered++) {
        problem *p = sheet(scattered ? PIA_SCATTERED : PIA_GRID);
        check(p);
        meet_every(p, 100);
        check(p);
        p->options.interpolate_count = 0;
        meet_every(p, 20); /* 36 constraints begin with 16 control points */
        check(p);
        free(p);
    }
}

/* A derivative at the start and a direction in the middle. */
static void derivatives_are_met(void **state)
{
    (void)state;
    pia_context *context;
    assert_ok(NULL, pia_context_create(NULL, &context));
    for (int degree = 2; degree <= 5; degree++) {
        problem *p = curve(degree, 0);
        pia_model *model;
        pia_report report = {.struct_size = sizeof report};
        p->slope[0][0] = 30;
        p->slope[0][1] = 50;
        p->slope[1][1] = -1;
        for (int k = 0; k < 2; k++) {
            pia_constraint_init(&p->constraints[k]);
            p->constraints[k].derivative[0] = 1;
            p->constraints[k].at_parameter[0] = k == 0 ? 0 : 0.4997;
            p->constraints[k].value = p->slope[k];
            p->constraints[k].direction_only = k;
        }
        p->options.constraints = p->constraints;
        p->options.constraint_count = 2;
        assert_ok(context, pia_fit_data(context, &p->data, &p->options, &model, &report));
        assert_int_equal(report.reached, 1);
        assert_true(report.constraint_error <= 1e-11);
        for (int k = 0; k < 2; k++) {
            double value[4];
            assert_ok(context, pia_model_eval(context, model, p->constraints[k].at_parameter, 1, 1, value));
            assert_near(value[2], k == 0 ? 30 : 0, 1e-9);
            if (k == 0) assert_near(value[3], 50, 1e-9);
        }
        pia_model_destroy(model);
        free(p);
    }
    pia_context_destroy(context);
}

static void contradictions_are_named(void **state)
{
    (void)state;
    static const double away[] = {0, 0};
    pia_context *context;
    pia_model *model = NULL;
    assert_ok(NULL, pia_context_create(NULL, &context));
    problem *p = curve(3, 0);
    pia_constraint_init(&p->constraints[0]);
    pia_constraint_init(&p->constraints[1]);
    p->constraints[0].at_point = 7;
    p->constraints[0].value = away;
    p->options.constraints = p->constraints;
    p->options.constraint_count = 1;
    assert_status(context, pia_fit_data(context, &p->data, &p->options, &model, NULL), PIA_E_CONSTRAINT);
    assert_non_null(strstr(pia_message(context), "point 7"));
    p->constraints[0] = p->constraints[1];
    p->constraints[0].at_parameter[0] = p->constraints[1].at_parameter[0] = 0.3;
    p->constraints[0].value = p->points;
    p->constraints[1].value = p->points + 2;
    p->options.constraint_count = 2;
    assert_status(context, pia_fit_data(context, &p->data, &p->options, &model, NULL), PIA_E_CONSTRAINT);
    assert_null(model);
    free(p);
    pia_context_destroy(context);
}

static void what_needs_a_number_of_control_points_is_refused(void **state)
{
    (void)state;
    static const pia_index frozen[] = {0};
    pia_context *context;
    pia_model *model = NULL;
    assert_ok(NULL, pia_context_create(NULL, &context));
    for (int k = 0; k < 4; k++) {
        problem *p = curve(3, 0);
        meet_every(p, 100);
        p->options.freeze = frozen;
        p->options.freeze_count = k == 0;
        p->options.soft = k == 1 ? 10 : 0;
        p->options.limiter = k == 2 ? "convex-local" : NULL;
        p->options.robust = k == 3 ? "huber" : NULL;
        assert_status(context, pia_fit_data(context, &p->data, &p->options, &model, NULL), PIA_E_ARGUMENT);
        assert_null(model);
        free(p);
    }
    pia_context_destroy(context);
}

static double rms_of_even_rows(const problem *p)
{
    pia_context *context;
    pia_fit *fit;
    double *residual = malloc(2 * ROWS * sizeof *residual), square = 0;
    assert_ok(NULL, pia_context_create(NULL, &context));
    assert_ok(context, pia_fit_open(context, &p->data, &p->options, &fit));
    assert_ok(context, pia_fit_run(fit, NULL));
    assert_ok(context, pia_fit_residuals(fit, residual));
    for (int i = 0; i < ROWS; i += 2) square += pow(residual[2 * i], 2) + pow(residual[2 * i + 1], 2);
    pia_fit_close(fit);
    pia_context_destroy(context);
    free(residual);
    return sqrt(square / (ROWS / 2));
}

/* Every second row lies beside the others: those of more weight are followed. */
static void weights_decide_which_rows_the_fit_is_close_to(void **state)
{
    (void)state;
    problem *p = curve(3, 0);
    double weights[ROWS], parameters[ROWS];
    for (int i = 0; i < ROWS; i++) {
        weights[i] = i % 2 == 0 ? 1e4 : 1;
        parameters[i] = i / (ROWS - 1.0);
        if (i % 2 == 1) p->points[2 * i + 1] += 0.08;
    }
    p->data.parameters = parameters;
    double plain = rms_of_even_rows(p);
    p->data.weights = weights;
    check(p);
    assert_true(rms_of_even_rows(p) < 0.7 * plain);
    free(p);
}

/* Rows of weight 0 say nothing: outliers among them need no knots. */
static void rows_without_weight_may_be_anywhere(void **state)
{
    (void)state;
    pia_context *context;
    pia_report clean = {.struct_size = sizeof clean}, dirty = {.struct_size = sizeof dirty};
    assert_ok(NULL, pia_context_create(NULL, &context));
    problem *p = curve(3, 0);
    double weights[ROWS], parameters[ROWS];
    for (int i = 0; i < ROWS; i++) {
        weights[i] = i % 50 != 7;
        parameters[i] = i / (ROWS - 1.0);
    }
    p->data.weights = weights;
    p->data.parameters = parameters;
    assert_ok(context, pia_fit_data(context, &p->data, &p->options, NULL, &clean));
    for (int i = 7; i < ROWS; i += 50) p->points[2 * i] += 3;
    assert_ok(context, pia_fit_data(context, &p->data, &p->options, NULL, &dirty));
    assert_int_equal(dirty.reached, 1);
    assert_int_equal(dirty.control_count, clean.control_count);
    free(p);
    pia_context_destroy(context);
}

static double bending(const problem *p)
{
    pia_context *context;
    pia_model *model;
    double energy = 0;
    assert_ok(NULL, pia_context_create(NULL, &context));
    assert_ok(context, pia_fit_data(context, &p->data, &p->options, &model, NULL));
    for (int i = 0; i < 1000; i++) {
        double t = (i + 0.5) / 1000, value[6];
        assert_ok(context, pia_model_eval(context, model, &t, 1, 2, value));
        energy += value[4] * value[4] + value[5] * value[5];
    }
    pia_model_destroy(model);
    pia_context_destroy(context);
    return energy;
}

static void fairing_within_the_tolerance_bends_less(void **state)
{
    (void)state;
    problem *p = curve(3, 0);
    p->options.tolerance = 0.05;
    double plain = bending(p);
    p->options.fairing = 1e-6;
    check(p);
    assert_true(bending(p) < plain);
    free(p);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(points_of_curves_are_met),
        cmocka_unit_test(points_of_surfaces_are_met),
        cmocka_unit_test(derivatives_are_met),
        cmocka_unit_test(contradictions_are_named),
        cmocka_unit_test(what_needs_a_number_of_control_points_is_refused),
        cmocka_unit_test(weights_decide_which_rows_the_fit_is_close_to),
        cmocka_unit_test(rows_without_weight_may_be_anywhere),
        cmocka_unit_test(fairing_within_the_tolerance_bends_less),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
