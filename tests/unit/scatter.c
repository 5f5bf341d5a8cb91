/* The operator of scattered points against its dense matrix. */
#include "problems.h"

typedef struct shape {
    int p, q, nu, nv, rows, dim, cyclic, weighted;
} shape;

static const shape shapes[] = {
    {3, 3, 7, 6, 13, 3, 0, 0}, {1, 1, 4, 5, 8, 1, 0, 1},   {2, 3, 6, 5, 9, 2, 1, 0},  {3, 2, 5, 7, 10, 4, 2, 1},
    {3, 3, 8, 8, 12, 3, 3, 1}, {5, 4, 8, 7, 9, 2, 0, 0},   {7, 1, 9, 3, 11, 1, 0, 1}, {3, 3, 4, 4, 7, 3, 0, 0},
    {3, 3, 3, 3, 9, 2, 3, 0},  {3, 3, 60, 70, 6, 2, 0, 0},
};
enum { SHAPES = sizeof shapes / sizeof *shapes };

static double *some_numbers(pia_index count, uint64_t seed)
{
    double *x = malloc((size_t)count * sizeof *x);
    for (pia_index i = 0; i < count; i++) x[i] = 2 * problem_random(&seed) - 1;
    return x;
}

static pia_context *context_with_threads(int threads)
{
    pia_context_options options;
    pia_context *context = NULL;
    pia_context_options_init(&options);
    options.threads = threads;
    assert_ok(NULL, pia_context_create(&options, &context));
    return context;
}

static problem *open_shape(pia_context *context, const shape *s)
{
    return problem_open(context, PIA_SCATTERED, s->p, s->q, s->nu, s->nv, s->rows, s->dim, s->cyclic, s->weighted);
}

static void values_and_sums_are_those_of_the_dense_matrix(void **state)
{
    (void)state;
    pia_context *context = context_with_threads(2);
    for (int k = 0; k < SHAPES; k++) {
        problem *p = open_shape(context, &shapes[k]);
        int dim = p->dim;
        double *x = some_numbers(p->cols * dim, 1), *r = some_numbers(p->rows * dim, 2);
        double *values = some_numbers(p->rows * dim, 3), *sums = some_numbers(p->cols * dim, 4);
        pia_op_apply(p->op, x, dim, values);
        pia_op_gather(p->op, r, p->weights, dim, sums);
        for (pia_index row = 0; row < p->rows; row++)
            for (int d = 0; d < dim; d++) {
                double expected = 0;
                for (pia_index c = 0; c < p->cols; c++) expected += p->dense[row * p->cols + c] * x[c * dim + d];
                assert_near(values[row * dim + d], expected, 1e-14);
            }
        for (pia_index c = 0; c < p->cols; c++)
            for (int d = 0; d < dim; d++) {
                double expected = 0;
                for (pia_index row = 0; row < p->rows; row++)
                    expected += (p->weights != NULL ? p->weights[row] : 1) * p->dense[row * p->cols + c] * r[row * dim + d];
                assert_near(sums[c * dim + d], expected, 1e-12);
            }
        free(x), free(r), free(values), free(sums);
        problem_close(p);
    }
    pia_context_destroy(context);
}

static void residuals_and_errors_are_those_of_the_rows_as_given(void **state)
{
    (void)state;
    pia_context *context = context_with_threads(1);
    for (int k = 0; k < SHAPES; k++) {
        problem *p = open_shape(context, &shapes[k]);
        int dim = p->dim;
        double *x = some_numbers(p->cols * dim, 5), *r = some_numbers(p->rows * dim, 6), *values = some_numbers(p->rows * dim, 7);
        pia_op_apply(p->op, x, dim, values);
        pia_errors e = pia_op_residual(p->op, x, &p->targets, r), alone = pia_op_residual(p->op, x, &p->targets, NULL);
        double squares = 0, weighted = 0, worst = -1;
        pia_index worst_row = -1;
        for (pia_index row = 0; row < p->rows; row++) {
            double square = 0;
            for (int d = 0; d < dim; d++) {
                double expected = p->points[row * dim + d] - p->origin[d] - values[row * dim + d];
                assert_near(r[row * dim + d], expected, 0);
                square += expected * expected;
            }
            squares += square;
            weighted += (p->weights != NULL ? p->weights[row] : 1) * square;
            if (square > worst) worst = square, worst_row = row;
        }
        assert_near(e.sum_squares, squares, 1e-12 * squares);
        assert_near(e.weighted, weighted, 1e-12 * weighted);
        assert_near(e.max, sqrt(worst), 0);
        assert_int_equal(e.max_row, worst_row);
        assert_int_equal(e.count, p->rows);
        assert_memory_equal(&e, &alone, sizeof e);
        free(x), free(r), free(values);
        problem_close(p);
    }
    pia_context_destroy(context);
}

