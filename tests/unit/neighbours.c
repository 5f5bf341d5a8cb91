/* Rows of a curve on spans one after the other, which are taken four at a time, against the sum of the definition. */
#include "problems.h"

enum { ROWS = 203, MOST_DIM = 4 };

typedef struct curve {
    pia_context *context;
    int degree, dim;
    double t[ROWS], knots[ROWS + PIA_MAX_DEGREE + 1], points[ROWS * MOST_DIM], x[ROWS * MOST_DIM], next[ROWS * MOST_DIM],
        origin[MOST_DIM];
    pia_collocation line;
    pia_targets targets;
    pia_op *op;
} curve;

/* uneven: some rows share a span and some spans have none, so that fours and single rows take turns. */
static void open_curve(curve *c, int degree, int dim, int uneven)
{
    uint64_t seed = (uint64_t)(degree + 10 * dim);
    *c = (curve){.degree = degree, .dim = dim};
    assert_ok(NULL, pia_context_create(NULL, &c->context));
    for (int i = 0; i < ROWS; i++)
        c->t[i] = i + (i > 0 && i < ROWS - 1 ? (i / 20 % 2 && uneven ? 0.9 : 0.3) * problem_random(&seed) : 0);
    for (int k = 0; k <= degree; k++) {
        c->knots[k] = 0;
        c->knots[ROWS + k] = ROWS - 1;
    }
    for (int i = degree + 1; i < ROWS; i++) c->knots[i] = i - (degree + 1) / 2.0;
    for (int i = 0; i < ROWS * dim; i++) {
        c->points[i] = problem_random(&seed);
        c->x[i] = problem_random(&seed);
    }
    for (int d = 0; d < dim; d++) c->origin[d] = 0.1 * d;
    assert_ok(c->context, pia_collocation_open(c->context, degree, PIA_MAP_IDENTITY, 0, c->knots, ROWS, c->t, ROWS, 0, &c->line));
    assert_ok(c->context, pia_op_curve_open(c->context, &c->line, NULL, dim, &c->op));
    c->targets = (pia_targets){c->points, c->origin, dim};
}

static void close_curve(curve *c)
{
    pia_op_close(c->op);
    pia_collocation_close(c->context, &c->line);
    pia_context_destroy(c->context);
}

static double difference(const curve *c, int i, int d)
{
    double left = c->points[i * c->dim + d] - c->origin[d];
    for (int j = 0; j < ROWS; j++)
        if (c->knots[j] <= c->t[i] && c->t[i] <= c->knots[j + c->degree + 1])
            left -= problem_basis(c->knots, j, c->degree, c->t[i], ROWS - 1) * c->x[j * c->dim + d];
    return left;
}

static void check_move(int degree, int dim, int uneven)
{
    curve c;
    double worst = -1, sum = 0;
    int row = 0;
    open_curve(&c, degree, dim, uneven);
    pia_errors errors = pia_op_move(c.op, c.x, &c.targets, 0.75, c.next);
    for (int i = 0; i < ROWS; i++) {
        double square = 0;
        for (int d = 0; d < dim; d++) {
            double left = difference(&c, i, d);
            assert_near(c.next[i * dim + d], c.x[i * dim + d] + 0.75 * left, 1e-14);
            square += left * left;
        }
        if (square > worst) row = i;
        worst = fmax(worst, square);
        sum += square;
    }
    assert_near(errors.max, sqrt(worst), 1e-14);
    assert_near(errors.sum_squares, sum, 1e-12);
    assert_int_equal(errors.max_row, row);
    assert_int_equal(errors.count, ROWS);
    close_curve(&c);
}

static void rows_one_a_span_move_as_defined(void **state)
{
    (void)state;
    for (int degree = 1; degree <= 5; degree++)
        for (int dim = 1; dim <= MOST_DIM; dim++) check_move(degree, dim, 0);
}

static void rows_that_share_spans_move_as_defined(void **state)
{
    (void)state;
    for (int degree = 1; degree <= 5; degree++)
        for (int dim = 1; dim <= MOST_DIM; dim++) check_move(degree, dim, 1);
}

static void errors_alone_are_the_same(void **state)
{
    (void)state;
    curve c;
    open_curve(&c, 3, 3, 1);
    pia_errors moved = pia_op_move(c.op, c.x, &c.targets, 1, c.next), alone = pia_op_residual(c.op, c.x, &c.targets, NULL);
    assert_near(moved.max, alone.max, 1e-15);
    assert_int_equal(moved.max_row, alone.max_row);
    close_curve(&c);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rows_one_a_span_move_as_defined),
        cmocka_unit_test(rows_that_share_spans_move_as_defined),
        cmocka_unit_test(errors_alone_are_the_same),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
