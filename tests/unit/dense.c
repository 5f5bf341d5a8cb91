#include "dense.h"
#include "check.h"

#include <lapacke.h>
#include <stdlib.h>

enum { ROOM = 30, DIM = 4 };

static void fill(double *a, int count)
{
    for (int i = 0; i < count; i++) a[i] = 2 * (rand() / (double)RAND_MAX) - 1;
}

/* s = g g' with g [n x rank]. */
static void semidefinite(int n, int rank, double *s)
{
    double g[ROOM * ROOM];
    fill(g, n * rank);
    for (int i = 0; i < n; i++)
        for (int j = 0; j < n; j++) {
            s[i * n + j] = 0;
            for (int k = 0; k < rank; k++) s[i * n + j] += g[i * rank + k] * g[j * rank + k];
        }
}

static void cholesky_solves_like_lapack(void **state)
{
    (void)state;
    double s[ROOM * ROOM], copy[ROOM * ROOM], b[ROOM * DIM], expected[ROOM * DIM], scratch[ROOM * DIM];
    pia_index order[ROOM];
    lapack_int pivot[ROOM];
    for (int n = 1; n <= ROOM; n++)
        for (int dim = 1; dim <= DIM; dim++) {
            semidefinite(n, n, s);
            for (int i = 0; i < n; i++) s[i * n + i] += 1 + i % 5;
            memcpy(copy, s, sizeof s);
            fill(b, n * dim);
            memcpy(expected, b, sizeof b);
            assert_int_equal(LAPACKE_dgesv(LAPACK_ROW_MAJOR, n, dim, copy, n, pivot, expected, dim), 0);
            assert_int_equal(pia_dense_cholesky(s, n, 1e-14, order), n);
            pia_dense_cholesky_solve(s, n, n, order, b, dim, scratch);
            for (int i = 0; i < n * dim; i++) assert_near(b[i], expected[i], 1e-12);
        }
}

static void cholesky_finds_the_rank_and_solves_what_is_consistent(void **state)
{
    (void)state;
    double s[ROOM * ROOM], factor[ROOM * ROOM], x[ROOM], b[ROOM], scratch[ROOM];
    pia_index order[ROOM];
    for (int n = 2; n <= ROOM; n++)
        for (int rank = 1; rank < n; rank += 3) {
            semidefinite(n, rank, s);
            memcpy(factor, s, sizeof s);
            fill(x, n);
            for (int i = 0; i < n; i++) {
                b[i] = 0;
                for (int j = 0; j < n; j++) b[i] += s[i * n + j] * x[j];
            }
            double expected[ROOM];
            memcpy(expected, b, sizeof b);
            assert_int_equal(pia_dense_cholesky(factor, n, 1e-10, order), rank);
            pia_dense_cholesky_solve(factor, n, rank, order, b, 1, scratch);
            for (int i = 0; i < n; i++) {
                double sum = 0;
                for (int j = 0; j < n; j++) sum += s[i * n + j] * b[j];
                assert_near(sum, expected[i], 1e-8);
            }
        }
    memset(s, 0, sizeof s);
    assert_int_equal(pia_dense_cholesky(s, 4, 1e-10, order), 0);
    s[0] = NAN;
    assert_int_equal(pia_dense_cholesky(s, 1, 1e-10, order), 0);
}

static void lu_solves_like_lapack_and_knows_singular_matrices(void **state)
{
    (void)state;
    double a[ROOM * ROOM], copy[ROOM * ROOM], b[ROOM * DIM], expected[ROOM * DIM];
    pia_index order[ROOM];
    lapack_int pivot[ROOM];
    for (int n = 1; n <= ROOM; n++)
        for (int dim = 1; dim <= DIM; dim++) {
            fill(a, n * n);
            memcpy(copy, a, sizeof a);
            fill(b, n * dim);
            memcpy(expected, b, sizeof b);
            assert_int_equal(LAPACKE_dgesv(LAPACK_ROW_MAJOR, n, dim, copy, n, pivot, expected, dim), 0);
            assert_true(pia_dense_lu(a, n, order));
            pia_dense_lu_solve(a, n, order, b, dim);
            for (int i = 0; i < n * dim; i++) assert_near(b[i], expected[i], 1e-10 * (1 + fabs(expected[i])));
        }
    double singular[] = {1, 2, 2, 4}, empty[] = {NAN};
    assert_false(pia_dense_lu(singular, 2, order));
    assert_false(pia_dense_lu(empty, 1, order));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(cholesky_solves_like_lapack),
        cmocka_unit_test(cholesky_finds_the_rank_and_solves_what_is_consistent),
        cmocka_unit_test(lu_solves_like_lapack_and_knows_singular_matrices),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
