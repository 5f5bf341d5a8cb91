/* How pictures sample models and look at them. */
#include "check.h"

#include "sample.h"
#include "view.h"

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void the_axes_of_a_view_are_orthonormal(void **state)
{
    (void)state;
    for (double azimuth = -200; azimuth < 200; azimuth += 37) {
        for (double elevation = -90; elevation <= 90; elevation += 22.5) {
            pia_view view = {.stretch = {1, 1, 1}};
            pia_view_aim(&view, azimuth, elevation);
            assert_near(dot(view.right, view.right), 1, 1e-14);
            assert_near(dot(view.up, view.up), 1, 1e-14);
            assert_near(dot(view.toward, view.toward), 1, 1e-14);
            assert_near(dot(view.right, view.up), 0, 1e-14);
            assert_near(dot(view.right, view.toward), 0, 1e-14);
            assert_near(dot(view.up, view.toward), 0, 1e-14);
        }
    }
}

static void the_usual_view_has_x_to_the_right_and_z_up(void **state)
{
    (void)state;
    pia_view view = {.low = {0, 0, 0}, .high = {1, 1, 1}, .stretch = {1, 1, 1}};
    const pia_box page = {0, 0, 400, 300};
    pia_view_aim(&view, -60, 30);
    pia_view_fit(&view, &page);
    pia_spot origin = pia_view_spot(&view, (const double[]){0, 0, 0}), x = pia_view_spot(&view, (const double[]){1, 0, 0});
    pia_spot z = pia_view_spot(&view, (const double[]){0, 0, 1});
    assert_true(x.x > origin.x);
    assert_near(z.x, origin.x, 1e-9);
    assert_true(z.y < origin.y);
    assert_true(pia_view_depth(&view, (const double[]){0, 0, 1}) > pia_view_depth(&view, (const double[]){0, 1, 0}));
}

static void the_box_fits_its_page(void **state)
{
    (void)state;
    for (double azimuth = 0; azimuth < 360; azimuth += 25) {
        pia_view view = {.low = {10, -3, 5e5}, .high = {12, 7, 5e5 + 1}, .stretch = {1, 1, 4}};
        const pia_box page = {30, 40, 500, 400};
        pia_view_aim(&view, azimuth, 30);
        pia_view_fit(&view, &page);
        for (int k = 0; k < 8; k++) {
            const double at[3] = {k & 1 ? view.low[0] : view.high[0], k & 2 ? view.low[1] : view.high[1],
                                  k & 4 ? view.low[2] : view.high[2]};
            pia_spot spot = pia_view_spot(&view, at);
            assert_true(spot.x >= page.left && spot.x <= page.right && spot.y >= page.top - 1e-9 && spot.y <= page.bottom);
        }
    }
}

static pia_model *make_curve(const double *points, int dim)
{
    static const double knots[] = {0, 0, 0, 1, 1, 2, 3, 3, 3};
    const int degree = 2;
    const pia_index control = 6;
    pia_model *model = NULL;
    assert_ok(NULL, pia_model_create(NULL, 1, &degree, (const double *const[]){knots}, &control, dim, points, NULL, &model));
    return model;
}

static void samples_rise_over_the_domain_and_meet_every_knot(void **state)
{
    (void)state;
    static const double points[6] = {0};
    pia_model *model = make_curve(points, 1);
    for (pia_index wanted = 1; wanted < 40; wanted += 7) {
        pia_samples samples = {0};
        assert_ok(NULL, pia_samples_take(NULL, model, 0, wanted, 100, &samples));
        assert_near(samples.parameter[0], 0, 0);
        assert_near(samples.parameter[samples.count - 1], 3, 0);
        assert_int_equal(pia_samples_knots(&samples), 4);
        for (pia_index i = 0; i < samples.count; i++) {
            assert_true(i == 0 || samples.parameter[i] > samples.parameter[i - 1]);
            if (samples.at_knot[i]) assert_near(samples.parameter[i], round(samples.parameter[i]), 0);
        }
        pia_samples_give(NULL, &samples);
    }
    pia_model_destroy(model);
}

