#include "basis.h"

#include <math.h>

#include "check.h"
#include "knots.h"
#include "shapes.h"

enum { CONTROL = 32 };

static void values_follow_the_definition_for_every_degree(void **state)
{
    (void)state;
    uint64_t seed = 3;
    for (int degree = 1; degree <= 9; degree++) {
        double *knots = shape_knots(degree, CONTROL, &seed), values[PIA_MAX_DEGREE + 1];
        for (int i = 0; i <= 40; i++) {
            double t = i / 40.0;
            pia_index span = pia_knots_span(knots, degree, CONTROL, t);
            pia_basis_values(knots, degree, span, t, values);
            for (int k = 0; k <= degree; k++) {
                double expected = (double)shape_basis(knots, degree, CONTROL, span - degree + k, degree, t);
                assert_near(values[k], expected, 1e-13 * expected + 1e-300);
            }
        }
        free(knots);
    }
}

static void values_of_high_degrees_sum_to_one_and_are_never_negative(void **state)
{
    (void)state;
    uint64_t seed = 4;
    for (int degree = 10; degree <= PIA_MAX_DEGREE; degree++) {
        double *knots = shape_knots(degree, CONTROL, &seed), values[PIA_MAX_DEGREE + 1];
        for (int i = 0; i <= 100; i++) {
            double t = i / 100.0, sum = 0;
            pia_basis_values(knots, degree, pia_knots_span(knots, degree, CONTROL, t), t, values);
            for (int k = 0; k <= degree; k++) {
                assert_true(values[k] >= 0);
                sum += values[k];
            }
            assert_near(sum, 1, 1e-14);
        }
        free(knots);
    }
}

static void ends_are_met_to_the_last_bit(void **state)
{
    (void)state;
    uint64_t seed = 5;
    for (int degree = 1; degree <= PIA_MAX_DEGREE; degree++) {
        double *knots = shape_knots(degree, CONTROL, &seed), values[PIA_MAX_DEGREE + 1];
        pia_basis_values(knots, degree, degree, knots[0], values);
        for (int k = 0; k <= degree; k++) assert_true(values[k] == (k == 0));
        pia_basis_values(knots, degree, CONTROL - 1, knots[CONTROL], values);
        for (int k = 0; k <= degree; k++) assert_true(values[k] == (k == degree));
        free(knots);
    }
}

/* scipy.interpolate.BSpline([0,0,0,0,.2,.5,.5,1,1,1,1], identity, 3).derivative(k)(0.31), SciPy 1.10.1. */
static void derivatives_match_scipy(void **state)
{
    (void)state;
    const double knots[] = {0, 0, 0, 0, .2, .5, .5, 1, 1, 1, 1};
    const double expected[4][4] = {{0.091453333333333345, 0.38667111111111113, 0.50338944444444444, 0.018486111111111106},
                                   {-1.4440000000000002, -2.3053333333333335, 3.245166666666667, 0.50416666666666654},
                                   {15.200000000000003, -15.73333333333334, -8.6333333333333275, 9.1666666666666643},
                                   {-80, 293.33333333333337, -296.66666666666669, 83.333333333333329}};
    double out[5 * 4];
    pia_basis_derivatives(knots, 3, 4, 0.31, 4, out);
    for (int order = 0; order <= 4; order++)
        for (int k = 0; k < 4; k++) assert_near(out[order * 4 + k], order < 4 ? expected[order][k] : 0, 1e-12);
}

static void derivatives_are_those_of_the_basis_of_one_degree_less(void **state)
{
    (void)state;
    uint64_t seed = 6;
    for (int degree = 2; degree <= PIA_MAX_DEGREE; degree++) {
        double *knots = shape_knots(degree, CONTROL, &seed), out[(PIA_MAX_DEGREE + 2) * (PIA_MAX_DEGREE + 1)];
        double lower[PIA_MAX_DEGREE + 1];
        for (int i = 0; i <= 30; i++) {
            double t = i / 30.0;
            pia_index span = pia_knots_span(knots, degree, CONTROL, t);
            pia_basis_derivatives(knots, degree, span, t, degree + 1, out);
            pia_basis_values(knots, degree - 1, span, t, lower);
            for (int k = 0; k <= degree; k++) {
                pia_index f = span - degree + k;
                double rise = k > 0 ? lower[k - 1] / (knots[f + degree] - knots[f]) : 0;
                double fall = k < degree ? lower[k] / (knots[f + degree + 1] - knots[f + 1]) : 0;
                assert_near(out[degree + 1 + k], degree * (rise - fall), 1e-12 * degree * (rise + fall));
                assert_true(out[(degree + 1) * (degree + 1) + k] == 0);
            }
        }
        free(knots);
    }
}

