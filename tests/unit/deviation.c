#include "deviation.h"
#include "check.h"
#include "select.h"

#include <stdlib.h>

enum { COUNT = 100000 };

static int compare(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static void selection_agrees_with_sorting(void **state)
{
    (void)state;
    double values[200], sorted[200], work[200];
    srand(3);
    for (int run = 0; run < 300; run++) {
        int count = 1 + rand() % 200, different = 1 + rand() % 300;
        for (int i = 0; i < count; i++) values[i] = run % 3 == 0 ? i : run % 3 == 1 ? -i : rand() % different;
        memcpy(sorted, values, sizeof values);
        qsort(sorted, (size_t)count, sizeof *sorted, compare);
        for (int rank = 0; rank < count; rank += 1 + count / 9) {
            memcpy(work, values, sizeof values);
            assert_true(pia_select(work, count, rank) == sorted[rank]);
            for (int i = 0; i < count; i++) assert_true(i < rank ? work[i] <= sorted[rank] : work[i] >= sorted[rank]);
        }
    }
}

static void statistics_are_those_of_the_definition(void **state)
{
    (void)state;
    static double distances[COUNT], sorted[COUNT];
    long double sum = 0;
    srand(4);
    for (int i = 0; i < COUNT; i++) sorted[i] = distances[i] = rand() / (double)RAND_MAX;
    distances[777] = sorted[777] = distances[90000] = sorted[90000] = 2;
    for (int i = 0; i < COUNT; i++) sum += (long double)distances[i] * distances[i];
    qsort(sorted, COUNT, sizeof *sorted, compare);
    pia_deviation out;
    assert_ok(NULL, pia_deviation_summarize(NULL, distances, COUNT, &out));
    assert_true(out.max_error == 2 && out.max_error_index == 777);
    assert_near(out.rms_error, (double)sqrtl(sum / COUNT), 1e-15);
    assert_true(out.percentile[0] == sorted[COUNT / 2 - 1]);
    assert_true(out.percentile[1] == sorted[COUNT / 10 * 9 - 1]);
    assert_true(out.percentile[2] == sorted[COUNT / 100 * 99 - 1]);
    assert_int_equal(out.point_count, COUNT);
}

static void percentiles_of_few_points_are_points(void **state)
{
    (void)state;
    double one[] = {3}, three[] = {3, 1, 2};
    pia_deviation out;
    assert_ok(NULL, pia_deviation_summarize(NULL, one, 1, &out));
    assert_true(out.max_error == 3 && out.rms_error == 3 && out.percentile[0] == 3 && out.percentile[2] == 3);
    assert_ok(NULL, pia_deviation_summarize(NULL, three, 3, &out));
    assert_true(out.percentile[0] == 2 && out.percentile[1] == 3 && out.percentile[2] == 3);
}

static void tiny_and_huge_distances_keep_their_rms(void **state)
{
    (void)state;
    const double scales[] = {0, 1e-320, 1e-200, 1, 1e200, 1e307};
    for (int s = 0; s < 6; s++) {
        double distances[] = {3 * scales[s], 4 * scales[s], 0, 0};
        pia_deviation out;
        assert_ok(NULL, pia_deviation_summarize(NULL, distances, 4, &out));
        assert_near(out.rms_error, 2.5 * scales[s], 1e-15 * scales[s] + 1e-323);
        assert_true(out.max_error == 4 * scales[s]);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(selection_agrees_with_sorting),
        cmocka_unit_test(statistics_are_those_of_the_definition),
        cmocka_unit_test(percentiles_of_few_points_are_points),
        cmocka_unit_test(tiny_and_huge_distances_keep_their_rms),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
