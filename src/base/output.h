/* Whole-or-nothing output: bytes go to a temporary file beside the target, which takes the target's name only when everything has
 * reached the disk. A crash, a full disk or a failed writer leaves the old file as it was. "-" is standard output, which is buffered
 * whole before the first byte is written; devices (/dev/full, pipes) are written in place. */
#ifndef PIA_BASE_OUTPUT_H
#define PIA_BASE_OUTPUT_H

#include "context.h"

typedef struct pia_output pia_output;

pia_status pia_output_open(pia_context *context, const char *path, pia_output **out);
/* Failures are remembered and told by pia_output_commit, so that writers need not check each call. */
void pia_output_bytes(pia_output *output, const void *bytes, size_t size);
void pia_output_text(pia_output *output, const char *format, ...) __attribute__((format(printf, 2, 3)));
/* The shortest decimal that reads back as the same double, in any locale. */
void pia_output_number(pia_output *output, double value);
/* Flushes, syncs, renames and frees. On failure the target is untouched and the temporary is gone. */
pia_status pia_output_commit(pia_output *output);
/* Gives up: removes the temporary and frees. NULL is accepted. */
void pia_output_abandon(pia_output *output);

#endif
