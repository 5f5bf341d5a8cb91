/* Band solvers against LAPACK's dense ones. */
#include "band.h"
#include "basis.h"
#include "check.h"

#include <lapacke.h>
#include <stdlib.h>

enum { DIM = 5, ROOM = 120 };

static double random_number(void)
{
    return 2 * (rand() / (double)RAND_MAX) - 1;
}

static void fill(double *a, int count)
{
    for (int i = 0; i < count; i++) a[i] = random_number();
}

static void solve_dense(const double *a, int n, double *b, int dim)
{
    static double copy[ROOM * ROOM];
    lapack_int pivot[ROOM];
    memcpy(copy, a, (size_t)(n * n) * sizeof *a);
    assert_int_equal(LAPACKE_dgesv(LAPACK_ROW_MAJOR, n, dim, copy, n, pivot, b, dim), 0);
}

static void assert_same(const double *actual, const double *expected, int count, double tolerance)
{
    for (int i = 0; i < count; i++) assert_near(actual[i], expected[i], tolerance);
}

/* A diagonally dominant symmetric band in both storages; cyclic when wrap is set. */
static void symmetric_band(int n, int width, int wrap, double *h, double *dense)
{
    memset(dense, 0, sizeof(double) * (size_t)(n * n));
    for (int i = 0; i < n; i++)
        for (int k = 0; k <= width; k++) {
            double value = k == 0 ? 2 * width + 1 : random_number();
            h[i * (width + 1) + k] = value;
            if (i + k < n || wrap) dense[i * n + (i + k) % n] = dense[(i + k) % n * n + i] = value;
        }
}

static void ldl_solves_like_lapack_for_every_width_and_dimension(void **state)
{
    (void)state;
    static double h[ROOM * 30], dense[ROOM * ROOM], b[ROOM * DIM], expected[ROOM * DIM];
    for (int width = 0; width <= 25; width++)
        for (int dim = 1; dim <= DIM; dim++)
            for (int n = 1; n <= 60; n += 1 + n / 3) {
                symmetric_band(n, width, 0, h, dense);
                for (int i = 0; i < n; i++)
                    for (int k = 0; k <= width; k++)
                        if (i + k >= n) h[i * (width + 1) + k] = NAN;
                fill(b, n * dim);
                memcpy(expected, b, sizeof b);
                solve_dense(dense, n, expected, dim);
                assert_int_equal(pia_band_ldl_factor(h, n, width, 1e-14, NULL, 0), 0);
                pia_band_ldl_solve(h, n, width, b, dim);
                assert_same(b, expected, n * dim, 1e-13);
            }
}

static void ldl_decouples_weak_rows_and_names_them(void **state)
{
    (void)state;
    /* Unknown 2 is held by nothing, unknowns 4 and 5 only by their sum. */
    double h[] = {2, 1, 2, 0, 0, 0, 2, 1, 3, 3, 3, 0, 1, 0};
    double b[] = {3, 3, 7, 6, 8, 6, 5};
    pia_index weak[2] = {-1, -1};
    assert_int_equal(pia_band_ldl_factor(h, 7, 1, 1e-12, weak, 2), 2);
    assert_int_equal(weak[0], 2);
    pia_band_ldl_solve(h, 7, 1, b, 1);
    for (int i = 0; i < 7; i++) assert_true(isfinite(b[i]));
    assert_near(b[0], 1, 1e-15);
    assert_near(b[1], 1, 1e-15);
    assert_true(b[2] == 0);
    assert_near(b[6], 5, 1e-15);
    double nothing[] = {NAN, 0, -1, 0, 0, 0};
    assert_int_equal(pia_band_ldl_factor(nothing, 3, 1, 1e-12, weak, 1), 3);
}

