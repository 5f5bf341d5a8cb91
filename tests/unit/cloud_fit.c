/* Fits of clouds without parameters: which base is taken, foot points, what is said when a tolerance cannot be had, and that surfaces
 * stay near their points where there are none. */
#include "context_fixture.h"

#include "overlap.h"
#include "sheets.h"

#include <stdlib.h>

enum { COUNT = 1500 };

static double points[3 * COUNT];

static double random_share(uint64_t *state)
{
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return (double)(*state >> 11) / 9007199254740992.0;
}

/* Turned and moved, so that no axis is special. */
static void put(int i, double x, double y, double z)
{
    points[3 * i] = 5 + (2 * x - 2 * y + z) / 3;
    points[3 * i + 1] = 6 + (x + 2 * y + 2 * z) / 3;
    points[3 * i + 2] = 7 + (-2 * x - y + 2 * z) / 3;
}

static pia_data cloud(pia_index count)
{
    pia_data data;
    pia_data_init(&data);
    data.kind = PIA_SCATTERED;
    data.points = points;
    data.count[0] = count;
    data.dim = 3;
    return data;
}

static const char *base_of(pia_context *context)
{
    static char name[24];
    pia_data data = cloud(COUNT);
    pia_fit_options options;
    pia_report report = {.struct_size = sizeof report};
    pia_fit_options_init(&options);
    options.control[0] = options.control[1] = 6;
    assert_ok(context, pia_fit_data(context, &data, &options, NULL, &report));
    snprintf(name, sizeof name, "%s", report.parametrization);
    return name;
}

static void the_base_is_the_one_the_points_lie_over(void **state)
{
    uint64_t seed = 1;
    for (int i = 0; i < COUNT; i++) {
        double x = 4 * random_share(&seed), y = 3 * random_share(&seed);
        put(i, x, y, 0.3 * sin(x) * y);
    }
    assert_string_equal(base_of(*state), "plane");
    for (int i = 0; i < COUNT; i++) {
        double a = 6.283185307179586 * random_share(&seed), z = 5 * random_share(&seed), r = 2 + 0.2 * cos(3 * a) + 0.1 * z;
        put(i, r * cos(a), r * sin(a), z);
    }
    assert_string_equal(base_of(*state), "cylinder");
    for (int i = 0; i < COUNT; i++) {
        double a = 3.5 * random_share(&seed), b = 2.4 * (random_share(&seed) - 0.5), r = 2 + 0.1 * cos(2 * a);
        put(i, r * cos(b) * cos(a), r * cos(b) * sin(a), r * sin(b));
    }
    assert_string_equal(base_of(*state), "sphere");
}

/* A dome whose rim stands upright: parameters from the plane are squeezed there, foot points are not. */
static void make_dome(void)
{
    uint64_t seed = 2;
    for (int i = 0; i < COUNT; i++) {
        double a = 6.283185307179586 * random_share(&seed), b = 1.45 * sqrt(random_share(&seed));
        put(i, sin(b) * cos(a), sin(b) * sin(a), cos(b));
    }
}

static pia_report fit_dome(pia_context *context, int measure_distance, pia_model **model)
{
    pia_data data = cloud(COUNT);
    pia_fit_options options;
    pia_report report = {.struct_size = sizeof report};
    pia_fit_options_init(&options);
    options.parametrization = "plane";
    options.tolerance = 0.01;
    options.measure_distance = measure_distance;
    assert_ok(context, pia_fit_data(context, &data, &options, model, &report));
    return report;
}

static void true_distance_takes_fewer_control_points_and_is_what_is_reported(void **state)
{
    pia_model *model;
    pia_deviation deviation = {.struct_size = sizeof deviation};
    make_dome();
    pia_report parametric = fit_dome(*state, 0, NULL), distance = fit_dome(*state, 1, &model);
    assert_int_equal(distance.reached, 1);
    assert_int_equal(distance.measure_distance, 1);
    assert_true(distance.control_count < parametric.control_count);
    assert_ok(*state, pia_model_deviation(*state, model, points, COUNT, NULL, &deviation, NULL));
    assert_true(deviation.max_error <= distance.max_error * (1 + 1e-9));
    assert_true(deviation.max_error > 0.5 * distance.max_error);
    pia_model_destroy(model);
}

static void corrections_bring_scattered_points_closer(void **state)
{
    pia_data data = cloud(COUNT);
    pia_fit_options options;
    pia_report before = {.struct_size = sizeof before}, after = {.struct_size = sizeof after};
    make_dome();
    pia_fit_options_init(&options);
    options.parametrization = "plane";
    options.control[0] = options.control[1] = 8;
    assert_ok(*state, pia_fit_data(*state, &data, &options, NULL, &before));
    options.correct = 5;
    assert_ok(*state, pia_fit_data(*state, &data, &options, NULL, &after));
    assert_true(after.round_count > 0);
    assert_true(after.rms_error < 0.7 * before.rms_error);
}

