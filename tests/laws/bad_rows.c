/* Rows are checked while they are summed: one bad row among many is named all the same, wherever it is. */
#include "check.h"

#include <stdlib.h>

enum { ROWS = 20000 };

typedef struct sample {
    double t[ROWS], points[2 * ROWS];
    pia_data data;
    pia_fit_options options;
    pia_context *context;
} sample;

static void make(sample *s, pia_index control)
{
    for (int i = 0; i < ROWS; i++) {
        s->t[i] = (double)i / (ROWS - 1);
        s->points[2 * i] = cos(5 * s->t[i]);
        s->points[2 * i + 1] = 1e6 + sin(7 * s->t[i]);
    }
    pia_data_init(&s->data);
    pia_fit_options_init(&s->options);
    s->data.points = s->points;
    s->data.parameters = s->t;
    s->data.count[0] = ROWS;
    s->data.dim = 2;
    s->options.control[0] = control;
}

static void is_named(sample *s, const char *what, int row)
{
    char expected[40];
    snprintf(expected, sizeof expected, "%s %d", what, row);
    assert_status(s->context, pia_fit_data(s->context, &s->data, &s->options, NULL, NULL), PIA_E_DATA);
    if (strstr(pia_message(s->context), expected) == NULL) fail_msg("\"%s\" does not name %s", pia_message(s->context), expected);
}

/* Spans of thousands of rows, of a few, and of three. */
static const pia_index controls[] = {8, 1500, 6000};
static const int places[] = {1, 2, 511, 512, 513, 1023, 1024, 8191, 8192, 9999, ROWS - 2, ROWS - 1};
enum { CONTROLS = sizeof controls / sizeof *controls, PLACES = sizeof places / sizeof *places };

static void a_point_that_is_no_number_is_named(void **state)
{
    sample *s = *state;
    for (int c = 0; c < CONTROLS; c++) {
        make(s, controls[c]);
        for (int k = 0; k < PLACES; k++) {
            double *component = &s->points[2 * places[k] + k % 2], kept = *component;
            *component = k % 3 == 0 ? NAN : k % 3 == 1 ? INFINITY : -INFINITY;
            is_named(s, "row", places[k]);
            *component = kept;
        }
    }
}

static void a_parameter_out_of_order_is_named(void **state)
{
    sample *s = *state;
    for (int c = 0; c < CONTROLS; c++) {
        make(s, controls[c]);
        for (int k = 0; k < PLACES; k++) {
            double kept = s->t[places[k]];
            s->t[places[k]] = k % 2 == 0 ? NAN : nextafter(s->t[places[k] - 1], -1);
            is_named(s, "parameter", places[k]);
            s->t[places[k]] = kept;
        }
    }
}

static void points_that_are_all_equal_are_refused(void **state)
{
    sample *s = *state;
    make(s, 8);
    for (int i = 0; i < ROWS; i++) s->points[2 * i] = s->points[2 * i + 1] = 1e6;
    assert_status(s->context, pia_fit_data(s->context, &s->data, &s->options, NULL, NULL), PIA_E_DATA);
    assert_non_null(strstr(pia_message(s->context), "are equal"));
}

/* The errors of a report are measured when it is asked for, before or after the model. */
static void a_report_asked_for_late_is_the_same(void **state)
{
    sample *s = *state;
    pia_report at_once = {.struct_size = sizeof at_once}, late = at_once;
    pia_fit *fit;
    make(s, 20);
    assert_ok(s->context, pia_fit_data(s->context, &s->data, &s->options, NULL, &at_once));
    assert_ok(s->context, pia_fit_open(s->context, &s->data, &s->options, &fit));
    assert_ok(s->context, pia_fit_run(fit, NULL));
    assert_ok(s->context, pia_fit_report(fit, &late));
    assert_true(at_once.rms_error > 0);
    assert_near(late.rms_error, at_once.rms_error, 0);
    assert_near(late.max_error, at_once.max_error, 0);
    assert_near(late.start_error, at_once.start_error, 0);
    assert_int_equal(late.max_error_index, at_once.max_error_index);
    pia_fit_close(fit);
}

static int open_sample(void **state)
{
    sample *s = malloc(sizeof *s);
    *state = s;
    return s == NULL || pia_context_create(NULL, &s->context) != PIA_OK;
}

static int close_sample(void **state)
{
    sample *s = *state;
    pia_context_destroy(s->context);
    free(s);
    return 0;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_point_that_is_no_number_is_named),
        cmocka_unit_test(a_parameter_out_of_order_is_named),
        cmocka_unit_test(points_that_are_all_equal_are_refused),
        cmocka_unit_test(a_report_asked_for_late_is_the_same),
    };
    return cmocka_run_group_tests(tests, open_sample, close_sample);
}
