#include "notes.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

static int append(const pia_memory *memory, pia_notes *notes, const char *text)
{
    for (pia_index i = 0; i < notes->count; i++)
        if (strcmp(notes->line[i], text) == 0) return 1;
    size_t size = strlen(text) + 1;
    char *copy = pia_memory_take(memory, (pia_index)size, 1);
    if (copy == NULL) return 0;
    memcpy(copy, text, size);
    void *lines = notes->line;
    int grown = pia_memory_grow(memory, &lines, &notes->capacity, notes->count + 1, sizeof *notes->line);
    notes->line = lines;
    if (!grown) {
        pia_memory_give(memory, copy);
        return 0;
    }
    notes->line[notes->count++] = copy;
    return 1;
}

int pia_note_add(const pia_memory *memory, pia_notes *notes, const char *format, ...)
{
    char text[512];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    return append(memory, notes, text);
}

int pia_notes_copy(const pia_memory *memory, pia_notes *to, const pia_notes *from)
{
    for (pia_index i = 0; i < from->count; i++)
        if (!append(memory, to, from->line[i])) return 0;
    return 1;
}

void pia_notes_clear(const pia_memory *memory, pia_notes *notes)
{
    for (pia_index i = 0; i < notes->count; i++) pia_memory_give(memory, notes->line[i]);
    pia_memory_give(memory, notes->line);
    *notes = (pia_notes){0};
}
