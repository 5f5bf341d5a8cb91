/* What a piece of parallel work costs before it does anything: one POSIX thread started and joined, against one unit of arithmetic.
 * docs/decisions/0001 rests on it. */
#include <pthread.h>
#include <stdio.h>
#include <time.h>

enum { ROUNDS = 2000, THREADS = 8 };

static double now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static void *nothing(void *argument)
{
    return argument;
}

static double microseconds(int threads)
{
    double start = now();
    for (int round = 0; round < ROUNDS; round++) {
        pthread_t thread[THREADS];
        int started = 0;
        while (started < threads && pthread_create(&thread[started], NULL, nothing, NULL) == 0) started++;
        for (int i = 0; i < started; i++) pthread_join(thread[i], NULL);
    }
    return 1e6 * (now() - start) / ROUNDS;
}

int main(void)
{
    for (int threads = 1; threads <= THREADS; threads *= 2)
        printf("start and join of %d threads: %.1f us\n", threads, microseconds(threads));
    return 0;
}
