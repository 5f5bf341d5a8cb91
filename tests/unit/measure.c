#include <math.h>

#include "../memory/failing.h"
#include "shapes.h"

static pia_model *arc(double radius)
{
    const double knots[] = {0, 0, 0, 1, 1, 1}, points[] = {radius, 0, radius, radius, 0, radius}, weights[] = {1, sqrt(0.5), 1};
    const double *const all[] = {knots};
    const int degree = 2;
    const pia_index control = 3;
    pia_model *model = NULL;
    assert_ok(NULL, pia_model_create(NULL, 1, &degree, all, &control, 2, points, weights, &model));
    return model;
}

static pia_model *polynomial(int degree, int dim, const double *points)
{
    double knots[52];
    for (int k = 0; k <= degree; k++) knots[k] = 0, knots[degree + 1 + k] = 1;
    const double *const all[] = {knots};
    const pia_index control = degree + 1;
    pia_model *model = NULL;
    assert_ok(NULL, pia_model_create(NULL, 1, &degree, all, &control, dim, points, NULL, &model));
    return model;
}

static void lengths_of_known_curves(void **state)
{
    (void)state;
    double length;
    const double scales[] = {1e-160, 1e-9, 1, 1e9, 1e160};
    for (int k = 0; k < 5; k++) {
        pia_model *model = arc(scales[k]);
        assert_ok(NULL, pia_model_length(NULL, model, &length));
        assert_near(length / scales[k], acos(0), 1e-14);
        pia_model_destroy(model);
    }
    const double parabola[] = {0, 0, 0.5, 0, 1, 1}, line[] = {0, 0, 0, 1, 2, 2, 3, 6, 6}, cusp[] = {0, 0, 1, 1, 0, 1, 1, 0};
    pia_model *model = polynomial(2, 2, parabola);
    assert_ok(NULL, pia_model_length(NULL, model, &length));
    assert_near(length, (2 * sqrt(5) + asinh(2)) / 4, 1e-14);
    pia_model_destroy(model);
    model = polynomial(2, 3, line);
    assert_ok(NULL, pia_model_length(NULL, model, &length));
    assert_near(length, 9, 1e-14);
    pia_model_destroy(model);
    /* x' = 3 (1 - 2t)^2, y' = 3 (1 - 2t): with s = 1 - 2t the length is 3 times the integral of s sqrt(s^2 + 1) over [0, 1]. */
    model = polynomial(3, 2, cusp);
    assert_ok(NULL, pia_model_length(NULL, model, &length));
    assert_near(length, 2 * sqrt(2) - 1, 1e-11);
    pia_model_destroy(model);
}

static void the_length_of_a_polygon_is_the_sum_of_its_sides(void **state)
{
    (void)state;
    enum { COUNT = 500 };
    pia_model *model = shape_curve(NULL, 1, COUNT, 3, 0, 4);
    double points[COUNT * 3], length, expected = 0;
    pia_model_control(model, points, NULL);
    for (int i = 1; i < COUNT; i++) {
        double sum = 0;
        for (int c = 0; c < 3; c++) sum += (points[3 * i + c] - points[3 * i + c - 3]) * (points[3 * i + c] - points[3 * i + c - 3]);
        expected += sqrt(sum);
    }
    assert_ok(NULL, pia_model_length(NULL, model, &length));
    assert_near(length, expected, 1e-13 * expected);
    pia_model_destroy(model);
}

static void the_length_stays_when_the_form_changes(void **state)
{
    (void)state;
    for (int degree = 2; degree <= 7; degree++)
        for (int rational = 0; rational <= 1; rational++) {
            pia_model *model = shape_curve(NULL, degree, degree + 12, 3, rational, (uint64_t)degree), *pieces = NULL, *left = NULL,
                      *right = NULL;
            double whole, again, part[2];
            assert_ok(NULL, pia_model_length(NULL, model, &whole));
            assert_ok(NULL, pia_model_bezier(NULL, model, &pieces));
            assert_ok(NULL, pia_model_length(NULL, pieces, &again));
            assert_near(again, whole, 1e-11 * whole);
            assert_ok(NULL, pia_model_split(NULL, model, 0, 0.4321, &left, &right));
            assert_ok(NULL, pia_model_length(NULL, left, &part[0]));
            assert_ok(NULL, pia_model_length(NULL, right, &part[1]));
            assert_near(part[0] + part[1], whole, 1e-10 * whole);
            pia_model_destroy(model);
            pia_model_destroy(pieces);
            pia_model_destroy(left);
            pia_model_destroy(right);
        }
}