static void cyclic_bands_solve_like_lapack(void **state)
{
    (void)state;
    static double h[ROOM * 30], dense[ROOM * ROOM], b[ROOM * DIM], expected[ROOM * DIM], border[ROOM * 60];
    for (int width = 0; width <= 12; width++)
        for (int dim = 1; dim <= DIM; dim++)
            for (int n = 2 * width + 1; n <= 60; n += 1 + n / 2) {
                symmetric_band(n, width, 1, h, dense);
                fill(b, n * dim);
                memcpy(expected, b, sizeof b);
                solve_dense(dense, n, expected, dim);
                assert_int_equal(pia_band_cyclic_factor(h, n, width, 1e-14, border), 0);
                pia_band_cyclic_solve(h, border, n, width, b, dim);
                assert_same(b, expected, n * dim, 1e-13);
            }
}

static void a_singular_cyclic_band_stays_bounded(void **state)
{
    (void)state;
    double h[20], b[10], border[11];
    for (int i = 0; i < 10; i++) h[2 * i] = 2, h[2 * i + 1] = -1, b[i] = i % 2 ? 1 : -1;
    assert_int_equal(pia_band_cyclic_factor(h, 10, 1, 1e-12, border), 1);
    pia_band_cyclic_solve(h, border, 10, 1, b, 1);
    for (int i = 0; i < 10; i++) assert_near(fabs(b[i] - b[(i + 1) % 10]), 0.5, 1e-13);
}

/* Totally positive rows like those of a spline: Gaussian bumps around the diagonal. */
static void collocation(int n, int width, double *a, pia_index *first, double *dense)
{
    memset(dense, 0, sizeof(double) * (size_t)(n * n));
    for (int i = 0; i < n; i++) {
        int begin = i - width / 2 + (i % 3 == 0 && width > 2);
        begin = begin < 0 ? 0 : begin + width > n ? n - width : begin;
        first[i] = begin;
        for (int k = 0; k < width; k++) {
            double off = begin + k - i + 0.2 * random_number();
            a[i * width + k] = dense[i * n + begin + k] = exp(-off * off);
        }
    }
}

typedef struct stored_rows {
    const double *a;
    const pia_index *first;
    int width;
} stored_rows;

static void give_rows(void *work, pia_index begin, pia_index end, pia_index *first, double *a)
{
    const stored_rows *rows = work;
    memcpy(first, rows->first + begin, (size_t)(end - begin) * sizeof *first);
    memcpy(a, rows->a + begin * rows->width, (size_t)((end - begin) * rows->width) * sizeof *a);
}

static void lu_solves_like_lapack_stored_streamed_and_transposed(void **state)
{
    (void)state;
    static double a[ROOM * 30], dense[ROOM * ROOM], transposed[ROOM * ROOM], b[ROOM * DIM], streamed[ROOM * DIM], expected[ROOM * DIM];
    pia_index first[ROOM];
    for (int width = 1; width <= 26; width++)
        for (int dim = 1; dim <= DIM; dim++)
            for (int n = width; n <= 110; n += 1 + n) {
                collocation(n, width, a, first, dense);
                fill(b, n * dim);
                memcpy(expected, b, sizeof b);
                memcpy(streamed, b, sizeof b);
                solve_dense(dense, n, expected, dim);
                pia_band_lu lu;
                assert_ok(NULL, pia_band_lu_factor(NULL, a, first, n, width, &lu));
                assert_true(lu.smallest > 0.01 && lu.smallest <= 1);
                pia_band_lu_solve(&lu, b, dim);
                assert_same(b, expected, n * dim, 1e-11);
                stored_rows rows = {a, first, width};
                assert_ok(NULL, pia_band_lu_stream(NULL, give_rows, &rows, n, width, streamed, dim));
                assert_same(streamed, expected, n * dim, 1e-11);
                for (int i = 0; i < n; i++)
                    for (int j = 0; j < n; j++) transposed[j * n + i] = dense[i * n + j];
                memcpy(expected, b, sizeof b);
                solve_dense(transposed, n, expected, dim);
                pia_band_lu_solve_transposed(&lu, b, dim);
                assert_same(b, expected, n * dim, 1e-11);
                pia_band_lu_clear(NULL, &lu);
            }
}

