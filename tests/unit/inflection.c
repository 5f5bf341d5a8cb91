#include "check.h"
#include "model.h"
#include "shape.h"

static pia_model *curve(int degree, const double *knots, pia_index control, const double *points, const double *weights)
{
    pia_model *model = NULL;
    assert_ok(NULL, pia_model_create(NULL, 1, &degree, &knots, &control, 2, points, weights, &model));
    return model;
}

static pia_index inflections(int degree, const double *knots, pia_index control, const double *points, const double *weights)
{
    pia_index count = -1;
    pia_model *model = curve(degree, knots, control, points, weights);
    assert_ok(NULL, pia_curve_inflections(NULL, model, &count));
    pia_model_destroy(model);
    return count;
}

static const double cubic[] = {0, 0, 0, 0, 1, 1, 1, 1};

static void turns_below_rounding_have_no_sign(void **state)
{
    (void)state;
    const double a[] = {1, 0}, left[] = {1, 1e-11}, right[] = {1, -1e-11}, straight[] = {1, 1e-13}, none[] = {0, 0};
    assert_int_equal(pia_turn_sign(a, left), 1);
    assert_int_equal(pia_turn_sign(a, right), -1);
    assert_int_equal(pia_turn_sign(a, straight), 0);
    assert_int_equal(pia_turn_sign(a, none), 0);
}

static void a_zigzag_inflects_at_every_leg_between_opposite_turns(void **state)
{
    (void)state;
    const double zigzag[] = {0, 0, 1, 1, 2, 0, 3, 1, 4, 0}, bow[] = {0, 0, 1, 1, 1, 1, 2, 1, 3, 0, 4, -3};
    assert_int_equal(pia_polygon_inflections(zigzag, 5, 0), 2);
    assert_int_equal(pia_polygon_inflections(bow, 6, 0), 0);
    assert_int_equal(pia_polygon_inflections(zigzag, 2, 0), 0);
    assert_int_equal(pia_polygon_inflections(zigzag, 0, 0), 0);
}

static void a_closed_polygon_counts_the_turns_where_it_closes(void **state)
{
    (void)state;
    const double square[] = {0, 0, 1, 0, 1, 1, 0, 1}, arrow[] = {0, 0, 2, 1, 0, 2, 1, 1}, dented_first[] = {1, 1, 0, 0, 2, 1, 0, 2};
    assert_int_equal(pia_polygon_inflections(square, 4, 1), 0);
    assert_int_equal(pia_polygon_inflections(arrow, 4, 1), 2);
    assert_int_equal(pia_polygon_inflections(dented_first, 4, 1), 2);
}

/* Two left turns of the polygon, 250 degrees in all: no guarantee, and the cubic has two inflections. */
static void a_convex_polygon_that_turns_too_far_has_a_curve_with_two_inflections(void **state)
{
    (void)state;
    const double points[] = {0, 0, 0.7, 1, 0.3, 1, 1, 0};
    assert_int_equal(pia_polygon_inflections(points, 4, 0), 0);
    assert_int_equal(pia_polygon_first_wide_turn(points, 4, 3), 0);
    assert_int_equal(inflections(3, cubic, 4, points, NULL), 2);
}

static void the_guarantee_holds_where_consecutive_legs_turn_by_less_than_pi(void **state)
{
    (void)state;
    const double arch[] = {0, 0, 0, 1, 1, 1, 1, 0.5}, back[] = {0, 0, 1, 0, 2, 1, 1, 0};
    const double doubled[] = {0, 0, 0, 0, 0, 1, 1, 1};
    assert_int_equal(pia_polygon_first_wide_turn(arch, 4, 3), 0);
    assert_int_equal(pia_polygon_first_wide_turn(arch, 4, 2), -1);
    assert_int_equal(pia_polygon_first_wide_turn(back, 4, 2), 1);
    assert_int_equal(pia_polygon_first_wide_turn(doubled, 4, 3), -1);
    assert_int_equal(inflections(3, cubic, 4, doubled, NULL), 0);
}

