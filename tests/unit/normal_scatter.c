/* The stencil normal form against dense equations: scattered points, grids with holes, grids with weights. */
#include "dense_normal.h"

typedef struct shape {
    pia_kind kind;
    int p, q, nu, nv, rows, dim, cyclic, weighted, holes, frozen;
} shape;

static const shape shapes[] = {
    {PIA_SCATTERED, 3, 3, 7, 6, 16, 3, 0, 0, 0, 0}, {PIA_SCATTERED, 3, 3, 8, 7, 17, 1, 1, 1, 0, 0},
    {PIA_SCATTERED, 1, 2, 6, 7, 18, 2, 0, 1, 0, 1}, {PIA_SCATTERED, 4, 3, 9, 8, 22, 2, 3, 0, 0, 0},
    {PIA_SCATTERED, 2, 2, 3, 4, 16, 1, 3, 0, 0, 0}, {PIA_SCATTERED, 5, 1, 8, 5, 20, 4, 2, 0, 0, 1},
    {PIA_GRID, 3, 3, 7, 7, 22, 3, 0, 0, 1, 0},      {PIA_GRID, 2, 3, 6, 7, 20, 2, 1, 1, 0, 0},
    {PIA_GRID, 3, 2, 6, 6, 21, 1, 2, 1, 1, 1},
};
enum { SHAPES = sizeof shapes / sizeof *shapes };

static problem *open_shape(pia_context *context, const shape *s)
{
    problem *p = problem_open(context, s->kind, s->p, s->q, s->nu, s->nv, s->rows, s->dim, s->cyclic, s->weighted);
    for (pia_index row = 0; s->holes && row < p->rows; row += 7) p->points[row * p->dim] = NAN;
    for (pia_index c = 2; s->frozen && c < p->cols; c += 11) assert_ok(context, pia_op_freeze(p->op, c, 1));
    return p;
}

static pia_context *new_context(int threads)
{
    pia_context_options options;
    pia_context *context = NULL;
    pia_context_options_init(&options);
    options.threads = threads;
    assert_ok(NULL, pia_context_create(&options, &context));
    return context;
}

static void fill(pia_index count, uint64_t seed, double *x)
{
    for (pia_index i = 0; i < count; i++) x[i] = 2 * problem_random(&seed) - 1;
}

static void sums_and_products_are_those_of_the_dense_matrix(void **state)
{
    (void)state;
    pia_context *context = new_context(2);
    for (int k = 0; k < SHAPES; k++) {
        problem *p = open_shape(context, &shapes[k]);
        pia_normal *normal, *dense = dense_normal_open(p);
        double x[400], y[400], expected[400];
        assert_ok(context, pia_normal_open(p->op, &p->targets, &normal));
        assert_string_equal(normal->class->name, "stencil");
        for (pia_index i = 0; i < p->cols * p->dim; i++) assert_near(normal->right[i], dense->right[i], 1e-12);
        for (pia_index i = 0; i < p->cols; i++) assert_near(normal->diagonal[i], dense->diagonal[i], 1e-12);
        for (pia_index i = 0; i < p->cols && !shapes[k].holes; i++) assert_near(normal->column_sum[i], dense->column_sum[i], 1e-11);
        for (int dim = 1; dim <= p->dim; dim++) {
            fill(p->cols * dim, 3, x);
            normal->class->multiply(normal, x, dim, y);
            dense->class->multiply(dense, x, dim, expected);
            for (pia_index i = 0; i < p->cols * dim; i++) assert_near(y[i], expected[i], 1e-11);
        }
        pia_normal_close(normal);
        pia_normal_close(dense);
        problem_close(p);
    }
    pia_context_destroy(context);
}

static void direct_solutions_are_those_of_dense_elimination(void **state)
{
    (void)state;
    pia_context *context = new_context(1);
    for (int k = 0; k < SHAPES; k++) {
        problem *p = open_shape(context, &shapes[k]);
        pia_normal *normal, *dense = dense_normal_open(p);
        double x[400], expected[400];
        assert_ok(context, pia_normal_open(p->op, &p->targets, &normal));
        assert_ok(context, normal->class->factor(normal));
        assert_int_equal(normal->weak, 0);
        memcpy(x, normal->right, (size_t)(p->cols * p->dim) * sizeof *x);
        memcpy(expected, normal->right, (size_t)(p->cols * p->dim) * sizeof *x);
        normal->class->solve(normal, x, p->dim);
        dense->class->solve(dense, expected, p->dim);
        for (pia_index i = 0; i < p->cols * p->dim; i++) assert_near(x[i], expected[i], 1e-9);
        pia_normal_close(normal);
        pia_normal_close(dense);
        problem_close(p);
    }
    pia_context_destroy(context);
}

