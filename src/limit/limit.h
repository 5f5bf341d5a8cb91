/* A limiter is one record in one file: what may shorten a step, given P and D. */
#ifndef PIA_LIMIT_LIMIT_H
#define PIA_LIMIT_LIMIT_H

#include "iterate.h"
#include "values.h"

typedef struct pia_limiter {
    const char *name, *title, *reference, *detail;
    const pia_parameter *parameters; /* as in a method's record */
    size_t state_size;
    pia_status (*begin)(pia_iterate *iterate, const pia_values *values, void *state);
    /* Edits D in place; sets iterate->stalled when nothing may move any more. */
    pia_status (*limit)(pia_iterate *iterate, void *state);
    void (*end)(pia_iterate *iterate, void *state);
    /* As in a method's record. NULL: begin makes all of the state. */
    void (*history)(pia_iterate *iterate, void *state, void (*visit)(void *user, const char *name, double *numbers, pia_index count),
                    void *user);
} pia_limiter;

/* The registry, collected from the files limit_*.c; NULL past the end. */
const pia_limiter *pia_limit_list(pia_index index);
const pia_limiter *pia_limit_find(const char *name);

#endif
