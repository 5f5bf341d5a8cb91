#include "deviation.h"
#include "check.h"
#include "select.h"
#include "shapes.h"

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

/* Points set off from a curve by known amounts, at parameters and at closest points. */
static void a_model_is_measured_at_parameters_and_at_closest_points(void **state)
{
    (void)state;
    enum { POINTS = 101 };
    const double knots[] = {0, 0, 1, 1}, line[] = {0, 0, 0, 10, 0, 0}, *const vectors[] = {knots};
    const int degree = 1;
    const pia_index control = 2;
    double points[POINTS * 3], parameters[POINTS], distances[POINTS];
    pia_model *model = NULL;
    assert_ok(NULL, pia_model_create(NULL, 1, &degree, vectors, &control, 3, line, NULL, &model));
    for (int i = 0; i < POINTS; i++) {
        parameters[i] = i / 100.0;
        points[3 * i] = 10 * parameters[i] + (i % 2 ? 0.4 : 0);
        points[3 * i + 1] = i == 100 ? 0 : 0.3;
        points[3 * i + 2] = i == 100 ? 7 : 0;
    }
    pia_deviation out;
    assert_ok(NULL, pia_model_deviation(NULL, model, points, POINTS, parameters, &out, distances));
    for (int i = 0; i < 100; i++) assert_near(distances[i], i % 2 ? 0.5 : 0.3, 1e-14);
    assert_true(out.max_error == 7 && out.max_error_index == 100 && out.foot_points == 0);
    assert_near(out.percentile[0], 0.5, 1e-14);
    assert_ok(NULL, pia_model_deviation(NULL, model, points, POINTS, NULL, &out, distances));
    for (int i = 0; i < 95; i++) assert_near(distances[i], 0.3, 1e-12);
    assert_true(out.max_error == 7 && out.foot_points == 1);
    assert_near(out.percentile[0], 0.3, 1e-12);
    pia_model_destroy(model);
}

static void points_of_a_surface_do_not_deviate(void **state)
{
    (void)state;
    enum { POINTS = 50 };
    double parameters[2 * POINTS], points[3 * POINTS];
    uint64_t seed = 1;
    pia_model *model = shape_surface(NULL, 3, 2, 3, 1, 4);
    for (int i = 0; i < 2 * POINTS; i++) parameters[i] = shape_random(&seed);
    assert_ok(NULL, pia_model_eval(NULL, model, parameters, POINTS, 0, points));
    pia_deviation out;
    assert_ok(NULL, pia_model_deviation(NULL, model, points, POINTS, parameters, &out, NULL));
    assert_true(out.max_error == 0 && out.rms_error == 0);
    assert_ok(NULL, pia_model_deviation(NULL, model, points, POINTS, NULL, &out, NULL));
    assert_near(out.max_error, 0, 1e-6);
    pia_model_destroy(model);
}

static void what_cannot_be_measured_is_refused(void **state)
{
    (void)state;
    double points[] = {0, 0, 1, NAN}, huge[] = {1.5e308, 1.5e308}, parameters[] = {0, INFINITY};
    pia_model *model = shape_curve(NULL, 3, 8, 2, 0, 2);
    pia_deviation out = {.max_error = 5};
    assert_status(NULL, pia_model_deviation(NULL, NULL, points, 1, NULL, &out, NULL), PIA_E_ARGUMENT);
    assert_status(NULL, pia_model_deviation(NULL, model, points, 1, NULL, NULL, NULL), PIA_E_ARGUMENT);
    assert_status(NULL, pia_model_deviation(NULL, model, NULL, 1, NULL, &out, NULL), PIA_E_ARGUMENT);
    assert_status(NULL, pia_model_deviation(NULL, model, points, 0, NULL, &out, NULL), PIA_E_DATA);
    assert_status(NULL, pia_model_deviation(NULL, model, points, -1, NULL, &out, NULL), PIA_E_ARGUMENT);
    assert_status(NULL, pia_model_deviation(NULL, model, points, 2, NULL, &out, NULL), PIA_E_DATA);
    assert_status(NULL, pia_model_deviation(NULL, model, points, 1, parameters + 1, &out, NULL), PIA_E_DATA);
    assert_status(NULL, pia_model_deviation(NULL, model, huge, 1, parameters, &out, NULL), PIA_E_DATA);
    assert_status(NULL, pia_model_deviation(NULL, model, points, INT64_MAX / 2, NULL, &out, NULL), PIA_E_SIZE);
    assert_true(out.max_error == 5);
    pia_model_destroy(model);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(selection_agrees_with_sorting),
        cmocka_unit_test(statistics_are_those_of_the_definition),
        cmocka_unit_test(percentiles_of_few_points_are_points),
        cmocka_unit_test(tiny_and_huge_distances_keep_their_rms),
        cmocka_unit_test(a_model_is_measured_at_parameters_and_at_closest_points),
        cmocka_unit_test(points_of_a_surface_do_not_deviate),
        cmocka_unit_test(what_cannot_be_measured_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
