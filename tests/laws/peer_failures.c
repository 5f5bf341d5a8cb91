/* How other fitting software failed, each as one test through the public interface. The numbers are those of the project's list of
 * known failures; the rest of them stand with the parts they belong to. */
#include "context_fixture.h"

#include <stdlib.h>
#include <unistd.h>

typedef struct call {
    pia_data data;
    pia_fit_options options;
} call;

static call curve_call(const double *points, pia_index count, int dim)
{
    call c;
    pia_data_init(&c.data);
    pia_fit_options_init(&c.options);
    c.data.points = points;
    c.data.count[0] = count;
    c.data.dim = dim;
    return c;
}

static void wave(double *points, pia_index count, int dim)
{
    for (pia_index i = 0; i < count; i++)
        for (int d = 0; d < dim; d++) points[i * dim + d] = d == 0 ? (double)i : sin(0.3 * (double)(i * d)) + d;
}

/* A fit that works, with a finite model that stays near its data. */
static void fits(pia_context *context, const call *c, double bound)
{
    pia_model *model;
    pia_report report = {.struct_size = sizeof report};
    assert_ok(context, pia_fit_data(context, &c->data, &c->options, &model, &report));
    pia_model_info info = {.struct_size = sizeof info};
    pia_model_get_info(model, &info);
    pia_index count = info.control[0] * info.control[1] * info.dim;
    double *control = malloc((size_t)count * sizeof *control);
    pia_model_control(model, control, NULL);
    for (pia_index i = 0; i < count; i++) assert_true(fabs(control[i]) <= bound);
    assert_true(isfinite(report.max_error));
    free(control);
    pia_model_destroy(model);
}

static void refused(pia_context *context, const call *c, pia_status expected, const char *word)
{
    pia_model *model = NULL;
    assert_status(context, pia_fit_data(context, &c->data, &c->options, &model, NULL), expected);
    assert_null(model);
    if (strstr(pia_message(context), word) == NULL) fail_msg("message \"%s\" does not say \"%s\"", pia_message(context), word);
}

static void t_peer_01_and_02_given_knots_fit_again_and_again_without_touching_foreign_memory(void **state)
{
    double points[60], knots[] = {0, 0, 0, 0, 0.5, 0.5, 0.5, 1, 1, 1, 1};
    wave(points, 30, 2);
    call c = curve_call(points, 30, 2);
    c.options.knots[0] = knots;
    c.options.knot_count[0] = 11;
    for (int k = 0; k < 50; k++) fits(*state, &c, 100);
}

static void t_peer_03_scattered_least_squares_is_sound_every_time(void **state)
{
    double points[300], uv[200];
    for (int i = 0; i < 100; i++) {
        uv[2 * i] = i % 10 / 9.0;
        uv[2 * i + 1] = i / 10 / 9.0;
        points[3 * i] = uv[2 * i];
        points[3 * i + 1] = uv[2 * i + 1];
        points[3 * i + 2] = sin(uv[2 * i] * 5);
    }
    call c = curve_call(points, 100, 3);
    c.data.kind = PIA_SCATTERED;
    c.data.parameters = uv;
    c.options.control[0] = c.options.control[1] = 6;
    double first[6 * 6 * 3], again[6 * 6 * 3];
    for (int k = 0; k < 20; k++) { /* one time in five it was not what it was before */
        pia_model *model;
        assert_ok(*state, pia_fit_data(*state, &c.data, &c.options, &model, NULL));
        pia_model_control(model, k == 0 ? first : again, NULL);
        if (k > 0) assert_memory_equal(first, again, sizeof first);
        for (int i = 0; i < 6 * 6 * 3; i++) assert_true(fabs(first[i]) <= 10);
        pia_model_destroy(model);
    }
}

static void t_peer_04_a_tolerance_on_109_points_places_knots_within_bounds(void **state)
{
    double points[218];
    wave(points, 109, 2);
    call c = curve_call(points, 109, 2);
    c.options.tolerance = 1e-3;
    fits(*state, &c, 200);
}

