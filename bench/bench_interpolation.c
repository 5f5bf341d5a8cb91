/* Interpolation of large data by the library, for interpolation_scipy.py: reads raw doubles, fits by `direct`, writes control points.
 *
 *   bench_interpolation curve POINTS PARAMETERS KNOTS OUT          rows x 3, rows, rows + 4
 *   bench_interpolation grid POINTS PARAMETERS KNOTS_U KNOTS_V OUT  n x n x 1
 *   bench_interpolation step ROWS                                  one iteration of pia beside a triad over 80 bytes a row
 *
 * Prints seconds; the files are read before the clock starts. Without arguments: `step 10000000`. */
#include "pia/pia.h"

#include <fcntl.h>
#include <math.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

enum { REPEATS = 6 }; /* the first one makes the memory known to the machine */

static double seconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static double elapsed(const struct timeval *from, const struct timeval *to)
{
    return (double)(to->tv_sec - from->tv_sec) + 1e-6 * (double)(to->tv_usec - from->tv_usec);
}

/* Of this program alone: ru_maxrss also knows the one that started it. */
static double peak_bytes(void)
{
    char line[256];
    double kilobytes = 0;
    FILE *file = fopen("/proc/self/status", "r");
    while (file != NULL && fgets(line, sizeof line, file) != NULL)
        if (strncmp(line, "VmHWM:", 6) == 0) kilobytes = atof(line + 6);
    if (file != NULL) fclose(file);
    return 1024 * kilobytes;
}

/* In huge pages, as the arrays of NumPy are. */
static double *take(size_t bytes)
{
    size_t page = (size_t)2 << 20, size = (bytes + page - 1) / page * page;
    double *block = aligned_alloc(page, size);
    if (block == NULL) exit(2);
    (void)madvise(block, size, MADV_HUGEPAGE);
    return block;
}

static double *load(const char *path, pia_index *count)
{
    FILE *file = fopen(path, "rb");
    struct stat info;
    if (file == NULL || fstat(fileno(file), &info) != 0) exit(2);
    *count = (pia_index)info.st_size / 8;
    double *data = take((size_t)info.st_size);
    if (fread(data, 8, (size_t)*count, file) != (size_t)*count) exit(2);
    fclose(file);
    return data;
}

static void save(const pia_model *model, const char *path)
{
    pia_model_info info = {.struct_size = sizeof info};
    pia_model_get_info(model, &info);
    size_t count = (size_t)(info.control[0] * info.control[1] * info.dim);
    double *points = malloc(count * sizeof *points);
    FILE *file = fopen(path, "wb");
    if (points == NULL || file == NULL) exit(2);
    pia_model_control(model, points, NULL);
    if (fwrite(points, sizeof *points, count, file) != count) exit(2);
    fclose(file);
    free(points);
}

static void fit_files(pia_context *context, int grid, char **path)
{
    pia_index count, parameters, knots[2] = {0, 0};
    double *q = load(path[0], &count), *t = load(path[1], &parameters), *u[2] = {load(path[2], &knots[0]), NULL};
    if (grid) u[1] = load(path[3], &knots[1]);
    pia_data data;
    pia_fit_options options;
    pia_data_init(&data);
    pia_fit_options_init(&options);
    data.kind = grid ? PIA_GRID : PIA_CURVE;
    data.points = q;
    data.parameters = t;
    data.count[0] = grid ? parameters / 2 : parameters;
    data.count[1] = grid ? parameters / 2 : 1;
    data.dim = (int)(count / (data.count[0] * data.count[1]));
    options.method = "direct";
    for (int d = 0; d < 2; d++) {
        options.knots[d] = u[d];
        options.knot_count[d] = knots[d];
    }
    struct rusage before, after;
    double peak = 0;
    for (int repeat = 0; repeat < REPEATS; repeat++) {
        pia_model *model;
        pia_report report = {.struct_size = sizeof report};
        getrusage(RUSAGE_SELF, &before);
        double start = seconds();
        if (pia_fit_data(context, &data, &options, &model, &report) != PIA_OK) {
            printf("%s\n", pia_message(context));
            exit(1);
        }
        double wall = seconds() - start;
        getrusage(RUSAGE_SELF, &after);
        printf("seconds %.6f user %.6f system %.6f max_error %.3g\n", wall, elapsed(&before.ru_utime, &after.ru_utime),
               elapsed(&before.ru_stime, &after.ru_stime), report.max_error);
        if (repeat == 0) {
            peak = peak_bytes(); /* of one fit alone: saving copies the control points */
            save(model, path[grid ? 4 : 3]);
        }
        pia_model_destroy(model);
    }
    printf("peak_over_input %.3f\n", peak / (8.0 * (double)(count + parameters)));
}

