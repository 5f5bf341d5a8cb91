#include "context.h"

#include "check.h"
#include "kernel.h"
#include "options.h"

static void defaults_make_a_context_with_the_best_backend(void **state)
{
    (void)state;
    pia_context *context = NULL;
    assert_ok(NULL, pia_context_create(NULL, &context));
    assert_ptr_equal(context->kernel, pia_kernel_list(0));
    assert_int_equal(context->threads, context->kernel->processors());
    assert_string_equal(pia_message(context), "");
    pia_context_destroy(context);
    pia_context_destroy(NULL);
}

static void every_listed_backend_is_found_by_name(void **state)
{
    (void)state;
    const pia_kernel *kernel;
    for (pia_index i = 0; (kernel = pia_kernel_list(i)) != NULL; i++) {
        pia_context_options options;
        pia_context_options_init(&options);
        options.backend = kernel->name;
        pia_context *context = NULL;
        assert_ok(NULL, pia_context_create(&options, &context));
        assert_ptr_equal(context->kernel, kernel);
        pia_context_destroy(context);
    }
}

static pia_status create_with(const pia_context_options *options)
{
    pia_context *context = NULL;
    pia_status status = pia_context_create(options, &context);
    if (status != PIA_OK) assert_null(context);
    pia_context_destroy(context);
    return status;
}

static void *never(void *user, size_t size, size_t align)
{
    (void)user, (void)size, (void)align;
    return NULL;
}

static void impossible_options_are_refused(void **state)
{
    (void)state;
    pia_context_options good, bad;
    pia_context_options_init(&good);
    assert_status(NULL, pia_context_create(&good, NULL), PIA_E_ARGUMENT);
    const int threads[] = {0, -2, 1025};
    for (int i = 0; i < 3; i++) {
        bad = good;
        bad.threads = threads[i];
        assert_status(NULL, create_with(&bad), PIA_E_ARGUMENT);
    }
    bad = good;
    bad.allocate = never;
    assert_status(NULL, create_with(&bad), PIA_E_ARGUMENT);
    bad = good;
    bad.backend = "abacus";
    assert_status(NULL, create_with(&bad), PIA_E_UNAVAILABLE);
}

static void options_of_an_older_header_get_the_defaults_of_what_they_lack(void **state)
{
    (void)state;
    pia_context_options options;
    memset(&options, 0x55, sizeof options);
    options.threads = 3;
    options.struct_size = offsetof(pia_context_options, backend);
    pia_context *context = NULL;
    assert_ok(NULL, pia_context_create(&options, &context));
    assert_int_equal(context->threads, 3);
    assert_true(context->log == NULL);
    pia_context_destroy(context);
}

static void options_not_initialised_or_from_a_newer_header_are_refused(void **state)
{
    (void)state;
    pia_context *context = NULL;
    assert_ok(NULL, pia_context_create(NULL, &context));
    struct {
        size_t struct_size;
        int known, unknown;
    } in = {0}, out = {sizeof out, 7, 7};
    assert_status(context, pia_options_read(context, "pia_thing", &out, sizeof out, &in), PIA_E_ARGUMENT);
    assert_non_null(strstr(pia_message(context), "pia_thing_init"));
    in.struct_size = sizeof in;
    assert_status(context, pia_options_read(context, "pia_thing", &out, offsetof(pia_context_options, backend) - 1, &in),
                  PIA_E_ARGUMENT);
    assert_int_equal(out.known, 7);
    assert_ok(context, pia_options_read(context, "pia_thing", &out, sizeof out, &in));
    assert_int_equal(out.known, 0);
    pia_context_destroy(context);
}

static void threads_can_be_changed_within_their_range(void **state)
{
    (void)state;
    pia_context *context = NULL;
    assert_ok(NULL, pia_context_create(NULL, &context));
    assert_ok(context, pia_context_set_threads(context, 1024));
    assert_int_equal(context->threads, 1024);
    assert_status(context, pia_context_set_threads(context, 0), PIA_E_ARGUMENT);
    assert_non_null(strstr(pia_message(context), "1024"));
    assert_int_equal(context->threads, 1024);
    assert_ok(context, pia_context_set_threads(context, PIA_AUTO));
    assert_int_equal(context->threads, context->kernel->processors());
    assert_status(NULL, pia_context_set_threads(NULL, 1), PIA_E_ARGUMENT);
    pia_context_destroy(context);
}

static void remember(void *user, int level, const char *text)
{
    if (level == 2) snprintf(user, 32, "%s", text);
}

static void log_lines_reach_the_callback(void **state)
{
    (void)state;
    char line[32] = "";
    pia_context_options options;
    pia_context_options_init(&options);
    options.log = remember;
    options.user = line;
    pia_context *context = NULL;
    assert_ok(NULL, pia_context_create(&options, &context));
    pia_log(context, 2, "row %d is odd", 5);
    assert_string_equal(line, "row 5 is odd");
    pia_log(NULL, 2, "nobody listens");
    pia_context_destroy(context);
}

static void a_size_that_does_not_fit_is_told_from_memory_that_is_short(void **state)
{
    (void)state;
    pia_context *context = NULL;
    assert_ok(NULL, pia_context_create(NULL, &context));
    assert_null(pia_take(context, INT64_MAX / 4, 8));
    assert_int_equal(pia_take_status(context, INT64_MAX / 4, 8), PIA_E_SIZE);
    assert_null(pia_take(context, -1, 8));
    void *nothing = pia_take_zero(context, 0, 8);
    assert_non_null(nothing);
    pia_give(context, nothing);
    pia_context_destroy(context);
}

static void every_status_and_stop_reason_has_words(void **state)
{
    (void)state;
    for (int i = PIA_OK; i <= PIA_E_INTERNAL; i++)
        for (int j = PIA_OK; j < i; j++) assert_string_not_equal(pia_strerror((pia_status)i), pia_strerror((pia_status)j));
    for (int i = PIA_STOP_NONE; i <= PIA_STOP_INFEASIBLE; i++)
        for (int j = PIA_STOP_NONE; j < i; j++) assert_string_not_equal(pia_stop_name((pia_stop)i), pia_stop_name((pia_stop)j));
    assert_int_equal(strspn(pia_version(), "0123456789."), strlen(pia_version()));
    assert_string_equal(pia_message(NULL), "");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(defaults_make_a_context_with_the_best_backend),
        cmocka_unit_test(every_listed_backend_is_found_by_name),
        cmocka_unit_test(impossible_options_are_refused),
        cmocka_unit_test(options_of_an_older_header_get_the_defaults_of_what_they_lack),
        cmocka_unit_test(options_not_initialised_or_from_a_newer_header_are_refused),
        cmocka_unit_test(threads_can_be_changed_within_their_range),
        cmocka_unit_test(log_lines_reach_the_callback),
        cmocka_unit_test(a_size_that_does_not_fit_is_told_from_memory_that_is_short),
        cmocka_unit_test(every_status_and_stop_reason_has_words),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
