/* Interpolation of grids, many lines at a time: the block solve, and the step from points to control points. */
#include "clones.h"
#include "problems.h"
#include "square.h"
#include "square_grid_parts.h"

enum { MOST = 150, MOST_DIM = 9 };

/* Knots at the parameters (not-a-knot, odd degrees) give rows with one neighbour on either side, but at the ends. */
typedef enum placement { AVERAGED, AT_PARAMETERS } placement;

typedef struct surface {
    pia_context *context;
    int degree[2], dim;
    pia_index count[2];
    double t[2][MOST], knots[2][MOST + PIA_MAX_DEGREE + 1], points[MOST * MOST * MOST_DIM], x[MOST * MOST * MOST_DIM],
        values[MOST * MOST * MOST_DIM], origin[MOST_DIM];
    pia_collocation line[2];
    pia_targets targets;
    pia_op *op;
} surface;

static void place(surface *s, int d, placement kind, uint64_t *seed)
{
    pia_index n = s->count[d];
    int degree = s->degree[d];
    for (pia_index i = 0; i < n; i++) s->t[d][i] = ((double)i + 0.4 * (i > 0 && i + 1 < n) * problem_random(seed)) / (double)(n - 1);
    for (int k = 0; k <= degree; k++) {
        s->knots[d][k] = 0;
        s->knots[d][n + k] = 1;
    }
    for (pia_index i = 1; i < n - degree; i++) {
        double sum = 0;
        for (int k = 0; k < degree; k++) sum += s->t[d][i + k];
        s->knots[d][degree + i] = kind == AVERAGED ? sum / degree : s->t[d][i + (degree - 1) / 2];
    }
}

/* Knots at the parameters of a closed direction, on and on. */
static void place_closed(surface *s, int d, uint64_t *seed)
{
    pia_index n = s->count[d];
    int degree = s->degree[d];
    for (pia_index i = 0; i < n; i++) s->t[d][i] = ((double)i + 0.4 * (i > 0) * problem_random(seed)) / (double)n;
    for (pia_index k = -degree; k <= n + degree; k++) {
        pia_index turn = k < 0 ? -1 : k / n;
        s->knots[d][degree + k] = s->t[d][k - turn * n] + (double)turn;
    }
}

static void open_direction(surface *s, int d, placement kind, int closed, uint64_t *seed)
{
    pia_index n = s->count[d];
    int degree = s->degree[d];
    if (closed)
        place_closed(s, d, seed);
    else
        place(s, d, kind, seed);
    assert_ok(s->context,
              pia_collocation_open(s->context, degree, closed ? PIA_MAP_CYCLIC : PIA_MAP_IDENTITY, closed ? n - degree / 2 : 0,
                                   s->knots[d], closed ? n + degree : n, s->t[d], n, PIA_STORE_VALUES, &s->line[d]));
}

/* closed: bit d for direction d. */
static surface *open_placed(int degree, pia_index u, pia_index v, int dim, placement kind, int closed, int threads)
{
    surface *s = malloc(sizeof *s);
    assert_non_null(s);
    pia_context_options options;
    pia_context_options_init(&options);
    options.threads = threads;
    assert_ok(NULL, pia_context_create(&options, &s->context));
    s->degree[0] = s->degree[1] = degree;
    s->dim = dim;
    s->count[0] = u;
    s->count[1] = v;
    uint64_t seed = (uint64_t)(degree + 10 * dim);
    for (int d = 0; d < 2; d++) open_direction(s, d, kind, closed >> d & 1, &seed);
    for (pia_index i = 0; i < u * v * dim; i++) s->points[i] = 1000 + problem_random(&seed);
    for (int d = 0; d < dim; d++) s->origin[d] = 0;
    s->targets = (pia_targets){s->points, s->origin, dim};
    assert_ok(s->context, pia_op_grid_open(s->context, &s->line[0], &s->line[1], NULL, dim, &s->op));
    return s;
}

