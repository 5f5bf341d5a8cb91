#include "check.h"
#include "param.h"

#include <stdlib.h>

static const pia_parametrization *rule_named(const char *name)
{
    const pia_parametrization *rule = pia_param_find(name);
    assert_non_null(rule);
    return rule;
}

/* Values by NumPy: cumulative chords, square roots of chords and the Foley-Nielson formula for (0,0) (3,4) (3,5) (10,5). */
static void known_values_of_an_open_polyline(void **state)
{
    (void)state;
    const double points[] = {0, 0, 3, 4, 3, 5, 10, 5};
    double t[4];
    assert_ok(NULL, rule_named("uniform")->compute(NULL, points, 4, 2, 3, 0, t));
    assert_near(t[1], 1.0 / 3, 1e-16);
    assert_ok(NULL, rule_named("chord")->compute(NULL, points, 4, 2, 3, 0, t));
    assert_near(t[1], 5.0 / 13, 1e-16);
    assert_near(t[2], 6.0 / 13, 1e-16);
    assert_ok(NULL, rule_named("centripetal")->compute(NULL, points, 4, 2, 3, 0, t));
    assert_near(t[1], sqrt(5) / (sqrt(5) + 1 + sqrt(7)), 1e-15);
    assert_near(t[2], (sqrt(5) + 1) / (sqrt(5) + 1 + sqrt(7)), 1e-15);
    double half = acos(0), a = atan2(3, 4);
    double d0 = 5 * (1 + 1.5 * a * 1 / 6), d1 = 1 + 1.5 * a * 5 / 6 + 1.5 * half * 7 / 8, d2 = 7 * (1 + 1.5 * half * 1 / 8);
    assert_ok(NULL, rule_named("foley")->compute(NULL, points, 4, 2, 3, 0, t));
    assert_near(t[1], d0 / (d0 + d1 + d2), 1e-15);
    assert_near(t[2], (d0 + d1) / (d0 + d1 + d2), 1e-15);
}

/* Bernstein polynomial i of degree p is largest at i / p; inside functions of uniform knots at the middle of their support. Two spans
 * of degree 2: 1 - (1 - t)^2 - t^2 / 2 is largest at 2/3 of the first. */
static void universal_parameters_are_where_basis_functions_are_largest(void **state)
{
    (void)state;
    double points[20], t[20];
    for (int i = 0; i < 20; i++) points[i] = i * i;
    const pia_parametrization *rule = rule_named("universal");
    for (int count = 2; count <= 20; count++) {
        assert_ok(NULL, rule->compute(NULL, points, count, 1, 25, 0, t));
        for (int i = 0; i < count; i++) assert_near(t[i], i / (count - 1.0), 1e-7);
    }
    assert_ok(NULL, rule->compute(NULL, points, 4, 1, 2, 0, t));
    assert_near(t[1], 1.0 / 3, 1e-8);
    assert_near(t[2], 2.0 / 3, 1e-8);
    assert_ok(NULL, rule->compute(NULL, points, 20, 1, 3, 0, t));
    for (int i = 3; i < 17; i++) assert_near(t[i], (i - 1) / 17.0, 1e-15);
    for (int i = 0; i < 20; i++) assert_near(t[i], 1 - t[19 - i], 1e-15);
}

static void every_rule_runs_from_exactly_0_to_exactly_1(void **state)
{
    (void)state;
    double points[3 * 40], t[40];
    srand(7);
    for (int i = 0; i < 120; i++) points[i] = rand() / (double)RAND_MAX;
    const pia_parametrization *rule;
    for (pia_index r = 0; (rule = pia_param_list(r)) != NULL; r++)
        for (int dim = 1; dim <= 3; dim++)
            for (int degree = 1; degree <= 7; degree++) {
                assert_ok(NULL, rule->compute(NULL, points, 40, dim, degree, 0, t));
                assert_true(t[0] == 0 && t[39] == 1);
                for (int i = 1; i < 40; i++) assert_true(t[i] > t[i - 1]);
                assert_ok(NULL, rule->compute(NULL, points, 40, dim, degree, 1, t));
                assert_true(t[0] == 0 && t[39] < 1);
                for (int i = 1; i < 40; i++) assert_true(t[i] > t[i - 1]);
            }
}