static void t_peer_11_the_smallest_interpolations_stay_inside_their_arrays(void **state)
{
    double points[16];
    wave(points, 8, 2);
    for (int degree = 1; degree <= 7; degree++)
        for (pia_index count = degree + 1; count <= 8; count++) {
            call c = curve_call(points, count, 2);
            c.options.degree[0] = degree;
            fits(*state, &c, 1e6);
        }
}

static void t_peer_14_checks_do_not_depend_on_the_build(void **state)
{
    double points[20];
    wave(points, 10, 2);
    call c = curve_call(points, 10, 2);
    c.options.degree[0] = -1;
    refused(*state, &c, PIA_E_ARGUMENT, "degree");
    c.options.degree[0] = 26;
    refused(*state, &c, PIA_E_ARGUMENT, "degree");
}

static void t_peer_20_to_25_sizes_that_do_not_fit_are_refused_before_memory_is_asked(void **state)
{
    static const pia_index huge[] = {INT64_MAX, INT64_MAX / 8, (pia_index)1 << 61, ((pia_index)1 << 32) + 1};
    double point[2] = {0, 0};
    for (size_t k = 0; k < sizeof huge / sizeof *huge; k++) {
        call c = curve_call(point, huge[k], 16);
        c.data.kind = PIA_GRID;
        c.data.count[1] = huge[k];
        refused(*state, &c, PIA_E_SIZE, "fit in memory");
    }
    pia_model *model = NULL;
    int degree[2] = {3, 3};
    pia_index control[2] = {(pia_index)1 << 40, (pia_index)1 << 40};
    const double *knots[2] = {point, point};
    pia_status status = pia_model_create(*state, 2, degree, knots, control, 3, point, NULL, &model);
    assert_true(status == PIA_E_SIZE || status == PIA_E_MEMORY);
    assert_null(model);
}

static void t_peer_26_control_counts_below_the_degree_do_not_wrap_around(void **state)
{
    double points[20];
    wave(points, 10, 2);
    call c = curve_call(points, 10, 2);
    for (pia_index n = 1; n <= 3; n++) {
        c.options.control[0] = n;
        refused(*state, &c, PIA_E_ARGUMENT, "control points");
    }
    c.options.control[0] = 0;
    refused(*state, &c, PIA_E_ARGUMENT, "control points");
    c.options.control[0] = INT64_MIN;
    refused(*state, &c, PIA_E_ARGUMENT, "control points");
}

static void t_peer_27_more_control_points_than_data_are_refused_before_memory_is_asked(void **state)
{
    double points[20];
    wave(points, 10, 2);
    call c = curve_call(points, 10, 2);
    c.options.control[0] = (pia_index)1 << 50;
    refused(*state, &c, PIA_E_ARGUMENT, "more than");
}

static void t_peer_28_a_repeated_abscissa_ends_with_an_answer(void **state)
{
    double points[] = {0, 0, 1, 1, 1, 3, 2, 2, 3, 1, 4, 0, 5, 1, 6, 2};
    call c = curve_call(points, 8, 2);
    c.data.function_graph = 1;
    fits(*state, &c, 100);
    c.options.tolerance = 1e-6; /* the two values at 1 cannot both be met */
    pia_report report = {.struct_size = sizeof report};
    assert_ok(*state, pia_fit_data(*state, &c.data, &c.options, NULL, &report));
    assert_int_equal(report.reached, report.max_error <= 1e-6);
}

