/* Grids that are taken in pieces: more columns and rows a span than fit side by side. */
#include "basis.h"
#include "normal.h"
#include "problems.h"

enum { U = 45, V = 2101, CONTROL_U = 6, CONTROL_V = 40 };

typedef struct sample {
    double t[U + V], knots[2][60], points[3 * U * V], values[3 * U * V], control[3 * CONTROL_U * CONTROL_V],
        right[3 * CONTROL_U * CONTROL_V], origin[3];
    pia_collocation line[2];
    pia_targets targets;
    pia_op *op;
    pia_context *context;
} sample;

static void clamped(double *knots, int degree, pia_index control)
{
    for (pia_index i = 0; i < control + degree + 1; i++) {
        double inner = (double)(i - degree) / (double)(control - degree);
        knots[i] = inner < 0 ? 0 : inner > 1 ? 1 : inner;
    }
}

static void make(sample *s, int degree, int dim)
{
    const pia_index count[2] = {U, V}, control[2] = {CONTROL_U, CONTROL_V};
    uint64_t seed = (uint64_t)(degree + 10 * dim);
    pia_context_options options;
    pia_context_options_init(&options);
    options.threads = 2;
    assert_ok(NULL, pia_context_create(&options, &s->context));
    for (int d = 0; d < 2; d++) {
        double *t = s->t + d * U;
        for (pia_index i = 0; i < count[d]; i++) t[i] = (double)i / (double)(count[d] - 1);
        clamped(s->knots[d], degree, control[d]);
        assert_ok(s->context, pia_collocation_open(s->context, degree, PIA_MAP_IDENTITY, 0, s->knots[d], control[d], t, count[d],
                                                   PIA_STORE_VALUES, &s->line[d]));
    }
    for (int i = 0; i < dim * U * V; i++) s->points[i] = problem_random(&seed) - 0.5;
    for (int i = 0; i < dim * CONTROL_U * CONTROL_V; i++) s->control[i] = problem_random(&seed);
    for (int d = 0; d < dim; d++) s->origin[d] = 0.25 * d;
    s->targets = (pia_targets){s->points, s->origin, dim};
    assert_ok(s->context, pia_op_grid_open(s->context, &s->line[0], &s->line[1], NULL, dim, &s->op));
}

static void release(sample *s)
{
    pia_op_close(s->op);
    for (int d = 0; d < 2; d++) pia_collocation_close(s->context, &s->line[d]);
    pia_context_destroy(s->context);
}

/* Component d of the surface at data point (i, j), by the sum of its definition. */
static double surface(const sample *s, int degree, int dim, int i, int j, int d)
{
    double u[PIA_MAX_DEGREE + 1], v[PIA_MAX_DEGREE + 1], sum = 0;
    pia_index a = pia_collocation_span(&s->line[0], i), b = pia_collocation_span(&s->line[1], j);
    pia_basis_values(s->knots[0], degree, a, s->t[i], u);
    pia_basis_values(s->knots[1], degree, b, s->t[U + j], v);
    for (int k = 0; k <= degree; k++)
        for (int l = 0; l <= degree; l++) sum += u[k] * v[l] * s->control[((a - degree + k) * CONTROL_V + b - degree + l) * dim + d];
    return sum;
}

static void check_errors(sample *s, int degree, int dim, int holes)
{
    double sum = 0, worst = -1;
    pia_index at = -1, count = 0;
    double *out = malloc(sizeof *out * (size_t)(dim * U * V));
    pia_op_apply(s->op, s->control, dim, s->values);
    pia_errors with = pia_op_residual(s->op, s->control, &s->targets, out);
    pia_errors without = pia_op_residual(s->op, s->control, &s->targets, NULL);
    for (int i = 0; i < U; i++)
        for (int j = 0; j < V; j++) {
            double square = 0;
            for (int d = 0; d < dim; d++) {
                pia_index k = (pia_index)(i * V + j) * dim + d;
                double expected = surface(s, degree, dim, i, j, d), difference = s->points[k] - s->origin[d] - expected;
                assert_near(s->values[k], expected, 1e-14);
                assert_near(out[k], isnan(s->points[k - d]) ? 0 : difference, 1e-14);
                square += difference * difference;
            }
            if (isnan(square)) continue;
            count++;
            sum += square;
            at = square > worst ? i * V + j : at;
            worst = fmax(worst, square);
        }
    assert_int_equal(with.count, count);
    assert_int_equal(count, U * V - holes);
    assert_int_equal(with.max_row, at);
    assert_near(with.max, sqrt(worst), 1e-14);
    assert_near(with.sum_squares, sum, 1e-12 * sum);
    assert_near(with.weighted, sum, 1e-12 * sum);
    assert_memory_equal(&with, &without, sizeof with);
    free(out);
}

static void check(int degree, int dim)
{
    static sample s;
    pia_normal *normal;
    make(&s, degree, dim);
    check_errors(&s, degree, dim, 0);
    assert_ok(s.context, pia_normal_open(s.op, &s.targets, &normal));
    assert_string_equal(normal->class->name, "kronecker");
    for (int i = 0; i < dim * U * V; i++) s.values[i] = s.points[i] - s.origin[i % dim];
    pia_op_gather(s.op, s.values, NULL, dim, s.right);
    for (int i = 0; i < dim * CONTROL_U * CONTROL_V; i++) assert_near(normal->right[i], s.right[i], 1e-12 * V);
    pia_normal_close(normal);
    for (int k = 0; k < 5; k++)
        for (int d = 0; d < dim; d++) s.points[(V * k * 9 + 700 * k % V) * dim + d] = NAN;
    check_errors(&s, degree, dim, 5);
    release(&s);
}

static void sums_and_errors_of_wide_grids_are_those_of_their_definition(void **state)
{
    (void)state;
    for (int degree = 2; degree <= 4; degree++)
        for (int dim = 1; dim <= 3; dim++) check(degree, dim);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(sums_and_errors_of_wide_grids_are_those_of_their_definition)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
