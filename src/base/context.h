/* The context: what every call of the library may use, and the last failure's message.
 * base knows the kernel table only by name; kernel/kernel.h defines it. */
#ifndef PIA_BASE_CONTEXT_H
#define PIA_BASE_CONTEXT_H

#include "memory.h"
#include "pia/pia.h"

struct pia_kernel;

struct pia_context {
    pia_memory memory;
    int threads;                     /* resolved, >= 1 */
    const struct pia_kernel *kernel; /* never NULL in a live context */
    void (*log)(void *user, int level, const char *text);
    void *user;
    int (*interrupted)(void *user);
    char message[512];
};

/* Whether long work in this context is to stop. context may be NULL. */
int pia_interrupted(pia_context *context);

/* Stores one line of detail and returns `status`, so that a check is `return pia_fail(...)`. context may be NULL. */
pia_status pia_fail(pia_context *context, pia_status status, const char *format, ...) __attribute__((format(printf, 3, 4)));

/* Hands one line to the log callback, if there is one. level as in pia_context_options. context may be NULL. */
void pia_log(pia_context *context, int level, const char *format, ...) __attribute__((format(printf, 3, 4)));

/* count * size bytes, aligned to 64, with the failure described in the context; NULL when it cannot be had.
 * count 0 gives a valid block. pia_take_zero clears it. */
void *pia_take(pia_context *context, pia_index count, size_t size);
void *pia_take_zero(pia_context *context, pia_index count, size_t size);
void pia_give(pia_context *context, void *block);

/* The status to return after pia_take gave NULL: PIA_E_SIZE or PIA_E_MEMORY, as the message says. */
pia_status pia_take_status(const pia_context *context, pia_index count, size_t size);

/* Allocations go through here when no context was given: the C library's allocator, serial kernels. */
const pia_memory *pia_memory_of(const pia_context *context);

#endif