static void lu_counts_only_entries_that_are_not_zero(void **state)
{
    (void)state;
    const double a[] = {1, 0, 0, 0, 0.2, 0.6, 0.2, 0, 0, 0.2, 0.6, 0.2, 0, 0, 0, 1};
    const pia_index first[] = {0, 0, 0, 0};
    pia_band_lu lu;
    assert_ok(NULL, pia_band_lu_factor(NULL, a, first, 4, 4, &lu));
    assert_int_equal(lu.lower, 1);
    assert_int_equal(lu.upper, 1);
    pia_band_lu_clear(NULL, &lu);
}

static void t_peer_31_t_peer_42_t_peer_43_a_vanishing_pivot_is_a_named_error(void **state)
{
    (void)state;
    const double equal_rows[] = {1, 0, 0.3, 0.7, 0.3, 0.7, 0, 1}, hole[] = {1, 0, 1, 0, 0, 1};
    const pia_index first[] = {0, 1, 1, 2}, missing[] = {0, 0, 1};
    double b[] = {1, 2, 3, 4};
    pia_band_lu lu;
    assert_status(NULL, pia_band_lu_factor(NULL, equal_rows, first, 4, 2, &lu), PIA_E_DATA);
    assert_null(lu.entry);
    assert_status(NULL, pia_band_lu_factor(NULL, hole, missing, 3, 2, &lu), PIA_E_DATA);
    stored_rows rows = {equal_rows, first, 2};
    assert_status(NULL, pia_band_lu_stream(NULL, give_rows, &rows, 4, 2, b, 1), PIA_E_DATA);
    rows = (stored_rows){hole, missing, 2};
    assert_status(NULL, pia_band_lu_stream(NULL, give_rows, &rows, 3, 2, b, 1), PIA_E_DATA);
    const double nan_row[] = {1, 0, NAN, 1, 0, 1};
    rows = (stored_rows){nan_row, missing, 2};
    assert_status(NULL, pia_band_lu_stream(NULL, give_rows, &rows, 3, 2, b, 1), PIA_E_DATA);
    assert_status(NULL, pia_band_lu_stream(NULL, give_rows, &rows, 3, 27, b, 1), PIA_E_ARGUMENT);
    assert_status(NULL, pia_band_lu_stream(NULL, give_rows, &rows, INT64_MAX / 2, 26, b, 1), PIA_E_SIZE);
}

static void pivoted_lu_solves_like_lapack_for_every_band(void **state)
{
    (void)state;
    static double a[ROOM * 30], dense[ROOM * ROOM], b[ROOM * DIM], expected[ROOM * DIM];
    for (int lower = 0; lower <= 8; lower++)
        for (int upper = 0; upper <= 8; upper++)
            for (int n = 1; n <= 50; n += 1 + n) {
                int row = lower + 1 + upper, dim = 1 + (lower + upper) % DIM;
                memset(dense, 0, sizeof dense);
                for (int i = 0; i < n; i++)
                    for (int k = 0; k < row; k++) {
                        int j = i + k - lower, inside = j >= 0 && j < n;
                        a[i * row + k] = inside ? random_number() : NAN;
                        if (j == i) a[i * row + k] += lower == 0 || upper == 0 ? 3 : 0; /* triangular ones grow quickly */
                        if (inside) dense[i * n + j] = a[i * row + k];
                    }
                fill(b, n * dim);
                memcpy(expected, b, sizeof b);
                solve_dense(dense, n, expected, dim);
                pia_band_plu lu;
                assert_ok(NULL, pia_band_plu_factor(NULL, a, n, lower, upper, &lu));
                pia_band_plu_solve(&lu, b, dim);
                for (int i = 0; i < n * dim; i++) assert_near(b[i], expected[i], 1e-9 * (1 + fabs(expected[i])));
                pia_band_plu_clear(NULL, &lu);
            }
}

