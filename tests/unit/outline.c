/* Where points end: distances, contours, hulls and alpha shapes against brute force and against shapes whose area is known. */
#include "context_fixture.h"

#include "hull.h"
#include "outline.h"

#include <stdlib.h>

static double random_share(uint64_t *state)
{
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return (double)(*state >> 11) / 9007199254740992.0;
}

static void distances_are_those_to_the_nearest_site(void **state)
{
    enum { N = 23, M = 31 };
    static double square[N * M];
    const pia_raster raster = {{N, M}, {0.5, 0.7}};
    uint64_t seed = 3;
    for (int i = 0; i < N * M; i++) square[i] = random_share(&seed) < 0.02 ? 0 : INFINITY;
    double sites[N * M];
    memcpy(sites, square, sizeof sites);
    assert_ok(*state, pia_distance_map(*state, &raster, square));
    for (int i = 0; i < N * M; i++) {
        double best = INFINITY;
        for (int j = 0; j < N * M; j++)
            if (sites[j] == 0) best = fmin(best, pow(0.5 * (i / M - j / M), 2) + pow(0.7 * (i % M - j % M), 2));
        assert_near(square[i], best, 1e-12);
    }
    for (int i = 0; i < N * M; i++) square[i] = INFINITY;
    assert_ok(*state, pia_distance_map(*state, &raster, square));
    assert_true(isinf(square[5]));
}

/* Sum of signed areas, and that no vertex is met twice. */
static double total_area(const pia_loops *loops)
{
    double sum = 0;
    const double *at = loops->at;
    for (pia_index k = 0; k < loops->loop_count; at += 2 * loops->vertex_count[k++]) sum += pia_loop_area(at, loops->vertex_count[k]);
    for (pia_index i = 0; i < loops->vertex_total; i++)
        for (pia_index j = 0; j < i; j++)
            assert_true(loops->at[2 * i] != loops->at[2 * j] || loops->at[2 * i + 1] != loops->at[2 * j + 1]);
    return sum;
}

static void contours_run_around_what_is_positive_with_holes_the_other_way(void **state)
{
    enum { N = 61 };
    static double value[N * N];
    const pia_raster raster = {{N, N}, {1.0 / 30, 1.0 / 30}};
    const double pi = acos(-1);
    for (int i = 0; i < N * N; i++) {
        double r = hypot(i / N / 30.0 - 1, i % N / 30.0 - 1);
        value[i] = fmin(0.9 - r, r - 0.4); /* a ring */
    }
    pia_loops loops;
    assert_ok(*state, pia_contour(*state, &raster, value, &loops));
    assert_int_equal(loops.loop_count, 2);
    assert_near(total_area(&loops), pi * (0.81 - 0.16), 0.01);
    assert_true(pia_loop_area(loops.at, loops.vertex_count[0]) *
                    pia_loop_area(loops.at + 2 * loops.vertex_count[0], loops.vertex_count[1]) <
                0);
    pia_loops_clear(*state, &loops);
    for (int i = 0; i < N * N; i++) value[i] = 1;
    assert_ok(*state, pia_contour(*state, &raster, value, &loops));
    assert_int_equal(loops.loop_count, 1);
    assert_near(total_area(&loops), 4, 1e-12);
    unsigned char keep[4 * N];
    assert_int_equal(pia_loop_simplify(loops.at, loops.vertex_count[0], 1e-9, keep), 4);
    assert_near(pia_loop_area(loops.at, 4), 4, 1e-12);
    pia_loops_clear(*state, &loops);
    uint64_t seed = 9;
    for (int i = 0; i < N * N; i++) value[i] = random_share(&seed) - 0.4; /* corners that meet, single nodes, the border */
    assert_ok(*state, pia_contour(*state, &raster, value, &loops));
    assert_true(loops.loop_count > 50);
    assert_true(total_area(&loops) > 0);
    pia_loops_clear(*state, &loops);
}

static void hulls_hold_all_points_and_turn_left(void **state)
{
    enum { N = 300 };
    double at[2 * N], hull[2 * N];
    uint64_t seed = 5;
    pia_index corners;
    for (int i = 0; i < 2 * N; i++) at[i] = hull[i] = floor(20 * random_share(&seed)); /* many on common lines, some repeated */
    assert_ok(*state, pia_hull(*state, hull, N, &corners));
    for (pia_index k = 0; k < corners; k++) {
        const double *a = hull + 2 * k, *b = hull + 2 * ((k + 1) % corners), *c = hull + 2 * ((k + 2) % corners);
        assert_true((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]) > 0);
        for (int i = 0; i < N; i++) assert_true((b[0] - a[0]) * (at[2 * i + 1] - a[1]) - (b[1] - a[1]) * (at[2 * i] - a[0]) >= 0);
    }
    for (int i = 0; i < N; i++) hull[2 * i] = hull[2 * i + 1] = i;
    assert_status(*state, pia_hull(*state, hull, N, &corners), PIA_E_DATA);
}

