#include "backend_threads.h"

#include <pthread.h>
#include <sched.h>
#include <stdatomic.h>

enum { MAX_THREADS = 1024 };

typedef struct crew {
    pia_task *task;
    void *work;
    pia_index chunks;
    _Atomic pia_index next;
} crew;

/* Every member takes the next chunk until none is left: a thread that could not be started is simply a smaller crew. */
static void *take_chunks(void *argument)
{
    crew *c = argument;
    pia_index chunk;
    while ((chunk = atomic_fetch_add_explicit(&c->next, 1, memory_order_relaxed)) < c->chunks) c->task(c->work, chunk);
    return NULL;
}

static int processors(void)
{
    cpu_set_t set;
    return sched_getaffinity(0, sizeof set, &set) == 0 ? CPU_COUNT(&set) : 1;
}

static void for_each(int threads, pia_index chunks, pia_task *task, void *work)
{
    crew c = {task, work, chunks, 0};
    pthread_t helper[MAX_THREADS];
    int helpers = 0;
    if (threads > MAX_THREADS) threads = MAX_THREADS;
    if ((pia_index)threads > chunks) threads = (int)chunks;
    while (helpers < threads - 1 && pthread_create(&helper[helpers], NULL, take_chunks, &c) == 0) helpers++;
    take_chunks(&c);
    for (int i = 0; i < helpers; i++) pthread_join(helper[i], NULL);
}

const pia_kernel pia_backend_threads = {"threads", "POSIX threads, passive between two pieces of work", processors, for_each};
