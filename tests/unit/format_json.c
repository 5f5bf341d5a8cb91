#include "files.h"

#include "model.h"

#include <locale.h>

static const double knots_u[] = {0, 0, 0, 0.1, 1, 1, 1}, knots_v[] = {-1, -1, 1.0 / 3, 1.0 / 3};

static pia_model *make_curve(pia_context *context, const double *weights)
{
    static const double points[] = {1.0 / 3, -2e-300, 3, 4, 5, 6e300, 0.1, 0.2};
    const int degree[] = {2};
    const pia_index control[] = {4};
    const double *knots[] = {knots_u};
    pia_model *model = NULL;
    assert_ok(context, pia_model_create(context, 1, degree, knots, control, 2, points, weights, &model));
    return model;
}

static pia_model *make_surface(pia_context *context)
{
    static double points[4 * 2 * 3];
    for (int i = 0; i < 24; i++) points[i] = sin(i) / 7;
    const int degree[] = {2, 1};
    const pia_index control[] = {4, 2};
    const double *knots[] = {knots_u, knots_v};
    pia_model *model = NULL;
    assert_ok(context, pia_model_create(context, 2, degree, knots, control, 3, points, NULL, &model));
    return model;
}

static void add_summary(pia_model *model)
{
    pia_summary *summary = pia_memory_take(&model->memory, 1, sizeof *summary);
    assert_non_null(summary);
    *summary = (pia_summary){.report = {.struct_size = sizeof summary->report,
                                        .kind = PIA_CURVE,
                                        .method = "lspia",
                                        .parametrization = "chord",
                                        .placement = "average",
                                        .limiter = "none",
                                        .degree = {2},
                                        .control = {4, 1},
                                        .control_count = 4,
                                        .point_count = 9,
                                        .iterations = 17,
                                        .stop = PIA_STOP_NO_KNOT_LEFT,
                                        .reached = 0,
                                        .max_error = 1.0 / 7,
                                        .max_error_index = 8,
                                        .rms_error = 1e-17,
                                        .constraint_error = NAN,
                                        .relative_gradient = 0.1,
                                        .start_error = 0.7,
                                        .rate = NAN,
                                        .measure_distance = 1,
                                        .repaired_count = 2,
                                        .seconds = 0.012345678901234567}};
    assert_true(pia_note_add(&model->memory, &summary->notes, "row 3 repeats \"row 2\"\\\t(dropped)"));
    assert_true(pia_note_add(&model->memory, &summary->notes, "second"));
    summary->parameters = pia_memory_take(&model->memory, 3, sizeof *summary->parameters);
    summary->dropped = pia_memory_take(&model->memory, 2, sizeof *summary->dropped);
    memcpy(summary->parameters, (double[]){0, 0.1, 1}, 3 * sizeof(double));
    memcpy(summary->dropped, (pia_index[]){3, 7}, 2 * sizeof(pia_index));
    summary->parameter_count = 3;
    summary->dropped_count = 2;
    model->summary = summary;
}

static void assert_same_models(const pia_model *a, const pia_model *b)
{
    assert_int_equal(a->directions, b->directions);
    assert_int_equal(a->dim, b->dim);
    assert_int_equal(a->rational, b->rational);
    for (int d = 0; d < a->directions; d++) {
        assert_int_equal(a->degree[d], b->degree[d]);
        assert_int_equal(a->control[d], b->control[d]);
        assert_int_equal(a->periodic[d], b->periodic[d]);
        assert_memory_equal(a->knots[d], b->knots[d], (size_t)(a->control[d] + a->degree[d] + 1) * sizeof(double));
    }
    size_t values = (size_t)(a->control[0] * a->control[1] * pia_model_width(a));
    assert_memory_equal(a->points, b->points, values * sizeof(double));
}

static pia_model **write_and_read(pia_context *context, const pia_model *const *models, pia_index count)
{
    pia_model **back = NULL;
    pia_index read = 0;
    assert_ok(context, pia_model_write(context, path_of("model.json"), NULL, models, count, PIA_AUTO));
    assert_ok(context, pia_model_read(context, path_of("model.json"), NULL, &back, &read));
    assert_int_equal(read, count);
    return back;
}

