#include <math.h>

#include "evaluate.h"
#include "shapes.h"

/* Derivatives of order k against differences of order k-1, at places away from knots. */
static void check_curve(const pia_model *model, int order, double tolerance)
{
    pia_model_info info;
    pia_model_get_info(model, &info);
    int dim = info.dim;
    const double *knots = pia_model_knots(model, 0), step = 1e-5;
    double *rows = malloc((size_t)(3 * (order + 1) * dim) * sizeof *rows);
    for (pia_index s = info.degree[0]; s < info.control[0]; s++) {
        if (knots[s + 1] - knots[s] < 4 * step) continue;
        double t = 0.4 * knots[s] + 0.6 * knots[s + 1], at[] = {t - step, t, t + step};
        assert_ok(NULL, pia_model_eval(NULL, model, at, 3, order, rows));
        for (int k = 1; k <= order; k++)
            for (int c = 0; c < dim; c++) {
                double before = rows[(k - 1) * dim + c], after = rows[(2 * (order + 1) + k - 1) * dim + c];
                double exact = rows[(order + 1 + k) * dim + c];
                assert_near((after - before) / (2 * step), exact, tolerance * (1 + fabs(exact)) * pow(30, k));
            }
    }
    free(rows);
}

static void derivatives_of_curves_are_limits_of_differences(void **state)
{
    (void)state;
    for (int degree = 2; degree <= 7; degree++)
        for (int rational = 0; rational <= 1; rational++) {
            pia_model *model = shape_curve(NULL, degree, degree + 4, 3, rational, (uint64_t)degree);
            check_curve(model, 3, 1e-7);
            pia_model_destroy(model);
        }
}

/* With u = tan(angle / 2) the circle is ((1 - t^2), 2 t) / (1 + t^2); its derivatives by hand at t. */
static void derivatives_of_a_rational_arc_match_calculus(void **state)
{
    (void)state;
    const double knots[] = {0, 0, 0, 1, 1, 1}, points[] = {1, 0, 1, 1, 0, 1}, weights[] = {1, 1, 2};
    const double *const all[] = {knots};
    const int degree = 2;
    const pia_index control = 3;
    pia_model *model = NULL;
    assert_ok(NULL, pia_model_create(NULL, 1, &degree, all, &control, 2, points, weights, &model));
    for (int i = 0; i <= 10; i++) {
        double t = i / 10.0, q = 1 + t * t, out[10];
        assert_ok(NULL, pia_model_eval(NULL, model, &t, 1, 4, out));
        const double expected[] = {(1 - t * t) / q,
                                   2 * t / q,
                                   -4 * t / (q * q),
                                   2 * (1 - t * t) / (q * q),
                                   4 * (3 * t * t - 1) / (q * q * q),
                                   4 * t * (t * t - 3) / (q * q * q),
                                   48 * t * (1 - t * t) / pow(q, 4),
                                   -12 * (pow(t, 4) - 6 * t * t + 1) / pow(q, 4),
                                   48 * (5 * pow(t, 4) - 10 * t * t + 1) / pow(q, 5),
                                   48 * t * (pow(t, 4) - 10 * t * t + 5) / pow(q, 5)};
        for (int k = 0; k < 10; k++) assert_near(out[k], expected[k], 1e-13 * 48);
    }
    pia_model_destroy(model);
}

/* S = (u^2 v, u v^3, u^3) in Bezier form of degrees 3 and 3: every mixed derivative is known, in the order of the header. */
static void mixed_derivatives_come_in_the_order_of_the_header(void **state)
{
    (void)state;
    const double knots[] = {0, 0, 0, 0, 1, 1, 1, 1}, *const all[] = {knots, knots};
    const double one[] = {0, 1.0 / 3, 2.0 / 3, 1}, two[] = {0, 0, 1.0 / 3, 1}, three[] = {0, 0, 0, 1};
    double points[16 * 3], u = 0.3, v = 0.8, at[] = {u, v}, out[15 * 3];
    for (int i = 0; i < 16; i++) {
        points[3 * i] = two[i / 4] * one[i % 4];
        points[3 * i + 1] = one[i / 4] * three[i % 4];
        points[3 * i + 2] = three[i / 4];
    }
    const int degree[] = {3, 3};
    const pia_index control[] = {4, 4};
    pia_model *model = NULL;
    assert_ok(NULL, pia_model_create(NULL, 2, degree, all, control, 3, points, NULL, &model));
    assert_ok(NULL, pia_model_eval(NULL, model, at, 1, 4, out));
    const double expected[15][3] = {{u * u * v, u * v * v * v, u * u * u}, /* S */
                                    {2 * u * v, v * v * v, 3 * u * u},     /* Su */
                                    {u * u, 3 * u * v * v, 0},             /* Sv */
                                    {2 * v, 0, 6 * u},                     /* Suu */
                                    {2 * u, 3 * v * v, 0},                 /* Suv */
                                    {0, 6 * u * v, 0},                     /* Svv */
                                    {0, 0, 6},                             /* Suuu */
                                    {2, 0, 0},                             /* Suuv */
                                    {0, 6 * v, 0},                         /* Suvv */
                                    {0, 6 * u, 0},                         /* Svvv */
                                    {0},                                   /* Suuuu */
                                    {0},
                                    {0},
                                    {0, 6, 0}, /* Suvvv */
                                    {0}};
    for (int r = 0; r < 15; r++)
        for (int c = 0; c < 3; c++) assert_near(out[3 * r + c], expected[r][c], 1e-13);
    pia_model_destroy(model);
}

