#include <math.h>

#include "../memory/failing.h"
#include "shapes.h"

static double distance_at(const pia_model *model, const double *at, const double *point)
{
    pia_model_info info;
    pia_model_get_info(model, &info);
    double out[PIA_MAX_DIM], sum = 0;
    assert_ok(NULL, pia_model_eval(NULL, model, at, 1, 0, out));
    for (int c = 0; c < info.dim; c++) sum += (out[c] - point[c]) * (out[c] - point[c]);
    return sqrt(sum);
}

/* The smallest distance on a raster, then around its best place on ever finer ones. */
static double brute_force(const pia_model *model, const double *point, int raster)
{
    pia_model_info info;
    pia_model_get_info(model, &info);
    double low[2] = {info.domain[0][0], info.domain[1][0]}, high[2] = {info.domain[0][1], info.domain[1][1]}, best = INFINITY;
    for (int round = 0; round < 12; round++) {
        double place[2] = {0, 0};
        int rows = info.directions > 1 ? raster : 0;
        for (int i = 0; i <= raster; i++)
            for (int j = 0; j <= rows; j++) {
                double at[2] = {low[0] + (high[0] - low[0]) * i / raster, low[1] + (high[1] - low[1]) * j / raster};
                double d = distance_at(model, at, point);
                if (d <= best || (i == 0 && j == 0 && round == 0)) {
                    best = d;
                    place[0] = at[0], place[1] = at[1];
                }
            }
        for (int d = 0; d < info.directions; d++) {
            double reach = (high[d] - low[d]) * 2 / raster;
            low[d] = fmax(info.domain[d][0], place[d] - reach);
            high[d] = fmin(info.domain[d][1], place[d] + reach);
        }
        if (round == 0) raster = 20;
    }
    return best;
}

static void check_point(const pia_model *model, const double *point, int raster)
{
    double at[2], distance;
    assert_ok(NULL, pia_model_closest(NULL, model, point, 1, at, &distance));
    assert_near(distance_at(model, at, point), distance, 1e-15 + 1e-14 * distance);
    double brute = brute_force(model, point, raster);
    if (!(distance <= brute + 1e-13 + 1e-12 * brute)) {
        print_error("distance %.17g at (%.17g, %.17g), brute force %.17g\n", distance, at[0], at[1], brute);
        fail();
    }
}

static void curves_agree_with_brute_force(void **state)
{
    (void)state;
    uint64_t seed = 99;
    for (int degree = 1; degree <= 7; degree++)
        for (int dim = 1; dim <= 4; dim++)
            for (int rational = 0; rational <= 1; rational++) {
                pia_model *model = shape_curve(NULL, degree, degree + 7, dim, rational, (uint64_t)(degree * 9 + dim));
                for (int k = 0; k < 8; k++) {
                    double point[4];
                    for (int c = 0; c < dim; c++) point[c] = 4 * shape_random(&seed) - 1;
                    check_point(model, point, 600);
                }
                pia_model_destroy(model);
            }
}

static void surfaces_agree_with_brute_force(void **state)
{
    (void)state;
    uint64_t seed = 7;
    for (int degree = 1; degree <= 4; degree++)
        for (int rational = 0; rational <= 1; rational++) {
            pia_model *model = shape_surface(NULL, degree, 5 - degree, 3, rational, (uint64_t)degree);
            for (int k = 0; k < 3; k++) {
                double point[3];
                for (int c = 0; c < 3; c++) point[c] = 14 * shape_random(&seed) - 2;
                check_point(model, point, 50);
            }
            pia_model_destroy(model);
        }
}

static void points_on_the_shape_are_found_again(void **state)
{
    (void)state;
    for (int degree = 2; degree <= 7; degree++)
        for (int kind = 0; kind < 4; kind++) {
            int surface = kind / 2, rational = kind % 2;
            pia_model *model = surface ? shape_surface(NULL, degree, 3, 3, rational, (uint64_t)degree)
                                       : shape_curve(NULL, degree, 20, 3, rational, (uint64_t)degree);
            for (int k = 0; k <= 20; k++) {
                double at[2] = {k / 20.0, (k * 7 % 20) / 20.0}, point[3], found[2], distance;
                assert_ok(NULL, pia_model_eval(NULL, model, at, 1, 0, point));
                assert_ok(NULL, pia_model_closest(NULL, model, point, 1, found, &distance));
                assert_near(distance, 0, 1e-14 * 8);
                for (int d = 0; d <= surface; d++) assert_near(found[d], at[d], 1e-11);
            }
            pia_model_destroy(model);
        }
}

static pia_model *bezier(int degree, int dim, const double *points, const double *weights)
{
    double knots[2 * (PIA_MAX_DEGREE + 1)];
    for (int k = 0; k <= degree; k++) knots[k] = 0, knots[degree + 1 + k] = 1;
    const double *const all[] = {knots};
    const pia_index control = degree + 1;
    pia_model *model = NULL;
    assert_ok(NULL, pia_model_create(NULL, 1, &degree, all, &control, dim, points, weights, &model));
    return model;
}

