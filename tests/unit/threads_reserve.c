/* Large blocks are kept for the next that asks for one of their size, and handed to one at a time. */
#include "reserve.h"

#include "check.h"
#include "context.h"

#include <pthread.h>
#include <stdatomic.h>
#include <stdint.h>
#include <string.h>

enum { LARGE = 6 << 20, THREADS = 4, ROUNDS = 200 };

static void *take(const pia_memory *memory, size_t size)
{
    void *block = pia_memory_take(memory, (pia_index)size, 1);
    assert_non_null(block);
    return block;
}

static pia_memory open_reserve(void)
{
    pia_memory memory;
    assert_ok(NULL, pia_reserve_open(&memory));
    return memory;
}

static void a_large_block_is_handed_to_the_next(void **state)
{
    (void)state;
    pia_memory memory = open_reserve();
    void *first = take(&memory, LARGE), *between = take(&memory, 64), *second;
    pia_memory_give(&memory, first);
    second = take(&memory, LARGE - 1000);
    assert_ptr_equal(second, first);
    pia_memory_give(&memory, second);
    pia_memory_give(&memory, between);
    pia_reserve_close(&memory);
}

static void smaller_blocks_leave_the_places_of_large_ones_alone(void **state)
{
    (void)state;
    pia_memory memory = open_reserve();
    void *small[40], *large = take(&memory, LARGE), *again;
    for (int k = 0; k < 40; k++) small[k] = take(&memory, 200000 + 1000 * (size_t)k);
    for (int k = 0; k < 40; k++) pia_memory_give(&memory, small[k]);
    pia_memory_give(&memory, large);
    again = take(&memory, LARGE);
    assert_ptr_equal(again, large);
    pia_memory_give(&memory, again);
    again = take(&memory, 200000);
    assert_ptr_equal(again, small[0]);
    pia_memory_give(&memory, again);
    pia_reserve_close(&memory);
}

static void a_block_that_fits_is_taken_before_a_larger_one(void **state)
{
    (void)state;
    pia_memory memory = open_reserve();
    void *larger = take(&memory, LARGE + LARGE / 3), *fitting = take(&memory, LARGE), *again;
    pia_memory_give(&memory, larger);
    pia_memory_give(&memory, fitting);
    again = take(&memory, LARGE);
    assert_ptr_equal(again, fitting);
    pia_memory_give(&memory, again);
    pia_reserve_close(&memory);
}

static void two_that_live_at_once_are_two(void **state)
{
    (void)state;
    pia_memory memory = open_reserve();
    pia_memory_give(&memory, take(&memory, LARGE));
    char *a = take(&memory, LARGE), *b = take(&memory, LARGE);
    assert_true(a + LARGE <= b || b + LARGE <= a);
    memset(a, 1, LARGE);
    memset(b, 2, LARGE);
    assert_int_equal(a[LARGE - 1], 1);
    pia_memory_give(&memory, a);
    pia_memory_give(&memory, b);
    pia_reserve_close(&memory);
}

static void a_block_of_twice_the_size_waits_for_its_like(void **state)
{
    (void)state;
    pia_memory memory = open_reserve();
    void *wide = take(&memory, 2 * LARGE), *narrow, *again;
    pia_memory_give(&memory, wide);
    narrow = take(&memory, LARGE);
    again = take(&memory, 2 * LARGE);
    assert_ptr_equal(again, wide);
    pia_memory_give(&memory, narrow);
    pia_memory_give(&memory, again);
    pia_reserve_close(&memory);
}

static void more_blocks_than_are_kept_are_released(void **state)
{
    (void)state;
    void *block[20];
    pia_memory memory = open_reserve();
    for (int k = 0; k < 20; k++) memset(block[k] = take(&memory, LARGE), k, 1 << 12);
    for (int k = 0; k < 20; k++) pia_memory_give(&memory, block[k]);
    pia_reserve_close(&memory);
}

static void a_context_has_one_and_a_given_allocator_none(void **state)
{
    (void)state;
    pia_context *context;
    pia_context_options options;
    assert_ok(NULL, pia_context_create(NULL, &context));
    void *block = take(&context->memory, LARGE);
    pia_memory_give(&context->memory, block);
    void *again = take(&context->memory, LARGE);
    assert_ptr_equal(again, block);
    pia_memory_give(&context->memory, again);
    pia_context_destroy(context);
    pia_context_options_init(&options);
    options.allocate = pia_memory_default()->allocate;
    options.release = pia_memory_default()->release;
    assert_ok(NULL, pia_context_create(&options, &context));
    assert_ptr_equal(context->memory.release, options.release);
    pia_context_destroy(context);
}

static pia_memory shared;
static atomic_int torn;

static void *work(void *number)
{
    uint64_t mark = (uint64_t)(uintptr_t)number;
    for (int round = 0; round < ROUNDS; round++) {
        size_t size = (size_t)(4 + (round + (int)mark) % 3) << 20;
        uint64_t *block = pia_memory_take(&shared, (pia_index)size, 1);
        if (block == NULL) continue;
        for (size_t k = 0; k < size / 8; k += 512) block[k] = mark;
        for (size_t k = 0; k < size / 8; k += 512)
            if (block[k] != mark) atomic_store(&torn, 1);
        pia_memory_give(&shared, block);
    }
    return NULL;
}

static void no_block_has_two_owners(void **state)
{
    (void)state;
    pthread_t thread[THREADS];
    shared = open_reserve();
    for (int k = 0; k < THREADS; k++) assert_int_equal(pthread_create(&thread[k], NULL, work, (void *)(uintptr_t)(k + 1)), 0);
    for (int k = 0; k < THREADS; k++) pthread_join(thread[k], NULL);
    assert_int_equal(atomic_load(&torn), 0);
    pia_reserve_close(&shared);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_large_block_is_handed_to_the_next),
        cmocka_unit_test(smaller_blocks_leave_the_places_of_large_ones_alone),
        cmocka_unit_test(a_block_that_fits_is_taken_before_a_larger_one),
        cmocka_unit_test(two_that_live_at_once_are_two),
        cmocka_unit_test(a_block_of_twice_the_size_waits_for_its_like),
        cmocka_unit_test(more_blocks_than_are_kept_are_released),
        cmocka_unit_test(a_context_has_one_and_a_given_allocator_none),
        cmocka_unit_test(no_block_has_two_owners),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
