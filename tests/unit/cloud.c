/* Parameters of scattered points on base surfaces. */
#include "context_fixture.h"

#include "cloud.h"

#include <stdlib.h>

enum { COUNT = 2000 };

static double random_share(uint64_t *state)
{
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return (double)(*state >> 11) / 9007199254740992.0;
}

/* Points of a cylinder about (1, 2, 2) / 3 through (5, 6, 7), over `turn` of the circle. */
static void cylinder(double *points, double *truth, double turn)
{
    static const double x[3] = {2.0 / 3, 1.0 / 3, -2.0 / 3}, y[3] = {-2.0 / 3, 2.0 / 3, -1.0 / 3}, z[3] = {1.0 / 3, 2.0 / 3, 2.0 / 3};
    uint64_t state = 7;
    for (int i = 0; i < COUNT; i++) {
        double a = 6.283185307179586 * turn * random_share(&state), h = 9 * random_share(&state);
        for (int d = 0; d < 3; d++) points[3 * i + d] = 5 + d + 2 * cos(a) * x[d] + 2 * sin(a) * y[d] + h * z[d];
        truth[2 * i] = a / 6.283185307179586;
        truth[2 * i + 1] = h / 9;
    }
}

/* Whether one column follows the truth up to direction, shift around the turn and range. */
static void follows(const double *uv, const double *truth, int column, int around)
{
    double worst = 1;
    for (int flip = 0; flip < 2; flip++) {
        double start = 0, largest = 0;
        for (int i = 0; i < COUNT; i++) {
            double difference = uv[2 * i + column] - (flip ? -1 : 1) * truth[2 * i + column];
            if (around) difference -= floor(difference);
            if (i == 0) start = difference;
            double off = fabs(difference - start);
            if (around && off > 0.5) off = 1 - off;
            largest = fmax(largest, off);
        }
        worst = fmin(worst, largest);
    }
    assert_true(worst < 0.02);
}

static void a_whole_cylinder_is_closed_and_a_half_one_is_not(void **state)
{
    static double points[3 * COUNT], truth[2 * COUNT], uv[2 * COUNT];
    int closed;
    cylinder(points, truth, 1);
    assert_ok(*state, pia_cloud_find("cylinder")->compute(*state, points, COUNT, 3, uv, &closed));
    assert_int_equal(closed, 1);
    follows(uv, truth, 0, 1);
    follows(uv, truth, 1, 0);
    cylinder(points, truth, 0.5);
    assert_ok(*state, pia_cloud_find("cylinder")->compute(*state, points, COUNT, 3, uv, &closed));
    assert_int_equal(closed, 0);
    for (int i = 0; i < COUNT; i++) truth[2 * i] *= 2;
    follows(uv, truth, 0, 0);
}

static void a_sphere_has_longitude_and_latitude(void **state)
{
    static double points[3 * COUNT], uv[2 * COUNT];
    uint64_t seed = 3;
    int closed;
    for (int i = 0; i < COUNT; i++) {
        double z = 2 * random_share(&seed) - 1, a = 6.283185307179586 * random_share(&seed), r = sqrt(1 - z * z);
        points[3 * i] = 100 + 3 * r * cos(a);
        points[3 * i + 1] = -50 + 3 * r * sin(a);
        points[3 * i + 2] = 3 * z;
    }
    assert_ok(*state, pia_cloud_find("sphere")->compute(*state, points, COUNT, 3, uv, &closed));
    assert_int_equal(closed, 1);
    for (int i = 0; i < COUNT; i++) { /* two points with the same parameters are the same point */
        assert_true(uv[2 * i] >= 0 && uv[2 * i] < 1 && uv[2 * i + 1] >= 0 && uv[2 * i + 1] <= 1);
        for (int j = 0; j < i && j < 200; j++) {
            double du = fabs(uv[2 * i] - uv[2 * j]), dv = fabs(uv[2 * i + 1] - uv[2 * j + 1]), square = 0;
            for (int d = 0; d < 3; d++) square += pow(points[3 * i + d] - points[3 * j + d], 2);
            if (du < 1e-3 && dv < 1e-3) assert_true(sqrt(square) < 0.05);
        }
    }
}

