#include "memory.h"

#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>

enum { ALIGNMENT = 64 /* a cache line, and every vector register */ };

/* Advice alone: the first touch of a huge page costs a third of that of the 512 small ones that it stands for. */
static void *allocate_from_c(void *user, size_t size, size_t align)
{
    (void)user;
    int large = size >= PIA_LARGE_BLOCK;
    if (large && align < PIA_HUGE_PAGE) align = PIA_HUGE_PAGE;
    if (size > SIZE_MAX - (align - 1)) return NULL;
    size_t whole = (size + align - 1) / align * align;
    void *block = aligned_alloc(align, whole);
    if (block != NULL && large) (void)madvise(block, whole, MADV_HUGEPAGE);
    return block;
}

static void release_to_c(void *user, void *block)
{
    (void)user;
    free(block);
}

const pia_memory *pia_memory_default(void)
{
    static const pia_memory memory = {allocate_from_c, release_to_c, NULL};
    return &memory;
}

int pia_multiply(pia_index a, pia_index b, pia_index *product)
{
    if (a < 0 || b < 0) return 0;
    return !__builtin_mul_overflow(a, b, product);
}

void *pia_memory_take(const pia_memory *memory, pia_index count, size_t size)
{
    pia_index bytes;
    if (!pia_multiply(count, (pia_index)size, &bytes) || (uint64_t)bytes > SIZE_MAX / 2) return NULL;
    return memory->allocate(memory->user, bytes > 0 ? (size_t)bytes : 1, ALIGNMENT);
}

void pia_memory_give(const pia_memory *memory, void *block)
{
    if (block != NULL) memory->release(memory->user, block);
}

int pia_memory_grow(const pia_memory *memory, void **block, pia_index *capacity, pia_index wanted, size_t size)
{
    if (wanted <= *capacity) return 1;
    pia_index target = *capacity + *capacity / 2;
    if (target < wanted) target = wanted;
    if (target < 16) target = 16;
    void *larger = pia_memory_take(memory, target, size);
    if (larger == NULL) return 0;
    if (*capacity > 0) memcpy(larger, *block, (size_t)*capacity * size);
    pia_memory_give(memory, *block);
    *block = larger;
    *capacity = target;
    return 1;
}