static void threads_do_not_change_a_bit(void **state)
{
    pia_model *model[2];
    static double control[2][3 * 4096];
    (void)state;
    make_dome();
    for (int k = 0; k < 2; k++) {
        pia_context *context;
        assert_ok(NULL, pia_context_create(NULL, &context));
        assert_ok(context, pia_context_set_threads(context, k == 0 ? 1 : 5));
        fit_dome(context, 1, &model[k]);
        pia_model_info info = {.struct_size = sizeof info};
        pia_model_get_info(model[k], &info);
        assert_true(info.control[0] * info.control[1] <= 4096);
        pia_model_control(model[k], control[k], NULL);
        pia_model_destroy(model[k]);
        pia_context_destroy(context);
    }
    assert_memory_equal(control[0], control[1], sizeof control[0]);
}

/* A plate with a large hole and a missing corner. */
static pia_index make_plate(void)
{
    uint64_t seed = 3;
    pia_index count = 0;
    while (count < COUNT) {
        double x = 4 * random_share(&seed), y = 4 * random_share(&seed);
        if (hypot(x - 2.2, y - 1.5) < 0.9 || x + y > 6) continue;
        put((int)count++, x, y, 0.2 * sin(3 * x) * cos(2 * y));
    }
    return count;
}

static void surfaces_stay_near_their_points_where_there_are_none(void **state)
{
    pia_data data = cloud(make_plate());
    pia_fit_options options;
    pia_model *model;
    double low[3], high[3], data_low[3], data_high[3], extent = 0;
    pia_fit_options_init(&options);
    options.parametrization = "plane";
    options.tolerance = 0.005;
    options.measure_distance = 1;
    assert_ok(*state, pia_fit_data(*state, &data, &options, &model, NULL));
    assert_ok(*state, pia_model_bounds(*state, model, low, high));
    for (int d = 0; d < 3; d++) {
        data_low[d] = INFINITY;
        data_high[d] = -INFINITY;
        for (pia_index i = 0; i < data.count[0]; i++) {
            data_low[d] = fmin(data_low[d], points[3 * i + d]);
            data_high[d] = fmax(data_high[d], points[3 * i + d]);
        }
        extent = hypot(extent, data_high[d] - data_low[d]);
    }
    for (int d = 0; d < 3; d++) {
        assert_true(low[d] > data_low[d] - 0.25 * extent);
        assert_true(high[d] < data_high[d] + 0.25 * extent);
    }
    pia_model_destroy(model);
}

static int has_note(const pia_model *model, const char *text)
{
    for (pia_index i = 0; pia_model_note(model, i) != NULL; i++)
        if (strstr(pia_model_note(model, i), text) != NULL) return 1;
    return 0;
}

static void sheets_over_each_other_are_named_as_the_reason(void **state)
{
    pia_data data = cloud(COUNT);
    pia_fit_options options;
    pia_model *model;
    pia_report report = {.struct_size = sizeof report};
    uint64_t seed = 4;
    for (int i = 0; i < COUNT; i++)
        for (int d = 0; d < 3; d++) points[3 * i + d] = d < 2 ? 4 * random_share(&seed) : 0;
    memcpy(&points[3 * 1100], &points[3 * 40], 2 * sizeof *points);
    points[3 * 1100 + 2] = 1;
    pia_fit_options_init(&options);
    options.parametrization = "xy";
    options.tolerance = 0.01;
    assert_ok(*state, pia_fit_data(*state, &data, &options, &model, &report));
    assert_int_equal(report.reached, 0);
    assert_int_equal(report.stop, PIA_STOP_NO_KNOT_LEFT);
    assert_true(has_note(model, "rows 40 and 1100 are 1 apart at nearly the same parameters"));
    assert_true(report.control_count < COUNT);
    pia_model_destroy(model);
}

/* Against all pairs: nothing farther than what is found lies within a half of the width, and what is found is a pair of the width. */
static void overlaps_are_those_of_all_pairs(void **state)
{
    enum { FEW = 1500, COPIES = 40 };
    static double uv[2 * FEW], at[FEW];
    uint64_t seed = 5;
    pia_overlap overlap;
    for (int i = 0; i < FEW; i++) {
        for (int d = 0; d < 2; d++) uv[2 * i + d] = random_share(&seed);
        if (i > FEW - COPIES)
            for (int d = 0; d < 2; d++) uv[2 * i + d] = uv[2 * (i - 700) + d] + 1e-4 * random_share(&seed);
        at[i] = random_share(&seed);
    }
    double width = 1 / sqrt((double)FEW) / 20, longest = 0;
    for (int i = 0; i < FEW; i++)
        for (int j = 0; j < i; j++)
            if (fabs(uv[2 * i] - uv[2 * j]) < 0.49 * width && fabs(uv[2 * i + 1] - uv[2 * j + 1]) < 0.49 * width)
                longest = fmax(longest, fabs(at[i] - at[j]));
    assert_ok(*state, pia_overlap_find(*state, uv, at, FEW, 1, &overlap));
    const pia_index *row = overlap.row;
    assert_true(longest > 0.5);
    assert_true(overlap.distance >= longest);
    assert_near(overlap.distance, fabs(at[row[0]] - at[row[1]]), 1e-15);
    for (int d = 0; d < 2; d++) assert_true(fabs(uv[2 * row[0] + d] - uv[2 * row[1] + d]) <= width);
    for (int i = 0; i < FEW; i++) { /* a grid, none close to another */
        uv[2 * i] = i % 40;
        uv[2 * i + 1] = i / 40;
    }
    assert_ok(*state, pia_overlap_find(*state, uv, at, FEW, 1, &overlap));
    assert_near(overlap.distance, 0, 0);
}