static void derivatives_of_rational_surfaces_are_limits_of_differences(void **state)
{
    (void)state;
    pia_model *model = shape_surface(NULL, 3, 4, 3, 1, 5);
    enum { ORDER = 3, ROWS = 10 };
    const double step = 1e-5;
    for (int i = 0; i < 5; i++) {
        double u = 0.11 + 0.17 * i, v = 0.93 - 0.19 * i, out[5][ROWS * 3];
        const double at[] = {u, v, u - step, v, u + step, v, u, v - step, u, v + step};
        assert_ok(NULL, pia_model_eval(NULL, model, at, 5, ORDER, out[0]));
        for (int a = 0; a < ORDER; a++)
            for (int b = 0; a + b < ORDER; b++)
                for (int c = 0; c < 3; c++) {
                    pia_index from = pia_derivative_row(a, b) * 3 + c;
                    double du = (out[2][from] - out[1][from]) / (2 * step), dv = (out[4][from] - out[3][from]) / (2 * step);
                    double su = out[0][pia_derivative_row(a + 1, b) * 3 + c], sv = out[0][pia_derivative_row(a, b + 1) * 3 + c];
                    double tolerance = 1e-7 * pow(30, a + b + 1);
                    assert_near(du, su, tolerance * (1 + fabs(su)));
                    assert_near(dv, sv, tolerance * (1 + fabs(sv)));
                }
    }
    pia_model_destroy(model);
}

/* Constant weights change nothing, so the quotient rule must give the polynomial's derivatives, beyond the degree too. */
static void equal_weights_give_the_derivatives_of_the_polynomial(void **state)
{
    (void)state;
    const int degree[] = {2, 3};
    const pia_index control[] = {5, 6};
    uint64_t seed = 3;
    double *u = shape_knots(2, 5, &seed), *v = shape_knots(3, 6, &seed), points[90], weights[30], at[] = {0.3, 0.6};
    const double *const knots[] = {u, v};
    for (int i = 0; i < 90; i++) points[i] = shape_random(&seed);
    for (int i = 0; i < 30; i++) weights[i] = 0.7;
    pia_model *plain = NULL, *rational = NULL;
    assert_ok(NULL, pia_model_create(NULL, 2, degree, knots, control, 3, points, NULL, &plain));
    assert_ok(NULL, pia_model_create(NULL, 2, degree, knots, control, 3, points, weights, &rational));
    double a[28 * 3], b[28 * 3];
    assert_ok(NULL, pia_model_eval(NULL, plain, at, 1, 6, a));
    assert_ok(NULL, pia_model_eval(NULL, rational, at, 1, 6, b));
    for (int i = 0; i < 28 * 3; i++) assert_near(b[i], a[i], 1e-10 * (1 + fabs(a[i])));
    pia_model_destroy(plain);
    pia_model_destroy(rational);
    free(u), free(v);
}

static void t_peer_07_a_huge_order_of_derivative_is_refused_or_served(void **state)
{
    (void)state;
    pia_model *curve = shape_curve(NULL, 3, 8, 2, 1, 1), *surface = shape_surface(NULL, 2, 1, 3, 0, 1);
    enum { ORDER = 60 };
    double at[] = {0.5, 0.5}, out[(ORDER + 1) * 2];
    assert_ok(NULL, pia_model_eval(NULL, curve, at, 1, ORDER, out));
    for (int i = 0; i < (ORDER + 1) * 2; i++) assert_true(isfinite(out[i]));
    assert_status(NULL, pia_model_eval(NULL, surface, at, INT64_MAX / 1000, INT32_MAX, out), PIA_E_SIZE);
    pia_model_destroy(curve);
    pia_model_destroy(surface);
}

static void t_peer_09_derivatives_above_the_degree_are_zero(void **state)
{
    (void)state;
    pia_model *curve = shape_curve(NULL, 3, 8, 2, 0, 1), *surface = shape_surface(NULL, 2, 1, 3, 0, 1);
    enum { ORDER = 40 };
    double at[] = {0.5, 0.5}, *out = malloc((ORDER + 1) * (ORDER + 2) / 2 * 3 * sizeof *out);
    assert_ok(NULL, pia_model_eval(NULL, curve, at, 1, ORDER, out));
    for (int i = 4 * 2; i < (ORDER + 1) * 2; i++) assert_true(out[i] == 0);
    assert_ok(NULL, pia_model_eval(NULL, surface, at, 1, ORDER, out));
    for (int i = 10 * 3; i < (ORDER + 1) * (ORDER + 2) / 2 * 3; i++) assert_true(out[i] == 0);
    free(out);
    pia_model_destroy(curve);
    pia_model_destroy(surface);
}

