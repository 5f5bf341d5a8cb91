#include "model.h"

#include <math.h>

#include "../memory/failing.h"
#include "shapes.h"

static const int degree[2] = {2, 1};
static const pia_index control[2] = {4, 3};
static const double u[] = {0, 0, 0, 0.5, 1, 1, 1}, v[] = {-1, -1, 0, 2, 2};
static const double *const knots[2] = {u, v};

static double coordinate(pia_index i)
{
    return sin((double)i * 1.7) * 10;
}

static pia_status create(pia_context *context, int directions, int dim, const double *weights, pia_model **out)
{
    double points[12 * 3];
    for (int i = 0; i < 36; i++) points[i] = coordinate(i);
    return pia_model_create(context, directions, degree, knots, control, dim, points, weights, out);
}

static void a_model_tells_what_it_was_made_of(void **state)
{
    (void)state;
    pia_model *model = NULL;
    double weights[12], points[36], w[12];
    for (int i = 0; i < 12; i++) weights[i] = 0.25 * (1 << i % 4);
    assert_ok(NULL, create(NULL, 2, 3, weights, &model));
    pia_model_info info;
    pia_model_get_info(model, &info);
    assert_int_equal(info.struct_size, sizeof info);
    assert_int_equal(info.directions, 2);
    assert_int_equal(info.dim, 3);
    assert_int_equal(info.rational, 1);
    for (int d = 0; d < 2; d++) {
        assert_int_equal(info.degree[d], degree[d]);
        assert_int_equal(info.control[d], control[d]);
        assert_int_equal(info.knot_count[d], control[d] + degree[d] + 1);
        assert_int_equal(info.periodic[d], 0);
        assert_memory_equal(pia_model_knots(model, d), knots[d], (size_t)info.knot_count[d] * sizeof(double));
        assert_true(info.domain[d][0] == knots[d][0] && info.domain[d][1] == knots[d][info.knot_count[d] - 1]);
    }
    assert_null(pia_model_knots(model, 2));
    assert_null(pia_model_knots(model, -1));
    pia_model_control(model, points, w);
    for (int i = 0; i < 36; i++) assert_true(points[i] == coordinate(i));
    assert_memory_equal(w, weights, sizeof w);
    pia_model_control(model, NULL, NULL);
    pia_model_destroy(model);
    pia_model_destroy(NULL);
}

static void a_curve_has_one_direction_and_weights_of_one(void **state)
{
    (void)state;
    pia_model *model = NULL;
    assert_ok(NULL, create(NULL, 1, 3, NULL, &model));
    pia_model_info info;
    pia_model_get_info(model, &info);
    assert_int_equal(info.control[1], 1);
    assert_int_equal(info.knot_count[1], 0);
    assert_int_equal(info.rational, 0);
    assert_null(pia_model_knots(model, 1));
    double w[4];
    pia_model_control(model, NULL, w);
    for (int i = 0; i < 4; i++) assert_true(w[i] == 1);
    pia_model_destroy(model);
}

static void a_model_without_a_fit_has_no_report_notes_or_parameters(void **state)
{
    (void)state;
    pia_model *model = NULL;
    assert_ok(NULL, create(NULL, 1, 3, NULL, &model));
    pia_report report;
    pia_index count = 7;
    assert_int_equal(pia_model_report(model, &report), 0);
    assert_null(pia_model_note(model, 0));
    assert_null(pia_model_parameters(model, &count));
    assert_int_equal(count, 0);
    pia_model_destroy(model);
}

static void a_model_tells_the_fit_that_made_it(void **state)
{
    (void)state;
    pia_model *model = NULL;
    assert_ok(NULL, create(NULL, 1, 3, NULL, &model));
    double parameters[] = {0, 0.5, 1};
    pia_summary summary = {.report = {.iterations = 12}, .parameters = parameters, .parameter_count = 3};
    assert_int_equal(pia_note_add(pia_memory_default(), &summary.notes, "dropped row %d", 4), 1);
    model->summary = pia_summary_copy(&model->memory, &summary);
    assert_non_null(model->summary);
    pia_notes_clear(pia_memory_default(), &summary.notes);
    pia_report report;
    pia_index count;
    assert_int_equal(pia_model_report(model, &report), 1);
    assert_int_equal(report.iterations, 12);
    assert_string_equal(pia_model_note(model, 0), "dropped row 4");
    assert_null(pia_model_note(model, 1));
    assert_null(pia_model_note(model, -1));
    assert_memory_equal(pia_model_parameters(model, &count), parameters, sizeof parameters);
    assert_int_equal(count, 3);
    pia_model_destroy(model);
}

static void refused(pia_status expected, const char *word, int directions, const int *degrees, const pia_index *controls, int dim,
                    double point, double weight)
{
    pia_context *context = NULL;
    assert_ok(NULL, pia_context_create(NULL, &context));
    double points[12 * 3] = {0}, weights[12];
    for (int i = 0; i < 12; i++) weights[i] = 1;
    points[7] = point;
    weights[3] = weight;
    pia_model *model = NULL;
    assert_status(context, pia_model_create(context, directions, degrees, knots, controls, dim, points, weights, &model), expected);
    assert_null(model);
    if (strstr(pia_message(context), word) == NULL) fail_msg("\"%s\" lacks \"%s\"", pia_message(context), word);
    pia_context_destroy(context);
}

