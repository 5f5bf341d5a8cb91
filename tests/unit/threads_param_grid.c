/* Parameters of grids whose lines are taken in many chunks. */
#include "check.h"
#include "param.h"

#include <stdlib.h>

enum { ROWS = 301, COLUMNS = 411, DIM = 3 };

static double *make_points(int holes)
{
    double *points = malloc(sizeof(double) * ROWS * COLUMNS * DIM);
    assert_non_null(points);
    for (int i = 0; i < ROWS; i++)
        for (int j = 0; j < COLUMNS; j++) {
            double *p = points + (i * COLUMNS + j) * DIM;
            p[0] = pow(i, 1.2);
            p[1] = 2 * j + sin(j);
            p[2] = sin(1e-2 * i * j);
            if (holes && (7 * i + 3 * j) % 50 == 0) p[2] = NAN;
        }
    return points;
}

static void compute(const double *points, int threads, double *u, double *v)
{
    const pia_index count[] = {ROWS, COLUMNS};
    const int degree[] = {3, 3}, open[] = {0, 0};
    pia_context *context;
    pia_context_options options;
    pia_context_options_init(&options);
    options.threads = threads;
    assert_ok(NULL, pia_context_create(&options, &context));
    assert_ok(context, pia_param_grid(context, pia_param_find("chord"), points, count, DIM, degree, open, u, v));
    pia_context_destroy(context);
}

static double distance(const double *points, int i, int j, int m, int n)
{
    double square = 0;
    for (int d = 0; d < DIM; d++) square += pow(points[(i * COLUMNS + j) * DIM + d] - points[(m * COLUMNS + n) * DIM + d], 2);
    return sqrt(square);
}

/* [2004] Eq. (12), (13). */
static void chunks_of_lines_add_up_to_the_mean(void **state)
{
    (void)state;
    static double u[ROWS], v[COLUMNS], expected[COLUMNS];
    double *points = make_points(0);
    compute(points, 2, u, v);
    for (int i = 0; i < ROWS; i++) {
        double sum = 0, t = 0;
        for (int j = 1; j < COLUMNS; j++) sum += distance(points, i, j, i, j - 1);
        for (int j = 1; j < COLUMNS; j++) expected[j] += (t += distance(points, i, j, i, j - 1) / sum) / ROWS;
    }
    for (int j = 0; j < COLUMNS; j++) assert_near(v[j], expected[j], 1e-13);
    memset(expected, 0, sizeof expected);
    for (int j = 0; j < COLUMNS; j++) {
        double sum = 0, t = 0;
        for (int i = 1; i < ROWS; i++) sum += distance(points, i, j, i - 1, j);
        for (int i = 1; i < ROWS; i++) expected[i] += (t += distance(points, i, j, i - 1, j) / sum) / COLUMNS;
    }
    for (int i = 0; i < ROWS; i++) assert_near(u[i], expected[i], 1e-13);
    free(points);
}

static void the_number_of_threads_changes_no_bit(void **state)
{
    (void)state;
    static double u[ROWS], v[COLUMNS], same_u[ROWS], same_v[COLUMNS];
    for (int holes = 0; holes < 2; holes++) {
        double *points = make_points(holes);
        compute(points, 1, u, v);
        for (int threads = 2; threads <= 8; threads *= 2) {
            compute(points, threads, same_u, same_v);
            assert_memory_equal(u, same_u, sizeof u);
            assert_memory_equal(v, same_v, sizeof v);
        }
        free(points);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(chunks_of_lines_add_up_to_the_mean),
        cmocka_unit_test(the_number_of_threads_changes_no_bit),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