static void a_left_turn_has_positive_curvature(void **state)
{
    (void)state;
    const double knots[] = {0, 0, 0, 1, 1, 1}, *const all[] = {knots}, weights[] = {1, sqrt(0.5), 1};
    const double left[] = {2, 0, 2, 2, 0, 2}, right[] = {0, 2, 2, 2, 2, 0}, space[] = {2, 0, 5, 2, 2, 5, 0, 2, 5};
    const int degree = 2;
    const pia_index control = 3;
    const double at[] = {0, 0.2, 0.5, 1};
    const struct {
        const double *points;
        int dim;
        double curvature;
    } curve[] = {{left, 2, 0.5}, {right, 2, -0.5}, {space, 3, 0.5}};
    for (int k = 0; k < 3; k++) {
        pia_model *model = NULL;
        double out[4];
        assert_ok(NULL, pia_model_create(NULL, 1, &degree, all, &control, curve[k].dim, curve[k].points, weights, &model));
        assert_ok(NULL, pia_model_curvature(NULL, model, at, 4, out));
        for (int i = 0; i < 4; i++) assert_near(out[i], curve[k].curvature, 1e-14);
        pia_model_destroy(model);
    }
}

/* z = (a x^2 + b y^2) / 2 at the origin: principal curvatures a and b. */
static void a_paraboloid_has_the_curvatures_of_its_coefficients(void **state)
{
    (void)state;
    const double knots[] = {-1, -1, -1, 1, 1, 1}, *const all[] = {knots, knots}, line[] = {-1, 0, 1}, square[] = {1, -1, 1};
    const double a = 3, b = -0.5;
    double points[27], at[] = {0, 0}, out[2];
    for (int i = 0; i < 9; i++) {
        points[3 * i] = line[i / 3];
        points[3 * i + 1] = line[i % 3];
        points[3 * i + 2] = (a * square[i / 3] + b * square[i % 3]) / 2;
    }
    const int degree[] = {2, 2};
    const pia_index control[] = {3, 3};
    pia_model *model = NULL;
    assert_ok(NULL, pia_model_create(NULL, 2, degree, all, control, 3, points, NULL, &model));
    assert_ok(NULL, pia_model_curvature(NULL, model, at, 1, out));
    assert_near(out[0], (a + b) / 2, 1e-14);
    assert_near(out[1], a * b, 1e-14);
    pia_model_destroy(model);
}

static void a_curve_that_stands_still_has_no_curvature(void **state)
{
    (void)state;
    const double knots[] = {0, 0, 0, 1, 1, 1}, *const all[] = {knots}, points[] = {1, 2, 1, 2, 1, 2}, at = 0.5;
    const int degree = 2;
    const pia_index control = 3;
    pia_model *model = NULL;
    double out;
    assert_ok(NULL, pia_model_create(NULL, 1, &degree, all, &control, 2, points, NULL, &model));
    assert_ok(NULL, pia_model_curvature(NULL, model, &at, 1, &out));
    assert_true(isnan(out));
    pia_model_destroy(model);
}

static void curvature_is_refused_where_it_has_no_meaning(void **state)
{
    (void)state;
    pia_model *flat = shape_surface(NULL, 2, 2, 2, 0, 1), *curve = shape_curve(NULL, 3, 8, 1, 0, 1);
    double at[] = {0.5, NAN}, out[2] = {7, 7};
    assert_status(NULL, pia_model_curvature(NULL, flat, at, 1, out), PIA_E_SHAPE);
    assert_status(NULL, pia_model_curvature(NULL, NULL, at, 1, out), PIA_E_ARGUMENT);
    assert_status(NULL, pia_model_curvature(NULL, curve, at, 1, NULL), PIA_E_ARGUMENT);
    assert_status(NULL, pia_model_curvature(NULL, curve, NULL, 1, out), PIA_E_ARGUMENT);
    assert_status(NULL, pia_model_curvature(NULL, curve, at, 2, out), PIA_E_DATA);
    assert_true(out[0] == 7);
    assert_ok(NULL, pia_model_curvature(NULL, curve, at, 1, out));
    assert_near(out[0], 0, 1e-12);
    pia_model_destroy(flat);
    pia_model_destroy(curve);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(derivatives_of_curves_are_limits_of_differences),
        cmocka_unit_test(derivatives_of_a_rational_arc_match_calculus),
        cmocka_unit_test(mixed_derivatives_come_in_the_order_of_the_header),
        cmocka_unit_test(derivatives_of_rational_surfaces_are_limits_of_differences),
        cmocka_unit_test(equal_weights_give_the_derivatives_of_the_polynomial),
        cmocka_unit_test(t_peer_07_a_huge_order_of_derivative_is_refused_or_served),
        cmocka_unit_test(t_peer_09_derivatives_above_the_degree_are_zero),
        cmocka_unit_test(a_left_turn_has_positive_curvature),
        cmocka_unit_test(a_paraboloid_has_the_curvatures_of_its_coefficients),
        cmocka_unit_test(a_curve_that_stands_still_has_no_curvature),
        cmocka_unit_test(curvature_is_refused_where_it_has_no_meaning),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