/* Where spans are short and coordinates large the speed is noise in its last digits, which must not be chased. */
static void a_place_far_from_the_origin_changes_no_length(void **state)
{
    (void)state;
    enum { COUNT = 1000, DEGREE = 3 };
    const int degree = DEGREE;
    const pia_index control = COUNT;
    double knots[COUNT + DEGREE + 1], points[COUNT * 2], length[2] = {0, 0};
    for (int i = 0; i < COUNT + DEGREE + 1; i++) knots[i] = fmin(fmax(i - DEGREE, 0), COUNT - DEGREE);
    for (int far = 0; far < 2; far++) {
        for (int i = 0; i < COUNT; i++) {
            points[2 * i] = sin(0.1 * i) + far * 5e6;
            points[2 * i + 1] = cos(0.13 * i) + far * 5e6;
        }
        pia_model *model = NULL;
        assert_ok(NULL, pia_model_create(NULL, 1, &degree, (const double *const[]){knots}, &control, 2, points, NULL, &model));
        assert_ok(NULL, pia_model_length(NULL, model, &length[far]));
        pia_model_destroy(model);
    }
    assert_near(length[1], length[0], 1e-8 * length[0]);
}

static void a_point_has_length_zero_and_a_surface_none(void **state)
{
    (void)state;
    const double points[] = {1, 2, 1, 2, 1, 2};
    double length = 7;
    pia_model *model = polynomial(2, 2, points), *surface = shape_surface(NULL, 2, 2, 3, 0, 1);
    assert_ok(NULL, pia_model_length(NULL, model, &length));
    assert_true(length == 0);
    assert_status(NULL, pia_model_length(NULL, surface, &length), PIA_E_ARGUMENT);
    assert_status(NULL, pia_model_length(NULL, NULL, &length), PIA_E_ARGUMENT);
    assert_status(NULL, pia_model_length(NULL, model, NULL), PIA_E_ARGUMENT);
    pia_model_destroy(model);
    pia_model_destroy(surface);
}

static void the_box_of_an_arc_touches_it(void **state)
{
    (void)state;
    pia_model *model = arc(2);
    double low[2], high[2];
    assert_ok(NULL, pia_model_bounds(NULL, model, low, high));
    for (int c = 0; c < 2; c++) {
        assert_near(low[c], 0, 1e-15);
        assert_near(high[c], 2, 1e-15);
    }
    pia_model_destroy(model);
}

static void the_box_of_a_parabola_reaches_its_vertex(void **state)
{
    (void)state;
    const double points[] = {0, 0, 0.3, 1, 1, -0.5}; /* y = 2 t (1 - t) - t^2 / 2: highest at t = 0.4 */
    pia_model *model = polynomial(2, 2, points);
    double low[2], high[2];
    assert_ok(NULL, pia_model_bounds(NULL, model, low, high));
    assert_near(low[0], 0, 1e-16);
    assert_near(high[0], 1, 1e-15);
    assert_near(low[1], -0.5, 1e-15);
    assert_near(high[1], 0.4, 1e-13);
    pia_model_destroy(model);
}

/* Places of one direction: `raster` in every span, so that each knot, where a kink may be, is one of them. */
static pia_index places(const pia_model *model, int direction, int raster, double *out)
{
    pia_model_info info;
    pia_model_get_info(model, &info);
    const double *knots = pia_model_knots(model, direction);
    pia_index count = 0;
    for (pia_index s = info.degree[direction]; direction < info.directions && s < info.control[direction]; s++)
        for (int k = 0; k < raster && knots[s] < knots[s + 1]; k++) out[count++] = knots[s] + (knots[s + 1] - knots[s]) * k / raster;
    out[count++] = info.domain[direction][1];
    return count;
}

