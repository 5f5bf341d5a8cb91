/* Golden cases: every .json file of this folder is a problem, its options, and what an independent source says must come out. See
 * README.md beside it. */
#include "check.h"

#include <dirent.h>
#include <jansson.h>
#include <stdlib.h>

enum { MAX_CASES = 200, MAX_LIST = 16 };

typedef struct numbers {
    double *value;
    size_t count;
} numbers;

static numbers read_numbers(json_t *array)
{
    numbers n = {NULL, json_array_size(array)};
    if (n.count == 0) return n;
    n.value = malloc(n.count * sizeof *n.value);
    for (size_t i = 0; i < n.count; i++) {
        assert_true(json_is_number(json_array_get(array, i)));
        n.value[i] = json_number_value(json_array_get(array, i));
    }
    return n;
}

static double number_or(json_t *object, const char *key, double otherwise)
{
    json_t *value = json_object_get(object, key);
    return value != NULL ? json_number_value(value) : otherwise;
}

static void read_pair(json_t *object, const char *key, pia_index out[2])
{
    json_t *pair = json_object_get(object, key);
    for (size_t d = 0; d < 2 && pair != NULL && d < json_array_size(pair); d++) out[d] = json_integer_value(json_array_get(pair, d));
}

/* Lists of the options, which borrow them. */
typedef struct lists {
    const char *text[MAX_LIST];
    pia_index row[MAX_LIST];
} lists;

static void read_lists(json_t *o, pia_fit_options *options, lists *list)
{
    json_t *texts = json_object_get(o, "method_options"), *rows = json_object_get(o, "interpolate");
    assert_true(json_array_size(texts) <= MAX_LIST && json_array_size(rows) <= MAX_LIST);
    for (size_t i = 0; i < json_array_size(texts); i++) list->text[i] = json_string_value(json_array_get(texts, i));
    for (size_t i = 0; i < json_array_size(rows); i++) list->row[i] = json_integer_value(json_array_get(rows, i));
    options->method_options = list->text;
    options->method_option_count = (pia_index)json_array_size(texts);
    options->interpolate = list->row;
    options->interpolate_count = (pia_index)json_array_size(rows);
}

static void read_options(json_t *o, pia_fit_options *options, numbers knots[2], lists *list)
{
    pia_index degree[2] = {3, 3}, closed[2] = {0, 0};
    pia_fit_options_init(options);
    read_pair(o, "degree", degree);
    read_pair(o, "closed", closed);
    read_pair(o, "control", options->control);
    read_lists(o, options, list);
    options->tolerance = number_or(o, "tolerance", 0);
    for (int d = 0; d < 2; d++) {
        options->degree[d] = (int)degree[d];
        options->closed[d] = (int)closed[d];
    }
    options->method = json_string_value(json_object_get(o, "method"));
    options->placement = json_string_value(json_object_get(o, "placement"));
    options->parametrization = json_string_value(json_object_get(o, "parametrization"));
    options->max_iterations = (pia_index)number_or(o, "iterations", PIA_AUTO);
    options->stop_change = number_or(o, "stop_change", PIA_AUTO);
    options->trace_every = 1;
    knots[0] = read_numbers(json_object_get(o, "knots_u"));
    knots[1] = read_numbers(json_object_get(o, "knots_v"));
    for (int d = 0; d < 2; d++) {
        options->knots[d] = knots[d].value;
        options->knot_count[d] = (pia_index)knots[d].count;
    }
}

static void check_trace(pia_fit *fit, json_t *rows)
{
    size_t i;
    json_t *row;
    json_array_foreach(rows, i, row)
    {
        pia_index at = (pia_index)json_integer_value(json_object_get(row, "iteration"));
        pia_trace_row found = {0};
        for (pia_index k = 0; pia_fit_trace(fit, k, &found) && found.iteration != at; k++) continue;
        assert_int_equal(found.iteration, at);
        if (json_object_get(row, "control_count") != NULL)
            assert_int_equal(found.control_count, json_integer_value(json_object_get(row, "control_count")));
        if (json_object_get(row, "max_error") != NULL)
            assert_near(found.max_error, json_number_value(json_object_get(row, "max_error")), number_or(row, "tolerance", 0));
        if (json_object_get(row, "rms_error") != NULL)
            assert_near(found.rms_error, json_number_value(json_object_get(row, "rms_error")), number_or(row, "tolerance", 0));
    }
}

