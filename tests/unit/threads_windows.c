/* Interpolation of long curves, a window at a time. */
#include "clones.h"
#include "problems.h"
#include "windows_group.h"

enum { ROWS = 8192 + 37, MAX_COMPONENTS = 4 };

/* An open curve through ROWS points. `spread`: parameter steps lie between 1 and that. Knots by averaging follow uneven parameters now
 * earlier and now later; knots at the parameters (not-a-knot, odd degrees) one a row. */
typedef enum placement { AVERAGED, AT_PARAMETERS } placement;

typedef struct curve {
    pia_context *context;
    int degree, dim;
    double *parameters, *knots, *points, origin[MAX_COMPONENTS];
    pia_collocation line;
    pia_targets targets;
    pia_op *op;
} curve;

static pia_context *context_with(int threads)
{
    pia_context_options options;
    pia_context_options_init(&options);
    options.threads = threads;
    pia_context *context;
    assert_ok(NULL, pia_context_create(&options, &context));
    return context;
}

static void place(const curve *c, placement kind)
{
    for (pia_index i = 0; i <= c->degree; i++) {
        c->knots[i] = c->parameters[0];
        c->knots[ROWS + i] = c->parameters[ROWS - 1];
    }
    for (pia_index i = 1; i < ROWS - c->degree; i++) {
        double sum = 0;
        for (int k = 0; k < c->degree; k++) sum += c->parameters[i + k];
        c->knots[c->degree + i] = kind == AVERAGED ? sum / c->degree : c->parameters[i + (c->degree - 1) / 2];
    }
}

static curve *open_curve(int degree, int dim, double spread, placement kind, int threads)
{
    curve *c = malloc(sizeof *c);
    assert_non_null(c);
    *c = (curve){.context = context_with(threads), .degree = degree, .dim = dim};
    uint64_t seed = (uint64_t)(10 * degree + dim);
    c->parameters = malloc(ROWS * sizeof(double));
    c->knots = malloc((size_t)(ROWS + degree + 1) * sizeof(double));
    c->points = malloc((size_t)(ROWS * dim) * sizeof(double));
    double t = 0;
    for (pia_index i = 0; i < ROWS; i++) {
        c->parameters[i] = t;
        t += pow(spread, problem_random(&seed)) / ROWS;
        for (int d = 0; d < dim; d++) c->points[i * dim + d] = 3 + sin(20 * t + d) + 0.1 * problem_random(&seed);
    }
    for (int d = 0; d < dim; d++) c->origin[d] = 3 - 0.1 * d;
    place(c, kind);
    assert_ok(c->context, pia_collocation_open(c->context, degree, PIA_MAP_IDENTITY, 0, c->knots, ROWS, c->parameters, ROWS,
                                               PIA_WITHOUT_BEGINS, &c->line));
    assert_ok(c->context, pia_op_curve_open(c->context, &c->line, NULL, dim, &c->op));
    c->targets = (pia_targets){c->points, c->origin, dim};
    assert_true(pia_windows_suit(c->op));
    return c;
}

static void close_curve(curve *c)
{
    pia_op_close(c->op);
    pia_collocation_close(c->context, &c->line);
    pia_context_destroy(c->context);
    free(c->parameters), free(c->knots), free(c->points), free(c);
}

/* The largest |points - origin - A x| and its row, by the Cox-de Boor recursion. */
static double largest_error(const curve *c, const double *x, pia_index *row)
{
    double worst = -1;
    pia_index span = c->degree;
    for (pia_index i = 0; i < ROWS; i++) {
        double left[MAX_COMPONENTS], square = 0;
        while (span < ROWS - 1 && c->parameters[i] >= c->knots[span + 1]) span++;
        for (int d = 0; d < c->dim; d++) left[d] = c->points[i * c->dim + d] - c->origin[d];
        for (pia_index j = span - c->degree; j <= span; j++) {
            double value = problem_basis(c->knots, j, c->degree, c->parameters[i], ROWS - 1);
            for (int d = 0; d < c->dim; d++) left[d] -= value * x[j * c->dim + d];
        }
        for (int d = 0; d < c->dim; d++) square += left[d] * left[d];
        if (square > worst) {
            worst = square;
            *row = i;
        }
    }
    return sqrt(worst);
}

static double *take_control(const curve *c)
{
    double *x = malloc((size_t)(ROWS * c->dim) * sizeof *x);
    assert_non_null(x);
    return x;
}

static void check_step(int degree, int dim, double spread, placement kind)
{
    curve *c = open_curve(degree, dim, spread, kind, 2);
    double *x = take_control(c), *start = take_control(c), moved = 0;
    pia_step_errors errors;
    pia_index row;
    int done = 0;
    assert_ok(c->context, pia_windows_step(c->op, NULL, &c->targets, x, NULL, &errors, &done));
    assert_int_equal(done, 1);
    assert_true(largest_error(c, x, &row) < 1e-12);
    assert_true(errors.after.max < 1e-12);
    assert_int_equal(errors.after.count, ROWS);
    for (pia_index i = 0; i < ROWS * dim; i++) start[i] = c->points[i] - c->origin[i % dim];
    assert_near(errors.before.max, largest_error(c, start, &row), 1e-14);
    assert_int_equal(errors.before.max_row, row);
    assert_int_equal(errors.before.count, ROWS);
    for (pia_index i = 0; i < ROWS; i++) {
        double square = 0;
        for (int d = 0; d < dim; d++) square += pow(x[i * dim + d] - start[i * dim + d], 2);
        moved = fmax(moved, sqrt(square));
    }
    assert_near(errors.moved, moved, 1e-14 * (1 + moved));
    free(x), free(start);
    close_curve(c);
}