static void of_equal_errors_the_smallest_row_is_named(void **state)
{
    (void)state;
    pia_context *context = context_with_threads(1);
    problem *p = problem_open(context, PIA_SCATTERED, 2, 2, 5, 5, 8, 1, 0, 0);
    double *x = calloc((size_t)p->cols, sizeof *x);
    for (pia_index row = 0; row < p->rows; row++) p->points[row] = p->origin[0] + (row == 9 || row == 21 || row == 50 ? -2 : 1);
    assert_int_equal(pia_op_residual(p->op, x, &p->targets, NULL).max_row, 9);
    free(x);
    problem_close(p);
    pia_context_destroy(context);
}

/* Enough rows for many chunks. */
static void the_thread_count_does_not_change_a_bit(void **state)
{
    (void)state;
    enum { SIDE = 300, CONTROL = 40 };
    double *sums[2], *values[2];
    pia_errors errors[2];
    for (int k = 0; k < 2; k++) {
        pia_context *context = context_with_threads(k == 0 ? 1 : 7);
        static const int degree[2] = {3, 2};
        static const pia_map map[2] = {PIA_MAP_CYCLIC, PIA_MAP_IDENTITY};
        static const pia_index full[2] = {CONTROL + 3, CONTROL};
        uint64_t seed = 11;
        double *knots[2] = {problem_knots(3, 1, CONTROL, &seed), problem_knots(2, 0, CONTROL, &seed)}, origin[2] = {0, 0};
        double *parameters = some_numbers(2 * SIDE * SIDE, 12), *points = some_numbers(2 * SIDE * SIDE, 13);
        double *x = some_numbers(2 * CONTROL * CONTROL, 14);
        for (pia_index i = 0; i < 2 * SIDE * SIDE; i++) parameters[i] *= parameters[i];
        pia_op *op;
        assert_ok(context,
                  pia_op_scatter_open(context, degree, map, (const double *const *)knots, full, parameters, SIDE * SIDE, NULL, 2, &op));
        pia_targets targets = {.points = points, .origin = origin, .dim = 2};
        values[k] = some_numbers(2 * SIDE * SIDE, 15);
        sums[k] = some_numbers(2 * CONTROL * CONTROL, 16);
        errors[k] = pia_op_residual(op, x, &targets, values[k]);
        pia_op_gather(op, points, NULL, 2, sums[k]);
        pia_op_close(op);
        free(knots[0]), free(knots[1]), free(parameters), free(points), free(x);
        pia_context_destroy(context);
    }
    assert_memory_equal(values[0], values[1], 2 * SIDE * SIDE * sizeof(double));
    assert_memory_equal(sums[0], sums[1], 2 * CONTROL * CONTROL * sizeof(double));
    assert_memory_equal(&errors[0], &errors[1], sizeof errors[0]);
    for (int k = 0; k < 2; k++) free(values[k]), free(sums[k]);
}

static void frozen_unknowns_gather_nothing(void **state)
{
    (void)state;
    pia_context *context = context_with_threads(1);
    problem *p = problem_open(context, PIA_SCATTERED, 3, 3, 6, 6, 12, 2, 1, 0);
    double *sums = some_numbers(p->cols * 2, 4);
    assert_ok(context, pia_op_freeze(p->op, 7, 1));
    pia_op_gather(p->op, p->points, NULL, 2, sums);
    assert_near(sums[14], 0, 0);
    assert_near(sums[15], 0, 0);
    assert_true(sums[16] != 0);
    free(sums);
    problem_close(p);
    pia_context_destroy(context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(values_and_sums_are_those_of_the_dense_matrix),
        cmocka_unit_test(residuals_and_errors_are_those_of_the_rows_as_given),
        cmocka_unit_test(of_equal_errors_the_smallest_row_is_named),
        cmocka_unit_test(the_thread_count_does_not_change_a_bit),
        cmocka_unit_test(frozen_unknowns_gather_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
