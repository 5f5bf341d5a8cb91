#include "context.h"
#include "failing.h"
#include "notes.h"
#include "summary.h"
#include "trace.h"

static void a_context_that_cannot_be_had_is_reported(void **state)
{
    (void)state;
    failing f = {.fail_at = 1};
    pia_context_options options;
    pia_context_options_init(&options);
    options.allocate = failing_allocate;
    options.release = failing_release;
    options.user = &f;
    pia_context *context = NULL;
    assert_status(NULL, pia_context_create(&options, &context), PIA_E_MEMORY);
    assert_null(context);
    assert_int_equal(f.blocks, 0);
}

static pia_status take_two(pia_context *context, void *user)
{
    (void)user;
    pia_status status = PIA_OK;
    double *first = pia_take(context, 10, sizeof *first);
    double *second = first != NULL ? pia_take_zero(context, 10, sizeof *second) : NULL;
    if (second == NULL) status = pia_take_status(context, 10, sizeof *second);
    pia_give(context, first);
    pia_give(context, second);
    return status;
}

static void take_and_give_survive_every_failure(void **state)
{
    (void)state;
    assert_survives_failures(take_two, NULL);
}

static pia_status copy_summary(pia_context *context, void *user)
{
    (void)user;
    const pia_memory *memory = pia_memory_of(context);
    double parameters[] = {0, 0.25, 1};
    pia_index dropped[] = {4, 7};
    pia_summary summary = {.parameters = parameters, .parameter_count = 3, .dropped = dropped, .dropped_count = 2};
    pia_summary *copy = NULL;
    int noted = 1;
    for (int i = 0; i < 20 && noted; i++) noted = pia_note_add(memory, &summary.notes, "row %d was dropped", i);
    if (noted) copy = pia_summary_copy(memory, &summary);
    int copied = copy != NULL;
    if (copied) {
        assert_int_equal(copy->notes.count, 20);
        assert_int_equal(copy->dropped[1], 7);
        assert_near(copy->parameters[1], 0.25, 0);
    }
    pia_summary_destroy(memory, copy);
    pia_notes_clear(memory, &summary.notes);
    return copied ? PIA_OK : pia_fail(context, PIA_E_MEMORY, "out of memory");
}

static void a_summary_is_copied_whole_or_not_at_all(void **state)
{
    (void)state;
    assert_survives_failures(copy_summary, NULL);
}

static pia_status grow_trace(pia_context *context, void *user)
{
    (void)user;
    pia_trace trace = {0};
    int grown = 1;
    for (pia_index i = 0; i < 100 && grown; i++)
        grown = pia_trace_add(pia_memory_of(context), &trace, &(pia_trace_row){.iteration = i});
    for (pia_index i = 0; i < trace.count; i++) assert_int_equal(trace.row[i].iteration, i);
    pia_trace_clear(pia_memory_of(context), &trace);
    return grown ? PIA_OK : pia_fail(context, PIA_E_MEMORY, "out of memory");
}

static void a_trace_that_cannot_grow_keeps_its_rows(void **state)
{
    (void)state;
    assert_survives_failures(grow_trace, NULL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_context_that_cannot_be_had_is_reported),
        cmocka_unit_test(take_and_give_survive_every_failure),
        cmocka_unit_test(a_summary_is_copied_whole_or_not_at_all),
        cmocka_unit_test(a_trace_that_cannot_grow_keeps_its_rows),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