static void impossible_models_are_refused_with_the_reason(void **state)
{
    (void)state;
    const int zero[2] = {0, 1}, high[2] = {2, 26}, other[2] = {1, 1};
    const pia_index few[2] = {2, 3}, negative[2] = {4, -1}, huge[2] = {INT64_MAX / 4, INT64_MAX / 4}, endless[2] = {INT64_MAX, 3};
    refused(PIA_E_ARGUMENT, "3 directions", 3, degree, control, 3, 0, 1);
    refused(PIA_E_ARGUMENT, "0 directions", 0, degree, control, 3, 0, 1);
    refused(PIA_E_ARGUMENT, "dimension 0", 1, degree, control, 0, 0, 1);
    refused(PIA_E_ARGUMENT, "dimension 17", 1, degree, control, 17, 0, 1);
    refused(PIA_E_ARGUMENT, "degree 0", 1, zero, control, 3, 0, 1);
    refused(PIA_E_ARGUMENT, "degree 26", 2, high, control, 3, 0, 1);
    refused(PIA_E_SHAPE, "2 control points", 2, degree, few, 3, 0, 1);
    refused(PIA_E_SHAPE, "-1 control points", 2, degree, negative, 3, 0, 1);
    refused(PIA_E_SIZE, "64 bits", 2, degree, huge, 3, 0, 1);
    refused(PIA_E_SIZE, "64 bits", 1, degree, endless, 3, 0, 1);
    refused(PIA_E_DATA, "occurs too often", 1, other, control, 3, 0, 1);
    refused(PIA_E_DATA, "component 1 of control point 2", 1, degree, control, 3, NAN, 1);
    refused(PIA_E_DATA, "overflows", 1, degree, control, 2, 1e300, 1e300);
    refused(PIA_E_DATA, "weight 3 is 0", 1, degree, control, 3, 0, 0);
    refused(PIA_E_DATA, "weight 3 is -1", 1, degree, control, 3, 0, -1);
    refused(PIA_E_DATA, "weight 3 is inf", 1, degree, control, 3, 0, INFINITY);
    refused(PIA_E_DATA, "weight 3 is ", 1, degree, control, 3, 0, NAN);
}

static pia_status create_surface(pia_context *context, void *user)
{
    pia_model *model = NULL;
    pia_status status = create(context, 2, 3, user, &model);
    pia_model_destroy(model);
    return status;
}

static void creation_survives_every_failed_allocation(void **state)
{
    (void)state;
    assert_survives_failures(create_surface, NULL);
}

static void missing_arrays_are_refused(void **state)
{
    (void)state;
    const double points[12] = {0};
    pia_model *model = NULL;
    const double *half[2] = {u, NULL};
    assert_status(NULL, pia_model_create(NULL, 2, degree, half, control, 1, points, NULL, &model), PIA_E_ARGUMENT);
    assert_status(NULL, pia_model_create(NULL, 1, NULL, knots, control, 1, points, NULL, &model), PIA_E_ARGUMENT);
    assert_status(NULL, pia_model_create(NULL, 1, degree, NULL, control, 1, points, NULL, &model), PIA_E_ARGUMENT);
    assert_status(NULL, pia_model_create(NULL, 1, degree, knots, NULL, 1, points, NULL, &model), PIA_E_ARGUMENT);
    assert_status(NULL, pia_model_create(NULL, 1, degree, knots, control, 1, NULL, NULL, &model), PIA_E_ARGUMENT);
    assert_status(NULL, pia_model_create(NULL, 1, degree, knots, control, 1, points, NULL, NULL), PIA_E_ARGUMENT);
    assert_null(model);
}

static void t_peer_13_unclamped_knots_are_refused_by_name(void **state)
{
    (void)state;
    pia_context *context = NULL;
    assert_ok(NULL, pia_context_create(NULL, &context));
    const double unclamped[] = {0, 1, 2, 3, 4, 5, 6}, points[4] = {0, 1, 2, 3};
    const double *const all[1] = {unclamped};
    pia_model *model = NULL;
    assert_status(context, pia_model_create(context, 1, degree, all, control, 1, points, NULL, &model), PIA_E_DATA);
    assert_non_null(strstr(pia_message(context), "not clamped"));
    pia_context_destroy(context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_model_tells_what_it_was_made_of),
        cmocka_unit_test(a_curve_has_one_direction_and_weights_of_one),
        cmocka_unit_test(a_model_without_a_fit_has_no_report_notes_or_parameters),
        cmocka_unit_test(a_model_tells_the_fit_that_made_it),
        cmocka_unit_test(impossible_models_are_refused_with_the_reason),
        cmocka_unit_test(creation_survives_every_failed_allocation),
        cmocka_unit_test(missing_arrays_are_refused),
        cmocka_unit_test(t_peer_13_unclamped_knots_are_refused_by_name),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