static void check_box(const pia_model *model, int raster)
{
    pia_model_info info;
    pia_model_get_info(model, &info);
    double low[PIA_MAX_DIM], high[PIA_MAX_DIM], least[PIA_MAX_DIM], most[PIA_MAX_DIM], out[PIA_MAX_DIM];
    double *u = malloc(60000 * sizeof *u), *v = malloc(60000 * sizeof *v);
    pia_index rows = places(model, 0, raster, u), columns = places(model, 1, raster, v);
    assert_ok(NULL, pia_model_bounds(NULL, model, low, high));
    for (int c = 0; c < info.dim; c++) least[c] = INFINITY, most[c] = -INFINITY;
    for (pia_index i = 0; i < rows; i++)
        for (pia_index j = 0; j < columns; j++) {
            double at[] = {u[i], v[j]};
            assert_ok(NULL, pia_model_eval(NULL, model, at, 1, 0, out));
            for (int c = 0; c < info.dim; c++) {
                least[c] = fmin(least[c], out[c]);
                most[c] = fmax(most[c], out[c]);
            }
        }
    for (int c = 0; c < info.dim; c++) {
        double range = most[c] - least[c], tight = 10.0 / raster / raster * range;
        assert_true(low[c] <= least[c] + 1e-13 * range && low[c] >= least[c] - tight);
        assert_true(high[c] >= most[c] - 1e-13 * range && high[c] <= most[c] + tight);
    }
    free(u), free(v);
}

static void boxes_hold_the_shape_and_no_more(void **state)
{
    (void)state;
    for (int degree = 1; degree <= 7; degree++)
        for (int rational = 0; rational <= 1; rational++) {
            pia_model *model = shape_curve(NULL, degree, degree + 9, 3, rational, (uint64_t)degree);
            check_box(model, 300);
            pia_model_destroy(model);
            if (degree > 4) continue;
            model = shape_surface(NULL, degree, 5 - degree, 3, rational, (uint64_t)degree);
            check_box(model, 20);
            pia_model_destroy(model);
        }
    pia_model *high = shape_curve(NULL, 25, 40, 2, 1, 3);
    check_box(high, 100);
    pia_model_destroy(high);
}

/* The highest place of z = 1 - (x - y)^2 is a diagonal of the domain: every part along it comes as near. */
static void a_diagonal_ridge_takes_no_longer(void **state)
{
    (void)state;
    const double knots[] = {0, 0, 0, 1, 1, 1}, *const all[] = {knots, knots};
    const double z[] = {1, 1, 0, 1, 1.5, 1, 0, 1, 1};
    const int degree[] = {2, 2};
    const pia_index control[] = {3, 3};
    pia_model *model = NULL;
    double low, high;
    assert_ok(NULL, pia_model_create(NULL, 2, degree, all, control, 1, z, NULL, &model));
    assert_ok(NULL, pia_model_bounds(NULL, model, &low, &high));
    assert_near(low, 0, 1e-13);
    assert_near(high, 1, 1e-13);
    assert_status(NULL, pia_model_bounds(NULL, NULL, &low, &high), PIA_E_ARGUMENT);
    assert_status(NULL, pia_model_bounds(NULL, model, NULL, &high), PIA_E_ARGUMENT);
    assert_status(NULL, pia_model_bounds(NULL, model, &low, NULL), PIA_E_ARGUMENT);
    pia_model_destroy(model);
}

static pia_status measure(pia_context *context, void *user)
{
    double low[3], high[3], length;
    pia_status status = pia_model_length(context, user, &length);
    return status == PIA_OK ? pia_model_bounds(context, user, low, high) : status;
}

static void measuring_survives_every_failed_allocation(void **state)
{
    (void)state;
    pia_model *model = shape_curve(NULL, 3, 9, 3, 0, 1);
    assert_survives_failures(measure, model);
    pia_model_destroy(model);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lengths_of_known_curves),
        cmocka_unit_test(the_length_of_a_polygon_is_the_sum_of_its_sides),
        cmocka_unit_test(the_length_stays_when_the_form_changes),
        cmocka_unit_test(a_place_far_from_the_origin_changes_no_length),
        cmocka_unit_test(a_point_has_length_zero_and_a_surface_none),
        cmocka_unit_test(the_box_of_an_arc_touches_it),
        cmocka_unit_test(the_box_of_a_parabola_reaches_its_vertex),
        cmocka_unit_test(boxes_hold_the_shape_and_no_more),
        cmocka_unit_test(a_diagonal_ridge_takes_no_longer),
        cmocka_unit_test(measuring_survives_every_failed_allocation),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