static void pivoted_lu_solves_a_saddle_point_and_refuses_a_singular_one(void **state)
{
    (void)state;
    /* [0 1; 1 0] needs the exchange; two equal columns have no single solution. */
    const double saddle[] = {0, 0, 1, 1, 0, 0}, singular[] = {0, 1, 1, 1, 1, 0};
    double b[] = {5, 7};
    pia_band_plu lu;
    assert_ok(NULL, pia_band_plu_factor(NULL, saddle, 2, 1, 1, &lu));
    pia_band_plu_solve(&lu, b, 1);
    assert_true(b[0] == 7 && b[1] == 5);
    pia_band_plu_clear(NULL, &lu);
    assert_status(NULL, pia_band_plu_factor(NULL, singular, 2, 1, 1, &lu), PIA_E_DATA);
    assert_null(lu.entry);
    assert_status(NULL, pia_band_plu_factor(NULL, saddle, INT64_MAX / 2, 1, 1, &lu), PIA_E_SIZE);
}

/* Rows of random bumps, a few a column, sorted by first; also as a dense matrix. */
static int overdetermined(int columns, int width, int each, double *a, pia_index *first, double *dense)
{
    int rows = 0;
    for (int begin = 0; begin + width <= columns; begin++)
        for (int e = 0; e < each; e++, rows++) {
            first[rows] = begin;
            fill(a + rows * width, width);
            for (int j = 0; j < columns; j++)
                dense[rows * columns + j] = j >= begin && j < begin + width ? a[rows * width + j - begin] : 0;
        }
    return rows;
}

static void qr_gives_the_least_squares_solution_of_lapack(void **state)
{
    (void)state;
    enum { ROWS = 200 };
    static double a[ROWS * 26], dense[ROWS * 60], b[ROWS * DIM], expected[ROWS * DIM], x[60 * DIM];
    pia_index first[ROWS];
    for (int width = 1; width <= 26; width += 3)
        for (int dim = 1; dim <= DIM; dim++) {
            int columns = width + 30, rows = overdetermined(columns, width, 1 + (width + 30) / 20, a, first, dense);
            fill(b, rows * dim);
            memcpy(expected, b, sizeof b);
            assert_int_equal(LAPACKE_dgels(LAPACK_ROW_MAJOR, 'N', rows, columns, dim, dense, columns, expected, dim), 0);
            pia_band_qr qr;
            assert_ok(NULL, pia_band_qr_open(NULL, columns, width, dim, &qr));
            for (int i = 0; i < rows; i++) pia_band_qr_add(&qr, first[i], a + i * width, b + i * dim);
            assert_int_equal(pia_band_qr_solve(&qr, 1e-14, x), 0);
            for (int i = 0; i < columns * dim; i++) assert_near(x[i], expected[i], 1e-9 * (1 + fabs(expected[i])));
            pia_band_qr_close(NULL, &qr);
        }
}

/* Columns 0..3 are held, column 4 by nothing, of columns 5 and 6 only the sum. What is given for 4 and for one of the pair stays, the
 * rest is exact for it. */
static void qr_keeps_what_nothing_holds_and_fits_the_rest_to_it(void **state)
{
    (void)state;
    double rows[][3] = {{2, 1, 0}, {1, 2, 1}, {0, 1, 2}, {0, 2, 0}, {0, 1, 1}, {0, 2, 2}, {0, 1, 1}};
    const pia_index first[] = {0, 1, 1, 2, 4, 4, 4};
    double right[] = {4, 8, 8, 6, 11, 22, 11}, x[] = {9, 9, 9, 9, 42, 5, 9};
    pia_band_qr qr;
    assert_ok(NULL, pia_band_qr_open(NULL, 7, 3, 1, &qr));
    for (int i = 0; i < 7; i++) pia_band_qr_add(&qr, first[i], rows[i], right + i);
    assert_int_equal(pia_band_qr_solve(&qr, 1e-12, x), 2);
    assert_true(x[4] == 42);
    assert_near(x[5] + x[6], 11, 1e-14);
    assert_near(2 * x[0] + x[1], 4, 1e-14);
    assert_near(2 * x[3], 6, 1e-14);
    pia_band_qr_close(NULL, &qr);
}

