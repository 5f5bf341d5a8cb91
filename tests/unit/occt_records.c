/* What the plug-in says is believed only as far as its bytes go. */
#include "occt.h"

#include <math.h>

#include "../memory/failing.h"
#include "occt_records.h"

static const pia_input input = {.path = "part.step"};

typedef struct message {
    int64_t value[200];
    pia_index count;
} message;

static void add(message *m, int64_t value)
{
    m->value[m->count++] = value;
}

static void add_reals(message *m, const double *values, int count)
{
    memcpy(m->value + m->count, values, (size_t)count * sizeof *values);
    m->count += count;
}

static message plane(pia_index loops)
{
    static const double knots[] = {0, 0, 1, 1}, points[] = {0, 0, 0, 0, 1, 0, 1, 0, 0, 1, 1, 0},
                        loop[] = {0.2, 0.2, 0.8, 0.2, 0.2, 0.8};
    const int64_t head[] = {PIA_OCCT_SPLINE, 2, 0, 1, 1, 2, 2, loops};
    message m = {.count = 0};
    for (size_t i = 0; i < sizeof head / sizeof *head; i++) add(&m, head[i]);
    add_reals(&m, knots, 4);
    add_reals(&m, knots, 4);
    add_reals(&m, points, 12);
    for (pia_index l = 0; l < loops; l++) {
        add(&m, 3);
        add_reals(&m, loop, 6);
    }
    return m;
}

static message arc(void)
{
    static const double knots[] = {0, 0, 0, 1, 1, 1}, points[] = {1, 0, 0, 1, 1, 0, 0, 1, 0}, weights[] = {1, 0.5, 1};
    const int64_t head[] = {PIA_OCCT_SPLINE, 1, 1, 2, 0, 3, 1, 0};
    message m = {.count = 0};
    for (size_t i = 0; i < sizeof head / sizeof *head; i++) add(&m, head[i]);
    add_reals(&m, knots, 6);
    add_reals(&m, points, 9);
    add_reals(&m, weights, 3);
    return m;
}

static pia_status parse(pia_context *context, const message *m, pia_index bytes, pia_model ***out, pia_index *count)
{
    char *copy = malloc(bytes > 0 ? (size_t)bytes : 1); /* exactly the bytes: nothing may be read behind them */
    memcpy(copy, m->value, (size_t)bytes);
    pia_status status = pia_occt_parse(context, &input, copy, bytes, out, count);
    free(copy);
    return status;
}

static void append(message *to, const message *from)
{
    memcpy(to->value + to->count, from->value, (size_t)from->count * sizeof *from->value);
    to->count += from->count;
}

static void splines_come_as_models(void **state)
{
    (void)state;
    message m = plane(1), second = arc();
    append(&m, &second);
    add(&m, PIA_OCCT_END);
    pia_model **models = NULL;
    pia_index count = 0, vertices;
    assert_ok(NULL, parse(NULL, &m, 8 * m.count, &models, &count));
    assert_int_equal(count, 2);
    assert_int_equal(models[0]->directions, 2);
    assert_int_equal(pia_model_trim_loop_count(models[0]), 1);
    assert_near(pia_model_trim_loop(models[0], 0, &vertices)[2], 0.8, 0);
    assert_int_equal(models[1]->directions, 1);
    assert_int_equal(models[1]->rational, 1);
    double p[3];
    assert_ok(NULL, pia_model_eval(NULL, models[1], (double[]){0.5}, 1, 0, p));
    assert_near(p[0], 2.0 / 3, 1e-15); /* (1 + 2 * 0.5 + 0) / (1 + 2 * 0.5 + 1) */
    pia_models_destroy(models, count);
}

static void loops_that_are_not_simple_are_left_out(void **state)
{
    (void)state;
    message m = plane(2); /* the same loop twice */
    add(&m, PIA_OCCT_END);
    pia_model **models = NULL;
    pia_index count = 0;
    assert_ok(NULL, parse(NULL, &m, 8 * m.count, &models, &count));
    assert_int_equal(pia_model_trim_loop_count(models[0]), 0);
    pia_models_destroy(models, count);
}

