#include "normal.h"
#include "problems.h"
#include "span_sums.h"

static pia_context *context_with(int threads)
{
    pia_context *context = NULL;
    pia_context_options options;
    pia_context_options_init(&options);
    options.threads = threads;
    assert_ok(NULL, pia_context_create(&options, &context));
    return context;
}

static double largest(const double *values, pia_index count)
{
    double most = 0;
    for (pia_index i = 0; i < count; i++)
        if (!(fabs(values[i]) <= most)) most = fabs(values[i]);
    return most;
}

static void check_against_dense(problem *p, double tolerance)
{
    pia_normal *normal = NULL;
    assert_ok(p->context, pia_normal_open(p->op, &p->targets, &normal));
    pia_index n = p->cols, size = n * p->dim;
    double *h = malloc((size_t)(n * n) * sizeof *h), *b = malloc((size_t)size * sizeof *b);
    double *x = malloc((size_t)size * sizeof *x), *y = malloc((size_t)size * sizeof *y);
    uint64_t seed = 3;
    problem_normal(p, h, b);
    for (pia_index i = 0; i < size; i++) x[i] = problem_random(&seed) - 0.5;
    normal->class->multiply(normal, x, p->dim, y);
    double scale = largest(h, n * n), right = largest(b, size);
    for (pia_index i = 0; i < n; i++) {
        double sum = 0;
        for (pia_index j = 0; j < n; j++) sum += h[i * n + j];
        assert_near(normal->column_sum[i], sum, 1e-13 * (double)n * scale);
        assert_near(normal->diagonal[i], h[i * n + i], 1e-13 * scale);
        for (int d = 0; d < p->dim; d++) {
            double product = 0;
            for (pia_index j = 0; j < n; j++) product += h[i * n + j] * x[j * p->dim + d];
            assert_near(y[i * p->dim + d], product, 1e-13 * (double)n * scale);
            assert_near(normal->right[i * p->dim + d], b[i * p->dim + d], 1e-12 * right);
        }
    }
    assert_ok(p->context, normal->class->factor(normal));
    assert_int_equal(normal->weak, 0);
    memcpy(x, normal->right, (size_t)size * sizeof *x);
    normal->class->solve(normal, x, p->dim);
    problem_solve(h, n, b, p->dim);
    double extent = largest(b, size);
    for (pia_index i = 0; i < size; i++) assert_near(x[i], b[i], tolerance * extent);
    pia_normal_close(normal);
    free(h);
    free(b);
    free(x);
    free(y);
}

static void a_curve_has_the_dense_normal_form(void **state)
{
    (void)state;
    pia_context *context = context_with(1);
    for (int degree = 1; degree <= 7; degree++)
        for (int cyclic = 0; cyclic < 2; cyclic++)
            for (int dim = 1; dim <= 4; dim++) {
                problem *p = problem_open(context, PIA_CURVE, degree, 0, 17, 1, 40 + 80 * dim, dim, cyclic, dim == 2);
                check_against_dense(p, degree < 6 ? 1e-10 : 1e-8);
                problem_close(p);
            }
    pia_context_destroy(context);
}

static void spans_full_of_points_go_by_moments_to_the_same_form(void **state)
{
    (void)state;
    pia_context *context = context_with(2);
    for (int degree = 1; degree <= 12; degree++) {
        problem *p = problem_open(context, PIA_CURVE, degree, 0, degree + 4, 1, 3000, 3, 0, degree % 2);
        check_against_dense(p, 1e-6);
        problem_close(p);
    }
    pia_context_destroy(context);
}

static void a_closed_curve_of_few_unknowns_wraps_onto_itself(void **state)
{
    (void)state;
    pia_context *context = context_with(1);
    for (int degree = 1; degree <= 5; degree++)
        for (pia_index unknowns = degree > 1 ? degree : 2; unknowns <= 2 * degree + 1; unknowns++) {
            problem *p = problem_open(context, PIA_CURVE, degree, 0, unknowns, 1, 60, 2, 1, 1);
            check_against_dense(p, 1e-7);
            problem_close(p);
        }
    pia_context_destroy(context);
}

static void a_grid_has_the_dense_normal_form(void **state)
{
    (void)state;
    pia_context *context = context_with(1);
    for (int degree = 1; degree <= 4; degree++)
        for (int cyclic = 0; cyclic < 4; cyclic++) {
            problem *p = problem_open(context, PIA_GRID, degree, 5 - degree, 9, 11, 40, cyclic % 3 + 1, cyclic, 0);
            check_against_dense(p, 1e-9);
            problem_close(p);
        }
    pia_context_destroy(context);
}