static void the_targets_move_to_the_interpolating_curve(void **state)
{
    (void)state;
    for (int degree = 1; degree <= 7; degree++)
        for (int dim = 1; dim <= MAX_COMPONENTS; dim++) check_step(degree, dim, dim % 2 == 0 ? 10 : 3, AVERAGED);
}

static void rows_one_a_span_are_no_different(void **state)
{
    (void)state;
    for (int degree = 1; degree <= 7; degree++) check_step(degree, 3, 1, AVERAGED);
    for (int dim = 1; dim <= MAX_COMPONENTS; dim++) check_step(3, dim, 3, AT_PARAMETERS);
    for (int degree = 1; degree <= 7; degree += 2) check_step(degree, 2, 2, AT_PARAMETERS);
}

static void curves_far_from_the_origin_lose_nothing(void **state)
{
    (void)state;
    for (int kind = AVERAGED; kind <= AT_PARAMETERS; kind++) {
        curve *c = open_curve(3, 3, 3, (placement)kind, 2);
        double *x = take_control(c), *same = take_control(c);
        pia_step_errors errors;
        int done;
        assert_ok(c->context, pia_windows_step(c->op, NULL, &c->targets, x, NULL, &errors, &done));
        for (pia_index i = 0; i < ROWS * 3; i++) c->points[i] += 1 << 20;
        for (int d = 0; d < 3; d++) c->origin[d] += 1 << 20;
        assert_ok(c->context, pia_windows_step(c->op, NULL, &c->targets, same, NULL, &errors, &done));
        assert_true(errors.after.max < 1e-14);
        for (pia_index i = 0; i < ROWS * 3; i++) assert_near(x[i], same[i], 1e-9); /* the points themselves are as coarse as that */
        free(x), free(same);
        close_curve(c);
    }
}

static void any_control_points_move_to_the_same_curve(void **state)
{
    (void)state;
    curve *c = open_curve(3, 3, 10, AVERAGED, 2);
    double *start = take_control(c), *x = take_control(c), *same = take_control(c);
    pia_step_errors errors;
    uint64_t seed = 3;
    pia_index row;
    int done;
    for (pia_index i = 0; i < ROWS * 3; i++) start[i] = problem_random(&seed);
    assert_ok(c->context, pia_windows_step(c->op, NULL, &c->targets, same, NULL, &errors, &done));
    assert_ok(c->context, pia_windows_step(c->op, start, &c->targets, x, NULL, &errors, &done));
    assert_near(errors.before.max, largest_error(c, start, &row), 1e-13);
    assert_int_equal(errors.before.max_row, row);
    for (pia_index i = 0; i < ROWS * 3; i++) assert_near(x[i], same[i], 1e-12);
    free(start), free(x), free(same);
    close_curve(c);
}

/* On knots of very different distances the inverse decays slowly, and a window may not know enough. */
static void errors_are_told_as_they_are_on_uneven_data(void **state)
{
    (void)state;
    for (int degree = 2; degree <= 7; degree++) {
        curve *c = open_curve(degree, 2, 1e4, AVERAGED, 2);
        double *x = take_control(c), largest = 0;
        pia_step_errors errors;
        pia_index row;
        int done;
        assert_ok(c->context, pia_windows_step(c->op, NULL, &c->targets, x, NULL, &errors, &done));
        assert_int_equal(done, 1);
        for (pia_index i = 0; i < ROWS * 2; i++) largest = fmax(largest, fabs(x[i]));
        assert_near(errors.after.max, largest_error(c, x, &row), 1e-14 * largest + 1e-6 * errors.after.max);
        free(x);
        close_curve(c);
    }
}

static void a_vanishing_pivot_is_told(void **state)
{
    (void)state;
    static const pia_index at[] = {2, ROWS / 2, ROWS - 3}; /* here the row of c has no hold on unknown c */
    for (size_t k = 0; k < sizeof at / sizeof *at; k++)
        for (int degree = 1; degree <= 3; degree++) {
            curve *c = open_curve(degree, 1, 10, AVERAGED, 2);
            double *x = take_control(c), t = c->knots[at[k] + degree + 1];
            pia_step_errors errors;
            int done = 1;
            for (pia_index i = at[k]; i < ROWS && c->parameters[i] < t; i++) c->parameters[i] = t;
            assert_ok(c->context, pia_windows_step(c->op, NULL, &c->targets, x, NULL, &errors, &done));
            assert_int_equal(done, 0);
            free(x);
            close_curve(c);
        }
}

