/* Smoothing, discrete curvature and dominant points against what they mean. */
#include "dominant.h"

#include <stdlib.h>

#include "check.h"
#include "discrete_curvature.h"

enum { COUNT = 120, MOST_DIM = 4 };

static double random_number(uint64_t *seed)
{
    *seed = *seed * 6364136223846793005u + 1442695040888963407u;
    return (double)(*seed >> 11) * 0x1p-53;
}

/* A wavy line with uneven steps and noise, in up to four dimensions. */
static void wander(double *points, int dim, uint64_t seed)
{
    double t = 0;
    for (int i = 0; i < COUNT; i++) {
        t += 0.02 + 0.08 * random_number(&seed);
        for (int d = 0; d < dim; d++) points[i * dim + d] = sin((d + 1) * t + d) + t * (d == 0) + 0.01 * random_number(&seed);
    }
}

/* A turn in the first two components, a scale, a shift. */
static void move_similarly(const double *points, int dim, double scale, double *out)
{
    double c = cos(0.7), s = sin(0.7);
    for (int i = 0; i < COUNT; i++) {
        const double *p = points + i * dim;
        for (int d = 0; d < dim; d++) out[i * dim + d] = scale * p[d] + 3 * d + 1;
        out[i * dim] = scale * (c * p[0] - s * p[1]) + 5;
        out[i * dim + 1] = scale * (s * p[0] + c * p[1]) - 2;
    }
}

static void a_circle_has_the_curvature_of_its_chords(void **state)
{
    (void)state;
    double points[2 * COUNT], curvature[COUNT], step = 0.05, radius = 3;
    for (int i = 0; i < COUNT; i++) {
        points[2 * i] = radius * cos(step * i);
        points[2 * i + 1] = radius * sin(step * i);
    }
    pia_curvature_along(points, COUNT, 2, curvature);
    double expected = 2 * (1 - cos(step)) / (radius * sin(step) * sin(step));
    for (int i = 0; i < COUNT; i++) assert_near(curvature[i], expected, 1e-9);
}

static void curvature_follows_the_cross_product_of_equation_29(void **state)
{
    (void)state;
    double points[3 * COUNT], curvature[COUNT];
    wander(points, 3, 4);
    pia_curvature_along(points, COUNT, 3, curvature);
    for (int i = 1; i + 1 < COUNT; i++) {
        double a[3], b[3];
        for (int d = 0; d < 3; d++) {
            a[d] = (points[3 * i + 3 + d] - points[3 * i - 3 + d]) / 2;
            b[d] = points[3 * i + 3 + d] - 2 * points[3 * i + d] + points[3 * i - 3 + d];
        }
        double x = a[1] * b[2] - a[2] * b[1], y = a[2] * b[0] - a[0] * b[2], z = a[0] * b[1] - a[1] * b[0];
        double expected = sqrt(x * x + y * y + z * z) / pow(a[0] * a[0] + a[1] * a[1] + a[2] * a[2], 1.5);
        assert_near(curvature[i], expected, 1e-9 * expected + 1e-12);
    }
    assert_true(curvature[0] == curvature[1] && curvature[COUNT - 1] == curvature[COUNT - 2]);
}

static void curvature_is_finite_where_a_line_turns_back(void **state)
{
    (void)state;
    const double points[] = {0, 0, 1, 0, 2, 0, 1, 0, 0, 0}, nearly[] = {0, 0, 1, 0.1, 2, 0, 1, 0.1 + 1e-12, 0, 0};
    double curvature[5];
    pia_curvature_along(points, 5, 2, curvature);
    assert_true(curvature[1] == 0);
    assert_near(curvature[2], 2 / (1e-3 * 4), 1e-9);
    pia_curvature_along(nearly, 5, 2, curvature);
    assert_near(curvature[2], sqrt(4.04) / (1e-3 * 4.04), 5);
}