static surface *open_surface(int degree, pia_index u, pia_index v, int dim, int threads)
{
    return open_placed(degree, u, v, dim, AVERAGED, 0, threads);
}

static void close_surface(surface *s)
{
    pia_op_close(s->op);
    for (int d = 0; d < 2; d++) pia_collocation_close(s->context, &s->line[d]);
    pia_context_destroy(s->context);
    free(s);
}

static pia_index size_of(const surface *s)
{
    return s->count[0] * s->count[1] * s->dim;
}

/* The largest |points - A x| over the points, and its row. */
static double largest_error(surface *s, const double *x, pia_index *row)
{
    double worst = -1;
    pia_op_apply(s->op, x, s->dim, s->values);
    for (pia_index i = 0; i < s->count[0] * s->count[1]; i++) {
        double square = 0;
        for (int d = 0; d < s->dim; d++) square += pow(s->points[i * s->dim + d] - s->values[i * s->dim + d], 2);
        if (square <= worst) continue;
        worst = square;
        *row = i;
    }
    return sqrt(worst);
}

static const pia_index SIZES[][2] = {{8, 8}, {33, 9}, {9, 33}, {64, 32}, {37, 85}, {83, 35}, {21, 150}, {149, 18}};
enum { SIZE_COUNT = sizeof SIZES / sizeof *SIZES };

static void solving_lines_side_by_side_undoes_the_operator(void **state)
{
    (void)state;
    for (int degree = 1; degree <= 5; degree++)
        for (int k = 0; k < SIZE_COUNT; k++)
            for (int dim = 1; dim <= 3; dim++) {
                surface *s = open_surface(degree, SIZES[k][0], SIZES[k][1], dim, 2);
                pia_op_apply(s->op, s->points, dim, s->values);
                assert_ok(s->context, pia_square_solve(s->op, s->values, dim));
                for (pia_index i = 0; i < size_of(s); i++) assert_near(s->values[i], s->points[i], 1e-9);
                close_surface(s);
            }
}

static void check_step(int degree, const pia_index *count, int dim, placement kind, int closed, const pia_grid_solver *solver)
{
    surface *s = open_placed(degree, count[0], count[1], dim, kind, closed, dim == 1 ? 2 : 1);
    pia_step_errors errors;
    pia_index row;
    double moved = 0, size = 0;
    assert_int_equal(pia_square_grid_suits(s->op, dim), 1);
    assert_ok(s->context, pia_square_grid_step_with(solver, s->op, &s->targets, s->x, NULL, &errors));
    for (pia_index i = 0; i < count[0] * count[1]; i++) {
        double square = 0;
        for (int d = 0; d < dim; d++) square += pow(s->x[i * dim + d] - s->points[i * dim + d], 2);
        moved = fmax(moved, sqrt(square));
        size = fmax(size, fabs(s->x[i * dim]));
    }
    assert_near(errors.moved, moved, 1e-12 * size);
    assert_true(largest_error(s, s->x, &row) < 1e-13 * size && errors.after.max < 1e-13 * size);
    assert_int_equal(errors.after.count, count[0] * count[1]);
    assert_near(errors.before.max, largest_error(s, s->points, &row), 1e-11);
    assert_int_equal(errors.before.max_row, row);
    assert_int_equal(errors.before.count, count[0] * count[1]);
    close_surface(s);
}

static const pia_grid_solver *const solvers[] = {&pia_grid_by_four, &pia_grid_by_eight};

static int solver_count(void)
{
    return pia_has_wide() ? 2 : 1;
}

static void a_step_leads_to_the_interpolating_surface(void **state)
{
    (void)state;
    for (int solver = 0; solver < solver_count(); solver++)
        for (int degree = 1; degree <= 7; degree++)
            for (int k = 0; k < SIZE_COUNT; k++)
                for (int dim = 1; dim < MOST_DIM; dim += 1 + degree / 4)
                    check_step(degree, SIZES[k], dim, AVERAGED, 0, solvers[solver]);
}

