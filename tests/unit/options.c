#include "pia/pia.h"

#include "check.h"

#include <math.h>

static pia_fit_options defaults(void)
{
    pia_fit_options options;
    memset(&options, 0x55, sizeof options);
    pia_fit_options_init(&options);
    return options;
}

static size_t size_of(pia_option_type type)
{
    switch (type) {
    case PIA_OPTION_SWITCH:
    case PIA_OPTION_INTEGER: return sizeof(int);
    case PIA_OPTION_COUNT: return sizeof(pia_index);
    case PIA_OPTION_NUMBER: return sizeof(double);
    default: return sizeof(void *);
    }
}

static void cover(unsigned char *covered, size_t offset, size_t size)
{
    for (size_t i = offset; i < offset + size; i++) {
        assert_int_equal(covered[i], 0);
        covered[i] = 1;
    }
}

/* A member that is added to the struct and forgotten in the table leaves a hole wider than padding. */
static void the_table_covers_the_struct_once(void **state)
{
    (void)state;
    unsigned char covered[sizeof(pia_fit_options)] = {0};
    cover(covered, 0, sizeof(size_t));
    cover(covered, offsetof(pia_fit_options, progress), sizeof((pia_fit_options){0}.progress));
    cover(covered, offsetof(pia_fit_options, user), sizeof(void *));
    pia_option option;
    for (pia_index i = 0; pia_list_options(i, &option); i++) {
        cover(covered, option.offset, (size_t)option.directions * size_of(option.type));
        if (option.count_offset > 0) cover(covered, option.count_offset, (size_t)option.directions * sizeof(pia_index));
    }
    size_t hole = 0;
    for (size_t i = 0; i < sizeof covered; i++) {
        hole = covered[i] ? 0 : hole + 1;
        assert_true(hole < sizeof(void *));
    }
}

static void what_is_left_out_is_zero_or_automatic(void **state)
{
    (void)state;
    pia_fit_options options = defaults();
    assert_int_equal(options.struct_size, sizeof options);
    assert_int_equal(options.degree[1], 3);
    assert_int_equal(options.control[1], PIA_AUTO);
    assert_int_equal(options.max_iterations, PIA_AUTO);
    assert_near(options.robust_scale, PIA_AUTO, 0);
    assert_near(options.stop_gradient, PIA_AUTO, 0);
    assert_near(options.tolerance, 0, 0);
    assert_null(options.method);
    assert_null(options.knots[1]);
    assert_int_equal(options.corner_count, 0);
    assert_true(options.progress == NULL);
}

static void every_record_says_what_it_does(void **state)
{
    (void)state;
    pia_option option, other;
    pia_index i = 0;
    for (; pia_list_options(i, &option); i++) {
        assert_true(strlen(option.sentence) > 5);
        assert_true(option.directions == 1 || option.directions == 2);
        assert_true((option.type == PIA_OPTION_NAME) == (option.values != NULL));
        for (pia_index k = 0; k < i; k++) {
            assert_true(pia_list_options(k, &other));
            assert_string_not_equal(option.name, other.name);
        }
    }
    assert_true(i > 20);
    assert_false(pia_list_options(-1, &option));
    assert_false(pia_list_options(0, NULL));
}

static const double line[] = {0, 0, 1, 1, 2, 0, 3, 1, 4, 0, 5, 1};

/* The message of a fit with these options; "" when it was accepted. */
static const char *refusal(pia_context *context, const pia_fit_options *options)
{
    pia_data data;
    pia_data_init(&data);
    data.points = line;
    data.count[0] = 6;
    data.dim = 2;
    pia_fit *fit = NULL;
    pia_status status = pia_fit_open(context, &data, options, &fit);
    pia_fit_close(fit);
    return status == PIA_E_ARGUMENT ? pia_message(context) : "";
}

static void put(pia_fit_options *options, const pia_option *option, double value)
{
    char *member = (char *)options + option->offset;
    if (option->type == PIA_OPTION_INTEGER)
        *(int *)(void *)member = (int)value;
    else if (option->type == PIA_OPTION_COUNT)
        *(pia_index *)(void *)member = (pia_index)value;
    else
        *(double *)(void *)member = value;
}

static void numbers_below_their_range_are_refused_by_name(void **state)
{
    (void)state;
    pia_context *context = NULL;
    assert_ok(NULL, pia_context_create(NULL, &context));
    pia_option option;
    for (pia_index i = 0; pia_list_options(i, &option); i++) {
        if (option.type < PIA_OPTION_INTEGER || option.type > PIA_OPTION_NUMBER) continue;
        pia_fit_options options = defaults();
        put(&options, &option, option.minimum - 3); /* - 2 may be PIA_AUTO */
        assert_non_null(strstr(refusal(context, &options), option.name));
        if (option.type != PIA_OPTION_NUMBER) continue;
        put(&options, &option, NAN);
        assert_non_null(strstr(refusal(context, &options), option.name));
    }
    pia_context_destroy(context);
}

static void counts_without_an_array_are_refused_by_name(void **state)
{
    (void)state;
    pia_context *context = NULL;
    assert_ok(NULL, pia_context_create(NULL, &context));
    pia_option option;
    for (pia_index i = 0; pia_list_options(i, &option); i++)
        for (int sign = -1; sign <= 1; sign += 2) {
            if (option.count_offset == 0) continue;
            pia_fit_options options = defaults();
            *(pia_index *)(void *)((char *)&options + option.count_offset) = sign * 2;
            assert_non_null(strstr(refusal(context, &options), option.name));
        }
    pia_context_destroy(context);
}

/* What pia_fit_set takes by name, and what of it is a count. */
static void rules_are_set_within_their_range(void **state)
{
    (void)state;
    static const char *const rule[] = {"tolerance", "stop_change", "stop_gradient", "time_limit", "max_iterations", "trace_every"};
    static const char *const never[] = {"", "x", "-1", "nan", "inf", "1e400", "1 ", "0x1"};
    double points[] = {0, 0, 1, 1, 2, 0, 3, 1, 4, 0, 5, 2};
    pia_context *context;
    pia_fit *fit;
    pia_data data;
    pia_index count;
    assert_ok(NULL, pia_context_create(NULL, &context));
    pia_data_init(&data);
    data.points = points;
    data.count[0] = 6;
    data.dim = 2;
    assert_ok(context, pia_fit_open(context, &data, NULL, &fit));
    for (size_t r = 0; r < sizeof rule / sizeof *rule; r++) {
        for (size_t n = 0; n < sizeof never / sizeof *never; n++) {
            assert_status(context, pia_fit_set(fit, rule[r], never[n]), PIA_E_ARGUMENT);
            assert_non_null(strstr(pia_message(context), rule[r]));
        }
        assert_status(context, pia_fit_set(fit, rule[r], "2.5"), r < 4 ? PIA_OK : PIA_E_ARGUMENT);
        assert_ok(context, pia_fit_set(fit, rule[r], "3"));
    }
    assert_status(context, pia_fit_set(fit, "no such rule", "1"), PIA_E_ARGUMENT);
    assert_status(context, pia_fit_parameters(fit, NULL, &count, NULL), PIA_E_ARGUMENT);
    pia_fit_close(fit);
    pia_context_destroy(context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_table_covers_the_struct_once),
        cmocka_unit_test(what_is_left_out_is_zero_or_automatic),
        cmocka_unit_test(every_record_says_what_it_does),
        cmocka_unit_test(numbers_below_their_range_are_refused_by_name),
        cmocka_unit_test(counts_without_an_array_are_refused_by_name),
        cmocka_unit_test(rules_are_set_within_their_range),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
