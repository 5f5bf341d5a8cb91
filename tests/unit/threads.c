/* Laws of every backend in the registry: whoever does the work, each chunk is done once and the answer has the same bits. */
#include <pthread.h>
#include <stdlib.h>

#include "check.h"
#include "kernel.h"

static const int crew_sizes[] = {1, 2, 3, 8, 64, 1024};
enum { CREW_SIZES = sizeof crew_sizes / sizeof *crew_sizes, CHUNKS = 500, ITEMS = 100003 };

static pia_context *context_of(const char *backend, int threads)
{
    pia_context_options options;
    pia_context_options_init(&options);
    options.backend = backend;
    options.threads = threads;
    pia_context *context = NULL;
    assert_ok(NULL, pia_context_create(&options, &context));
    return context;
}

/* Calls `law` with every backend and crew size. */
static void with_every_crew(void (*law)(pia_context *context))
{
    const pia_kernel *kernel;
    for (pia_index i = 0; (kernel = pia_kernel_list(i)) != NULL; i++)
        for (int j = 0; j < CREW_SIZES; j++) {
            pia_context *context = context_of(kernel->name, crew_sizes[j]);
            law(context);
            pia_context_destroy(context);
        }
}

static void count_visit(void *work, pia_index chunk)
{
    ((int *)work)[chunk]++;
}

static void expect_one_visit_each(pia_context *context)
{
    for (pia_index chunks = 0; chunks <= CHUNKS; chunks += chunks < 5 ? 1 : 99) {
        int visits[CHUNKS + 1] = {0};
        pia_for_each(context, chunks, count_visit, visits);
        for (pia_index c = 0; c <= CHUNKS; c++) assert_int_equal(visits[c], c < chunks);
    }
}

static void every_chunk_is_done_once(void **state)
{
    (void)state;
    with_every_crew(expect_one_visit_each);
}

typedef struct sums {
    double term[ITEMS];
    double part[CHUNKS];
    pia_index chunks;
} sums;

static void add_chunk(void *work, pia_index chunk)
{
    sums *s = work;
    double sum = 0;
    for (pia_index i = pia_chunk_begin(ITEMS, s->chunks, chunk); i < pia_chunk_begin(ITEMS, s->chunks, chunk + 1); i++)
        sum += s->term[i];
    s->part[chunk] = sum;
}

static double add_up(pia_context *context)
{
    sums *s = calloc(1, sizeof *s);
    assert_non_null(s);
    for (pia_index i = 0; i < ITEMS; i++) s->term[i] = sin(1e4 * (double)i);
    s->chunks = pia_chunk_count(ITEMS, ITEMS / CHUNKS);
    assert_in_range(s->chunks, 2, CHUNKS);
    pia_for_each(context, s->chunks, add_chunk, s);
    double sum = 0;
    for (pia_index c = 0; c < s->chunks; c++) sum += s->part[c];
    free(s);
    return sum;
}

static void expect_the_serial_sum(pia_context *context)
{
    assert_near(add_up(context), add_up(NULL), 0);
}

static void a_sum_has_the_same_bits_for_every_crew(void **state)
{
    (void)state;
    with_every_crew(expect_the_serial_sum);
}

typedef struct nest {
    pia_context *context;
    int visits[8][CHUNKS];
} nest;

static void visit_inner(void *work, pia_index chunk)
{
    nest *n = work;
    pia_for_each(n->context, CHUNKS, count_visit, n->visits[chunk]);
}

static void work_inside_work_is_done_as_well(void **state)
{
    (void)state;
    nest *n = calloc(1, sizeof *n);
    assert_non_null(n);
    n->context = context_of(NULL, 3);
    pia_for_each(n->context, 8, visit_inner, n);
    for (int i = 0; i < 8; i++)
        for (int j = 0; j < CHUNKS; j++) assert_int_equal(n->visits[i][j], 1);
    pia_context_destroy(n->context);
    free(n);
}

static void *add_up_in_own_context(void *result)
{
    pia_context *context = context_of(NULL, 2);
    for (int i = 0; i < 20; i++) *(double *)result = add_up(context);
    pia_context_destroy(context);
    return NULL;
}

static void contexts_of_different_threads_do_not_meet(void **state)
{
    (void)state;
    double result[4];
    pthread_t thread[4];
    for (int i = 0; i < 4; i++) assert_int_equal(pthread_create(&thread[i], NULL, add_up_in_own_context, &result[i]), 0);
    for (int i = 0; i < 4; i++) assert_int_equal(pthread_join(thread[i], NULL), 0);
    for (int i = 0; i < 4; i++) assert_near(result[i], add_up(NULL), 0);
}

static void chunks_cover_all_items_without_gap(void **state)
{
    (void)state;
    const pia_index counts[] = {0, 1, 7, 4096, 4097, 1000000007, INT64_MAX};
    for (int i = 0; i < 7; i++) {
        pia_index chunks = pia_chunk_count(counts[i], 1 + counts[i] / 100);
        assert_in_range(chunks, 1, 4096);
        assert_int_equal(pia_chunk_begin(counts[i], chunks, 0), 0);
        assert_int_equal(pia_chunk_begin(counts[i], chunks, chunks), counts[i]);
        for (pia_index c = 0; c < chunks; c++)
            assert_true(pia_chunk_begin(counts[i], chunks, c) <= pia_chunk_begin(counts[i], chunks, c + 1));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_chunk_is_done_once),           cmocka_unit_test(a_sum_has_the_same_bits_for_every_crew),
        cmocka_unit_test(work_inside_work_is_done_as_well),   cmocka_unit_test(contexts_of_different_threads_do_not_meet),
        cmocka_unit_test(chunks_cover_all_items_without_gap),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