static void check_values(pia_context *context, const pia_model *model, json_t *expected, int dim)
{
    if (expected == NULL) return;
    numbers at = read_numbers(json_object_get(expected, "parameters")), want = read_numbers(json_object_get(expected, "points"));
    double tolerance = number_or(expected, "tolerance", 0);
    pia_index count = (pia_index)(want.count / (size_t)dim);
    double *found = malloc(want.count * sizeof *found);
    assert_ok(context, pia_model_eval(context, model, at.value, count, 0, found));
    for (size_t i = 0; i < want.count; i++) assert_near(found[i], want.value[i], tolerance);
    free(found);
    free(at.value);
    free(want.value);
}

/* The error that [2004] prints for iteration 0 of Fig. 6: the sum over all points. */
static void check_error_sum(pia_fit *fit, json_t *expected, pia_index rows, int dim)
{
    json_t *sum = json_object_get(expected, "start_error_sum");
    if (sum == NULL) return;
    double *residual = malloc((size_t)(rows * dim) * sizeof *residual), total = 0;
    assert_int_equal(pia_fit_residuals(fit, residual), PIA_OK);
    for (pia_index i = 0; i < rows; i++) {
        double square = 0;
        for (int d = 0; d < dim; d++) square += residual[i * dim + d] * residual[i * dim + d];
        total += sqrt(square);
    }
    free(residual);
    assert_near(total, json_number_value(sum), number_or(expected, "start_error_sum_tolerance", 0));
}

static void check_case(pia_context *context, json_t *root)
{
    pia_data data;
    pia_fit_options options;
    lists list;
    numbers knots[2], points = read_numbers(json_object_get(root, "points")),
                      parameters = read_numbers(json_object_get(root, "parameters"));
    numbers weights = read_numbers(json_object_get(root, "weights"));
    pia_data_init(&data);
    data.kind = strcmp(json_string_value(json_object_get(root, "kind")), "grid") == 0 ? PIA_GRID : PIA_CURVE;
    read_pair(root, "count", data.count);
    data.dim = (int)json_integer_value(json_object_get(root, "dim"));
    data.points = points.value;
    data.parameters = parameters.value;
    data.weights = weights.value;
    assert_int_equal(points.count, data.count[0] * data.count[1] * data.dim);
    read_options(json_object_get(root, "options"), &options, knots, &list);
    json_t *expected = json_object_get(root, "expect");
    pia_fit *fit;
    assert_ok(context, pia_fit_open(context, &data, &options, &fit));
    check_error_sum(fit, expected, data.count[0] * data.count[1], data.dim);
    pia_report report = {.struct_size = sizeof report};
    assert_ok(context, pia_fit_run(fit, &report));
    check_trace(fit, json_object_get(expected, "trace"));
    if (json_object_get(expected, "rms_error") != NULL)
        assert_near(report.rms_error, number_or(expected, "rms_error", 0), number_or(expected, "rms_tolerance", 0));
    pia_model *model;
    assert_ok(context, pia_fit_model(fit, &model));
    check_values(context, model, json_object_get(expected, "values"), data.dim);
    pia_model_destroy(model);
    pia_fit_close(fit);
    free(points.value);
    free(parameters.value);
    free(weights.value);
    free(knots[0].value);
    free(knots[1].value);
}

static void check_file(void **state)
{
    char path[1200];
    json_error_t error;
    snprintf(path, sizeof path, "%s/golden/%s", PIA_TESTS, (const char *)*state);
    json_t *root = json_load_file(path, JSON_REJECT_DUPLICATES, &error);
    if (root == NULL) fail_msg("%s:%d: %s", path, error.line, error.text);
    pia_context *context;
    assert_int_equal(pia_context_create(NULL, &context), PIA_OK);
    check_case(context, root);
    pia_context_destroy(context);
    json_decref(root);
}

static int is_case(const struct dirent *entry)
{
    size_t length = strlen(entry->d_name);
    return length > 5 && strcmp(entry->d_name + length - 5, ".json") == 0;
}

int main(void)
{
    struct dirent **entry;
    struct CMUnitTest test[MAX_CASES] = {{0}};
    int count = scandir(PIA_TESTS "/golden", &entry, is_case, alphasort);
    if (count < 1 || count > MAX_CASES) return 1;
    for (int i = 0; i < count; i++)
        test[i] = (struct CMUnitTest){.name = entry[i]->d_name, .test_func = check_file, .initial_state = entry[i]->d_name};
    int failed = _cmocka_run_group_tests("golden", test, (size_t)count, NULL, NULL);
    for (int i = 0; i < count; i++) free(entry[i]);
    free(entry);
    return failed;
}