/* Orders sum to zero, and order k applied to the monomials' blossoms gives their derivatives: here t^degree / degree!. */
static void the_highest_derivative_reproduces_the_monomial(void **state)
{
    (void)state;
    uint64_t seed = 8;
    for (int degree = 1; degree <= 12; degree++) {
        double *knots = shape_knots(degree, CONTROL, &seed), out[13 * 13];
        pia_index span = pia_knots_span(knots, degree, CONTROL, 0.4);
        pia_basis_derivatives(knots, degree, span, 0.4, degree, out);
        double sum = 0, size = 0;
        for (int k = 0; k <= degree; k++) {
            double blossom = 1;
            for (int j = 1; j <= degree; j++) blossom *= knots[span - degree + k + j] / j;
            sum += out[degree * (degree + 1) + k] * blossom;
            size += fabs(out[degree * (degree + 1) + k] * blossom);
        }
        assert_near(sum, 1, 1e-14 * size);
        free(knots);
    }
}

static void t_peer_08_a_basis_over_one_empty_span_is_not_asked_for(void **state)
{
    (void)state;
    const double point[] = {0, 0};
    assert_status(NULL, pia_knots_check(NULL, 1, point, 2, 0), PIA_E_SHAPE);
    const double repeated[] = {0, 0, 0, 1, 1, 2, 2, 2};
    for (int i = 0; i <= 20; i++) {
        double values[3], sum = 0;
        pia_basis_values(repeated, 2, pia_knots_span(repeated, 2, 5, i / 10.0), i / 10.0, values);
        for (int k = 0; k < 3; k++) sum += values[k];
        assert_near(sum, 1, 1e-15);
    }
}

static void the_blossom_at_a_points_own_knots_is_that_point(void **state)
{
    (void)state;
    uint64_t seed = 9;
    for (int degree = 1; degree <= PIA_MAX_DEGREE; degree++) {
        double *knots = shape_knots(degree, CONTROL, &seed), row[PIA_MAX_DEGREE + 1];
        for (pia_index j = 0; j < CONTROL; j++) {
            pia_index span = pia_knots_span(knots, degree, CONTROL, knots[j]);
            pia_basis_blossom(knots, degree, span, knots + j + 1, row);
            for (int k = 0; k <= degree; k++) assert_true(row[k] == (span - degree + k == j));
        }
        free(knots);
    }
}

static void the_blossom_at_equal_arguments_is_the_value(void **state)
{
    (void)state;
    uint64_t seed = 10;
    double *knots = shape_knots(5, CONTROL, &seed), row[6], values[6];
    const double arguments[5] = {0.6, 0.6, 0.6, 0.6, 0.6};
    pia_index span = pia_knots_span(knots, 5, CONTROL, 0.6);
    pia_basis_blossom(knots, 5, span, arguments, row);
    pia_basis_values(knots, 5, span, 0.6, values);
    assert_memory_equal(row, values, sizeof row);
    free(knots);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(values_follow_the_definition_for_every_degree),
        cmocka_unit_test(values_of_high_degrees_sum_to_one_and_are_never_negative),
        cmocka_unit_test(ends_are_met_to_the_last_bit),
        cmocka_unit_test(derivatives_match_scipy),
        cmocka_unit_test(derivatives_are_those_of_the_basis_of_one_degree_less),
        cmocka_unit_test(the_highest_derivative_reproduces_the_monomial),
        cmocka_unit_test(t_peer_08_a_basis_over_one_empty_span_is_not_asked_for),
        cmocka_unit_test(the_blossom_at_a_points_own_knots_is_that_point),
        cmocka_unit_test(the_blossom_at_equal_arguments_is_the_value),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