static void refused(const message *m, pia_index bytes, const char *what)
{
    pia_context *context = NULL;
    pia_model **models = NULL;
    pia_index count = 0;
    assert_ok(NULL, pia_context_create(NULL, &context));
    assert_status(context, parse(context, m, bytes, &models, &count), PIA_E_FORMAT);
    assert_null(models);
    if (strstr(pia_message(context), what) == NULL) fail_msg("\"%s\" lacks \"%s\"", pia_message(context), what);
    pia_context_destroy(context);
}

static void every_broken_off_message_is_refused(void **state)
{
    (void)state;
    message m = plane(1);
    add(&m, PIA_OCCT_END);
    for (pia_index bytes = 0; bytes < 8 * m.count; bytes++) refused(&m, bytes, "broke off");
}

static void claims_beyond_the_bytes_are_refused(void **state)
{
    (void)state;
    static const int64_t wild[] = {-1, 0, 26, 1000000, INT64_MAX / 3, INT64_MAX, INT64_MIN};
    for (int field = 1; field <= 8; field++)
        for (size_t w = 0; w < sizeof wild / sizeof *wild; w++) {
            message m = plane(1);
            if (field == 2 || (field == 7 && wild[w] == 0)) continue; /* rational, and no loops: both are possible */
            m.value[field < 8 ? field : 28] = wild[w];                /* 28: the vertices of the loop */
            if (field == 8 && wild[w] == 0) continue;
            pia_context *context = NULL;
            pia_model **models = NULL;
            pia_index count = 0;
            assert_ok(NULL, pia_context_create(NULL, &context));
            assert_status(context, parse(context, &m, 8 * m.count, &models, &count), PIA_E_FORMAT);
            pia_context_destroy(context);
        }
    for (int64_t columns = 0; columns <= 2; columns += 2) {
        message curve = arc();
        curve.value[6] = columns; /* of a curve: one, or there are not the points it needs */
        refused(&curve, 8 * curve.count, "broke off");
    }
    message unknown = {{77}, 1};
    refused(&unknown, 8, "broke off");
}

static void errors_of_the_plugin_are_told_and_splines_that_are_none_too(void **state)
{
    (void)state;
    message m = {.count = 0};
    add(&m, PIA_OCCT_ERROR);
    add(&m, 5);
    memcpy(m.value + m.count++, "no\nfi\0\0", 8);
    refused(&m, 8 * m.count, "part.step: no fi");
    message bad = plane(0);
    const double nan_value = NAN;
    memcpy(&bad.value[20], &nan_value, 8);
    refused(&bad, 8 * bad.count, "part.step: holds a spline that is none");
    message nothing = {{PIA_OCCT_END}, 1};
    refused(&nothing, 8, "holds no curve and no surface");
}

static pia_status parse_two(pia_context *context, void *user)
{
    pia_model **models = NULL;
    pia_index count = 0;
    const message *m = user;
    pia_status status = pia_occt_parse(context, &input, (const char *)m->value, 8 * m->count, &models, &count);
    pia_models_destroy(models, count);
    return status;
}

static void parsing_survives_every_failed_allocation(void **state)
{
    (void)state;
    message m = plane(1), second = arc();
    append(&m, &second);
    add(&m, PIA_OCCT_END);
    assert_survives_failures(parse_two, &m);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(splines_come_as_models),
        cmocka_unit_test(loops_that_are_not_simple_are_left_out),
        cmocka_unit_test(every_broken_off_message_is_refused),
        cmocka_unit_test(claims_beyond_the_bytes_are_refused),
        cmocka_unit_test(errors_of_the_plugin_are_told_and_splines_that_are_none_too),
        cmocka_unit_test(parsing_survives_every_failed_allocation),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