static void more_spans_than_samples_are_taken_together(void **state)
{
    (void)state;
    static const double points[6] = {0};
    pia_model *model = make_curve(points, 1);
    pia_samples samples = {0};
    assert_ok(NULL, pia_samples_take(NULL, model, 0, 2, 2, &samples));
    assert_int_equal(samples.count, 3);
    assert_near(samples.parameter[1], 2, 0);
    assert_near(samples.parameter[2], 3, 0);
    pia_samples_give(NULL, &samples);
    pia_model_destroy(model);
}

static void assert_shape(const double *points, int graph, int monotone)
{
    pia_model *model = make_curve(points, 2);
    pia_figure figure;
    assert_ok(NULL, pia_figure_take(NULL, model, 10, 1, &figure));
    assert_int_equal(pia_figure_is_graph(&figure), graph);
    assert_int_equal(pia_figure_is_monotone(&figure), monotone);
    pia_figure_give(NULL, &figure);
    pia_model_destroy(model);
}

static void graphs_and_curves_that_never_turn_back_are_recognised(void **state)
{
    (void)state;
    /* Greville abscissae of the knots above: 0, 0.5, 1, 1.5, 2.5, 3. */
    static const double graph[] = {10, 1, 15, -1, 20, 4, 25, 2, 35, 0, 40, 7}, uneven[] = {0, 1, 1, -1, 2, 4, 3, 2, 4, 0, 5, 7};
    static const double loop[] = {0, 1, 1, -1, 2, 4, 1, 2, 0, 0, -1, 7};
    assert_shape(graph, 1, 1);
    assert_shape(uneven, 0, 1);
    assert_shape(loop, 0, 0);
}

/* A circle of radius 2 as a rational quadratic has curvature 1/2 everywhere, towards its centre. */
static void teeth_have_the_curvature_of_the_curve(void **state)
{
    (void)state;
    static const double knots[] = {0, 0, 0, 1, 1, 1}, points[] = {2, 0, 2, 2, 0, 2}, weights[] = {1, 0.70710678118654752440, 1};
    const int degree = 2;
    const pia_index control = 3;
    pia_model *model = NULL;
    pia_figure figure;
    assert_ok(NULL, pia_model_create(NULL, 1, &degree, (const double *const[]){knots}, &control, 2, points, weights, &model));
    assert_ok(NULL, pia_figure_take(NULL, model, 10, 1, &figure));
    assert_true(figure.tooth_count > 100);
    for (pia_index i = 0; i < figure.tooth_count; i++) {
        const pia_tooth *tooth = &figure.tooth[i];
        assert_near(tooth->curvature, 0.5, 1e-12);
        for (int c = 0; c < 2; c++) assert_near(tooth->bend[c], -0.25 * tooth->root[c], 1e-12);
    }
    pia_figure_give(NULL, &figure);
    pia_model_destroy(model);
}

static void terrain_is_told_from_a_folded_surface(void **state)
{
    (void)state;
    static const double knots[] = {0, 0, 1, 1}, flat[] = {0, 0, 1, 0, 1, 5, 1, 0, 2, 1, 1, 3},
                        folded[] = {0, 0, 1, 0, 1, 5, 1, 1, 2, 1, 0, 3};
    const int degree[2] = {1, 1};
    const pia_index control[2] = {2, 2};
    for (int fold = 0; fold < 2; fold++) {
        pia_model *model = NULL;
        pia_figure figure;
        assert_ok(NULL, pia_model_create(NULL, 2, degree, (const double *const[]){knots, knots}, control, 3, fold ? folded : flat, NULL,
                                         &model));
        assert_ok(NULL, pia_figure_take(NULL, model, 10, 0, &figure));
        assert_int_equal(pia_figure_is_terrain(&figure), !fold);
        pia_figure_give(NULL, &figure);
        pia_model_destroy(model);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_axes_of_a_view_are_orthonormal),
        cmocka_unit_test(the_usual_view_has_x_to_the_right_and_z_up),
        cmocka_unit_test(the_box_fits_its_page),
        cmocka_unit_test(samples_rise_over_the_domain_and_meet_every_knot),
        cmocka_unit_test(more_spans_than_samples_are_taken_together),
        cmocka_unit_test(graphs_and_curves_that_never_turn_back_are_recognised),
        cmocka_unit_test(teeth_have_the_curvature_of_the_curve),
        cmocka_unit_test(terrain_is_told_from_a_folded_surface),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
