/* The first touch of fresh memory, which the kernel clears, costs more than many a fit, and the C library gives large blocks back at
 * once. Without locks, so that a process that was forked in between cannot hang. */
#include "reserve.h"

#include <malloc.h>
#include <stdatomic.h>
#include <stdint.h>
#include <stdlib.h>
#include <sys/mman.h>

/* LEAST: from here on the C library maps memory for a block, and unmaps it. */
enum { LEAST = 128 << 10, LARGE = 8, BLOCKS = 32, MOST_BYTES = 512 << 20 };

/* Places up to LARGE are for blocks of whole huge pages, the others for smaller ones, which would crowd them out. */
typedef struct reserve {
    _Atomic(void *) block[BLOCKS];
    atomic_llong bytes;
} reserve;

static void drop(reserve *r, void *block)
{
    atomic_fetch_sub(&r->bytes, (long long)malloc_usable_size(block));
    free(block);
}

static int is_large(const void *block, size_t has)
{
    return (uintptr_t)block % PIA_HUGE_PAGE == 0 && has >= PIA_LARGE_BLOCK;
}

/* Into an empty place; returns 0 where there is none. */
static int put(reserve *r, void *block, int large)
{
    for (int k = large ? 0 : LARGE; k < (large ? LARGE : BLOCKS); k++) {
        void *none = NULL;
        if (atomic_compare_exchange_strong(&r->block[k], &none, block)) return 1;
    }
    return 0;
}

/* One of that size, or larger by `more` at most; NULL where there is none. */
static void *take_within(reserve *r, size_t size, size_t more)
{
    int large = size >= PIA_LARGE_BLOCK;
    for (int k = large ? 0 : LARGE; k < (large ? LARGE : BLOCKS); k++) {
        if (atomic_load_explicit(&r->block[k], memory_order_relaxed) == NULL) continue;
        void *block = atomic_exchange(&r->block[k], NULL);
        if (block == NULL) continue;
        size_t has = malloc_usable_size(block);
        if (has >= size && has - size <= more) {
            atomic_fetch_sub(&r->bytes, (long long)has);
            return block;
        }
        if (!put(r, block, large)) drop(r, block);
    }
    return NULL;
}

/* The same call asks for the same sizes again: one that fits is not taken from the next that needs it. */
static void *take(reserve *r, size_t size)
{
    void *block = take_within(r, size, size / 16);
    return block != NULL ? block : take_within(r, size, size / 2);
}

/* Returns 0 where it is one too many. Large pages stay what they are until somebody writes to them or the kernel has taken them. */
static int keep(reserve *r, void *block, size_t has)
{
    int large = is_large(block, has);
    if (atomic_fetch_add(&r->bytes, (long long)has) + (long long)has <= MOST_BYTES) {
        if (large) (void)madvise(block, has / PIA_HUGE_PAGE * PIA_HUGE_PAGE, MADV_FREE);
        if (put(r, block, large)) return 1;
    }
    atomic_fetch_sub(&r->bytes, (long long)has);
    return 0;
}

static void *allocate(void *user, size_t size, size_t align)
{
    const pia_memory *c = pia_memory_default();
    void *block = size >= LEAST ? take(user, size) : NULL;
    return block != NULL ? block : c->allocate(c->user, size, align);
}

static void release(void *user, void *block)
{
    size_t has = malloc_usable_size(block);
    if (has < LEAST || !keep(user, block, has)) free(block);
}

pia_status pia_reserve_open(pia_memory *out)
{
    reserve *r = calloc(1, sizeof *r);
    if (r == NULL) return PIA_E_MEMORY;
    *out = (pia_memory){allocate, release, r};
    return PIA_OK;
}

void pia_reserve_close(const pia_memory *memory)
{
    if (memory->release != release) return;
    reserve *r = memory->user;
    for (int k = 0; k < BLOCKS; k++) free(atomic_load(&r->block[k]));
    free(r);
}