/* Columns 0 and 1 are seen as their sum only; the rows that show column 2 must not be lost with the weak one of the two. */
static void qr_turns_the_rows_of_weak_columns_into_the_others(void **state)
{
    (void)state;
    double rows[][3] = {{1, 1, 0}, {1, 1, 1e-3}, {1, 1, 2e-3}, {1, 0, 0}}, right[] = {3, 3.005, 3.01, 7};
    const pia_index first[] = {0, 0, 0, 3};
    pia_band_qr qr;
    assert_ok(NULL, pia_band_qr_open(NULL, 6, 3, 1, &qr));
    double y[] = {1, 0, 0, 0, 0, 0};
    for (int i = 0; i < 4; i++) pia_band_qr_add(&qr, first[i], rows[i], right + i);
    assert_int_equal(pia_band_qr_solve(&qr, 1e-12, y), 3);
    assert_near(y[0] + y[1], 3, 1e-12);
    assert_near(y[2], 5, 1e-9);
    assert_near(y[3], 7, 1e-14);
    pia_band_qr_close(NULL, &qr);
    assert_status(NULL, pia_band_qr_open(NULL, INT64_MAX / 2, 3, 1, &qr), PIA_E_SIZE);
}

/* Where the Gram matrix has a condition number of 1e11 and more, rows keep their digits. */
static void qr_fits_degree_25_to_rounding(void **state)
{
    (void)state;
    enum { DEGREE = 25, WIDTH = 26, COLUMNS = 40, ROWS = 400 };
    static double knots[COLUMNS + WIDTH], a[ROWS][WIDTH], values[ROWS], x[COLUMNS];
    pia_index first[ROWS];
    for (int i = 0; i < COLUMNS + WIDTH; i++) knots[i] = fmin(fmax((i - DEGREE) / (double)(COLUMNS - DEGREE), 0), 1);
    pia_band_qr qr;
    assert_ok(NULL, pia_band_qr_open(NULL, COLUMNS, WIDTH, 1, &qr));
    for (int i = 0; i < ROWS; i++) {
        double t = i / (ROWS - 1.0), row[WIDTH], right;
        int span = DEGREE + (int)fmin(floor(t * (COLUMNS - DEGREE)), COLUMNS - DEGREE - 1);
        pia_basis_values(knots, DEGREE, span, t, a[i]);
        first[i] = span - DEGREE;
        memcpy(row, a[i], sizeof row);
        right = values[i] = cos(5 * t);
        pia_band_qr_add(&qr, first[i], row, &right);
    }
    assert_int_equal(pia_band_qr_solve(&qr, 1e-14, x), 0);
    for (int i = 0; i < ROWS; i++) {
        double sum = 0;
        for (int k = 0; k < WIDTH; k++) sum += a[i][k] * x[first[i] + k];
        assert_near(sum, values[i], 1e-13);
    }
    pia_band_qr_close(NULL, &qr);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ldl_solves_like_lapack_for_every_width_and_dimension),
        cmocka_unit_test(ldl_decouples_weak_rows_and_names_them),
        cmocka_unit_test(cyclic_bands_solve_like_lapack),
        cmocka_unit_test(a_singular_cyclic_band_stays_bounded),
        cmocka_unit_test(lu_solves_like_lapack_stored_streamed_and_transposed),
        cmocka_unit_test(lu_counts_only_entries_that_are_not_zero),
        cmocka_unit_test(t_peer_31_t_peer_42_t_peer_43_a_vanishing_pivot_is_a_named_error),
        cmocka_unit_test(pivoted_lu_solves_like_lapack_for_every_band),
        cmocka_unit_test(pivoted_lu_solves_a_saddle_point_and_refuses_a_singular_one),
        cmocka_unit_test(qr_gives_the_least_squares_solution_of_lapack),
        cmocka_unit_test(qr_fits_degree_25_to_rounding),
        cmocka_unit_test(qr_keeps_what_nothing_holds_and_fits_the_rest_to_it),
        cmocka_unit_test(qr_turns_the_rows_of_weak_columns_into_the_others),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