/* a = b + s c over `bytes` in all, on two threads: what the memory gives. */
typedef struct triad {
    double *a, *b, *c;
    size_t begin, end;
} triad;

static void *run_triad(void *work)
{
    triad *t = work;
    for (size_t i = t->begin; i < t->end; i++) t->a[i] = t->b[i] + 3 * t->c[i];
    return NULL;
}

static double triad_seconds(size_t bytes)
{
    size_t count = bytes / 24;
    double *a = calloc(count, 8), *b = calloc(count, 8), *c = calloc(count, 8), best = 1e9;
    if (a == NULL || b == NULL || c == NULL) exit(2);
    memset(a, 1, count * 8);
    memset(b, 1, count * 8);
    memset(c, 1, count * 8);
    for (int repeat = 0; repeat < REPEATS; repeat++) {
        triad half[2] = {{a, b, c, 0, count / 2}, {a, b, c, count / 2, count}};
        pthread_t other;
        double start = seconds();
        pthread_create(&other, NULL, run_triad, &half[1]);
        run_triad(&half[0]);
        pthread_join(other, NULL);
        best = fmin(best, seconds() - start);
    }
    free(a);
    free(b);
    free(c);
    return best;
}

static void time_step(pia_context *context, pia_index rows)
{
    double *q = malloc((size_t)rows * 24);
    if (q == NULL) exit(2);
    for (pia_index i = 0; i < rows; i++) {
        q[3 * i] = (double)i;
        q[3 * i + 1] = sin(1e-3 * (double)i);
        q[3 * i + 2] = cos(2e-3 * (double)i);
    }
    pia_data data;
    pia_fit_options options;
    pia_fit *fit;
    pia_data_init(&data);
    pia_fit_options_init(&options);
    data.points = q;
    data.count[0] = rows;
    data.dim = 3;
    options.method = "pia";
    options.placement = "average";
    options.stop_change = 0;
    options.max_iterations = 1000;
    if (pia_fit_open(context, &data, &options, &fit) != PIA_OK) exit(1);
    free(q);
    pia_fit_step(fit, 2, NULL);
    double start = seconds();
    pia_fit_step(fit, 1, NULL);
    double one = seconds() - start;
    start = seconds();
    pia_fit_step(fit, 21, NULL);
    double step = (seconds() - start - one) / 20; /* a call also measures the errors at its end */
    pia_fit_close(fit);
    double memory = triad_seconds((size_t)rows * 80);
    printf("pia step %lld rows: %.2f ms, triad over 80 bytes a row %.2f ms, step / triad %.2f\n", (long long)rows, 1e3 * step,
           1e3 * memory, step / memory);
}

int main(int argc, char **argv)
{
    pia_context *context;
    if (pia_context_create(NULL, &context) != PIA_OK) return 1;
    if (argc == 6 && strcmp(argv[1], "curve") == 0)
        fit_files(context, 0, argv + 2);
    else if (argc == 7 && strcmp(argv[1], "grid") == 0)
        fit_files(context, 1, argv + 2);
    else
        time_step(context, argc == 3 ? atoll(argv[2]) : 10000000);
    pia_context_destroy(context);
    return 0;
}