/* The region of support as Teh and Chin define it, and the Gaussian mean over it. */
static void smoothing_averages_over_the_region_of_support(void **state)
{
    (void)state;
    for (int dim = 2; dim <= MOST_DIM; dim++)
        for (pia_index most = 0; most <= 6; most++) {
            double points[MOST_DIM * COUNT], smooth[MOST_DIM * COUNT];
            wander(points, dim, (uint64_t)(dim + 1));
            pia_curvature_smooth(points, COUNT, dim, most, smooth);
            for (pia_index j = 0; j < COUNT; j++) {
                pia_index room = j < COUNT - 1 - j ? j : COUNT - 1 - j, h = most > 0 && room > 0 ? 1 : 0;
                double length = 0, ratio = 0;
                for (pia_index k = 1; k <= room && k <= most; k++) {
                    double chord = 0, side = 0, along = 0;
                    for (int d = 0; d < dim; d++) {
                        double c = points[(j + k) * dim + d] - points[(j - k) * dim + d];
                        double s = points[j * dim + d] - points[(j - k) * dim + d];
                        chord += c * c;
                        side += s * s;
                        along += c * s;
                    }
                    double height = sqrt(fmax(side - along * along / chord, 0)) / sqrt(chord);
                    if (k > 1 && (sqrt(chord) <= length || height < ratio)) break;
                    h = k;
                    length = sqrt(chord);
                    ratio = height;
                }
                for (int d = 0; d < dim; d++) {
                    double sum = 0, total = 0;
                    for (pia_index i = -h; i <= h; i++) {
                        double weight = h > 0 ? exp(-2.0 * (double)(i * i) / (double)(h * h)) : 1;
                        sum += weight * points[(j + i) * dim + d];
                        total += weight;
                    }
                    assert_near(smooth[j * dim + d], sum / total, 1e-13);
                }
            }
        }
}

static void a_grid_averages_the_squared_curvatures_of_its_lines(void **state)
{
    (void)state;
    enum { R = 9, C = 12 };
    double points[R * C * 3], rows[R], columns[C], total[R][C], line[C * 3], k[C];
    uint64_t seed = 8;
    for (int i = 0; i < R * C * 3; i++)
        points[i] = (double)(i / 3 % C) * (i % 3 == 0) + (double)(i / 3 / C) * (i % 3 == 1) + random_number(&seed);
    const pia_index count[2] = {R, C};
    assert_ok(NULL, pia_curvature_of_grid(NULL, points, count, 3, 3, rows, columns));
    for (int i = 0; i < R; i++) {
        assert_ok(NULL, pia_curvature_of_curve(NULL, points + i * C * 3, C, 3, 3, k));
        for (int j = 0; j < C; j++) total[i][j] = k[j] * k[j];
    }
    for (int j = 0; j < C; j++) {
        for (int i = 0; i < R; i++) memcpy(line + 3 * i, points + (i * C + j) * 3, 3 * sizeof *line);
        assert_ok(NULL, pia_curvature_of_curve(NULL, line, R, 3, 3, k));
        for (int i = 0; i < R; i++) total[i][j] += k[i] * k[i];
    }
    for (int i = 0; i < R; i++) {
        double sum = 0;
        for (int j = 0; j < C; j++) sum += total[i][j];
        assert_near(rows[i], sum / C, 1e-9 * sum);
    }
    for (int j = 0; j < C; j++) {
        double sum = 0;
        for (int i = 0; i < R; i++) sum += total[i][j];
        assert_near(columns[j], sum / R, 1e-9 * sum);
    }
}

static void local_maxima_and_the_middle_of_plateaus_are_dominant(void **state)
{
    (void)state;
    const double curvature[] = {9, 1, 3, 2, 2, 5, 5, 5, 1, 0.2, 0.3, 0.2, 4, 4, 2, 6, 6};
    const unsigned char expected[] = {1, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 1};
    unsigned char mark[17] = {0};
    assert_int_equal(pia_dominant_mark(curvature, 17, 0.05, mark), 5);
    assert_memory_equal(mark, expected, 17);
    mark[4] = 1; /* what was marked stays */
    assert_int_equal(pia_dominant_mark(curvature, 17, 0, mark), 7);
    assert_true(mark[4] && mark[10]);
}

