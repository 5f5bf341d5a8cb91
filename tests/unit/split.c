#include <math.h>

#include "../memory/failing.h"
#include "shapes.h"

static void the_halves_are_the_shape_on_their_part_of_the_domain(void **state)
{
    (void)state;
    for (int degree = 1; degree <= 8; degree++)
        for (int kind = 0; kind < 4; kind++) {
            pia_model *model = shape_curve(NULL, degree, degree + 11, 2, kind % 2, (uint64_t)degree), *left = NULL, *right = NULL;
            double value = kind < 2 ? 0.37 : pia_model_knots(model, 0)[degree + 4]; /* between knots, and at one */
            assert_ok(NULL, pia_model_split(NULL, model, 0, value, &left, &right));
            pia_model_info a, b;
            pia_model_get_info(left, &a);
            pia_model_get_info(right, &b);
            assert_true(a.domain[0][0] == 0 && a.domain[0][1] == value && b.domain[0][0] == value && b.domain[0][1] == 1);
            shape_assert_same(left, model, 40, 1e-14 * 4);
            shape_assert_same(right, model, 40, 1e-14 * 4);
            pia_model_destroy(model);
            pia_model_destroy(left);
            pia_model_destroy(right);
        }
}

static void surfaces_split_in_either_direction(void **state)
{
    (void)state;
    for (int direction = 0; direction < 2; direction++) {
        pia_model *model = shape_surface(NULL, 3, 2, 3, 1, 8), *left = NULL, *right = NULL;
        assert_ok(NULL, pia_model_split(NULL, model, direction, 0.61, &left, &right));
        shape_assert_same(left, model, 17, 1e-14);
        shape_assert_same(right, model, 17, 1e-14);
        pia_model_destroy(model);
        pia_model_destroy(left);
        pia_model_destroy(right);
    }
}

static void a_split_outside_the_domain_is_refused(void **state)
{
    (void)state;
    pia_model *model = shape_curve(NULL, 3, 9, 2, 0, 4), *left = NULL, *right = NULL;
    const double bad[] = {0, 1, -1, 2, NAN, 1e-320};
    for (int i = 0; i < 6; i++)
        assert_status(NULL, pia_model_split(NULL, model, 0, bad[i], &left, &right), i < 5 ? PIA_E_ARGUMENT : PIA_E_DATA);
    assert_status(NULL, pia_model_split(NULL, model, 1, 0.5, &left, &right), PIA_E_ARGUMENT);
    assert_status(NULL, pia_model_split(NULL, NULL, 0, 0.5, &left, &right), PIA_E_ARGUMENT);
    assert_status(NULL, pia_model_split(NULL, model, 0, 0.5, NULL, &right), PIA_E_ARGUMENT);
    assert_status(NULL, pia_model_split(NULL, model, 0, 0.5, &left, NULL), PIA_E_ARGUMENT);
    assert_null(left);
    assert_null(right);
    pia_model_destroy(model);
}

static pia_status split(pia_context *context, void *user)
{
    pia_model *left = NULL, *right = NULL;
    pia_status status = pia_model_split(context, user, 0, 0.5, &left, &right);
    pia_model_destroy(left);
    pia_model_destroy(right);
    return status;
}

static void splitting_survives_every_failed_allocation(void **state)
{
    (void)state;
    pia_model *model = shape_curve(NULL, 3, 10, 2, 0, 1);
    assert_survives_failures(split, model);
    pia_model_destroy(model);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_halves_are_the_shape_on_their_part_of_the_domain),
        cmocka_unit_test(surfaces_split_in_either_direction),
        cmocka_unit_test(a_split_outside_the_domain_is_refused),
        cmocka_unit_test(splitting_survives_every_failed_allocation),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