static void t_peer_29_nan_in_data_weights_parameters_or_knots_is_named(void **state)
{
    double points[40], weights[20], parameters[20], knots[] = {0, 0, 0, 0, NAN, 1, 1, 1, 1};
    wave(points, 20, 2);
    for (int i = 0; i < 20; i++) {
        weights[i] = 1;
        parameters[i] = i / 19.0;
    }
    call c = curve_call(points, 20, 2);
    points[13] = NAN;
    refused(*state, &c, PIA_E_DATA, "row 6");
    points[13] = INFINITY;
    refused(*state, &c, PIA_E_DATA, "row 6");
    wave(points, 20, 2);
    c.options.control[0] = 8;
    c.data.weights = weights;
    weights[4] = NAN;
    refused(*state, &c, PIA_E_DATA, "weight 4");
    weights[4] = -1;
    refused(*state, &c, PIA_E_DATA, "weight 4");
    c.data.weights = NULL;
    c.data.parameters = parameters;
    parameters[7] = NAN;
    refused(*state, &c, PIA_E_DATA, "parameter 7");
    c.data.parameters = NULL;
    c.options.control[0] = PIA_AUTO;
    c.options.knots[0] = knots;
    c.options.knot_count[0] = 9;
    pia_model *model = NULL;
    assert_true(pia_fit_data(*state, &c.data, &c.options, &model, NULL) != PIA_OK);
    assert_null(model);
}

static void t_peer_30_knots_that_the_data_cannot_hold_end_bounded_or_refused(void **state)
{
    double points[40], parameters[20];
    double knots[] = {0, 0, 0, 0, 0.501, 0.502, 0.503, 0.504, 0.505, 1, 1, 1, 1};
    wave(points, 20, 2);
    for (int i = 0; i < 20; i++) parameters[i] = i < 10 ? 0.04 * i : 0.6 + 0.4 * (i - 10) / 9; /* a gap where the knots are */
    call c = curve_call(points, 20, 2);
    c.data.parameters = parameters;
    c.options.knots[0] = knots;
    c.options.knot_count[0] = 13;
    static const char *const method[] = {"direct", "lspia", "cg"};
    for (size_t k = 0; k < sizeof method / sizeof *method; k++) {
        c.options.method = method[k];
        fits(*state, &c, 200);
    }
    c.options.method = "pia"; /* as many knots as an interpolation has, but not where the points are */
    double crowded[24];
    for (int i = 0; i < 24; i++) crowded[i] = i < 4 ? 0 : i >= 20 ? 1 : 0.51 + 0.001 * i;
    c.options.knots[0] = crowded;
    c.options.knot_count[0] = 24;
    refused(*state, &c, PIA_E_DATA, "Schoenberg-Whitney");
}

static void t_peer_32_a_cloud_that_froze_a_tutorial_ends(void **state)
{
    double points[600], uv[400];
    for (int i = 0; i < 200; i++) { /* everything in one corner, and one point far away */
        uv[2 * i] = i == 199 ? 1 : 0.01 * (i % 14) / 14;
        uv[2 * i + 1] = i == 199 ? 1 : 0.01 * (i / 14) / 15;
        points[3 * i] = uv[2 * i];
        points[3 * i + 1] = uv[2 * i + 1];
        points[3 * i + 2] = i % 7;
    }
    call c = curve_call(points, 200, 3);
    c.data.kind = PIA_SCATTERED;
    c.data.parameters = uv;
    c.options.control[0] = c.options.control[1] = 12;
    fits(*state, &c, 1000);
}

static void t_peer_34_huge_parameters_of_closed_curves_do_not_loop(void **state)
{
    double points[40], parameters[20];
    wave(points, 20, 2);
    for (int i = 0; i < 20; i++) parameters[i] = 1e15 * i;
    call c = curve_call(points, 20, 2);
    c.options.closed[0] = 1;
    c.data.parameters = parameters;
    refused(*state, &c, PIA_E_DATA, "[0, 1)");
}

static void t_peer_33_and_35_to_39_equal_and_degenerate_points_end_with_a_message(void **state)
{
    double points[60];
    for (int i = 0; i < 60; i++) points[i] = i % 2 == 0 ? 3 : 4; /* one point, thirty times */
    static const char *const method[] = {"auto", "pia", "direct", "lspia", "gia"};
    for (size_t k = 0; k < sizeof method / sizeof *method; k++)
        for (int closed = 0; closed < 2; closed++) {
            call c = curve_call(points, 30, 2);
            c.options.method = method[k];
            c.options.closed[0] = closed;
            refused(*state, &c, PIA_E_DATA, "equal");
        }
    points[59] = 5; /* two different points */
    call c = curve_call(points, 30, 2);
    refused(*state, &c, PIA_E_DATA, "too few");
    c.options.degree[0] = 1;
    fits(*state, &c, 10);
}