static void holes_and_weights_leave_no_kronecker_product(void **state)
{
    (void)state;
    pia_context *context = context_with(1);
    pia_normal *normal = NULL;
    for (int weighted = 0; weighted < 2; weighted++) {
        problem *p = problem_open(context, PIA_GRID, 3, 3, 6, 6, 20, 2, 0, weighted);
        if (!weighted) p->points[77] = NAN;
        assert_ok(context, pia_normal_open(p->op, &p->targets, &normal));
        assert_string_equal(normal->class->name, "stencil");
        pia_normal_close(normal);
        problem_close(p);
    }
    pia_context_destroy(context);
}

static void frozen_unknowns_solve_to_zero_and_the_rest_without_them(void **state)
{
    (void)state;
    pia_context *context = context_with(1);
    for (int cyclic = 0; cyclic < 2; cyclic++) {
        problem *p = problem_open(context, PIA_CURVE, 3, 0, 12, 1, 60, 2, cyclic, 0);
        pia_normal *normal = NULL;
        assert_ok(context, pia_op_freeze(p->op, 0, 1));
        assert_ok(context, pia_op_freeze(p->op, 5, 1));
        assert_ok(context, pia_normal_open(p->op, &p->targets, &normal));
        assert_ok(context, normal->class->factor(normal));
        double h[12 * 12], b[12 * 2], x[12 * 2];
        problem_normal(p, h, b);
        for (int i = 0; i < 12; i++)
            for (int c = 0; c < 2; c++) {
                int f = 5 * c;
                h[i * 12 + f] = h[f * 12 + i] = i == f;
                b[f * 2] = b[f * 2 + 1] = 0;
            }
        memcpy(x, normal->right, sizeof x);
        normal->class->solve(normal, x, 2);
        problem_solve(h, 12, b, 2);
        for (int i = 0; i < 24; i++) assert_near(x[i], b[i], 1e-11);
        assert_near(x[10], 0, 0);
        pia_normal_close(normal);
        problem_close(p);
    }
    pia_context_destroy(context);
}

/* Points in the first and last quarter only: the control points between have none. */
static void what_no_data_holds_stays_and_is_counted(void **state)
{
    (void)state;
    pia_context *context = context_with(1);
    problem *p = problem_open(context, PIA_CURVE, 3, 0, 20, 1, 200, 1, 0, 0);
    for (pia_index i = 0; i < 200; i++) p->parameters[0][i] = i < 100 ? 0.25 * (double)i / 99 : 0.75 + 0.25 * (double)(i - 100) / 99;
    pia_collocation_rebucket(&p->line[0]);
    pia_normal *normal = NULL;
    assert_ok(context, pia_normal_open(p->op, &p->targets, &normal));
    assert_ok(context, normal->class->factor(normal));
    double x[20], y[20];
    memcpy(x, normal->right, sizeof x);
    normal->class->solve(normal, x, 1);
    assert_int_equal(normal->weak, 4);
    for (int i = 8; i < 12; i++) assert_near(x[i], 0, 0);
    normal->class->multiply(normal, x, 1, y);
    for (int i = 0; i < 20; i++) assert_near(y[i], normal->right[i], 1e-9 * largest(normal->right, 20));
    pia_normal_close(normal);
    problem_close(p);
    pia_context_destroy(context);
}

static void assert_same_form(const pia_normal *a, const pia_normal *b, int dim)
{
    pia_index cols = a->op->cols;
    double *x = malloc((size_t)cols * sizeof *x), *y = malloc((size_t)(2 * cols) * sizeof *y);
    for (pia_index i = 0; i < cols; i++) x[i] = sin((double)i);
    a->class->multiply(a, x, 1, y);
    b->class->multiply(b, x, 1, y + cols);
    assert_memory_equal(y, y + cols, (size_t)cols * sizeof *y);
    assert_memory_equal(a->right, b->right, (size_t)(cols * dim) * sizeof(double));
    assert_memory_equal(a->column_sum, b->column_sum, (size_t)cols * sizeof(double));
    free(x);
    free(y);
}

