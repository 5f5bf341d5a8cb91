/* A part of a problem against the whole of it: residuals and errors after some control points have moved. */
#include "part.h"
#include "context_fixture.h"
#include "problems.h"

static void fill(double *x, pia_index count, uint64_t seed)
{
    for (pia_index i = 0; i < count; i++) x[i] = problem_random(&seed);
}

/* Control points of the box get other values. */
static void move(const problem *p, const pia_block *moving, double *x, uint64_t seed)
{
    for (pia_index i = moving->low[0]; i < moving->high[0]; i++)
        fill(x + (i * p->unknowns[1] + moving->low[1]) * p->dim, (moving->high[1] - moving->low[1]) * p->dim, seed + (uint64_t)i);
}

static void assert_errors(pia_errors actual, pia_errors expected)
{
    assert_near(actual.max, expected.max, 1e-13);
    assert_int_equal(actual.max_row, expected.max_row);
    assert_near(actual.sum_squares, expected.sum_squares, 1e-13 * expected.sum_squares);
    assert_near(actual.weighted, expected.weighted, 1e-13 * expected.weighted);
    assert_int_equal(actual.count, expected.count);
}

static void compare(problem *p, const pia_block *moving, int known)
{
    pia_part *part = NULL;
    pia_index size = p->rows * p->dim;
    double *x = malloc((size_t)(p->cols * p->dim) * sizeof *x), *whole = malloc((size_t)size * sizeof *whole),
           *residual = malloc((size_t)size * sizeof *residual);
    fill(x, p->cols * p->dim, 3);
    pia_op_residual(p->op, x, &p->targets, residual);
    assert_ok(p->context, pia_part_open(p->op, &p->targets, moving, known ? residual : NULL, &part));
    for (uint64_t step = 0; step < 3; step++) {
        move(p, moving, x, 17 * step);
        pia_errors expected = pia_op_residual(p->op, x, &p->targets, whole);
        assert_errors(pia_part_residual(part, x, &p->targets, residual), expected);
        for (pia_index i = 0; i < size; i++) assert_near(residual[i], whole[i], 1e-13);
    }
    assert_true(part->rows < p->rows);
    pia_part_close(part);
    free(x);
    free(whole);
    free(residual);
}

static void a_part_measures_as_the_whole(void **state)
{
    static const pia_block moving[] = {{{0, 0}, {2, 2}}, {{7, 6}, {9, 8}}, {{12, 11}, {14, 13}}};
    for (pia_kind kind = PIA_CURVE; kind <= PIA_SCATTERED; kind++)
        for (int degree = 1; degree <= 4; degree++)
            for (size_t k = 0; k < sizeof moving / sizeof *moving; k++)
                for (int weighted = 0; weighted < 2; weighted++) {
                    problem *p = problem_open(*state, kind, degree, degree, 14, 13, 42, 1 + (int)k, 0, weighted);
                    pia_block block = moving[k];
                    if (kind == PIA_CURVE) block.low[1] = 0, block.high[1] = 1;
                    compare(p, &block, weighted);
                    problem_close(p);
                }
}

/* Control points that no row touches: nothing changes as they move. */
static void a_part_without_rows_leaves_the_errors_alone(void **state)
{
    problem *p = problem_open(*state, PIA_SCATTERED, 1, 1, 14, 13, 2, 3, 0, 0);
    const pia_block moving = {{2, 2}, {3, 3}};
    pia_part *part = NULL;
    double *x = calloc((size_t)(p->cols * 3), sizeof *x), residual[12];
    assert_ok(*state, pia_part_open(p->op, &p->targets, &moving, NULL, &part));
    assert_int_equal(part->rows, 0);
    pia_errors expected = pia_op_residual(p->op, x, &p->targets, NULL);
    assert_errors(pia_part_residual(part, x, &p->targets, residual), expected);
    move(p, &moving, x, 5);
    assert_errors(pia_part_residual(part, x, &p->targets, residual), expected);
    pia_part_close(part);
    free(x);
    problem_close(p);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_part_measures_as_the_whole),
        cmocka_unit_test(a_part_without_rows_leaves_the_errors_alone),
    };
    return cmocka_run_group_tests(tests, open_context, close_context);
}
