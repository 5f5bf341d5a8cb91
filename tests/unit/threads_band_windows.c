/* Bands solved in windows, against the factor of the whole, which knows no windows. */
#include "../memory/failing.h"
#include "band.h"
#include "context.h"
#include "problems.h"

enum { MOST = 13001, WIDTH = 9, DIM = 4 };

static double h[MOST * (WIDTH + 1)], factor[MOST * (WIDTH + 1)], border[(MOST + WIDTH) * WIDTH];
static double b[MOST * DIM], x[MOST * DIM], same[MOST * DIM], expected[MOST * DIM];

/* Diagonally dominant: the inverse decays by a half a row at least. Entries past the last column are no numbers, where it does not
 * wrap. */
static pia_band_system make(pia_index n, int width, int dim, int wraps)
{
    uint64_t seed = (uint64_t)(n + width);
    for (pia_index i = 0; i < n; i++)
        for (int k = 0; k <= width; k++)
            h[i * (width + 1) + k] = k == 0 ? 4 * width + 1 : !wraps && i + k >= n ? NAN : 2 * problem_random(&seed) - 1;
    for (pia_index i = 0; i < n * dim; i++) b[i] = problem_random(&seed);
    return (pia_band_system){h, b, n, width, dim, wraps, 1e-13};
}

static void solve_whole(const pia_band_system *s)
{
    memcpy(factor, h, sizeof(double) * (size_t)(s->n * (s->width + 1)));
    memcpy(expected, b, sizeof(double) * (size_t)(s->n * s->dim));
    if (s->wraps) {
        assert_int_equal(pia_band_cyclic_factor(factor, s->n, s->width, 0, border), 0);
        pia_band_cyclic_solve(factor, border, s->n, s->width, expected, s->dim);
    } else {
        assert_int_equal(pia_band_ldl_factor(factor, s->n, s->width, 0, NULL, 0), 0);
        pia_band_ldl_solve(factor, s->n, s->width, expected, s->dim);
    }
}

static pia_context *with_threads(int threads)
{
    pia_context *context = NULL;
    pia_context_options options;
    pia_context_options_init(&options);
    options.threads = threads;
    assert_ok(NULL, pia_context_create(&options, &context));
    return context;
}

static void windows_solve_like_the_factor_of_the_whole(void **state)
{
    (void)state;
    const pia_index sizes[] = {4096, 5003, MOST};
    pia_context *context = with_threads(2);
    for (int k = 0; k < 3; k++)
        for (int width = 1; width <= WIDTH; width++)
            for (int wraps = 0; wraps < 2; wraps++) {
                int dim = 1 + (width + k) % DIM, done = 0;
                pia_band_system s = make(sizes[k], width, dim, wraps);
                assert_true(pia_band_windows_suit(s.n, width));
                solve_whole(&s);
                memset(x, 0xff, sizeof x);
                assert_ok(context, pia_band_windows_solve(context, &s, x, &done));
                assert_true(done);
                for (pia_index i = 0; i < s.n * dim; i++) assert_near(x[i], expected[i], 1e-15);
            }
    pia_context_destroy(context);
}

static void threads_change_no_bit(void **state)
{
    (void)state;
    pia_context *one = with_threads(1), *five = with_threads(5);
    int done = 0;
    pia_band_system s = make(MOST, 3, 3, 1);
    assert_ok(one, pia_band_windows_solve(one, &s, x, &done));
    assert_ok(five, pia_band_windows_solve(five, &s, same, &done));
    assert_memory_equal(x, same, sizeof(double) * MOST * 3);
    pia_context_destroy(one);
    pia_context_destroy(five);
}

static void a_weak_pivot_anywhere_is_told(void **state)
{
    (void)state;
    const pia_index rows[] = {0, 1023, 5000, MOST - 1};
    pia_context *context = with_threads(2);
    for (int k = 0; k < 4; k++)
        for (int nan = 0; nan < 2; nan++) {
            int done = 1;
            pia_band_system s = make(MOST, 2, 1, 0);
            h[rows[k] * 3] = nan ? NAN : 0;
            assert_ok(context, pia_band_windows_solve(context, &s, x, &done));
            assert_false(done);
        }
    pia_context_destroy(context);
}

static void small_and_wide_bands_do_not_suit(void **state)
{
    (void)state;
    assert_false(pia_band_windows_suit(4095, 3));
    assert_false(pia_band_windows_suit(100000, 10));
    assert_false(pia_band_windows_suit(100000, 0));
}

static pia_status solve(pia_context *context, void *user)
{
    int done;
    return pia_band_windows_solve(context, user, x, &done);
}

static void memory_that_is_short_is_told(void **state)
{
    (void)state;
    pia_band_system s = make(4096, 3, 2, 0);
    assert_survives_failures(solve, &s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(windows_solve_like_the_factor_of_the_whole),
        cmocka_unit_test(threads_change_no_bit),
        cmocka_unit_test(a_weak_pivot_anywhere_is_told),
        cmocka_unit_test(small_and_wide_bands_do_not_suit),
        cmocka_unit_test(memory_that_is_short_is_told),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
