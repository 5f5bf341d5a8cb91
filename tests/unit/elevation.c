#include <math.h>

#include "../memory/failing.h"
#include "shapes.h"

static void raised_curves_keep_their_shape(void **state)
{
    (void)state;
    for (int degree = 1; degree <= 7; degree++)
        for (int raise = 0; raise <= 3; raise++) {
            pia_model *model = shape_curve(NULL, degree, degree + 9, 3, raise % 2, (uint64_t)degree), *higher = NULL;
            assert_ok(NULL, pia_model_elevate(NULL, model, 0, raise, &higher));
            pia_model_info info;
            pia_model_get_info(higher, &info);
            assert_int_equal(info.degree[0], degree + raise);
            shape_assert_same(model, higher, 83, 3e-14);
            pia_model_destroy(model);
            pia_model_destroy(higher);
        }
}

static void the_highest_degree_is_reached_without_losing_digits(void **state)
{
    (void)state;
    pia_model *model = shape_curve(NULL, 3, 9, 2, 1, 4), *higher = NULL;
    assert_ok(NULL, pia_model_elevate(NULL, model, 0, 22, &higher));
    shape_assert_same(model, higher, 200, 5e-14);
    pia_model_destroy(model);
    pia_model_destroy(higher);
}

/* A Bezier curve: Q_i = i/(n+1) P_(i-1) + (1 - i/(n+1)) P_i. */
static void a_bezier_curve_is_raised_by_the_textbook_formula(void **state)
{
    (void)state;
    pia_model *model = shape_curve(NULL, 4, 5, 1, 0, 6), *higher = NULL;
    double p[5], q[6];
    assert_ok(NULL, pia_model_elevate(NULL, model, 0, 1, &higher));
    pia_model_control(model, p, NULL);
    pia_model_control(higher, q, NULL);
    for (int i = 0; i <= 5; i++) assert_near(q[i], (i > 0 ? i / 5.0 * p[i - 1] : 0) + (i < 5 ? (1 - i / 5.0) * p[i] : 0), 1e-15);
    pia_model_destroy(model);
    pia_model_destroy(higher);
}

static void surfaces_are_raised_in_one_direction(void **state)
{
    (void)state;
    for (int direction = 0; direction < 2; direction++) {
        pia_model *model = shape_surface(NULL, 2, 3, 3, direction, 8), *higher = NULL;
        assert_ok(NULL, pia_model_elevate(NULL, model, direction, 2, &higher));
        pia_model_info info;
        pia_model_get_info(higher, &info);
        assert_int_equal(info.degree[direction], 4 + direction);
        assert_int_equal(info.degree[1 - direction], 3 - direction);
        shape_assert_same(model, higher, 19, 2e-14);
        pia_model_destroy(model);
        pia_model_destroy(higher);
    }
}

static void impossible_raises_are_refused(void **state)
{
    (void)state;
    pia_model *model = shape_curve(NULL, 3, 9, 2, 0, 4), *out = NULL;
    assert_status(NULL, pia_model_elevate(NULL, model, 0, -1, &out), PIA_E_ARGUMENT);
    assert_status(NULL, pia_model_elevate(NULL, model, 0, 23, &out), PIA_E_ARGUMENT);
    assert_status(NULL, pia_model_elevate(NULL, model, 1, 1, &out), PIA_E_ARGUMENT);
    assert_status(NULL, pia_model_elevate(NULL, NULL, 0, 1, &out), PIA_E_ARGUMENT);
    assert_status(NULL, pia_model_elevate(NULL, model, 0, 1, NULL), PIA_E_ARGUMENT);
    assert_null(out);
    pia_model_destroy(model);
}

static pia_status raise_twice(pia_context *context, void *user)
{
    pia_model *out = NULL;
    pia_status status = pia_model_elevate(context, user, 0, 2, &out);
    pia_model_destroy(out);
    return status;
}

static void elevation_survives_every_failed_allocation(void **state)
{
    (void)state;
    pia_model *model = shape_curve(NULL, 3, 10, 2, 0, 1);
    assert_survives_failures(raise_twice, model);
    pia_model_destroy(model);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(raised_curves_keep_their_shape),
        cmocka_unit_test(the_highest_degree_is_reached_without_losing_digits),
        cmocka_unit_test(a_bezier_curve_is_raised_by_the_textbook_formula),
        cmocka_unit_test(surfaces_are_raised_in_one_direction),
        cmocka_unit_test(impossible_raises_are_refused),
        cmocka_unit_test(elevation_survives_every_failed_allocation),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
