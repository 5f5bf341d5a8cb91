#include "image.h"

#include <math.h>

#include "../memory/failing.h"
#include "shapes.h"

/* The image at t against the surface at the point of the segment, for t all along it. */
static void assert_lies_above(const pia_model *surface, const double from[2], const double to[2], double tolerance)
{
    pia_model *curve = NULL;
    assert_ok(NULL, pia_model_image(NULL, surface, from, to, &curve));
    pia_model_info info;
    pia_model_get_info(curve, &info);
    assert_int_equal(info.degree[0], surface->degree[0] + surface->degree[1]);
    assert_int_equal(info.rational, surface->rational);
    assert_true(info.domain[0][0] == 0 && info.domain[0][1] == 1);
    for (int i = 0; i <= 300; i++) {
        double t = i / 300.0, p[PIA_MAX_DIM], q[PIA_MAX_DIM];
        const double at[2] = {from[0] + t * (to[0] - from[0]), from[1] + t * (to[1] - from[1])};
        assert_ok(NULL, pia_model_eval(NULL, curve, &t, 1, 0, p));
        assert_ok(NULL, pia_model_eval(NULL, surface, at, 1, 0, q));
        for (int c = 0; c < info.dim; c++) assert_near(p[c], q[c], tolerance);
    }
    pia_model_destroy(curve);
}

static void segments_of_any_direction_have_exact_images(void **state)
{
    (void)state;
    static const double ends[][4] = {{0, 0, 1, 1},     {0.9, 0.1, 0.05, 0.95}, {0.2, 0.3, 0.2, 0.8},
                                     {0, 0.4, 1, 0.4}, {1, 1, 0, 1},           {0.31, 0.32, 0.33, 0.34}};
    for (int rational = 0; rational < 2; rational++)
        for (size_t k = 0; k < sizeof ends / sizeof *ends; k++) {
            pia_model *surface = shape_surface(NULL, 3, 2, 3, rational, 8);
            assert_lies_above(surface, ends[k], ends[k] + 2, 2e-14);
            pia_model_destroy(surface);
        }
}

static void high_degrees_stay_accurate(void **state)
{
    (void)state;
    pia_model *surface = shape_surface(NULL, 12, 13, 3, 1, 5);
    assert_lies_above(surface, (double[]){0.1, 0.9}, (double[]){0.8, 0.05}, 1e-13);
    pia_model_destroy(surface);
}

/* At a knot of one direction, along a knot of the other, through a corner of knot cells. */
static void knots_on_the_way_make_pieces(void **state)
{
    (void)state;
    const double knots[2][8] = {{0, 0, 0.5, 1, 1}, {0, 0, 0, 0.5, 0.75, 1, 1, 1}}, *const all[2] = {knots[0], knots[1]};
    const int degree[2] = {1, 2};
    const pia_index control[2] = {3, 5};
    double points[15];
    for (int i = 0; i < 15; i++) points[i] = sin(i);
    pia_model *surface = NULL, *curve = NULL;
    assert_ok(NULL, pia_model_create(NULL, 2, degree, all, control, 1, points, NULL, &surface));
    assert_ok(NULL, pia_model_image(NULL, surface, (double[]){0, 0}, (double[]){1, 1}, &curve));
    assert_int_equal(curve->control[0], 3 * 3 + 1); /* pieces end at 0.5 (both directions at once) and 0.75 */
    pia_model_destroy(curve);
    assert_lies_above(surface, (double[]){0, 0}, (double[]){1, 1}, 1e-15);
    assert_lies_above(surface, (double[]){0.5, 0}, (double[]){0.5, 1}, 1e-15);
    assert_lies_above(surface, (double[]){0, 0.75}, (double[]){0.5, 0.75}, 1e-15);
    pia_model_destroy(surface);
}

static void degrees_that_add_up_to_too_much_are_refused(void **state)
{
    (void)state;
    pia_model *surface = shape_surface(NULL, 13, 13, 2, 0, 5), *curve = NULL;
    assert_status(NULL, pia_model_image(NULL, surface, (double[]){0, 0}, (double[]){1, 1}, &curve), PIA_E_ARGUMENT);
    assert_null(curve);
    pia_model_destroy(surface);
}

static pia_status image(pia_context *context, void *user)
{
    pia_model *curve = NULL;
    pia_status status = pia_model_image(context, user, (double[]){0, 0}, (double[]){1, 0.9}, &curve);
    pia_model_destroy(curve);
    return status;
}

static void images_survive_every_failed_allocation(void **state)
{
    (void)state;
    pia_model *surface = shape_surface(NULL, 3, 2, 3, 1, 8);
    assert_survives_failures(image, surface);
    pia_model_destroy(surface);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(segments_of_any_direction_have_exact_images),
        cmocka_unit_test(high_degrees_stay_accurate),
        cmocka_unit_test(knots_on_the_way_make_pieces),
        cmocka_unit_test(degrees_that_add_up_to_too_much_are_refused),
        cmocka_unit_test(images_survive_every_failed_allocation),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