static void the_number_of_threads_changes_no_bit(void **state)
{
    (void)state;
    static const int threads[] = {1, 2, 3, 8};
    for (int degree = 2; degree <= 5; degree++) {
        double *first = NULL;
        pia_step_errors first_errors, errors;
        for (size_t k = 0; k < sizeof threads / sizeof *threads; k++) {
            curve *c = open_curve(degree, 3, 10, AVERAGED, threads[k]);
            double *x = take_control(c);
            int done;
            assert_ok(c->context, pia_windows_step(c->op, NULL, &c->targets, x, NULL, &errors, &done));
            assert_int_equal(done, 1);
            if (first == NULL) {
                first = x;
                first_errors = errors;
            } else {
                assert_memory_equal(x, first, ROWS * 3 * sizeof *x);
                assert_true(errors.before.sum_squares == first_errors.before.sum_squares);
                assert_true(errors.after.sum_squares == first_errors.after.sum_squares);
                assert_true(errors.after.max == first_errors.after.max && errors.after.max_row == first_errors.after.max_row);
                free(x);
            }
            close_curve(c);
        }
        free(first);
    }
}

static void wider_vectors_change_no_bit(void **state)
{
    (void)state;
    if (!pia_has_wide()) return;
    for (int degree = 1; degree <= 7; degree++)
        for (int kind = AVERAGED; kind <= AT_PARAMETERS; kind++) {
            curve *c = open_curve(degree, 1 + degree % MAX_COMPONENTS, kind == AVERAGED ? 10 : 3, (placement)kind, 2);
            double *x = take_control(c), *same = take_control(c);
            pia_step_errors errors, same_errors;
            int done;
            assert_ok(c->context, pia_windows_step_with(pia_windows_solve_by_four, c->op, NULL, &c->targets, x, NULL, &errors, &done));
            assert_int_equal(done, 1);
            assert_ok(c->context,
                      pia_windows_step_with(pia_windows_solve_by_eight, c->op, NULL, &c->targets, same, NULL, &same_errors, &done));
            assert_int_equal(done, 1);
            assert_memory_equal(x, same, (size_t)(ROWS * c->dim) * sizeof *x);
            assert_true(errors.before.sum_squares == same_errors.before.sum_squares && errors.moved == same_errors.moved);
            assert_true(errors.after.sum_squares == same_errors.after.sum_squares && errors.after.max == same_errors.after.max);
            assert_int_equal(errors.after.max_row, same_errors.after.max_row);
            free(x), free(same);
            close_curve(c);
        }
}

static void what_the_step_sees_is_told(void **state)
{
    (void)state;
    curve *c = open_curve(3, 2, 3, AT_PARAMETERS, 2);
    double *x = take_control(c), low = INFINITY, high = -INFINITY;
    pia_step_errors errors;
    pia_survey survey;
    int done;
    for (pia_index i = 0; i < ROWS; i++) {
        low = fmin(low, c->points[2 * i + 1]);
        high = fmax(high, c->points[2 * i + 1]);
    }
    assert_ok(c->context, pia_windows_step(c->op, NULL, &c->targets, x, &survey, &errors, &done));
    assert_true(survey.finite && survey.ordered && survey.low[1] == low && survey.high[1] == high);
    c->points[2 * (ROWS - 1)] = INFINITY;
    assert_ok(c->context, pia_windows_step(c->op, NULL, &c->targets, x, &survey, &errors, &done));
    assert_true(!done || !survey.finite);
    for (pia_index i = 0; i < 2 * ROWS; i++) c->points[i] = NAN; /* no square is the largest */
    assert_ok(c->context, pia_windows_step(c->op, NULL, &c->targets, x, &survey, &errors, &done));
    assert_true(!done || (!survey.finite && errors.after.max_row < ROWS));
    free(x);
    close_curve(c);
}

static void only_long_open_curves_are_suited(void **state)
{
    (void)state;
    curve *c = open_curve(3, 1, 10, AVERAGED, 1);
    assert_ok(c->context, pia_op_freeze(c->op, 5, 1));
    assert_int_equal(pia_windows_suit(c->op), 0);
    assert_ok(c->context, pia_op_freeze(c->op, 5, 0));
    c->op->rows = c->op->cols = 4000;
    assert_int_equal(pia_windows_suit(c->op), 0);
    c->op->rows = c->op->cols = ROWS;
    close_curve(c);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_targets_move_to_the_interpolating_curve),
        cmocka_unit_test(rows_one_a_span_are_no_different),
        cmocka_unit_test(curves_far_from_the_origin_lose_nothing),
        cmocka_unit_test(any_control_points_move_to_the_same_curve),
        cmocka_unit_test(errors_are_told_as_they_are_on_uneven_data),
        cmocka_unit_test(a_vanishing_pivot_is_told),
        cmocka_unit_test(the_number_of_threads_changes_no_bit),
        cmocka_unit_test(wider_vectors_change_no_bit),
        cmocka_unit_test(what_the_step_sees_is_told),
        cmocka_unit_test(only_long_open_curves_are_suited),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