/* Points of the part of a sphere above a height, its top towards (1, 2, 2) / 3. */
static void dome(double *points, double height)
{
    static const double x[3] = {2.0 / 3, 1.0 / 3, -2.0 / 3}, y[3] = {-2.0 / 3, 2.0 / 3, -1.0 / 3}, z[3] = {1.0 / 3, 2.0 / 3, 2.0 / 3};
    uint64_t seed = 5;
    for (int i = 0; i < COUNT; i++) {
        double h = height + (1 - height) * random_share(&seed), a = 6.283185307179586 * random_share(&seed), r = sqrt(1 - h * h);
        for (int d = 0; d < 3; d++) points[3 * i + d] = 7 * d + 4 * (r * cos(a) * x[d] + r * sin(a) * y[d] + h * z[d]);
    }
}

/* Neighbours on a dome are neighbours in the parameters, and the other way round: no pole and no seam among the points. */
static void a_dome_is_a_disc(void **state)
{
    static double points[3 * COUNT], uv[2 * COUNT];
    const double height[] = {0.3, 0, -0.4, -0.8};
    for (int k = 0; k < 4; k++) {
        int closed;
        dome(points, height[k]);
        assert_ok(*state, pia_cloud_find("sphere")->compute(*state, points, COUNT, 3, uv, &closed));
        assert_int_equal(closed, 0);
        double least = INFINITY, most = 0;
        for (int i = 0; i < COUNT; i++)
            for (int j = 0; j < i; j++) {
                double square = 0;
                for (int d = 0; d < 3; d++) square += pow(points[3 * i + d] - points[3 * j + d], 2);
                if (square > 1 || square < 1e-6) continue;
                double stretch = hypot(uv[2 * i] - uv[2 * j], uv[2 * i + 1] - uv[2 * j + 1]) / sqrt(square);
                least = fmin(least, stretch);
                most = fmax(most, stretch);
            }
        assert_true(most < 6 * least);
    }
}

static void a_tilted_sheet_is_flat_on_its_best_plane_and_seen_from_above_by_xy(void **state)
{
    static double points[3 * COUNT], truth[2 * COUNT], uv[2 * COUNT];
    int closed;
    for (int i = 0; i < COUNT; i++) { /* a lattice, whose principal axes are its own */
        truth[2 * i] = i % 40 / 39.0;
        truth[2 * i + 1] = i / 40 / 49.0;
        points[3 * i] = 4 * truth[2 * i];
        points[3 * i + 1] = truth[2 * i + 1];
        points[3 * i + 2] = 4 * truth[2 * i];
    }
    assert_ok(*state, pia_cloud_find("plane")->compute(*state, points, COUNT, 3, uv, &closed));
    follows(uv, truth, 0, 0);
    follows(uv, truth, 1, 0);
    assert_ok(*state, pia_cloud_find("xy")->compute(*state, points, COUNT, 3, uv, &closed));
    follows(uv, truth, 0, 0);
    assert_int_equal(closed, 0);
}

static void points_on_one_line_are_refused(void **state)
{
    double points[30], uv[20];
    int closed;
    for (int i = 0; i < 10; i++)
        for (int d = 0; d < 3; d++) points[3 * i + d] = d == 0 ? i : 0;
    for (pia_index k = 0; pia_cloud_list(k) != NULL; k++)
        assert_status(*state, pia_cloud_list(k)->compute(*state, points, 10, 3, uv, &closed), PIA_E_DATA);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_whole_cylinder_is_closed_and_a_half_one_is_not),
        cmocka_unit_test(a_sphere_has_longitude_and_latitude),
        cmocka_unit_test(a_dome_is_a_disc),
        cmocka_unit_test(a_tilted_sheet_is_flat_on_its_best_plane_and_seen_from_above_by_xy),
        cmocka_unit_test(points_on_one_line_are_refused),
    };
    return cmocka_run_group_tests(tests, open_context, close_context);
}