static void assert_comes_back(pia_context *context, pia_model *model)
{
    const pia_model *one = model;
    pia_model **back = write_and_read(context, &one, 1);
    assert_same_models(model, back[0]);
    pia_models_destroy(back, 1);
    pia_model_destroy(model);
}

static void curves_and_surfaces_come_back_with_the_same_bits(void **state)
{
    static const double weights[] = {1, 0.70710678118654757, 2.5, 1e-3};
    assert_comes_back(*state, make_curve(*state, NULL));
    assert_comes_back(*state, make_curve(*state, weights));
    assert_comes_back(*state, make_surface(*state));
    pia_model *closed = make_surface(*state);
    closed->periodic[1] = 1;
    assert_comes_back(*state, closed);
}

static void random_rational_models_come_back_with_the_same_bits(void **state)
{
    srand(5);
    for (int trial = 0; trial < 200; trial++) {
        double weights[4];
        for (int i = 0; i < 4; i++) weights[i] = exp(6.0 * rand() / RAND_MAX - 3);
        assert_comes_back(*state, make_curve(*state, weights));
    }
}

static void several_models_come_back_in_order(void **state)
{
    pia_model *first = make_curve(*state, NULL), *second = make_curve(*state, NULL);
    add_summary(second);
    second->periodic[0] = 1;
    const pia_model *both[] = {first, second};
    pia_model **back = write_and_read(*state, both, 2);
    assert_same_models(first, back[0]);
    assert_same_models(second, back[1]);
    assert_null(back[0]->summary);
    assert_non_null(back[1]->summary);
    pia_models_destroy(back, 2);
    pia_model_destroy(first);
    pia_model_destroy(second);
}

static void the_report_of_the_fit_comes_back_with_the_same_bits(void **state)
{
    pia_model *model = make_curve(*state, NULL);
    add_summary(model);
    const pia_model *one = model;
    pia_model **back = write_and_read(*state, &one, 1);
    const pia_report *a = &model->summary->report, *b = &back[0]->summary->report;
    assert_string_equal(a->method, b->method);
    assert_string_equal(a->parametrization, b->parametrization);
    assert_string_equal(a->placement, b->placement);
    assert_string_equal(a->limiter, b->limiter);
    assert_int_equal(a->kind, b->kind);
    assert_int_equal(a->degree[0], b->degree[0]);
    assert_int_equal(a->control[0], b->control[0]);
    assert_int_equal(a->control_count, b->control_count);
    assert_int_equal(a->point_count, b->point_count);
    assert_int_equal(a->iterations, b->iterations);
    assert_int_equal(a->stop, b->stop);
    assert_int_equal(a->reached, b->reached);
    assert_near(b->max_error, a->max_error, 0);
    assert_int_equal(a->max_error_index, b->max_error_index);
    assert_near(b->rms_error, a->rms_error, 0);
    assert_true(isnan(b->constraint_error) && isnan(b->rate));
    assert_near(b->relative_gradient, a->relative_gradient, 0);
    assert_near(b->start_error, a->start_error, 0);
    assert_int_equal(a->measure_distance, b->measure_distance);
    assert_int_equal(a->repaired_count, b->repaired_count);
    assert_near(b->seconds, a->seconds, 0);
    assert_string_equal(pia_model_note(back[0], 0), "row 3 repeats \"row 2\"\\\t(dropped)");
    assert_string_equal(pia_model_note(back[0], 1), "second");
    assert_null(pia_model_note(back[0], 2));
    assert_int_equal(back[0]->summary->parameter_count, 3);
    assert_near(back[0]->summary->parameters[1], 0.1, 0);
    assert_int_equal(back[0]->summary->dropped_count, 2);
    assert_int_equal(back[0]->summary->dropped[1], 7);
    pia_models_destroy(back, 1);
    pia_model_destroy(model);
}

static void a_locale_with_decimal_commas_changes_nothing(void **state)
{
    if (setlocale(LC_ALL, "de_DE.UTF-8") == NULL) skip();
    assert_comes_back(*state, make_curve(*state, NULL));
    setlocale(LC_ALL, "C");
}

static void curves_and_surfaces_do_not_share_a_file(void **state)
{
    pia_model *curve = make_curve(*state, NULL), *surface = make_surface(*state);
    const pia_model *both[] = {curve, surface};
    assert_status(*state, pia_model_write(*state, path_of("model.json"), NULL, both, 2, PIA_AUTO), PIA_E_SHAPE);
    assert_int_equal(file_count(), 0);
    pia_model_destroy(curve);
    pia_model_destroy(surface);
}