static void equal_curvatures_leave_the_ends(void **state)
{
    (void)state;
    double curvature[30];
    unsigned char mark[30] = {0};
    for (int i = 0; i < 30; i++) curvature[i] = 2 + 1e-12 * (i % 3);
    assert_int_equal(pia_dominant_mark(curvature, 30, 0.03, mark), 2);
}

static void dominant_points_are_those_of_the_shape_wherever_it_lies(void **state)
{
    (void)state;
    for (int dim = 2; dim <= MOST_DIM; dim++)
        for (double scale = 1e-3; scale < 1e10; scale *= 1e6) {
            double points[MOST_DIM * COUNT], moved[MOST_DIM * COUNT], curvature[COUNT];
            unsigned char mark[COUNT] = {0}, again[COUNT] = {0};
            wander(points, dim, 21);
            move_similarly(points, dim, scale, moved);
            assert_ok(NULL, pia_curvature_of_curve(NULL, points, COUNT, dim, 3, curvature));
            pia_index found = pia_dominant_mark(curvature, COUNT, 0.03, mark);
            assert_ok(NULL, pia_curvature_of_curve(NULL, moved, COUNT, dim, 3, curvature));
            assert_int_equal(pia_dominant_mark(curvature, COUNT, 0.03, again), found);
            assert_memory_equal(mark, again, COUNT);
            assert_true(found > 2);
        }
}

static void thinning_keeps_the_sharpest_the_pinned_and_the_ends(void **state)
{
    (void)state;
    const double curvature[] = {0, 5, 1, 4, 2, 3, 0};
    const unsigned char pinned[] = {0, 0, 1, 0, 0, 0, 0}, expected[] = {1, 1, 1, 0, 0, 0, 1};
    unsigned char mark[] = {1, 1, 1, 1, 1, 1, 1};
    assert_ok(NULL, pia_dominant_thin(NULL, curvature, 7, 4, pinned, mark));
    assert_memory_equal(mark, expected, 7);
    assert_ok(NULL, pia_dominant_thin(NULL, curvature, 7, 1, pinned, mark));
    const unsigned char least[] = {1, 0, 1, 0, 0, 0, 1};
    assert_memory_equal(mark, least, 7);
}

static void filling_splits_the_widest_gap_at_its_middle(void **state)
{
    (void)state;
    const double t[] = {0, 0.1, 0.2, 0.3, 0.55, 0.6, 0.9, 1};
    unsigned char mark[] = {1, 0, 0, 1, 0, 0, 0, 1};
    const unsigned char first[] = {1, 0, 0, 1, 0, 1, 0, 1}, third[] = {1, 1, 0, 1, 0, 1, 1, 1};
    assert_int_equal(pia_dominant_fill(t, 8, 4, mark), 4);
    assert_memory_equal(mark, first, 8);
    assert_int_equal(pia_dominant_fill(t, 8, 6, mark), 6);
    assert_memory_equal(mark, third, 8);
    assert_int_equal(pia_dominant_fill(t, 8, 20, mark), 8);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_circle_has_the_curvature_of_its_chords),
        cmocka_unit_test(curvature_follows_the_cross_product_of_equation_29),
        cmocka_unit_test(curvature_is_finite_where_a_line_turns_back),
        cmocka_unit_test(smoothing_averages_over_the_region_of_support),
        cmocka_unit_test(a_grid_averages_the_squared_curvatures_of_its_lines),
        cmocka_unit_test(local_maxima_and_the_middle_of_plateaus_are_dominant),
        cmocka_unit_test(equal_curvatures_leave_the_ends),
        cmocka_unit_test(dominant_points_are_those_of_the_shape_wherever_it_lies),
        cmocka_unit_test(thinning_keeps_the_sharpest_the_pinned_and_the_ends),
        cmocka_unit_test(filling_splits_the_widest_gap_at_its_middle),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