static void knots_at_the_parameters_are_no_different(void **state)
{
    (void)state;
    for (int solver = 0; solver < solver_count(); solver++)
        for (int degree = 1; degree <= 7; degree += 2)
            for (int k = 0; k < SIZE_COUNT; k++)
                for (int dim = 1; dim <= 4; dim++) check_step(degree, SIZES[k], dim, AT_PARAMETERS, 0, solvers[solver]);
}

static void closed_directions_are_no_different(void **state)
{
    (void)state;
    static const pia_index sizes[][2] = {{17, 20}, {33, 19}, {64, 32}, {37, 85}, {21, 150}, {149, 18}};
    for (int solver = 0; solver < solver_count(); solver++)
        for (int degree = 1; degree <= 7; degree += 2)
            for (size_t k = 0; k < sizeof sizes / sizeof *sizes; k++)
                for (int dim = 1; dim <= 4; dim++)
                    for (int closed = 1; closed < 4; closed++) check_step(degree, sizes[k], dim, AVERAGED, closed, solvers[solver]);
}

static void wider_vectors_change_no_bit(void **state)
{
    (void)state;
    if (solver_count() < 2) return;
    for (int degree = 1; degree <= 7; degree++)
        for (int dim = 1; dim < MOST_DIM; dim++) {
            int odd = degree % 2 == 1;
            surface *s = open_placed(degree, 61, 147, dim, odd && dim % 2 == 1 ? AT_PARAMETERS : AVERAGED, odd ? dim % 4 : 0, 2);
            pia_step_errors errors, same;
            assert_ok(s->context, pia_square_grid_step_with(solvers[0], s->op, &s->targets, s->x, NULL, &errors));
            assert_ok(s->context, pia_square_grid_step_with(solvers[1], s->op, &s->targets, s->values, NULL, &same));
            assert_memory_equal(s->x, s->values, (size_t)size_of(s) * sizeof(double));
            assert_true(errors.before.sum_squares == same.before.sum_squares && errors.moved == same.moved);
            assert_true(errors.after.sum_squares == same.after.sum_squares && errors.after.max == same.after.max);
            assert_int_equal(errors.after.max_row, same.after.max_row);
            close_surface(s);
        }
}

static void errors_are_those_of_all_points(void **state)
{
    (void)state;
    surface *s = open_surface(3, 83, 150, 3, 2);
    pia_step_errors errors;
    double sum = 0;
    assert_ok(s->context, pia_square_grid_step(s->op, &s->targets, s->x, NULL, &errors));
    pia_op_apply(s->op, s->points, 3, s->values);
    for (pia_index i = 0; i < size_of(s); i++) sum += pow(s->points[i] - s->values[i], 2);
    assert_near(errors.before.sum_squares, sum, 1e-10 * sum);
    assert_true(errors.after.sum_squares <= pow(errors.after.max, 2) * (double)errors.after.count);
    close_surface(s);
}

static void what_the_step_sees_is_told(void **state)
{
    (void)state;
    surface *s = open_surface(3, 70, 61, 2, 2);
    pia_step_errors errors;
    pia_survey survey;
    double low = INFINITY, high = -INFINITY;
    for (pia_index i = 0; i < 70 * 61; i++) {
        low = fmin(low, s->points[2 * i + 1]);
        high = fmax(high, s->points[2 * i + 1]);
    }
    assert_ok(s->context, pia_square_grid_step(s->op, &s->targets, s->x, &survey, &errors));
    assert_true(survey.finite && survey.ordered && survey.low[1] == low && survey.high[1] == high);
    s->points[2 * 69 * 61] = NAN;
    assert_ok(s->context, pia_square_grid_step(s->op, &s->targets, s->x, &survey, &errors));
    assert_false(survey.finite);
    close_surface(s);
}