static void the_thread_count_changes_no_bit(void **state)
{
    (void)state;
    const pia_index rows[] = {90000, 600000};
    for (int longer = 0; longer < 2; longer++) {
        pia_context *one = context_with(1), *four = context_with(4);
        pia_normal *a = NULL, *b = NULL;
        problem *p = problem_open(one, PIA_CURVE, 3, 0, longer ? 4 : 50, 1, rows[longer], 1, 0, 0);
        assert_ok(one, pia_normal_open(p->op, &p->targets, &a));
        p->op->context = four;
        assert_ok(four, pia_normal_open(p->op, &p->targets, &b));
        assert_same_form(a, b, 1);
        pia_normal_close(b);
        p->op->context = one;
        pia_normal_close(a);
        problem_close(p);
        pia_context_destroy(one);
        pia_context_destroy(four);
    }
}

static void an_edit_gives_the_bits_of_a_fresh_start(void **state)
{
    (void)state;
    pia_context *context = context_with(1);
    for (int kind = 0; kind < 2; kind++) {
        problem *p = problem_open(context, kind == 0 ? PIA_CURVE : PIA_GRID, 3, 3, 10, 10, kind == 0 ? 400 : 30, 2, 0, 0);
        pia_normal *edited = NULL, *fresh = NULL;
        assert_ok(context, pia_normal_open(p->op, &p->targets, &edited));
        for (pia_index row = 100; row < 104; row++) p->points[2 * row] += 5;
        pia_normal_refresh(edited, &p->targets, 100, 103);
        assert_ok(context, pia_normal_open(p->op, &p->targets, &fresh));
        assert_same_form(edited, fresh, 2);
        pia_normal_close(edited);
        pia_normal_close(fresh);
        problem_close(p);
    }
    pia_context_destroy(context);
}

/* Rows first .. first + 3 are moved, and weigh more. */
static void check_edit(pia_context *context, problem *p, const pia_addition *addition, pia_index first)
{
    pia_normal *edited = NULL, *fresh = NULL;
    assert_ok(context, pia_normal_open_with(p->op, &p->targets, addition, &edited));
    for (pia_index row = first; row < first + 4; row++) {
        p->points[2 * row] += 5;
        p->weights[row] *= 1.5;
    }
    pia_normal_refresh(edited, &p->targets, first, first + 3);
    assert_ok(context, pia_normal_open_with(p->op, &p->targets, addition, &fresh));
    assert_same_form(edited, fresh, 2);
    assert_memory_equal(edited->diagonal, fresh->diagonal, (size_t)p->cols * sizeof(double));
    pia_normal_close(edited);
    pia_normal_close(fresh);
}

/* At both sides of the seam, where the copies of a closed curve meet, far from it, and where a few control points are all copies. */
static void edits_of_closed_faired_and_pulled_curves_give_the_bits_of_a_fresh_start(void **state)
{
    (void)state;
    pia_context *context = context_with(1);
    const pia_index counts[] = {5, 30}, first[] = {1, 17, 200, 370, 396, 0};
    for (int cyclic = 0; cyclic < 2; cyclic++)
        for (int c = 0; c < 2; c++)
            for (int more = 0; more < 4; more++) {
                double start[60];
                problem *p = problem_open(context, PIA_CURVE, 3, 0, counts[c], 1, 400, 2, cyclic, 1);
                for (int i = 0; i < 60; i++) start[i] = cos(i);
                pia_addition addition = {.fairing = more % 2 * 0.1, .pull = more / 2 * 0.01, .start = start};
                for (size_t k = 0; k < sizeof first / sizeof *first; k++) check_edit(context, p, &addition, first[k]);
                problem_close(p);
            }
    pia_context_destroy(context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_curve_has_the_dense_normal_form),
        cmocka_unit_test(spans_full_of_points_go_by_moments_to_the_same_form),
        cmocka_unit_test(a_closed_curve_of_few_unknowns_wraps_onto_itself),
        cmocka_unit_test(a_grid_has_the_dense_normal_form),
        cmocka_unit_test(holes_and_weights_leave_no_kronecker_product),
        cmocka_unit_test(frozen_unknowns_solve_to_zero_and_the_rest_without_them),
        cmocka_unit_test(what_no_data_holds_stays_and_is_counted),
        cmocka_unit_test(the_thread_count_changes_no_bit),
        cmocka_unit_test(an_edit_gives_the_bits_of_a_fresh_start),
        cmocka_unit_test(edits_of_closed_faired_and_pulled_curves_give_the_bits_of_a_fresh_start),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