static void the_closing_chord_belongs_to_the_period(void **state)
{
    (void)state;
    const double square[] = {0, 0, 1, 0, 1, 1, 0, 1};
    double t[4];
    const pia_parametrization *rule;
    for (pia_index r = 0; (rule = pia_param_list(r)) != NULL; r++) {
        assert_ok(NULL, rule->compute(NULL, square, 4, 2, 3, 1, t));
        for (int i = 0; i < 4; i++) assert_near(t[i], i / 4.0, 1e-15);
    }
}

static void t_peer_44_coincident_neighbours_get_equal_parameters(void **state)
{
    (void)state;
    const double points[] = {0, 0, 1, 0, 1, 0, 1, 0, 2, 1};
    const char *const names[] = {"chord", "centripetal", "foley"};
    double t[5];
    for (int r = 0; r < 3; r++) {
        assert_ok(NULL, rule_named(names[r])->compute(NULL, points, 5, 2, 3, 0, t));
        assert_true(t[1] == t[2] && t[2] == t[3] && t[1] > 0 && t[3] < t[4]);
    }
}

static void all_points_equal_is_a_named_error_of_every_rule(void **state)
{
    (void)state;
    const double points[] = {3, 4, 3, 4, 3, 4};
    double t[3];
    const pia_parametrization *rule;
    for (pia_index r = 0; (rule = pia_param_list(r)) != NULL; r++)
        for (int closed = 0; closed < 2; closed++) assert_status(NULL, rule->compute(NULL, points, 3, 2, 3, closed, t), PIA_E_DATA);
}

static void t_peer_45_t_peer_46_tiny_and_huge_coordinates_keep_their_parameters(void **state)
{
    (void)state;
    const double shape[] = {0, 0, 3, 4, 3, 5, 10, 5, 12, 7};
    const double scales[] = {1e-4, 1e-12, 1e-100, 1e-200, 1e-290, 1e100, 1e200, 1e300};
    const pia_parametrization *rule;
    double expected[5], t[5], points[10];
    for (pia_index r = 0; (rule = pia_param_list(r)) != NULL; r++)
        for (int closed = 0; closed < 2; closed++) {
            assert_ok(NULL, rule->compute(NULL, shape, 5, 2, 3, closed, expected));
            for (int s = 0; s < 8; s++) {
                for (int i = 0; i < 10; i++) points[i] = shape[i] * scales[s];
                assert_ok(NULL, rule->compute(NULL, points, 5, 2, 3, closed, t));
                for (int i = 0; i < 5; i++) assert_near(t[i], expected[i], 1e-15);
            }
        }
}

static void coordinates_that_are_not_finite_are_refused(void **state)
{
    (void)state;
    double points[] = {0, 0, 1, NAN, 2, 0}, t[3];
    assert_status(NULL, rule_named("chord")->compute(NULL, points, 3, 2, 3, 0, t), PIA_E_DATA);
    points[3] = INFINITY;
    assert_status(NULL, rule_named("foley")->compute(NULL, points, 3, 2, 3, 0, t), PIA_E_DATA);
    points[3] = -1.7e308, points[5] = 1.7e308;
    assert_status(NULL, rule_named("centripetal")->compute(NULL, points, 3, 2, 3, 0, t), PIA_E_DATA);
}

static void a_plane_grid_has_the_parameters_of_its_lines(void **state)
{
    (void)state;
    const double x[] = {0, 1, 3, 7}, y[] = {0, 2, 3};
    double points[4 * 3 * 3], u[4], v[3];
    for (int i = 0; i < 4; i++)
        for (int j = 0; j < 3; j++) {
            double *p = points + (i * 3 + j) * 3;
            p[0] = x[i], p[1] = y[j], p[2] = 0;
        }
    const pia_index count[] = {4, 3};
    const int degree[] = {3, 2}, open[] = {0, 0};
    assert_ok(NULL, pia_param_grid(NULL, rule_named("chord"), points, count, 3, degree, open, u, v));
    for (int i = 0; i < 4; i++) assert_near(u[i], x[i] / 7, 1e-15);
    for (int j = 0; j < 3; j++) assert_near(v[j], y[j] / 3, 1e-15);
    assert_true(u[0] == 0 && u[3] == 1 && v[0] == 0 && v[2] == 1);
}