static void points_that_are_all_one_have_no_error(void **state)
{
    (void)state;
    surface *s = open_surface(3, 20, 30, 2, 2);
    pia_step_errors errors;
    for (pia_index i = 0; i < size_of(s); i++) s->points[i] = 7;
    assert_ok(s->context, pia_square_grid_step(s->op, &s->targets, s->x, NULL, &errors));
    assert_true(errors.after.max == 0 && errors.moved == 0);
    assert_int_equal(errors.after.max_row, 0);
    assert_int_equal(errors.before.max_row, 0);
    for (pia_index i = 0; i < size_of(s); i++) assert_true(s->x[i] == 7);
    close_surface(s);
}

static void the_number_of_threads_changes_no_bit(void **state)
{
    (void)state;
    static const int threads[] = {1, 2, 3, 8};
    for (int dim = 1; dim <= 3; dim += 2) {
        surface *first = open_surface(3, 83, 85, dim, 1);
        pia_step_errors first_errors, errors;
        assert_ok(first->context, pia_square_grid_step(first->op, &first->targets, first->x, NULL, &first_errors));
        for (size_t k = 0; k < sizeof threads / sizeof *threads; k++) {
            surface *s = open_surface(3, 83, 85, dim, threads[k]);
            assert_ok(s->context, pia_square_grid_step(s->op, &s->targets, s->x, NULL, &errors));
            assert_memory_equal(s->x, first->x, (size_t)size_of(s) * sizeof(double));
            assert_true(errors.before.sum_squares == first_errors.before.sum_squares && errors.moved == first_errors.moved);
            assert_true(errors.after.sum_squares == first_errors.after.sum_squares);
            assert_true(errors.after.max == first_errors.after.max && errors.after.max_row == first_errors.after.max_row);
            close_surface(s);
        }
        close_surface(first);
    }
}

static void knots_that_do_not_suit_are_refused(void **state)
{
    (void)state;
    surface *s = open_surface(3, 40, 40, 1, 2);
    pia_step_errors errors;
    pia_collocation_close(s->context, &s->line[1]);
    for (int i = 10; i < 16; i++) s->t[1][i] = s->t[1][16] - 1e-3 * (16 - i);
    assert_ok(s->context,
              pia_collocation_open(s->context, 3, PIA_MAP_IDENTITY, 0, s->knots[1], 40, s->t[1], 40, PIA_STORE_VALUES, &s->line[1]));
    assert_status(s->context, pia_square_grid_step(s->op, &s->targets, s->x, NULL, &errors), PIA_E_DATA);
    close_surface(s);
}

static void only_plain_grids_of_few_components_are_suited(void **state)
{
    (void)state;
    surface *s = open_surface(3, 20, 20, MOST_DIM, 1);
    assert_int_equal(pia_square_grid_suits(s->op, MOST_DIM), 0);
    assert_int_equal(pia_square_grid_suits(s->op, MOST_DIM - 1), 1);
    assert_ok(s->context, pia_op_freeze(s->op, 5, 1));
    assert_int_equal(pia_square_grid_suits(s->op, 1), 0);
    close_surface(s);
    s = open_placed(3, 15, 20, 1, AVERAGED, 1, 1);
    assert_int_equal(pia_square_grid_suits(s->op, 1), 0);
    close_surface(s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(solving_lines_side_by_side_undoes_the_operator),
        cmocka_unit_test(a_step_leads_to_the_interpolating_surface),
        cmocka_unit_test(knots_at_the_parameters_are_no_different),
        cmocka_unit_test(closed_directions_are_no_different),
        cmocka_unit_test(wider_vectors_change_no_bit),
        cmocka_unit_test(errors_are_those_of_all_points),
        cmocka_unit_test(what_the_step_sees_is_told),
        cmocka_unit_test(points_that_are_all_one_have_no_error),
        cmocka_unit_test(the_number_of_threads_changes_no_bit),
        cmocka_unit_test(knots_that_do_not_suit_are_refused),
        cmocka_unit_test(only_plain_grids_of_few_components_are_suited),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
