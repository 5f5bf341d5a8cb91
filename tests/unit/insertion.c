#include <math.h>

#include "../memory/failing.h"
#include "shapes.h"

static void inserted_knots_leave_the_shape_alone(void **state)
{
    (void)state;
    for (int degree = 1; degree <= 9; degree++)
        for (int rational = 0; rational <= 1; rational++) {
            pia_model *model = shape_curve(NULL, degree, degree + 9, 3, rational, (uint64_t)degree), *finer = NULL;
            const double values[] = {0.1, 0.33, 0.5, 0.50001, 0.9};
            assert_ok(NULL, pia_model_insert_knots(NULL, model, 0, values, 5, &finer));
            pia_model_info info;
            pia_model_get_info(finer, &info);
            assert_int_equal(info.control[0], degree + 14);
            shape_assert_same(model, finer, 97, 2e-14);
            pia_model_destroy(model);
            pia_model_destroy(finer);
        }
}

static void high_degrees_stay_accurate_through_many_insertions(void **state)
{
    (void)state;
    const int degrees[] = {15, 25};
    for (int k = 0; k < 2; k++) {
        pia_model *model = shape_curve(NULL, degrees[k], degrees[k] + 7, 2, 0, 3), *finer = NULL;
        double values[200];
        for (int i = 0; i < 200; i++) values[i] = (i + 0.5) / 200;
        assert_ok(NULL, pia_model_insert_knots(NULL, model, 0, values, 200, &finer));
        shape_assert_same(model, finer, 301, 2e-14);
        pia_model_destroy(model);
        pia_model_destroy(finer);
    }
}

/* Boehm's formula for one knot, from The NURBS Book, Eq. 5.15. */
static void one_knot_follows_boehm(void **state)
{
    (void)state;
    for (int degree = 1; degree <= 6; degree++) {
        const int control = 12;
        pia_model *model = shape_curve(NULL, degree, control, 1, 0, (uint64_t)degree), *finer = NULL;
        const double *knots = pia_model_knots(model, 0), value = 0.41;
        double old[12], new[13];
        assert_ok(NULL, pia_model_insert_knots(NULL, model, 0, &value, 1, &finer));
        pia_model_control(model, old, NULL);
        pia_model_control(finer, new, NULL);
        int span = degree;
        while (knots[span + 1] <= value) span++;
        for (int i = 0; i <= control; i++) {
            double a = i <= span - degree ? 1 : i > span ? 0 : (value - knots[i]) / (knots[i + degree] - knots[i]);
            double expected = a == 1 ? old[i] : a == 0 ? old[i - 1] : a * old[i] + (1 - a) * old[i - 1];
            assert_near(new[i], expected, a == 0 || a == 1 ? 0 : 1e-15 * 4);
        }
        pia_model_destroy(model);
        pia_model_destroy(finer);
    }
}

static void surfaces_take_knots_in_either_direction(void **state)
{
    (void)state;
    for (int direction = 0; direction < 2; direction++)
        for (int rational = 0; rational <= 1; rational++) {
            pia_model *model = shape_surface(NULL, 3, 2, 3, rational, 8), *finer = NULL;
            const double values[] = {0.2, 0.2, 0.7};
            assert_ok(NULL, pia_model_insert_knots(NULL, model, direction, values, 3, &finer));
            shape_assert_same(model, finer, 23, 1e-14);
            pia_model_destroy(model);
            pia_model_destroy(finer);
        }
}

static void no_knots_make_an_equal_model(void **state)
{
    (void)state;
    pia_model *model = shape_curve(NULL, 3, 10, 2, 0, 1), *same = NULL;
    assert_ok(NULL, pia_model_insert_knots(NULL, model, 0, NULL, 0, &same));
    double a[20], b[20];
    pia_model_control(model, a, NULL);
    pia_model_control(same, b, NULL);
    assert_memory_equal(a, b, sizeof a);
    pia_model_destroy(model);
    pia_model_destroy(same);
}

static void bad_insertions_are_refused(void **state)
{
    (void)state;
    pia_context *context = NULL;
    assert_ok(NULL, pia_context_create(NULL, &context));
    pia_model *model = shape_curve(context, 3, 10, 2, 0, 1), *out = NULL;
    const double full[] = {0.5, 0.5, 0.5, 0.5}, falling[] = {0.5, 0.4}, end = 1, outside = 1.5, nan = NAN;
    assert_status(context, pia_model_insert_knots(context, model, 0, full, 4, &out), PIA_E_DATA);
    assert_status(context, pia_model_insert_knots(context, model, 0, falling, 2, &out), PIA_E_DATA);
    assert_status(context, pia_model_insert_knots(context, model, 0, &end, 1, &out), PIA_E_DATA);
    assert_status(context, pia_model_insert_knots(context, model, 0, &outside, 1, &out), PIA_E_DATA);
    assert_status(context, pia_model_insert_knots(context, model, 0, &nan, 1, &out), PIA_E_DATA);
    assert_status(context, pia_model_insert_knots(context, model, 1, full, 1, &out), PIA_E_ARGUMENT);
    assert_status(context, pia_model_insert_knots(context, model, -1, full, 1, &out), PIA_E_ARGUMENT);
    assert_status(context, pia_model_insert_knots(context, NULL, 0, full, 1, &out), PIA_E_ARGUMENT);
    assert_status(context, pia_model_insert_knots(context, model, 0, NULL, 1, &out), PIA_E_ARGUMENT);
    assert_status(context, pia_model_insert_knots(context, model, 0, full, -1, &out), PIA_E_ARGUMENT);
    assert_status(context, pia_model_insert_knots(context, model, 0, full, 1, NULL), PIA_E_ARGUMENT);
    assert_null(out);
    pia_model_destroy(model);
    pia_context_destroy(context);
}

static pia_status insert(pia_context *context, void *user)
{
    pia_model *out = NULL;
    const double value = 0.5;
    pia_status status = pia_model_insert_knots(context, user, 0, &value, 1, &out);
    pia_model_destroy(out);
    return status;
}

static void insertion_survives_every_failed_allocation(void **state)
{
    (void)state;
    pia_model *model = shape_curve(NULL, 3, 10, 2, 0, 1);
    assert_survives_failures(insert, model);
    pia_model_destroy(model);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(inserted_knots_leave_the_shape_alone),
        cmocka_unit_test(high_degrees_stay_accurate_through_many_insertions),
        cmocka_unit_test(one_knot_follows_boehm),
        cmocka_unit_test(surfaces_take_knots_in_either_direction),
        cmocka_unit_test(no_knots_make_an_equal_model),
        cmocka_unit_test(bad_insertions_are_refused),
        cmocka_unit_test(insertion_survives_every_failed_allocation),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
