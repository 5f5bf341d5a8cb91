/* Group means and agreements of curves, grids and scattered rows against plain sums over lists of members. */
#include "groups.h"

#include <stdlib.h>

#include "check.h"
#include "context.h"

enum { ROWS = 30, COLUMNS = 20, DIM = 3 };

static double random_number(uint64_t *seed)
{
    *seed = *seed * 6364136223846793005u + 1442695040888963407u;
    return (double)(*seed >> 11) * 0x1p-53 - 0.5;
}

/* member[row] is the group of a row, or -1. */
static void expect(const pia_groups *groups, const int *member, pia_index rows)
{
    pia_index count = groups->count[0] * groups->count[1], empty = 0;
    double *values = malloc((size_t)(rows * DIM) * sizeof *values), *means = malloc((size_t)(count * DIM) * sizeof *means);
    double *agreement = malloc((size_t)count * sizeof *agreement);
    uint64_t seed = 5;
    for (pia_index i = 0; i < rows * DIM; i++) values[i] = random_number(&seed);
    pia_groups_mean(NULL, groups, values, DIM, 0.5, means);
    pia_groups_agreement(NULL, groups, values, DIM, agreement);
    for (pia_index c = 0; c < count; c++) {
        double sum[DIM] = {0}, lengths = 0, square = 0;
        pia_index found = 0;
        for (pia_index r = 0; r < rows; r++) {
            double length = 0;
            if (member[r] != c) continue;
            found++;
            for (int d = 0; d < DIM; d++) {
                sum[d] += values[r * DIM + d];
                length += values[r * DIM + d] * values[r * DIM + d];
            }
            lengths += sqrt(length);
        }
        for (int d = 0; d < DIM; d++) {
            square += sum[d] * sum[d];
            assert_near(means[c * DIM + d], found > 0 ? 0.5 * sum[d] / (double)found : 0, 1e-14);
        }
        assert_near(agreement[c], found > 1 ? sqrt(square) / lengths : 1, 1e-14);
        empty += found == 0;
    }
    assert_int_equal(pia_groups_empty(groups), empty);
    free(values);
    free(means);
    free(agreement);
}

static void lines_of_a_curve(void **state)
{
    (void)state;
    const pia_index begin[] = {0, 1, 8, 9, 20}, end[] = {1, 7, 9, 20, 30}, zero = 0, one = 1;
    pia_groups groups = {.count = {5, 1}, .rows = ROWS, .lines = 1, .begin = {begin, &zero}, .end = {end, &one}};
    int member[ROWS];
    for (int r = 0; r < ROWS; r++) {
        member[r] = -1;
        for (int c = 0; c < 5; c++)
            if (begin[c] <= r && r < end[c]) member[r] = c;
    }
    expect(&groups, member, ROWS);
}

static void blocks_of_a_grid(void **state)
{
    (void)state;
    const pia_index u[] = {0, 4, 11, ROWS}, v[] = {0, 1, 6, 19, COLUMNS};
    pia_groups groups = {.count = {3, 4}, .rows = ROWS * COLUMNS, .lines = COLUMNS, .begin = {u, v}, .end = {u + 1, v + 1}};
    int member[ROWS * COLUMNS];
    for (int i = 0; i < ROWS; i++)
        for (int j = 0; j < COLUMNS; j++) {
            int a = i < 4 ? 0 : i < 11 ? 1 : 2, b = j < 1 ? 0 : j < 6 ? 1 : j < 19 ? 2 : 3;
            member[i * COLUMNS + j] = 4 * a + b;
        }
    expect(&groups, member, ROWS * COLUMNS);
}

static void lists_of_scattered_rows(void **state)
{
    (void)state;
    const pia_index start[] = {0, 3, 3, 7, 10}, row[] = {2, 5, 9, 0, 1, 4, 8, 3, 6, 7};
    pia_groups groups = {.count = {2, 2}, .rows = 10, .start = start, .row = row};
    int member[10];
    for (int c = 0; c < 4; c++)
        for (pia_index k = start[c]; k < start[c + 1]; k++) member[row[k]] = c;
    expect(&groups, member, 10);
}

static void means_have_the_same_bits_for_any_number_of_threads(void **state)
{
    (void)state;
    enum { MANY = 300000, GROUPS = 700 };
    double *values = malloc(MANY * sizeof *values), *one = malloc(GROUPS * sizeof *one), *more = malloc(GROUPS * sizeof *more);
    pia_index bound[GROUPS + 1], zero = 0, unit = 1;
    uint64_t seed = 9;
    for (int i = 0; i < MANY; i++) values[i] = random_number(&seed);
    for (pia_index c = 0; c <= GROUPS; c++) bound[c] = MANY * c * c / GROUPS / GROUPS;
    pia_groups groups = {.count = {GROUPS, 1}, .rows = MANY, .lines = 1, .begin = {bound, &zero}, .end = {bound + 1, &unit}};
    pia_context *context;
    assert_ok(NULL, pia_context_create(NULL, &context));
    assert_ok(context, pia_context_set_threads(context, 1));
    pia_groups_mean(context, &groups, values, 1, 1, one);
    for (int threads = 2; threads <= 8; threads++) {
        assert_ok(context, pia_context_set_threads(context, threads));
        pia_groups_mean(context, &groups, values, 1, 1, more);
        assert_memory_equal(one, more, GROUPS * sizeof *one);
    }
    pia_context_destroy(context);
    free(values);
    free(one);
    free(more);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lines_of_a_curve),
        cmocka_unit_test(blocks_of_a_grid),
        cmocka_unit_test(lists_of_scattered_rows),
        cmocka_unit_test(means_have_the_same_bits_for_any_number_of_threads),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
