/* Notes: what was repaired, chosen or is worth a warning, one line each, in order. They travel from a fit into its model. */
#ifndef PIA_BASE_NOTES_H
#define PIA_BASE_NOTES_H

#include "memory.h"

typedef struct pia_notes {
    char **line;
    pia_index count, capacity;
} pia_notes;

/* Appends a formatted line; a line that is already there is not repeated. Returns 0 when memory is short. */
int pia_note_add(const pia_memory *memory, pia_notes *notes, const char *format, ...) __attribute__((format(printf, 3, 4)));
/* Appends copies of all lines of `from`. Returns 0 when memory is short; `to` is then still valid. */
int pia_notes_copy(const pia_memory *memory, pia_notes *to, const pia_notes *from);
void pia_notes_clear(const pia_memory *memory, pia_notes *notes);

#endif
