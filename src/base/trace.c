#include "trace.h"

int pia_trace_add(const pia_memory *memory, pia_trace *trace, const pia_trace_row *row)
{
    void *rows = trace->row;
    int grown = pia_memory_grow(memory, &rows, &trace->capacity, trace->count + 1, sizeof *trace->row);
    trace->row = rows;
    if (grown) trace->row[trace->count++] = *row;
    return grown;
}

void pia_trace_clear(const pia_memory *memory, pia_trace *trace)
{
    pia_memory_give(memory, trace->row);
    *trace = (pia_trace){0};
}
