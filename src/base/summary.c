#include "summary.h"

#include <string.h>

static int copy_array(const pia_memory *memory, void *to, const void *from, pia_index count, size_t size)
{
    if (from == NULL) return 1;
    void *copy = pia_memory_take(memory, count, size);
    if (copy == NULL) return 0;
    memcpy(copy, from, (size_t)count * size);
    memcpy(to, &copy, sizeof copy);
    return 1;
}

pia_summary *pia_summary_copy(const pia_memory *memory, const pia_summary *summary)
{
    pia_summary *copy = pia_memory_take(memory, 1, sizeof *copy);
    if (copy == NULL) return NULL;
    *copy =
        (pia_summary){.report = summary->report, .parameter_count = summary->parameter_count, .dropped_count = summary->dropped_count};
    if (copy_array(memory, &copy->parameters, summary->parameters, summary->parameter_count, sizeof *summary->parameters) &&
        copy_array(memory, &copy->dropped, summary->dropped, summary->dropped_count, sizeof *summary->dropped) &&
        pia_notes_copy(memory, &copy->notes, &summary->notes))
        return copy;
    pia_summary_destroy(memory, copy);
    return NULL;
}

void pia_summary_destroy(const pia_memory *memory, pia_summary *summary)
{
    if (summary == NULL) return;
    pia_notes_clear(memory, &summary->notes);
    pia_memory_give(memory, summary->parameters);
    pia_memory_give(memory, summary->dropped);
    pia_memory_give(memory, summary);
}