#define LINE(...) "{\"shape\": {\"type\": \"curve\", \"count\": 1, \"data\": [{" __VA_ARGS__ "}]}}"
#define KNOTS "\"degree\": 1, \"knotvector\": [0, 0, 1, 1]"
#define POINTS "\"control_points\": {\"points\": [[0, 0], [1, 2]]}"

static void files_of_other_programs_are_read(void **state)
{
    static const char text[] =
        "{\"about\": {\"x\": [null, true, \"\\u00e9\"]}, \"shape\": {\"count\": 1, \"type\": \"curve\", \"data\": "
        "{\"type\": \"spline\", \"delta\": 0.01, \"degree\": 1, \"knotvector\": [0, 0.0, 1, 1e0], "
        "\"control_points\": {\"points\": [[0, 0, -1], [1, 2, 12345678901234567890]]}}}}";
    pia_model **models = NULL;
    pia_index count = 0;
    assert_ok(*state, pia_model_read(*state, make_text("other.json", text), NULL, &models, &count));
    assert_int_equal(count, 1);
    assert_int_equal(models[0]->dim, 3);
    assert_near(models[0]->points[5], 12345678901234567890.0, 0);
    assert_null(models[0]->summary);
    pia_models_destroy(models, count);
}

/* A file as TinySpline 0.6 saves it: flat control points, no shape. */
static void curves_of_tinyspline_are_read(void **state)
{
    static const char text[] =
        "{\n    \"degree\": 2,\n    \"dimension\": 3,\n    \"control_points\": [\n 0, 0, 1, 1, 2, 1, 2, 0, 1, 3, 1, 1 ],\n"
        "    \"knots\": [ 0, 0, 0, 0.5, 1, 1, 1 ]\n}";
    pia_model **models = NULL;
    pia_index count = 0;
    assert_ok(*state, pia_model_read(*state, make_text("tiny.json", text), NULL, &models, &count));
    assert_int_equal(count, 1);
    assert_int_equal(models[0]->directions, 1);
    assert_int_equal(models[0]->dim, 3);
    assert_int_equal(models[0]->control[0], 4);
    double p[3];
    assert_ok(*state, pia_model_eval(*state, models[0], (double[]){0.5}, 1, 0, p));
    assert_near(p[0], 1.5, 1e-15); /* at the single inside knot of degree 2: the middle of control points 1 and 2 */
    assert_near(p[1], 1, 1e-15);
    pia_models_destroy(models, count);
}

/* geomdl takes weights wherever they are. */
static void weights_without_a_word_make_a_rational_model(void **state)
{
    static const char text[] = "{\"shape\": {\"type\": \"curve\", \"data\": [{\"degree\": 2, \"knotvector\": [0, 0, 0, 1, 1, 1], "
                               "\"control_points\": {\"points\": [[1, 0], [1, 1], [0, 1]], \"weights\": [1, 0.5, 1]}}]}}";
    pia_model **models = NULL;
    pia_index count = 0;
    assert_ok(*state, pia_model_read(*state, make_text("weights.json", text), NULL, &models, &count));
    assert_int_equal(models[0]->rational, 1);
    pia_models_destroy(models, count);
}