/* Heights over a plane: `sheets` of them, 1 apart, at random, and noise. Returns the share that falls apart. */
static double share_of(pia_context *context, int sheets, double noise, double slope, uint64_t seed)
{
    static double uv[2 * COUNT];
    pia_sheets out;
    for (int i = 0; i < COUNT; i++) {
        double u = uv[2 * i] = random_share(&seed), v = uv[2 * i + 1] = random_share(&seed), sum = -3;
        for (int k = 0; k < 6; k++) sum += random_share(&seed);
        double sheet = floor(sheets * random_share(&seed));
        put(i, 4 * u, 4 * v, slope * sin(3 * u) * cos(4 * v) + sheet + noise * sum);
    }
    assert_ok(context, pia_sheets_find(context, uv, points, COUNT, 3, 0.1, &out));
    const double *a = points + 3 * out.row[0], *b = points + 3 * out.row[1];
    if (out.share > 0) assert_near(out.distance, hypot(hypot(a[0] - b[0], a[1] - b[1]), a[2] - b[2]), 1e-12);
    assert_true(out.share == 0 || out.distance > 0.1);
    return out.share;
}

static void sheets_are_told_from_graphs_noise_and_walls(void **state)
{
    for (uint64_t seed = 1; seed <= 20; seed++) {
        assert_true(share_of(*state, 2, 0, 0.5, seed) > 0.9);
        assert_true(share_of(*state, 3, 0.03, 0.5, seed) > 0.5);
        assert_true(share_of(*state, 1, 0, 2, seed) < 0.02);
        assert_true(share_of(*state, 1, 0.2, 1, seed) < 0.05);
        assert_true(share_of(*state, 1, 2, 0, seed) < 0.15);
    }
    static double uv[2 * COUNT];
    uint64_t seed = 6;
    pia_sheets out;
    for (int i = 0; i < COUNT; i++) { /* stairs, whose risers have no points */
        for (int d = 0; d < 2; d++) uv[2 * i + d] = random_share(&seed);
        put(i, 4 * uv[2 * i], 4 * uv[2 * i + 1], floor(3 * uv[2 * i]));
    }
    assert_ok(*state, pia_sheets_find(*state, uv, points, COUNT, 3, 0.1, &out));
    assert_true(out.share < 0.1);
    for (int i = 0; i < COUNT; i++) uv[2 * i] = uv[2 * i + 1] = 0; /* all at one place */
    assert_ok(*state, pia_sheets_find(*state, uv, points, 1, 3, 0.1, &out));
    assert_ok(*state, pia_sheets_find(*state, uv, points, COUNT, 3, 0.1, &out));
}

/* A whole torus is told of at once, at the parameters and with foot points, and its middle comes back. */
static void a_closed_solid_is_not_tried(void **state)
{
    uint64_t seed = 8;
    enum { MANY = 6000 };
    static double torus[3 * MANY];
    for (int i = 0; i < MANY; i++) {
        double a = 6.283185307179586 * random_share(&seed), b = 6.283185307179586 * random_share(&seed), r = 2 + 0.7 * cos(b);
        torus[3 * i] = r * cos(a);
        torus[3 * i + 1] = r * sin(a);
        torus[3 * i + 2] = 0.7 * sin(b);
    }
    for (int distance = 0; distance < 2; distance++) {
        pia_data data = cloud(MANY);
        pia_fit_options options;
        pia_model *model;
        pia_report report = {.struct_size = sizeof report};
        data.points = torus;
        pia_fit_options_init(&options);
        options.parametrization = "plane";
        options.tolerance = 0.02;
        options.measure_distance = distance;
        assert_ok(*state, pia_fit_data(*state, &data, &options, &model, &report));
        assert_int_equal(report.reached, 0);
        assert_int_equal(report.stop, PIA_STOP_NO_KNOT_LEFT);
        assert_true(report.control_count < MANY / 4);
        assert_true(report.rms_error < 0.7);
        assert_true(has_note(model, "the points lie on sheets over each other: rows "));
        pia_model_destroy(model);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_base_is_the_one_the_points_lie_over),
        cmocka_unit_test(true_distance_takes_fewer_control_points_and_is_what_is_reported),
        cmocka_unit_test(corrections_bring_scattered_points_closer),
        cmocka_unit_test(threads_do_not_change_a_bit),
        cmocka_unit_test(surfaces_stay_near_their_points_where_there_are_none),
        cmocka_unit_test(sheets_over_each_other_are_named_as_the_reason),
        cmocka_unit_test(overlaps_are_those_of_all_pairs),
        cmocka_unit_test(sheets_are_told_from_graphs_noise_and_walls),
        cmocka_unit_test(a_closed_solid_is_not_tried),
    };
    return cmocka_run_group_tests(tests, open_context, close_context);
}