static void points_beyond_the_ends_belong_to_the_ends(void **state)
{
    (void)state;
    const double points[] = {0, 0, 1, 1, 2, 1, 3, 0}, before[] = {-2, -3}, after[] = {6, -4};
    pia_model *model = bezier(3, 2, points, NULL);
    double at, distance;
    assert_ok(NULL, pia_model_closest(NULL, model, before, 1, &at, &distance));
    assert_true(at == 0);
    assert_near(distance, hypot(2, 3), 1e-15);
    assert_ok(NULL, pia_model_closest(NULL, model, after, 1, &at, &distance));
    assert_true(at == 1);
    assert_near(distance, 5, 1e-15);
    pia_model_destroy(model);
}

static void a_cusp_is_found(void **state)
{
    (void)state;
    const double points[] = {0, 0, 1, 1, 0, 1, 1, 0}, above[] = {0.5, 2}, at_cusp[] = {0.5, 0.75}; /* cusp at t = 1/2 */
    pia_model *model = bezier(3, 2, points, NULL);
    double at, distance;
    assert_ok(NULL, pia_model_closest(NULL, model, above, 1, &at, &distance));
    assert_near(at, 0.5, 1e-6);
    assert_near(distance, 1.25, 1e-12);
    assert_ok(NULL, pia_model_closest(NULL, model, at_cusp, 1, &at, &distance));
    assert_near(distance, 0, 1e-12);
    pia_model_destroy(model);
}

static void the_centre_of_a_circle_is_as_far_from_every_point(void **state)
{
    (void)state;
    const double h = sqrt(0.5), points[] = {1, 0, 1, 1, 0, 1}, weights[] = {1, h, 1}, centre[] = {0, 0}, inside[] = {0.3, 0.4},
                 outside[] = {30, 40};
    pia_model *model = bezier(2, 2, points, weights);
    double at, distance;
    assert_ok(NULL, pia_model_closest(NULL, model, centre, 1, &at, &distance));
    assert_near(distance, 1, 1e-15 * 2);
    assert_ok(NULL, pia_model_closest(NULL, model, inside, 1, &at, &distance));
    assert_near(distance, 0.5, 1e-15 * 2);
    assert_ok(NULL, pia_model_closest(NULL, model, outside, 1, &at, &distance));
    assert_near(distance, 49, 1e-14);
    pia_model_destroy(model);
}

/* Half a cylinder: its axis is as far from every point, and points beside it have whole lines of equal distance. */
static void the_axis_of_a_cylinder_takes_no_longer(void **state)
{
    (void)state;
    const double u[] = {0, 0, 0, 1, 1, 1}, v[] = {0, 0, 1, 1}, h = sqrt(0.5);
    const double points[] = {1, 0, 0, 1, 0, 5, 1, 1, 0, 1, 1, 5, 0, 1, 0, 0, 1, 5}, weights[] = {1, 1, h, h, 1, 1};
    const double *const knots[] = {u, v};
    const int degree[] = {2, 1};
    const pia_index control[] = {3, 2};
    pia_model *model = NULL;
    assert_ok(NULL, pia_model_create(NULL, 2, degree, knots, control, 3, points, weights, &model));
    const double queries[] = {0, 0, 2.5, 0.3, 0.4, 1, 3, 4, 4, 0.6, 0.8, 7};
    const double expected[] = {1, 0.5, 4, 2};
    double distance[4];
    assert_ok(NULL, pia_model_closest(NULL, model, queries, 4, NULL, distance));
    for (int i = 0; i < 4; i++) assert_near(distance[i], expected[i], 1e-14);
    pia_model_destroy(model);
}

static void tiny_huge_and_far_off_coordinates_are_served(void **state)
{
    (void)state;
    const double scales[] = {1e-150, 1e-9, 1, 1e9, 1e150};
    const double offsets[] = {0, 0, 1e6, 0, 0};
    for (int k = 0; k < 5; k++) {
        double points[8] = {0, 0, 1, 2, 3, -1, 4, 0.5}, query[] = {1.7, 0.9}, at, distance, first_at, first;
        pia_model *plain = bezier(3, 2, points, NULL);
        assert_ok(NULL, pia_model_closest(NULL, plain, query, 1, &first_at, &first));
        for (int i = 0; i < 8; i++) points[i] = points[i] * scales[k] + offsets[k];
        for (int i = 0; i < 2; i++) query[i] = query[i] * scales[k] + offsets[k];
        pia_model *model = bezier(3, 2, points, NULL);
        assert_ok(NULL, pia_model_closest(NULL, model, query, 1, &at, &distance));
        assert_near(distance / scales[k], first, offsets[k] > 0 ? 1e-9 : 1e-14);
        assert_near(at, first_at, offsets[k] > 0 ? 1e-9 : 1e-12);
        pia_model_destroy(plain);
        pia_model_destroy(model);
    }
}

