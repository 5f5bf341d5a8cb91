/* Checkpoints: the state of a running fit as named sections, each with its type, count and checksum.
 *
 * A file is the magic "PIACKPT\n", a version (uint32), then sections and an end mark, all little-endian:
 *   section: type (uint32: 1 double, 2 int64, 3 text), length of the name (uint32), count (uint64), name, values,
 *            CRC32C of all that (uint32)
 *   end:     type 0 (uint32), number of sections (uint32), CRC32C of both (uint32); nothing follows.
 * A file that is short, long or changed in any bit is refused. */
#ifndef PIA_IO_CHECKPOINT_H
#define PIA_IO_CHECKPOINT_H

#include "io.h"

typedef enum pia_section_type { PIA_SECTION_DOUBLE = 1, PIA_SECTION_INDEX, PIA_SECTION_TEXT } pia_section_type;

enum { PIA_SECTION_NAME_SIZE = 32, PIA_MAX_SECTIONS = 256 };

/* Writer: begin, put..., end on an open output; pia_output_commit tells of failures. */
typedef struct pia_checkpoint_writer {
    pia_output *output;
    uint32_t section_count;
} pia_checkpoint_writer;

void pia_checkpoint_begin(pia_checkpoint_writer *writer, pia_output *output);
/* data: [count] double, pia_index or char. name: 1 to PIA_SECTION_NAME_SIZE - 1 characters, once a file; at most PIA_MAX_SECTIONS. */
void pia_checkpoint_put(pia_checkpoint_writer *writer, const char *name, pia_section_type type, const void *data, pia_index count);
void pia_checkpoint_end(pia_checkpoint_writer *writer);

typedef struct pia_checkpoint pia_checkpoint;

/* Opens and verifies the whole file. PIA_E_FILE, PIA_E_FORMAT, PIA_E_MEMORY. */
pia_status pia_checkpoint_open(pia_context *context, const char *path, pia_checkpoint **out);
/* A copy of a section, taken with pia_take and the caller's to give back; text is followed by a NUL that *count does not count.
 * PIA_E_FORMAT when there is no section of that name and type. */
pia_status pia_checkpoint_get(pia_checkpoint *checkpoint, const char *name, pia_section_type type, void **data, pia_index *count);
/* The same into `data`, which has room for exactly `count` values; PIA_E_FORMAT when the section has another count. */
pia_status pia_checkpoint_copy(pia_checkpoint *checkpoint, const char *name, pia_section_type type, void *data, pia_index count);
/* Whether there is such a section, and how many values it has (count may be NULL). */
int pia_checkpoint_has(const pia_checkpoint *checkpoint, const char *name, pia_section_type type, pia_index *count);
void pia_checkpoint_close(pia_checkpoint *checkpoint);

/* The file already in memory, as pia_checkpoint_open uses it; `input` must outlive the checkpoint. */
pia_status pia_checkpoint_scan(pia_context *context, const pia_input *input, pia_checkpoint **out);

#endif