/* A bent plate over [0,3] x [0,2] with points where `there` says so. */
typedef int shape(double x, double y);

static int is_ring(double x, double y)
{
    double r = hypot(x - 1.5, y - 1);
    return r < 0.9 && r > 0.4;
}

static int is_everywhere(double x, double y)
{
    return x >= 0 && y >= 0;
}

static int is_two_islands(double x, double y)
{
    return hypot(x - 0.8, y - 1) < 0.7 || hypot(x - 2.5, y - 1) < 0.3;
}

enum { POINTS = 4000 };
static double parameters[2 * POINTS];

static pia_model *plate(pia_context *context)
{
    static const double ends[] = {0, 0, 1, 1}, control[] = {0, 0, 0, 0, 2, 0, 3, 0, 0, 3, 2, 0};
    const double *knots[] = {ends, ends};
    pia_model *model;
    assert_ok(context, pia_model_create(context, 2, (int[]){1, 1}, knots, (pia_index[]){2, 2}, 3, control, NULL, &model));
    return model;
}

static pia_model *trimmed(pia_context *context, shape *there, const pia_outline_options *options)
{
    pia_model *whole = plate(context), *out;
    uint64_t seed = 1;
    for (int i = 0; i < POINTS;) {
        double u = random_share(&seed), v = random_share(&seed);
        if (!there(3 * u, 2 * v)) continue;
        parameters[2 * i] = u;
        parameters[2 * i++ + 1] = v;
    }
    assert_ok(context, pia_model_trim_to_points(context, whole, parameters, POINTS, options, &out));
    pia_model_destroy(whole);
    return out;
}

static double area_of(const pia_model *model)
{
    double sum = 0;
    for (pia_index k = 0, count; k < pia_model_trim_loop_count(model); k++) {
        const double *at = pia_model_trim_loop(model, k, &count);
        sum += 6 * pia_loop_area(at, count);
    }
    return sum;
}

static void alpha_shapes_end_where_the_points_end(void **state)
{
    const double pi = acos(-1);
    pia_model *model = trimmed(*state, is_ring, NULL);
    assert_int_equal(pia_model_trim_loop_count(model), 2);
    assert_near(area_of(model), pi * (0.81 - 0.16), 0.06 * pi * (0.81 - 0.16));
    for (int i = 0; i < POINTS; i++) assert_true(pia_model_trim_contains(model, parameters[2 * i], parameters[2 * i + 1]));
    pia_model_destroy(model);
    model = trimmed(*state, is_everywhere, NULL);
    assert_true(pia_model_trim_loop_count(model) == 0 || area_of(model) > 0.97 * 6);
    pia_model_destroy(model);
    model = trimmed(*state, is_two_islands, NULL);
    assert_int_equal(pia_model_trim_loop_count(model), 1);
    assert_near(area_of(model), pi * 0.49, 0.06 * pi * 0.49);
    pia_model_destroy(model);
    pia_outline_options wide = {.struct_size = sizeof wide, .radius = 0.45};
    model = trimmed(*state, is_ring, &wide); /* no disc of that radius fits into the hole */
    assert_int_equal(pia_model_trim_loop_count(model), 1);
    assert_near(area_of(model), pi * 0.81, 0.04 * pi * 0.81);
    pia_model_destroy(model);
}

static void convex_hulls_have_no_holes(void **state)
{
    pia_outline_options hull = {.struct_size = sizeof hull, .hull = 1};
    pia_model *model = trimmed(*state, is_ring, &hull);
    assert_int_equal(pia_model_trim_loop_count(model), 1);
    assert_near(area_of(model), acos(-1) * 0.81, 0.03 * acos(-1) * 0.81);
    pia_model_destroy(model);
}

static void wrong_arguments_are_refused(void **state)
{
    pia_model *model = plate(*state), *out = NULL;
    double bad[] = {0.1, 0.1, 0.5, NAN, 0.2, 0.9};
    pia_outline_options negative = {.struct_size = sizeof negative, .radius = -1};
    assert_status(*state, pia_model_trim_to_points(*state, model, bad, 3, NULL, &out), PIA_E_DATA);
    assert_status(*state, pia_model_trim_to_points(*state, model, bad, 2, NULL, &out), PIA_E_ARGUMENT);
    assert_status(*state, pia_model_trim_to_points(*state, model, bad, 3, &negative, &out), PIA_E_ARGUMENT);
    assert_null(out);
    pia_model_destroy(model);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(distances_are_those_to_the_nearest_site),
        cmocka_unit_test(contours_run_around_what_is_positive_with_holes_the_other_way),
        cmocka_unit_test(hulls_hold_all_points_and_turn_left),
        cmocka_unit_test(alpha_shapes_end_where_the_points_end),
        cmocka_unit_test(convex_hulls_have_no_holes),
        cmocka_unit_test(wrong_arguments_are_refused),
    };
    return cmocka_run_group_tests(tests, open_context, close_context);
}
