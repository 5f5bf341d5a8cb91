/* The table of hot loops. Serial entries are the readable reference; a backend overrides what it does better, and what it leaves NULL
 * is filled in from serial. Work is cut into chunks whose bounds depend on the problem alone, never on the thread count, so every
 * backend gives the same bits. */
#ifndef PIA_KERNEL_KERNEL_H
#define PIA_KERNEL_KERNEL_H

#include "context.h"

/* One piece of work; `chunk` runs from 0 to chunks-1, in any order, on any thread. */
typedef void pia_task(void *work, pia_index chunk);

typedef struct pia_kernel {
    const char *name, *title;
    int (*processors)(void); /* threads worth using */
    void (*for_each)(int threads, pia_index chunks, pia_task *task, void *work);
} pia_kernel;

extern const pia_kernel pia_kernel_serial;

/* The backends of this build, best first; NULL past the end. */
const pia_kernel *pia_kernel_list(pia_index index);
/* By name; NULL name: the best. NULL when there is none of that name. */
const pia_kernel *pia_kernel_find(const char *name);

/* Runs `task` over all chunks with the context's backend and threads; serially without a context or for a single chunk. */
void pia_for_each(pia_context *context, pia_index chunks, pia_task *task, void *work);

/* Chunks of at least `grain` items that `count` items are cut into; at least 1, at most 4096. Chunk c holds
 * [pia_chunk_begin(c), pia_chunk_begin(c + 1)). */
pia_index pia_chunk_count(pia_index count, pia_index grain);
pia_index pia_chunk_begin(pia_index count, pia_index chunks, pia_index chunk);

/* Whether `check` holds for all items of 0 .. count - 1, asked in chunks [from, to) side by side. */
typedef int pia_check(const void *data, pia_index from, pia_index to);
int pia_all(pia_context *context, pia_index count, pia_check *check, const void *data);
/* to [count] = from. */
void pia_copy(pia_context *context, double *to, const double *from, pia_index count);

#endif
