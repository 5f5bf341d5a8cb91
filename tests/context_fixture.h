/* A context for every test, or for a group of them: cmocka_run_group_tests(tests, open_context, close_context); *state is the context.
 */
#ifndef PIA_TESTS_CONTEXT_FIXTURE_H
#define PIA_TESTS_CONTEXT_FIXTURE_H

#include "check.h"

static inline int open_context(void **state)
{
    return pia_context_create(NULL, (pia_context **)state) != PIA_OK;
}

static inline int close_context(void **state)
{
    pia_context_destroy(*state);
    return 0;
}

#endif