static void t_peer_36_a_sphere_of_tiny_points_is_fitted_like_any_other(void **state)
{
    double points[80];
    for (int i = 0; i < 40; i++) {
        points[2 * i] = 1e-9 * cos(0.15 * i);
        points[2 * i + 1] = 1e-9 * sin(0.15 * i);
    }
    call c = curve_call(points, 40, 2);
    c.options.tolerance = 1e-13;
    pia_report report = {.struct_size = sizeof report};
    assert_ok(*state, pia_fit_data(*state, &c.data, &c.options, NULL, &report));
    assert_int_equal(report.reached, 1);
    assert_true(report.max_error <= 1e-13);
    assert_true(report.control_count < 40);
}

/* Without its own check such a system is singular, and what solved it crashed. */
static void t_peer_42_unclamped_knots_are_refused_by_name(void **state)
{
    double points[40], knots[] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11};
    wave(points, 20, 2);
    call c = curve_call(points, 20, 2);
    c.options.knots[0] = knots;
    c.options.knot_count[0] = 12;
    refused(*state, &c, PIA_E_DATA, "not clamped");
}

/* At the start, inside, at the end, and side by side, for every parametrization, whether points are met or not. */
static void t_peer_43_to_45_coincident_points_give_finite_fits(void **state)
{
    static const int equal[][2] = {{0, 1}, {9, 10}, {10, 11}, {11, 12}, {28, 29}};
    double points[60];
    wave(points, 30, 2);
    for (int k = 0; k < 5; k++) memcpy(points + 2 * equal[k][1], points + 2 * equal[k][0], 2 * sizeof *points);
    static const char *const method[] = {"auto", "direct", "pia", "gia", "lspia", "cg"};
    static const char *const parametrization[] = {"chord", "centripetal", "foley", "uniform", "universal"};
    for (size_t m = 0; m < sizeof method / sizeof *method; m++)
        for (size_t p = 0; p < sizeof parametrization / sizeof *parametrization; p++) {
            call c = curve_call(points, 30, 2);
            c.options.method = method[m];
            c.options.parametrization = parametrization[p];
            if (m >= 4) c.options.control[0] = 10;
            fits(*state, &c, 1000);
        }
}

/* NaN made these loops endless, or ate memory. */
static void t_peer_37_to_39_nan_ends_every_call_about_a_model(void **state)
{
    double points[40], nan[] = {NAN, NAN, NAN, NAN, NAN, NAN, NAN, NAN}, out[8], other[8], length;
    pia_index count[] = {3}, order[4];
    wave(points, 20, 2);
    call c = curve_call(points, 20, 2);
    pia_model *curve, *result = NULL;
    pia_deviation deviation = {.struct_size = sizeof deviation};
    assert_ok(*state, pia_fit_data(*state, &c.data, &c.options, &curve, NULL));
    assert_status(*state, pia_model_eval(*state, curve, nan, 2, 1, out), PIA_E_DATA);
    assert_status(*state, pia_model_curvature(*state, curve, nan, 2, out), PIA_E_DATA);
    assert_status(*state, pia_model_closest(*state, curve, nan, 2, out, other), PIA_E_DATA);
    assert_status(*state, pia_model_deviation(*state, curve, nan, 2, NULL, &deviation, out), PIA_E_DATA);
    assert_true(pia_model_insert_knots(*state, curve, 0, nan, 1, &result) != PIA_OK);
    assert_true(pia_model_split(*state, curve, 0, NAN, &result, &result) != PIA_OK);
    assert_true(pia_model_remove_knots(*state, curve, NAN, &result, &length) != PIA_OK);
    assert_true(pia_model_trim(*state, curve, 1, count, nan, &result) != PIA_OK);
    assert_status(*state, pia_points_order(*state, nan, 4, 2, "tree", order, NULL), PIA_E_DATA);
    assert_status(*state, pia_points_order(*state, nan, 4, 2, "nearest", order, NULL), PIA_E_DATA);
    assert_null(result);
    pia_model_destroy(curve);
}

