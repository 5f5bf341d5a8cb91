/* The trace: one row an iteration, growing. */
#ifndef PIA_BASE_TRACE_H
#define PIA_BASE_TRACE_H

#include "memory.h"

typedef struct pia_trace {
    pia_trace_row *row;
    pia_index count, capacity;
} pia_trace;

/* Returns 0 when memory is short. */
int pia_trace_add(const pia_memory *memory, pia_trace *trace, const pia_trace_row *row);
void pia_trace_clear(const pia_memory *memory, pia_trace *trace);

#endif
