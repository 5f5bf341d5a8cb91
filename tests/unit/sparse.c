/* Sparse Cholesky against dense elimination. */
#include "sparse.h"

#include "problems.h"

enum { N = 60 };

/* A band with wrapped corners; entries at one place in two parts. */
static pia_triplets wrapped_band(double diagonal, pia_index *row, pia_index *column, double *value, double *dense)
{
    pia_triplets t = {.n = N, .row = row, .column = column, .value = value};
    memset(dense, 0, N * N * sizeof *dense);
    for (pia_index i = 0; i < N; i++)
        for (pia_index k = 0; k < 6; k++) {
            pia_index j = (i + (k > 2 ? k - 2 : 0)) % N;
            double x = k > 2 ? 0.1 * (double)(k - 1) : diagonal / 3;
            row[t.count] = i > j ? i : j;
            column[t.count] = i > j ? j : i;
            value[t.count++] = x;
            dense[i * N + j] += x;
            if (i != j) dense[j * N + i] += x;
        }
    return t;
}

static void solutions_are_those_of_dense_elimination(void **state)
{
    (void)state;
    pia_context *context = NULL;
    pia_index row[6 * N], column[6 * N], weak = -1;
    double value[6 * N], dense[N * N];
    assert_ok(NULL, pia_context_create(NULL, &context));
    pia_triplets t = wrapped_band(3, row, column, value, dense);
    pia_sparse *sparse;
    assert_ok(context, pia_sparse_factor(context, &t, 1e-12, &sparse, &weak));
    assert_int_equal(weak, 0);
    for (int dim = 1; dim <= 4; dim++) {
        double b[N * 4], expected[N * 4], copy[N * N];
        for (int i = 0; i < N * dim; i++) b[i] = expected[i] = sin(i);
        memcpy(copy, dense, sizeof copy);
        problem_solve(copy, N, expected, dim);
        pia_sparse_solve(sparse, b, dim);
        for (int i = 0; i < N * dim; i++) assert_near(b[i], expected[i], 1e-13);
    }
    pia_sparse_close(sparse);
    pia_context_destroy(context);
}

static void a_singular_matrix_is_known_by_its_pivots(void **state)
{
    (void)state;
    pia_context *context = NULL;
    pia_index row[] = {0, 1, 1, 2}, column[] = {0, 0, 1, 2}, weak = 0;
    double value[] = {1, 1, 1, 1};
    pia_triplets t = {3, 4, row, column, value};
    assert_ok(NULL, pia_context_create(NULL, &context));
    pia_sparse *sparse = NULL;
    assert_ok(context, pia_sparse_factor(context, &t, 1e-12, &sparse, &weak));
    assert_int_equal(weak, 1);
    pia_sparse_close(sparse);
    value[2] += 1e-14;
    assert_ok(context, pia_sparse_factor(context, &t, 1e-12, &sparse, &weak));
    assert_int_equal(weak, 1);
    pia_sparse_close(sparse);
    pia_context_destroy(context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(solutions_are_those_of_dense_elimination),
        cmocka_unit_test(a_singular_matrix_is_known_by_its_pivots),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
