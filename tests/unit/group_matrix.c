/* The matrix that method epia iterates with: the group means of the operator's rows, seen from inside a fit. */
#include <stdlib.h>

#include "check.h"
#include "fit.h"
#include "groups.h"

enum { COUNT = 90, ROWS = 14, COLUMNS = 17 };

static double random_number(uint64_t *seed)
{
    *seed = *seed * 6364136223846793005u + 1442695040888963407u;
    return (double)(*seed >> 11) * 0x1p-53;
}

static void random_walk(double *points, pia_index count, int dim, uint64_t seed)
{
    double at[4] = {0}, direction[4] = {1, 0.5, -0.3, 0.2};
    for (pia_index i = 0; i < count; i++)
        for (int d = 0; d < dim; d++) {
            direction[d] += random_number(&seed) - 0.5;
            at[d] += 0.3 * direction[d] + 0.05 * random_number(&seed);
            points[i * dim + d] = at[d];
        }
}

/* C [cols x cols] by unit vectors. */
static double *group_matrix(pia_fit *fit)
{
    pia_index n = fit->op->cols, m = fit->op->rows;
    double *matrix = malloc((size_t)(n * n) * sizeof *matrix), *unit = calloc((size_t)n, sizeof *unit);
    double *values = malloc((size_t)m * sizeof *values), *means = malloc((size_t)n * sizeof *means);
    for (pia_index c = 0; c < n; c++) {
        unit[c] = 1;
        pia_op_apply(fit->op, unit, 1, values);
        pia_groups_mean(fit->context, fit->iterate.groups, values, 1, 1, means);
        for (pia_index i = 0; i < n; i++) matrix[i * n + c] = means[i];
        unit[c] = 0;
    }
    free(unit);
    free(values);
    free(means);
    return matrix;
}

static double smallest_pivot(double *a, pia_index n)
{
    double smallest = INFINITY;
    for (pia_index k = 0; k < n; k++) {
        pia_index best = k;
        for (pia_index i = k + 1; i < n; i++)
            if (fabs(a[i * n + k]) > fabs(a[best * n + k])) best = i;
        smallest = fmin(smallest, fabs(a[best * n + k]));
        for (pia_index j = 0; j < n; j++) {
            double swap = a[k * n + j];
            a[k * n + j] = a[best * n + j];
            a[best * n + j] = swap;
        }
        for (pia_index i = k + 1; i < n && a[k * n + k] != 0; i++) {
            double factor = a[i * n + k] / a[k * n + k];
            for (pia_index j = k; j < n; j++) a[i * n + j] -= factor * a[k * n + j];
        }
    }
    return smallest;
}

static void check_matrix(pia_context *context, const pia_data *data, const pia_fit_options *options)
{
    pia_fit *fit;
    assert_ok(context, pia_fit_open(context, data, options, &fit));
    assert_int_equal(pia_groups_empty(fit->iterate.groups), 0);
    pia_index n = fit->op->cols;
    double *matrix = group_matrix(fit);
    for (pia_index i = 0; i < n; i++) {
        double sum = 0;
        for (pia_index j = 0; j < n; j++) {
            assert_true(matrix[i * n + j] >= 0);
            sum += matrix[i * n + j];
        }
        assert_near(sum, 1, 1e-12);
    }
    assert_true(smallest_pivot(matrix, n) > 1e-9);
    free(matrix);
    pia_fit_close(fit);
}

static void a_curve_has_no_empty_group_and_no_singular_matrix(void **state)
{
    static const char *const rules[][2] = {
        {"fence=printed", "ends=keep"}, {"fence=balanced", "ends=keep"}, {"fence=printed", "ends=free"}};
    (void)state;
    pia_context *context;
    assert_ok(NULL, pia_context_create(NULL, &context));
    for (uint64_t seed = 1; seed <= 20; seed++)
        for (int degree = 1; degree <= 7; degree++)
            for (size_t r = 0; r < sizeof rules / sizeof *rules; r++) {
                double points[3 * COUNT];
                pia_index meet[6];
                uint64_t more = seed;
                pia_data data;
                pia_fit_options options;
                random_walk(points, COUNT, 3, seed);
                for (int k = 0; k < 6; k++) meet[k] = (pia_index)(random_number(&more) * COUNT);
                pia_data_init(&data);
                data.points = points;
                data.count[0] = COUNT;
                data.dim = 3;
                pia_fit_options_init(&options);
                options.method = "epia";
                options.degree[0] = degree;
                options.method_options = rules[r];
                options.method_option_count = 2;
                check_matrix(context, &data, &options);
                options.interpolate = meet;
                options.interpolate_count = r == 0 ? 1 : 6;
                if (seed % 4 == 0 && r == 0) check_matrix(context, &data, &options);
            }
    pia_context_destroy(context);
}

static void a_patch_has_no_empty_group_and_no_singular_matrix(void **state)
{
    (void)state;
    pia_context *context;
    assert_ok(NULL, pia_context_create(NULL, &context));
    for (uint64_t seed = 1; seed <= 6; seed++) {
        double points[3 * ROWS * COLUMNS];
        uint64_t more = seed;
        pia_data data;
        pia_fit_options options;
        for (int i = 0; i < ROWS; i++)
            for (int j = 0; j < COLUMNS; j++) {
                double *p = points + (i * COLUMNS + j) * 3;
                p[0] = i + 0.3 * random_number(&more);
                p[1] = j + 0.3 * random_number(&more);
                p[2] = 2 * random_number(&more);
            }
        pia_data_init(&data);
        data.kind = PIA_GRID;
        data.points = points;
        data.count[0] = ROWS;
        data.count[1] = COLUMNS;
        data.dim = 3;
        pia_fit_options_init(&options);
        options.method = "epia";
        check_matrix(context, &data, &options);
    }
    pia_context_destroy(context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_curve_has_no_empty_group_and_no_singular_matrix),
        cmocka_unit_test(a_patch_has_no_empty_group_and_no_singular_matrix),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
