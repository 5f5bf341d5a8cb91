/* The allocator as a value, so that a model can release itself after its context's call is over. */
#ifndef PIA_BASE_MEMORY_H
#define PIA_BASE_MEMORY_H

#include "pia/pia.h"

typedef struct pia_memory {
    void *(*allocate)(void *user, size_t size, size_t align);
    void (*release)(void *user, void *block);
    void *user;
} pia_memory;

enum {
    PIA_HUGE_PAGE = 2 << 20,
    PIA_LARGE_BLOCK = 2 * PIA_HUGE_PAGE /* whole huge pages from here on: at most half more, of which only what is used is touched */
};

/* The C library's allocator. */
const pia_memory *pia_memory_default(void);

/* a * b without wrapping; returns 0 when a factor is negative or the product does not fit in pia_index. Every product of sizes goes
 * through here. */
int pia_multiply(pia_index a, pia_index b, pia_index *product);

/* count * size bytes aligned to 64; NULL on overflow or when the allocator has none. count 0 gives a valid block. */
void *pia_memory_take(const pia_memory *memory, pia_index count, size_t size);
void pia_memory_give(const pia_memory *memory, void *block);

/* Room for at least `wanted` elements in a growing array: *block of *capacity elements grows by half again. Returns 0 and leaves
 * both as they were when memory is short. */
int pia_memory_grow(const pia_memory *memory, void **block, pia_index *capacity, pia_index wanted, size_t size);

#endif
