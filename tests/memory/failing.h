/* An allocator that counts its blocks and fails the k-th request, and the loop that drives a call through every such failure.
 *
 *     static pia_status fit(pia_context *context, void *user) { ...the call, and the release of what it made... }
 *     assert_survives_failures(fit, &data);
 *
 * runs `fit` with the first, second, third, ... allocation failing (that one alone, then all from it on) until one run meets no
 * failure. Every run must say PIA_E_MEMORY with a message, or succeed by doing without, and leave no block behind. */
#ifndef PIA_TESTS_FAILING_H
#define PIA_TESTS_FAILING_H

#include <stdlib.h>

#include "check.h"

typedef struct failing {
    int64_t fail_at; /* number of the request that fails, from 1; 0: none */
    int sticky;      /* 1: all requests after it fail as well */
    int64_t requests, failures, blocks;
} failing;

static inline void *failing_allocate(void *user, size_t size, size_t align)
{
    failing *f = user;
    f->requests++;
    if (f->fail_at > 0 && (f->requests == f->fail_at || (f->sticky && f->requests > f->fail_at))) {
        f->failures++;
        return NULL;
    }
    void *block = NULL;
    if (posix_memalign(&block, align < sizeof(void *) ? sizeof(void *) : align, size) != 0) return NULL;
    memset(block, 0xa5, size); /* nobody may count on zeroes */
    f->blocks++;
    return block;
}

static inline void failing_release(void *user, void *block)
{
    if (block != NULL) ((failing *)user)->blocks--;
    free(block);
}

/* A context whose every block comes from `f`, which starts counting after the context is made. Results never depend on the thread
 * count, and neither may the order of requests: one thread, so that the k-th is always the same. */
static inline pia_context *failing_context(failing *f)
{
    pia_context_options options;
    pia_context_options_init(&options);
    options.threads = 1;
    options.allocate = failing_allocate;
    options.release = failing_release;
    options.user = f;
    *f = (failing){0};
    pia_context *context = NULL;
    assert_ok(NULL, pia_context_create(&options, &context));
    return context;
}

typedef pia_status failing_call(pia_context *context, void *user);

/* One run with the k-th request failing; returns whether it was reached. */
static inline int failing_run(failing_call *call, void *user, int64_t k, int sticky, const char *what, const char *file, int line)
{
    failing f;
    pia_context *context = failing_context(&f);
    int64_t before = f.blocks;
    f.requests = 0;
    f.fail_at = k;
    f.sticky = sticky;
    pia_status status = call(context, user);
    int reached = f.failures > 0;
    int lost = f.blocks != before;
    int wrong = status == PIA_E_MEMORY ? !reached || pia_message(context)[0] == '\0' : status != PIA_OK;
    if (lost || wrong) {
        print_error("%s with allocation %lld failing%s gave \"%s\" (%s) and left %lld blocks\n", what, (long long)k,
                    sticky ? " and all after it" : "", pia_strerror(status), pia_message(context), (long long)(f.blocks - before));
        _fail(file, line);
    }
    pia_context_destroy(context);
    if (f.blocks != 0) _fail(file, line);
    return reached;
}

static inline void failing_survives(failing_call *call, void *user, const char *what, const char *file, int line)
{
    for (int sticky = 0; sticky < 2; sticky++)
        for (int64_t k = 1; failing_run(call, user, k, sticky, what, file, line); k++) {
        }
}

#define assert_survives_failures(call, user) failing_survives((call), (user), #call, __FILE__, __LINE__)

#endif
