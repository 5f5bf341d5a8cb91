/* Least squares of high degree, held against an orthogonal factorisation of the dense rows by LAPACK. */
#include <lapacke.h>

#include "context_fixture.h"
#include "problems.h"

enum { ROWS = 600, MOST = 40 };

/* Rows t on clamped uniform knots, their dense matrix and data. */
typedef struct sample {
    int degree, control;
    double t[ROWS], knots[MOST + PIA_MAX_DEGREE + 1], points[ROWS], weights[ROWS], dense[ROWS * MOST];
    pia_data data;
    pia_fit_options options;
} sample;

/* The table of Cox and de Boor, row by row; a product of differences of knots that is 0 counts as 0. */
static void fill_row(sample *s, int row)
{
    double table[MOST + PIA_MAX_DEGREE + 1], t = s->t[row], *k = s->knots;
    int last = s->control - 1;
    for (int i = 0; i < s->control + s->degree; i++) table[i] = t == k[last + 1] ? i == last : k[i] <= t && t < k[i + 1];
    for (int d = 1; d <= s->degree; d++)
        for (int i = 0; i < s->control + s->degree - d; i++) {
            double left = k[i + d] - k[i], right = k[i + d + 1] - k[i + 1];
            table[i] = (left > 0 ? (t - k[i]) / left * table[i] : 0) + (right > 0 ? (k[i + d + 1] - t) / right * table[i + 1] : 0);
        }
    for (int i = 0; i < s->control; i++) s->dense[row * s->control + i] = table[i];
}

static void make(sample *s, int degree, int control, int weighted)
{
    s->degree = degree;
    s->control = control;
    for (int i = 0; i < control + degree + 1; i++) {
        double inner = (double)(i - degree) / (control - degree);
        s->knots[i] = inner < 0 ? 0 : inner > 1 ? 1 : inner;
    }
    for (int i = 0; i < ROWS; i++) {
        s->t[i] = (double)i / (ROWS - 1);
        s->weights[i] = weighted ? 0.5 + (i * 37 % 100) / 50.0 : 1;
        s->points[i] = sin(7 * s->t[i]) + 0.01 * cos(300 * s->t[i]);
        fill_row(s, i);
    }
    pia_data_init(&s->data);
    pia_fit_options_init(&s->options);
    s->data.points = s->points;
    s->data.count[0] = ROWS;
    s->data.dim = 1;
    s->data.parameters = s->t;
    s->data.weights = weighted ? s->weights : NULL;
    s->options.degree[0] = degree;
    s->options.knots[0] = s->knots;
    s->options.knot_count[0] = control + degree + 1;
}

static void fit(pia_context *context, const sample *s, double *control, pia_report *report)
{
    pia_model *model;
    report->struct_size = sizeof *report;
    assert_ok(context, pia_fit_data(context, &s->data, &s->options, &model, report));
    pia_model_control(model, control, NULL);
    pia_model_destroy(model);
}

static double residual(const sample *s, const double *x)
{
    double sum = 0;
    for (int i = 0; i < ROWS; i++) {
        double value = s->points[i];
        for (int c = 0; c < s->control; c++) value -= s->dense[i * s->control + c] * x[c];
        sum += s->weights[i] * value * value;
    }
    return sqrt(sum);
}

static void check(pia_context *context, int degree, int weighted, double tolerance)
{
    static sample s;
    double a[ROWS * MOST], b[ROWS], ours[MOST], extent = 0;
    pia_report report;
    make(&s, degree, degree + 9, weighted);
    for (int i = 0; i < ROWS * s.control; i++) a[i] = sqrt(s.weights[i / s.control]) * s.dense[i];
    for (int i = 0; i < ROWS; i++) b[i] = sqrt(s.weights[i]) * s.points[i];
    assert_int_equal(LAPACKE_dgels(LAPACK_ROW_MAJOR, 'N', ROWS, s.control, 1, a, s.control, b, 1), 0);
    fit(context, &s, ours, &report);
    for (int i = 0; i < s.control; i++) extent = fmax(extent, fabs(b[i]));
    for (int i = 0; i < s.control; i++) assert_near(ours[i], b[i], tolerance * extent);
    assert_near(residual(&s, ours), residual(&s, b), 1e-13 * sqrt(ROWS));
    assert_true(report.relative_gradient <= 1e-12);
    assert_int_equal(report.unsupported_count, 0);
}

static void degrees_up_to_the_highest_keep_the_digits_of_the_rows(void **state)
{
    static const int degrees[] = {10, 12, 15, 20, 25};
    static const double tolerances[] = {1e-11, 1e-11, 1e-10, 1e-8, 1e-7};
    for (int k = 0; k < 5; k++)
        for (int weighted = 0; weighted < 2; weighted++) check(*state, degrees[k], weighted, tolerances[k]);
}