static void t_peer_40_and_41_large_grids_have_no_erratic_values(void **state)
{
    enum { U = 300, V = 400 };
    double *points = malloc(sizeof *points * U * V);
    for (int i = 0; i < U; i++)
        for (int j = 0; j < V; j++) points[i * V + j] = sin(0.02 * i) * cos(0.03 * j);
    call c = curve_call(points, U, 1);
    c.data.kind = PIA_GRID;
    c.data.count[1] = V;
    double parameters[U + V];
    for (int i = 0; i < U; i++) parameters[i] = i;
    for (int j = 0; j < V; j++) parameters[U + j] = j;
    c.data.parameters = parameters;
    c.options.control[0] = 40;
    c.options.control[1] = 50;
    pia_model *model;
    double uv[2], value;
    assert_ok(*state, pia_fit_data(*state, &c.data, &c.options, &model, NULL));
    for (int i = 0; i < 900; i++) { /* between the data as well */
        uv[0] = (i % 30 + 0.37) / 30 * (U - 1);
        uv[1] = (i / 30 + 0.61) / 30 * (V - 1);
        assert_ok(*state, pia_model_eval(*state, model, uv, 1, 0, &value));
        assert_near(value, sin(0.02 * uv[0]) * cos(0.03 * uv[1]), 1e-5);
    }
    pia_model_destroy(model);
    free(points);
}

int main(void)
{
    alarm(120); /* nothing here may hang */
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(t_peer_01_and_02_given_knots_fit_again_and_again_without_touching_foreign_memory),
        cmocka_unit_test(t_peer_03_scattered_least_squares_is_sound_every_time),
        cmocka_unit_test(t_peer_04_a_tolerance_on_109_points_places_knots_within_bounds),
        cmocka_unit_test(t_peer_11_the_smallest_interpolations_stay_inside_their_arrays),
        cmocka_unit_test(t_peer_14_checks_do_not_depend_on_the_build),
        cmocka_unit_test(t_peer_20_to_25_sizes_that_do_not_fit_are_refused_before_memory_is_asked),
        cmocka_unit_test(t_peer_26_control_counts_below_the_degree_do_not_wrap_around),
        cmocka_unit_test(t_peer_27_more_control_points_than_data_are_refused_before_memory_is_asked),
        cmocka_unit_test(t_peer_28_a_repeated_abscissa_ends_with_an_answer),
        cmocka_unit_test(t_peer_29_nan_in_data_weights_parameters_or_knots_is_named),
        cmocka_unit_test(t_peer_30_knots_that_the_data_cannot_hold_end_bounded_or_refused),
        cmocka_unit_test(t_peer_32_a_cloud_that_froze_a_tutorial_ends),
        cmocka_unit_test(t_peer_34_huge_parameters_of_closed_curves_do_not_loop),
        cmocka_unit_test(t_peer_33_and_35_to_39_equal_and_degenerate_points_end_with_a_message),
        cmocka_unit_test(t_peer_36_a_sphere_of_tiny_points_is_fitted_like_any_other),
        cmocka_unit_test(t_peer_42_unclamped_knots_are_refused_by_name),
        cmocka_unit_test(t_peer_43_to_45_coincident_points_give_finite_fits),
        cmocka_unit_test(t_peer_37_to_39_nan_ends_every_call_about_a_model),
        cmocka_unit_test(t_peer_40_and_41_large_grids_have_no_erratic_values),
    };
    return cmocka_run_group_tests(tests, open_context, close_context);
}
