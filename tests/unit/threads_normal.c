/* The normal form of a curve of more spans than are summed at a time, of many, few and no rows: against the operator, which knows
 * nothing of sums over spans. */
#include "kernel.h"
#include "normal.h"
#include "problems.h"

enum { DEGREE = 3, DIM = 2, SPANS = 40000, FULL = SPANS + DEGREE };

typedef struct curve {
    pia_context *context;
    double knots[FULL + DEGREE + 1], origin[DIM], *parameters, *points, *weights;
    pia_index rows;
    pia_collocation line;
    pia_op *op;
    pia_targets targets;
} curve;

/* crowded: one span has so many rows that all threads share them. */
static pia_index rows_of(pia_index s, int crowded)
{
    if (crowded && s == 17) return 300;
    return s % 1000 >= 500 && s % 1000 < 503 ? 0 : s % 997 == 0 ? 200 : 1 + 7 * s % 12;
}

static curve *curve_open(int threads, int weighted, int crowded)
{
    curve *c = calloc(1, sizeof *c);
    uint64_t seed = 5;
    pia_context_options options;
    pia_context_options_init(&options);
    options.threads = threads;
    assert_ok(NULL, pia_context_create(&options, &c->context));
    for (pia_index k = 0; k < FULL + DEGREE + 1; k++) c->knots[k] = k < DEGREE ? 0 : k > FULL ? SPANS : (double)(k - DEGREE);
    for (pia_index s = 0; s < SPANS; s++) c->rows += rows_of(s, crowded);
    c->parameters = malloc((size_t)c->rows * sizeof(double));
    c->points = malloc((size_t)(c->rows * DIM) * sizeof(double));
    c->weights = malloc((size_t)c->rows * sizeof(double));
    pia_index row = 0;
    for (pia_index s = 0; s < SPANS; s++)
        for (pia_index k = 0; k < rows_of(s, crowded); k++, row++)
            c->parameters[row] = (double)s + ((double)k + problem_random(&seed)) / (double)rows_of(s, crowded);
    for (row = 0; row < c->rows * DIM; row++) c->points[row] = 4 * problem_random(&seed) - 1;
    for (row = 0; row < c->rows; row++) c->weights[row] = 0.1 + problem_random(&seed);
    c->origin[1] = 1;
    c->targets = (pia_targets){c->points, c->origin, DIM};
    assert_ok(c->context,
              pia_collocation_open(c->context, DEGREE, PIA_MAP_IDENTITY, 0, c->knots, FULL, c->parameters, c->rows, 0, &c->line));
    assert_ok(c->context, pia_op_curve_open(c->context, &c->line, weighted ? c->weights : NULL, DIM, &c->op));
    return c;
}

static void curve_close(curve *c)
{
    pia_op_close(c->op);
    pia_collocation_close(c->context, &c->line);
    pia_context_destroy(c->context);
    free(c->parameters);
    free(c->points);
    free(c->weights);
    free(c);
}

static void the_form_is_what_the_operator_says(void **state)
{
    (void)state;
    for (int way = 0; way < 4; way++) {
        int weighted = way % 2, crowded = way / 2;
        curve *c = curve_open(2, weighted, crowded);
        pia_normal *normal = NULL;
        double *values = malloc((size_t)(c->rows * DIM) * sizeof *values);
        double *x = malloc(FULL * DIM * sizeof *x), *y = malloc(FULL * DIM * sizeof *y), *z = malloc(FULL * DIM * sizeof *z);
        assert_ok(c->context, pia_normal_open(c->op, &c->targets, &normal));
        for (int i = 0; i < FULL * DIM; i++) x[i] = sin(i);
        pia_op_apply(c->op, x, DIM, values);
        pia_op_gather(c->op, values, c->op->weights, DIM, y);
        normal->class->multiply(normal, x, DIM, z);
        for (int i = 0; i < FULL * DIM; i++) assert_near(z[i], y[i], 1e-12);
        for (pia_index i = 0; i < c->rows * DIM; i++) values[i] = c->points[i] - c->origin[i % DIM];
        pia_op_gather(c->op, values, c->op->weights, DIM, y);
        for (int i = 0; i < FULL * DIM; i++) assert_near(normal->right[i], y[i], 1e-11);
        for (pia_index i = 0; i < c->rows; i++) values[i] = 1;
        pia_op_gather(c->op, values, c->op->weights, 1, y);
        for (int i = 0; i < FULL; i++) assert_near(normal->column_sum[i], y[i], 1e-12);
        free(values);
        free(x);
        free(y);
        free(z);
        pia_normal_close(normal);
        curve_close(c);
    }
}

static void assert_same(const pia_normal *a, const pia_normal *b)
{
    double *x = malloc(FULL * sizeof *x), *y = malloc(2 * FULL * sizeof *y);
    for (int i = 0; i < FULL; i++) x[i] = cos(i);
    a->class->multiply(a, x, 1, y);
    b->class->multiply(b, x, 1, y + FULL);
    assert_memory_equal(y, y + FULL, FULL * sizeof *y);
    assert_memory_equal(a->right, b->right, FULL * DIM * sizeof(double));
    assert_memory_equal(a->column_sum, b->column_sum, FULL * sizeof(double));
    free(x);
    free(y);
}

/* Edits inside, where two sums begin and end, and of the row that all refer to. */
static void check_edits(int crowded)
{
    curve *one = curve_open(1, 1, crowded), *four = curve_open(4, 1, crowded);
    pia_normal *edited = NULL, *fresh = NULL;
    const pia_index span[] = {20000, 16384, 32768, SPANS - 1, 0};
    assert_ok(one->context, pia_normal_open(one->op, &one->targets, &edited));
    for (int k = 0; k < 5; k++) {
        pia_index first = one->line.begin[span[k]] - (span[k] > 0), last = first + 6 < one->rows ? first + 6 : one->rows - 1;
        for (pia_index i = first * DIM; i < (last + 1) * DIM; i++) four->points[i] = one->points[i] += 3;
        pia_normal_refresh(edited, &one->targets, first, last);
        assert_ok(four->context, pia_normal_open(four->op, &four->targets, &fresh));
        assert_same(edited, fresh);
        pia_normal_close(fresh);
    }
    pia_normal_close(edited);
    curve_close(one);
    curve_close(four);
}

static void edits_and_threads_change_no_bit(void **state)
{
    (void)state;
    check_edits(0);
    check_edits(1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_form_is_what_the_operator_says),
        cmocka_unit_test(edits_and_threads_change_no_bit),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