static void a_model_that_is_one_point_has_that_distance(void **state)
{
    (void)state;
    const double points[] = {3, 4, 3, 4, 3, 4, 3, 4}, queries[] = {0, 0, 3, 4};
    pia_model *model = bezier(3, 2, points, NULL);
    double distance[2];
    assert_ok(NULL, pia_model_closest(NULL, model, queries, 2, NULL, distance));
    assert_near(distance[0], 5, 1e-15);
    assert_true(distance[1] == 0);
    pia_model_destroy(model);
}

static void high_degrees_are_served(void **state)
{
    (void)state;
    uint64_t seed = 3;
    pia_model *model = shape_curve(NULL, 25, 30, 2, 1, 5);
    for (int k = 0; k < 6; k++) {
        double point[] = {6 * shape_random(&seed), 6 * shape_random(&seed)};
        check_point(model, point, 1000);
    }
    pia_model_destroy(model);
}

static void bad_points_are_refused(void **state)
{
    (void)state;
    pia_context *context = NULL;
    assert_ok(NULL, pia_context_create(NULL, &context));
    pia_model *model = shape_curve(context, 3, 10, 2, 0, 1);
    double points[] = {0, 1, 0, NAN}, far[] = {1e308, -1e308}, at[2];
    assert_status(context, pia_model_closest(context, model, points, 2, at, NULL), PIA_E_DATA);
    assert_non_null(strstr(pia_message(context), "point 1"));
    assert_status(context, pia_model_closest(context, model, NULL, 1, at, NULL), PIA_E_ARGUMENT);
    assert_status(context, pia_model_closest(context, model, points, INT64_MAX / 2, at, NULL), PIA_E_SIZE);
    assert_status(context, pia_model_closest(context, model, points, -1, at, NULL), PIA_E_ARGUMENT);
    assert_status(context, pia_model_closest(context, NULL, points, 1, at, NULL), PIA_E_ARGUMENT);
    assert_ok(context, pia_model_closest(context, model, points, 0, at, NULL));
    assert_ok(context, pia_model_closest(context, model, far, 1, at, NULL));
    const double wide[] = {-1e308, 0, 0, 0};
    pia_model *huge = bezier(1, 2, wide, NULL);
    assert_status(context, pia_model_closest(context, huge, far, 1, at, NULL), PIA_E_DATA);
    pia_model_destroy(huge);
    pia_model_destroy(model);
    pia_context_destroy(context);
}

enum { MANY = 2000 };

static void thread_counts_and_batches_change_no_bit(void **state)
{
    (void)state;
    pia_model *model = shape_curve(NULL, 3, 200, 3, 0, 9);
    double *points = malloc(MANY * 3 * sizeof *points), *at = malloc(MANY * sizeof *at), *first = malloc(MANY * sizeof *first);
    uint64_t seed = 4;
    for (int i = 0; i < MANY * 3; i++) points[i] = 40 * shape_random(&seed);
    const int threads[] = {1, 2, 3, 8};
    for (int k = 0; k < 4; k++) {
        pia_context *context = NULL;
        assert_ok(NULL, pia_context_create(NULL, &context));
        assert_ok(context, pia_context_set_threads(context, threads[k]));
        assert_ok(context, pia_model_closest(context, model, points, MANY, k == 0 ? first : at, NULL));
        if (k > 0) assert_memory_equal(at, first, MANY * sizeof *at);
        pia_context_destroy(context);
    }
    for (int i = 0; i < 20; i++) {
        assert_ok(NULL, pia_model_closest(NULL, model, points + 3 * i, 1, at, NULL));
        assert_true(at[0] == first[i]);
    }
    pia_model_destroy(model);
    free(points), free(at), free(first);
}

static pia_status look_up(pia_context *context, void *user)
{
    const double point[] = {0, 0, 0};
    return pia_model_closest(context, user, point, 1, NULL, NULL);
}

static void closest_points_survive_every_failed_allocation(void **state)
{
    (void)state;
    pia_model *model = shape_surface(NULL, 3, 2, 3, 0, 1);
    assert_survives_failures(look_up, model);
    pia_model_destroy(model);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(curves_agree_with_brute_force),
        cmocka_unit_test(surfaces_agree_with_brute_force),
        cmocka_unit_test(points_on_the_shape_are_found_again),
        cmocka_unit_test(points_beyond_the_ends_belong_to_the_ends),
        cmocka_unit_test(a_cusp_is_found),
        cmocka_unit_test(the_centre_of_a_circle_is_as_far_from_every_point),
        cmocka_unit_test(the_axis_of_a_cylinder_takes_no_longer),
        cmocka_unit_test(tiny_huge_and_far_off_coordinates_are_served),
        cmocka_unit_test(a_model_that_is_one_point_has_that_distance),
        cmocka_unit_test(high_degrees_are_served),
        cmocka_unit_test(bad_points_are_refused),
        cmocka_unit_test(thread_counts_and_batches_change_no_bit),
        cmocka_unit_test(closest_points_survive_every_failed_allocation),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