/* y = T_6(x) as a Bezier curve over [-1, 1] has an inflection at each of the 4 zeroes of its second derivative. */
static void a_graph_inflects_where_its_second_derivative_changes_sign(void **state)
{
    (void)state;
    const double knots[] = {0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1, 1};
    /* Bernstein coefficients of T_n are (-1)^(n-i) C(2n, 2i) / C(n, i). */
    const double y[] = {1, -11, 33, -46.2, 33, -11, 1};
    double points[14];
    for (int i = 0; i < 7; i++) {
        points[2 * i] = -1 + i / 3.0;
        points[2 * i + 1] = y[i];
    }
    assert_int_equal(inflections(6, knots, 7, points, NULL), 4);
}

/* y'' = (x - 1/2)^2 - e: two inflections that lie between samples, none for the other sign of e. */
static void close_pairs_of_inflections_are_found_between_samples(void **state)
{
    (void)state;
    const double knots[] = {0, 0, 0, 0, 0, 1, 1, 1, 1, 1};
    for (int half = -1; half <= 1; half += 2)
        for (int e = 3; e <= 7; e++) {
            double gap = half * pow(10, -e), centre = 0.4637, c = centre * centre - gap, points[10];
            /* y = x^4/12 - centre x^3/3 + c x^2/2 in Bernstein form */
            const double power[] = {0, 0, c / 2, -centre / 3, 1.0 / 12};
            const double share[5][5] = {{1}, {1, 1.0 / 4}, {1, 1.0 / 2, 1.0 / 6}, {1, 3.0 / 4, 1.0 / 2, 1.0 / 4}, {1, 1, 1, 1, 1}};
            for (int i = 0; i < 5; i++) {
                points[2 * i] = i / 4.0;
                points[2 * i + 1] = 0;
                for (int k = 0; k <= i; k++) points[2 * i + 1] += share[i][k] * power[k];
            }
            assert_int_equal(inflections(4, knots, 5, points, NULL), half > 0 ? 2 : 0);
        }
}

static void corners_count_with_their_turn(void **state)
{
    (void)state;
    const double line_knots[] = {0, 0, 1, 2, 3, 4, 4}, zigzag[] = {0, 0, 1, 1, 2, 0, 3, 1, 4, 0};
    assert_int_equal(inflections(1, line_knots, 5, zigzag, NULL), 2);
    /* Two arcs that bend left, joined by a corner that turns right. */
    const double knots[] = {0, 0, 0, 1, 1, 2, 2, 2}, cusp[] = {0, 2, 0, 0, 2, 0, 2, -2, 4, -2};
    assert_int_equal(inflections(2, knots, 5, cusp, NULL), 2);
}

static void a_rational_circle_has_none(void **state)
{
    (void)state;
    const double w = sqrt(0.5), knots[] = {0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4};
    const double points[] = {1, 0, 1, 1, 0, 1, -1, 1, -1, 0, -1, -1, 0, -1, 1, -1, 1, 0};
    const double weights[] = {1, w, 1, w, 1, w, 1, w, 1};
    assert_int_equal(inflections(2, knots, 9, points, weights), 0);
}

static void curves_in_space_are_refused(void **state)
{
    (void)state;
    const int degree = 3;
    const pia_index control = 4;
    const double points[12] = {0, 0, 0, 1, 2, 3, 3, 2, 1, 4, 4, 4}, *const knots[] = {cubic};
    pia_model *model = NULL;
    pia_index count = 0;
    assert_ok(NULL, pia_model_create(NULL, 1, &degree, knots, &control, 3, points, NULL, &model));
    assert_status(NULL, pia_curve_inflections(NULL, model, &count), PIA_E_SHAPE);
    pia_model_destroy(model);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(turns_below_rounding_have_no_sign),
        cmocka_unit_test(a_zigzag_inflects_at_every_leg_between_opposite_turns),
        cmocka_unit_test(a_closed_polygon_counts_the_turns_where_it_closes),
        cmocka_unit_test(a_convex_polygon_that_turns_too_far_has_a_curve_with_two_inflections),
        cmocka_unit_test(the_guarantee_holds_where_consecutive_legs_turn_by_less_than_pi),
        cmocka_unit_test(a_graph_inflects_where_its_second_derivative_changes_sign),
        cmocka_unit_test(close_pairs_of_inflections_are_found_between_samples),
        cmocka_unit_test(corners_count_with_their_turn),
        cmocka_unit_test(a_rational_circle_has_none),
        cmocka_unit_test(curves_in_space_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