static void bad_models_are_refused_with_their_place(void **state)
{
    static const struct {
        const char *text, *message;
    } bad[] = {
        {"", ":1: column 0: "},
        {"{\n\"a\": 1,\n\"a\": 2}", ":3: column 3: duplicate object key"},
        {"{\"a\": NaN}", ":1: column 9: invalid token near 'NaN'"},
        {"{\"a\":\n 1e999}", ":2: column 6: real number overflow"},
        {"[1, 2]", "has no shape.data"},
        {"{\"shape\": {\"type\": \"mesh\", \"data\": [{}]}}", "shape.type must be"},
        {"{\"degree\": 1, \"dimension\": 2, \"control_points\": [0, 0, 1], \"knots\": [0, 0, 1, 1]}",
         "bad.json: control_points are not whole points"},
        {"{\"degree\": 1, \"dimension\": 2, \"control_points\": [0, 0, 1, 1], \"knots\": [0, 1, 1]}",
         "bad.json: knots must be as many"},
        {"{\"degree\": 1e18, \"dimension\": 2, \"control_points\": [], \"knots\": []}", "bad.json: degree must be a whole number"},
        {"{\"degree\": 1, \"dimension\": 2, \"control_points\": [0, 0, 1, 1], \"knots\": [0, 1, 2, 3]}", "not clamped"},
        {LINE(KNOTS), "shape.data[0]: points must be an array of points"},
        {LINE(POINTS), "shape.data[0]: degree is missing"},
        {LINE("\"degree\": 26, \"knotvector\": [0], " POINTS), "degree must be a whole number from 1 to 25"},
        {LINE("\"degree\": 1.5, \"knotvector\": [0], " POINTS), "degree must be a whole number from 1 to 25"},
        {LINE("\"degree\": 1, \"knotvector\": [0, 1], " POINTS),
         "2 knots do not go with 2 control points of degree 1; there must be 4"},
        {LINE("\"degree\": 1, \"knotvector\": [0, 0, 1, \"1\"], " POINTS), "knotvector holds something that is not a number"},
        {LINE("\"degree\": 1, \"knotvector\": 7, " POINTS), "knotvector must be an array of numbers"},
        {LINE("\"degree\": 1, \"knotvector\": [0, 1, 0, 1], " POINTS), "knot"},
        {LINE(KNOTS ", \"control_points\": {\"points\": [[0, 0], [1]]}"), "points[1] is not an array of 2 numbers"},
        {LINE(KNOTS ", \"control_points\": {\"points\": [[], []]}"), "points must have 1 to 16 components"},
        {LINE(KNOTS ", \"rational\": true, " POINTS), "weights is missing"},
        {LINE(KNOTS ", \"rational\": true, \"control_points\": {\"points\": [[0, 0], [1, 2]], \"weights\": [1]}"),
         "weights must be as many"},
        {LINE(KNOTS ", \"rational\": true, \"control_points\": {\"points\": [[0, 0], [1, 2]], \"weights\": [1, -1]}"), "weight"},
        {"{\"shape\": {\"type\": \"surface\", \"data\": [{\"degree_u\": 1, \"degree_v\": 1, \"knotvector_u\": [0,0,1,1], "
         "\"knotvector_v\": "
         "[0,0,1,1], \"size_u\": 2, \"size_v\": 1, " POINTS "}]}}",
         "knots do not go with"},
        {"{\"shape\": {\"type\": \"surface\", \"data\": [{\"degree_u\": 1, \"degree_v\": 1, \"knotvector_u\": [0,0,1,1], "
         "\"knotvector_v\": "
         "[0,0,1,1], \"size_u\": 2, \"size_v\": 2, " POINTS "}]}}",
         "points are not size_u * size_v"},
    };
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        pia_model **models = NULL;
        pia_index count = 0;
        assert_status(*state, pia_model_read(*state, make_text("bad.json", bad[i].text), NULL, &models, &count), PIA_E_FORMAT);
        assert_null(models);
        if (strstr(pia_message(*state), bad[i].message) != NULL) continue;
        print_error("the message is \"%s\", it should hold \"%s\"\n", pia_message(*state), bad[i].message);
        fail();
    }
}

static void deep_nesting_is_refused(void **state)
{
    enum { DEPTH = 1000000 };
    char *text = malloc(DEPTH);
    memset(text, '[', DEPTH);
    pia_model **models = NULL;
    pia_index count = 0;
    assert_status(*state, pia_model_read(*state, make_file("deep.json", text, DEPTH), NULL, &models, &count), PIA_E_FORMAT);
    free(text);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        IN_FOLDER(curves_and_surfaces_come_back_with_the_same_bits),
        IN_FOLDER(random_rational_models_come_back_with_the_same_bits),
        IN_FOLDER(several_models_come_back_in_order),
        IN_FOLDER(the_report_of_the_fit_comes_back_with_the_same_bits),
        IN_FOLDER(a_locale_with_decimal_commas_changes_nothing),
        IN_FOLDER(curves_and_surfaces_do_not_share_a_file),
        IN_FOLDER(files_of_other_programs_are_read),
        IN_FOLDER(curves_of_tinyspline_are_read),
        IN_FOLDER(weights_without_a_word_make_a_rational_model),
        IN_FOLDER(bad_models_are_refused_with_their_place),
        IN_FOLDER(deep_nesting_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