/* Cubic, but the rows of some spans lie so close together that the Gram matrix cannot tell its functions apart. */
static void rows_that_crowd_keep_their_digits(void **state)
{
    enum { CONTROL = 8, COUNT = 100 };
    double t[COUNT], points[COUNT], knots[CONTROL + 4], dense[COUNT * CONTROL], b[COUNT], extent = 0;
    pia_data data;
    pia_fit_options options;
    pia_model *model;
    pia_report report = {.struct_size = sizeof report};
    for (int i = 0; i < CONTROL + 4; i++) knots[i] = i < 4 ? 0 : i >= CONTROL ? 1 : (i - 3) / 5.0;
    for (int i = 0; i < COUNT; i++) {
        t[i] = i < 50 ? 0.2 * i / 50 : i < 90 ? 0.5 + 2e-4 * (i - 50) / 40 : 0.8 + 0.2 * (i - 90) / 9;
        points[i] = sin(5 * t[i]);
        for (int j = 0; j < CONTROL; j++) dense[i * CONTROL + j] = problem_basis(knots, j, 3, t[i], CONTROL - 1);
        b[i] = points[i];
    }
    t[COUNT - 1] = 1;
    points[COUNT - 1] = b[COUNT - 1] = sin(5);
    for (int j = 0; j < CONTROL; j++) dense[(COUNT - 1) * CONTROL + j] = problem_basis(knots, j, 3, 1, CONTROL - 1);
    assert_int_equal(LAPACKE_dgels(LAPACK_ROW_MAJOR, 'N', COUNT, CONTROL, 1, dense, CONTROL, b, 1), 0);
    pia_data_init(&data);
    pia_fit_options_init(&options);
    data.points = points;
    data.count[0] = COUNT;
    data.dim = 1;
    data.parameters = t;
    options.knots[0] = knots;
    options.knot_count[0] = CONTROL + 4;
    assert_ok(*state, pia_fit_data(*state, &data, &options, &model, &report));
    double control[CONTROL];
    pia_model_control(model, control, NULL);
    for (int i = 0; i < CONTROL; i++) extent = fmax(extent, fabs(b[i]));
    for (int i = 0; i < CONTROL; i++) assert_near(control[i], b[i], 1e-8 * extent);
    pia_model_destroy(model);
}

/* Nearly as many control points as rows, at parameters by chance: the rows hold every control point, but some of them by so little that
 * their functions are nearly dependent. The fit comes close all the same, and its control points stay within reach. */
static void nearly_dependent_functions_stay_near_the_data(void **state)
{
    enum { COUNT = 100, CONTROL = 93, TRIALS = 150 };
    unsigned seed = 1;
    for (int trial = 0; trial < TRIALS; trial++) {
        double t[COUNT], points[COUNT], control[CONTROL];
        pia_data data;
        pia_fit_options options;
        pia_model *model;
        pia_report report = {.struct_size = sizeof report};
        t[0] = 0;
        for (int i = 1; i < COUNT; i++) t[i] = t[i - 1] - log(1 - ((seed = seed * 1664525u + 1013904223u) >> 8) / 16777216.0);
        for (int i = 0; i < COUNT; i++) points[i] = sin(7 * (t[i] /= t[COUNT - 1]));
        pia_data_init(&data);
        pia_fit_options_init(&options);
        data.points = points;
        data.count[0] = COUNT;
        data.dim = 1;
        data.parameters = t;
        options.degree[0] = 3 + trial % 3;
        options.control[0] = CONTROL;
        assert_ok(*state, pia_fit_data(*state, &data, &options, &model, &report));
        pia_model_control(model, control, NULL);
        for (int i = 0; i < CONTROL; i++) assert_true(fabs(control[i]) < 1e4);
        assert_true(report.max_error < 1e-5);
        pia_model_destroy(model);
    }
}

/* Points met exactly by a fit of high degree: the system of the constraints keeps its digits as well. */
static void constraints_of_high_degree_are_met_at_the_constrained_minimum(void **state)
{
    enum { CONTROL = 20, MET = 3 };
    static const pia_index met[MET] = {0, 150, 599};
    static sample s;
    double a[ROWS * CONTROL], c[ROWS], b[MET * CONTROL], d[MET], x[CONTROL], ours[CONTROL];
    pia_report report;
    make(&s, 15, CONTROL, 0);
    s.options.interpolate = met;
    s.options.interpolate_count = MET;
    fit(*state, &s, ours, &report);
    assert_true(report.constraint_error <= 1e-12);
    memcpy(a, s.dense, sizeof a);
    memcpy(c, s.points, sizeof c);
    for (int k = 0; k < MET; k++) {
        memcpy(b + k * CONTROL, s.dense + met[k] * CONTROL, sizeof *b * CONTROL);
        d[k] = s.points[met[k]];
    }
    assert_int_equal(LAPACKE_dgglse(LAPACK_ROW_MAJOR, ROWS, CONTROL, MET, a, CONTROL, b, CONTROL, c, d, x), 0);
    for (int i = 0; i < CONTROL; i++) assert_near(ours[i], x[i], 1e-8);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(degrees_up_to_the_highest_keep_the_digits_of_the_rows),
        cmocka_unit_test(rows_that_crowd_keep_their_digits),
        cmocka_unit_test(nearly_dependent_functions_stay_near_the_data),
        cmocka_unit_test(constraints_of_high_degree_are_met_at_the_constrained_minimum),
    };
    return cmocka_run_group_tests(tests, open_context, close_context);
}
