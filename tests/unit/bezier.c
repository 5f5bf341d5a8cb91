#include <math.h>

#include "../memory/failing.h"
#include "shapes.h"

static double bernstein(int degree, int k, double t)
{
    double value = pow(t, k) * pow(1 - t, degree - k);
    for (int i = 1; i <= k; i++) value *= (double)(degree - k + i) / i;
    return value;
}

static void pieces_of_a_curve_are_bezier_curves(void **state)
{
    (void)state;
    for (int degree = 1; degree <= 8; degree++) {
        const int control = degree + 10;
        pia_model *model = shape_curve(NULL, degree, control, 2, 0, (uint64_t)degree), *pieces = NULL;
        assert_ok(NULL, pia_model_bezier(NULL, model, &pieces));
        pia_model_info info;
        pia_model_get_info(pieces, &info);
        const double *knots = pia_model_knots(pieces, 0);
        double points[300];
        assert_true(info.control[0] * 2 <= 300 && (info.control[0] - 1) % degree == 0);
        pia_model_control(pieces, points, NULL);
        for (pia_index piece = 0; piece < (info.control[0] - 1) / degree; piece++) {
            double low = knots[piece * degree + 1], high = knots[(piece + 1) * degree + 1];
            for (int i = 0; i <= 10; i++) {
                double t = low + (high - low) * i / 10, out[2], expected[2] = {0, 0};
                assert_ok(NULL, pia_model_eval(NULL, model, &t, 1, 0, out));
                for (int k = 0; k <= degree; k++)
                    for (int c = 0; c < 2; c++) expected[c] += bernstein(degree, k, i / 10.0) * points[(piece * degree + k) * 2 + c];
                for (int c = 0; c < 2; c++) assert_near(out[c], expected[c], 1e-13);
            }
        }
        pia_model_destroy(model);
        pia_model_destroy(pieces);
    }
}

static void rational_curves_and_surfaces_keep_their_shape_in_pieces(void **state)
{
    (void)state;
    pia_model *curve = shape_curve(NULL, 25, 31, 3, 1, 2), *surface = shape_surface(NULL, 3, 4, 3, 1, 3), *pieces = NULL;
    assert_ok(NULL, pia_model_bezier(NULL, curve, &pieces));
    shape_assert_same(curve, pieces, 101, 3e-14);
    pia_model_destroy(pieces);
    assert_ok(NULL, pia_model_bezier(NULL, surface, &pieces));
    pia_model_info info;
    pia_model_get_info(pieces, &info);
    assert_int_equal((info.control[0] - 1) % 3, 0);
    assert_int_equal((info.control[1] - 1) % 4, 0);
    shape_assert_same(surface, pieces, 21, 2e-14);
    pia_model_destroy(pieces);
    pia_model_destroy(curve);
    pia_model_destroy(surface);
    assert_status(NULL, pia_model_bezier(NULL, NULL, &pieces), PIA_E_ARGUMENT);
}

static pia_status cut_up(pia_context *context, void *user)
{
    pia_model *out = NULL;
    pia_status status = pia_model_bezier(context, user, &out);
    pia_model_destroy(out);
    return status;
}

static void bezier_pieces_survive_every_failed_allocation(void **state)
{
    (void)state;
    pia_model *model = shape_surface(NULL, 3, 2, 2, 0, 1);
    assert_survives_failures(cut_up, model);
    pia_model_destroy(model);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pieces_of_a_curve_are_bezier_curves),
        cmocka_unit_test(rational_curves_and_surfaces_keep_their_shape_in_pieces),
        cmocka_unit_test(bezier_pieces_survive_every_failed_allocation),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