static void holes_of_a_grid_are_left_out(void **state)
{
    (void)state;
    double points[5 * 4 * 3], u[5], v[4];
    for (int i = 0; i < 5; i++)
        for (int j = 0; j < 4; j++) {
            double *p = points + (i * 4 + j) * 3;
            p[0] = i, p[1] = j, p[2] = (i == 2 && j == 1) || (i == 0 && j == 3) || (i == 4 && j < 2) ? NAN : 0;
        }
    const pia_index count[] = {5, 4};
    const int degree[] = {3, 3}, open[] = {0, 0};
    assert_ok(NULL, pia_param_grid(NULL, rule_named("chord"), points, count, 3, degree, open, u, v));
    for (int i = 0; i < 5; i++) assert_near(u[i], i / 4.0, 1e-15);
    for (int j = 0; j < 4; j++) assert_near(v[j], j / 3.0, 1e-15);
}

static void lines_of_zero_length_do_not_count_and_closed_directions_have_a_period(void **state)
{
    (void)state;
    double points[6 * 3 * 3], u[6], v[3];
    for (int i = 0; i < 6; i++)
        for (int j = 0; j < 3; j++) {
            double *p = points + (i * 3 + j) * 3;
            p[0] = j * cos(i * acos(-1) / 3), p[1] = j * sin(i * acos(-1) / 3), p[2] = j; /* a cone with its pole at j = 0 */
        }
    const pia_index count[] = {6, 3};
    const int degree[] = {3, 2}, closed[] = {1, 0};
    assert_ok(NULL, pia_param_grid(NULL, rule_named("chord"), points, count, 3, degree, closed, u, v));
    for (int i = 0; i < 6; i++) assert_near(u[i], i / 6.0, 1e-15);
    assert_near(v[1], 0.5, 1e-15);
    memset(points, 0, sizeof points);
    assert_status(NULL, pia_param_grid(NULL, rule_named("chord"), points, count, 3, degree, closed, u, v), PIA_E_DATA);
}

static void large_sums_keep_their_digits(void **state)
{
    (void)state;
    pia_index count = 1000003;
    double *points = malloc((size_t)count * sizeof *points), *t = malloc((size_t)count * sizeof *t);
    assert_true(points != NULL && t != NULL);
    for (pia_index i = 0; i < count; i++) points[i] = (double)i * 0.1;
    assert_ok(NULL, rule_named("chord")->compute(NULL, points, count, 1, 3, 0, t));
    for (pia_index i = 0; i < count; i += 997) assert_near(t[i], (double)i / (double)(count - 1), 1e-13);
    assert_true(t[count - 1] == 1);
    free(points);
    free(t);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(known_values_of_an_open_polyline),
        cmocka_unit_test(universal_parameters_are_where_basis_functions_are_largest),
        cmocka_unit_test(every_rule_runs_from_exactly_0_to_exactly_1),
        cmocka_unit_test(the_closing_chord_belongs_to_the_period),
        cmocka_unit_test(t_peer_44_coincident_neighbours_get_equal_parameters),
        cmocka_unit_test(all_points_equal_is_a_named_error_of_every_rule),
        cmocka_unit_test(t_peer_45_t_peer_46_tiny_and_huge_coordinates_keep_their_parameters),
        cmocka_unit_test(coordinates_that_are_not_finite_are_refused),
        cmocka_unit_test(a_plane_grid_has_the_parameters_of_its_lines),
        cmocka_unit_test(holes_of_a_grid_are_left_out),
        cmocka_unit_test(lines_of_zero_length_do_not_count_and_closed_directions_have_a_period),
        cmocka_unit_test(large_sums_keep_their_digits),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