/* (Gu (x) Gv) / W from sums over the other direction: positive, and exact when the points form a full grid. */
static void the_preconditioner_is_exact_for_a_full_grid(void **state)
{
    (void)state;
    pia_context *context = new_context(1);
    problem *p = problem_open(context, PIA_GRID, 3, 2, 8, 7, 24, 2, 1, 1);
    for (pia_index row = 0; row < p->rows; row++) p->weights[row] = 2;
    pia_normal *normal;
    double x[400], y[400];
    assert_ok(context, pia_normal_open(p->op, &p->targets, &normal));
    assert_ok(context, normal->class->approximate(normal));
    fill(p->cols * 2, 9, x);
    normal->class->multiply(normal, x, 2, y);
    normal->class->precondition(normal, y, 2);
    for (pia_index i = 0; i < p->cols * 2; i++) assert_near(y[i], x[i], 1e-10);
    pia_normal_close(normal);
    problem_close(p);
    pia_context_destroy(context);
}

static void where_no_data_are_corrections_are_small_and_counted(void **state)
{
    (void)state;
    pia_context *context = new_context(1);
    problem *p = problem_open(context, PIA_SCATTERED, 3, 3, 10, 10, 30, 1, 0, 0);
    for (pia_index row = 0; row < p->rows; row++)
        for (int d = 0; d < 2; d++) p->parameters[0][2 * row + d] *= 0.6;
    pia_op_close(p->op);
    static const pia_map map[2] = {PIA_MAP_IDENTITY, PIA_MAP_IDENTITY};
    assert_ok(context, pia_op_scatter_open(context, p->degree, map, (const double *const *)p->knots, p->full, p->parameters[0], p->rows,
                                           NULL, 1, &p->op));
    pia_normal *normal;
    double x[100], y[100];
    assert_ok(context, pia_normal_open(p->op, &p->targets, &normal));
    assert_ok(context, normal->class->factor(normal));
    assert_true(normal->weak > 0 && normal->weak < 60);
    memcpy(x, normal->right, sizeof x);
    normal->class->solve(normal, x, 1);
    for (int i = 0; i < 100; i++) assert_true(fabs(x[i]) < 1000);
    assert_near(x[99], 0, 0);
    normal->class->multiply(normal, x, 1, y);
    for (int i = 0; i < 100; i++) assert_near(y[i], normal->right[i], 1e-4);
    pia_normal_close(normal);
    problem_close(p);
    pia_context_destroy(context);
}

/* Enough rows for threads. */
static void the_thread_count_does_not_change_a_bit(void **state)
{
    (void)state;
    enum { SIDE = 170 };
    double *right[2], *product[2];
    size_t bytes = (size_t)(30 * 31 * 2) * sizeof(double);
    for (int k = 0; k < 2; k++) {
        pia_context *context = new_context(k == 0 ? 1 : 5);
        static const int degree[2] = {3, 2};
        static const pia_map map[2] = {PIA_MAP_IDENTITY, PIA_MAP_CYCLIC};
        static const pia_index full[2] = {30, 33};
        uint64_t seed = 1;
        double *knots[2] = {problem_knots(3, 0, 30, &seed), problem_knots(2, 1, 31, &seed)}, origin[2] = {0, 0};
        double *parameters = malloc(2 * SIDE * SIDE * sizeof(double)), *points = malloc(2 * SIDE * SIDE * sizeof(double));
        for (int i = 0; i < 2 * SIDE * SIDE; i++) {
            parameters[i] = problem_random(&seed);
            points[i] = problem_random(&seed);
        }
        pia_op *op;
        pia_normal *normal;
        assert_ok(context,
                  pia_op_scatter_open(context, degree, map, (const double *const *)knots, full, parameters, SIDE * SIDE, NULL, 2, &op));
        pia_targets targets = {.points = points, .origin = origin, .dim = 2};
        assert_ok(context, pia_normal_open(op, &targets, &normal));
        right[k] = malloc(bytes);
        product[k] = malloc(bytes);
        memcpy(right[k], normal->right, bytes);
        normal->class->multiply(normal, right[k], 2, product[k]);
        pia_normal_close(normal);
        pia_op_close(op);
        free(knots[0]), free(knots[1]), free(parameters), free(points);
        pia_context_destroy(context);
    }
    assert_memory_equal(right[0], right[1], bytes);
    assert_memory_equal(product[0], product[1], bytes);
    for (int k = 0; k < 2; k++) free(right[k]), free(product[k]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sums_and_products_are_those_of_the_dense_matrix),
        cmocka_unit_test(direct_solutions_are_those_of_dense_elimination),
        cmocka_unit_test(the_preconditioner_is_exact_for_a_full_grid),
        cmocka_unit_test(where_no_data_are_corrections_are_small_and_counted),
        cmocka_unit_test(the_thread_count_does_not_change_a_bit),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
