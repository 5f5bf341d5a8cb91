/* Least-squares fits of large data with parameters and knots given. Usage: bench_lsq [CASE...], cases as below, all by default. One
 * line a case: name; seconds of the fit alone, and with a report, which measures the errors (best of some runs, which take turns);
 * seconds of all processors for the fit alone; RMS error; relative gradient; peak memory of the process over its input. lsq_scipy.py
 * fits the same data. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <time.h>

#include "pia/pia.h"

typedef struct bench_case {
    const char *name;
    pia_kind kind;
    pia_index points, control; /* in each direction */
    int dim, runs;
} bench_case;

static const bench_case cases[] = {
    {"curve-1e7-1000", PIA_CURVE, 10000000, 1000, 3, 10}, {"curve-1e8-1000", PIA_CURVE, 100000000, 1000, 3, 3},
    {"curve-1e6-1e5", PIA_CURVE, 1000000, 100000, 3, 20}, {"grid-1000-100", PIA_GRID, 1000, 100, 3, 40},
    {"grid-4000-500", PIA_GRID, 4000, 500, 1, 10},
};

static double seconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/* In huge pages, as the arrays of NumPy are. */
static double *take(pia_index count)
{
    size_t page = (size_t)2 << 20, size = ((size_t)count * sizeof(double) + page - 1) / page * page;
    double *block = aligned_alloc(page, size);
    if (block != NULL) (void)madvise(block, size, MADV_HUGEPAGE);
    if (block == NULL) {
        fprintf(stderr, "bench_lsq: out of memory\n");
        exit(1);
    }
    return block;
}

/* In [-1/2, 1/2), the same in every language that has 64-bit integers. */
static double noise(uint64_t i)
{
    return (double)((i * 2654435761u) % 4294967296u) / 4294967296.0 - 0.5;
}

static double *make_points(const bench_case *c, pia_index rows)
{
    double *q = take(rows * c->dim), m = (double)(c->points - 1);
    for (pia_index i = 0; i < rows; i++) {
        double u = (double)(c->kind == PIA_CURVE ? i : i / c->points) / m, v = c->kind == PIA_CURVE ? 0 : (double)(i % c->points) / m;
        for (int d = 0; d < c->dim; d++)
            q[i * c->dim + d] = sin((5 + 7 * d) * u) * cos(3 * v + d) + 0.01 * noise((uint64_t)(i * c->dim + d));
    }
    return q;
}

static double *make_knots(pia_index control)
{
    double *knots = take(control + 4);
    for (pia_index i = 0; i < control + 4; i++) knots[i] = i < 4 ? 0 : i >= control ? 1 : (double)(i - 3) / (double)(control - 3);
    return knots;
}

typedef struct timing {
    double seconds, work; /* of the clock on the wall, of all processors */
} timing;

/* One fit; report NULL: none. */
static timing fit(pia_context *context, const pia_data *data, const pia_fit_options *options, pia_report *report)
{
    pia_model *model = NULL;
    double start = seconds();
    clock_t begun = clock();
    if (pia_fit_data(context, data, options, &model, report) != PIA_OK) {
        fprintf(stderr, "bench_lsq: %s\n", pia_message(context));
        exit(1);
    }
    timing t = {seconds() - start, (double)(clock() - begun) / CLOCKS_PER_SEC};
    pia_model_destroy(model);
    return t;
}

static timing better(timing a, timing b)
{
    return (timing){fmin(a.seconds, b.seconds), fmin(a.work, b.work)};
}

/* Of this program alone: getrusage would tell the peak of who started it, if that is higher. */
static double peak_bytes(void)
{
    char line[256];
    double kilobytes = NAN;
    FILE *file = fopen("/proc/self/status", "r");
    while (file != NULL && fgets(line, sizeof line, file) != NULL)
        if (strncmp(line, "VmHWM:", 6) == 0) kilobytes = strtod(line + 6, NULL);
    if (file != NULL) fclose(file);
    return 1024 * kilobytes;
}

static void run(pia_context *context, const bench_case *c)
{
    int directions = c->kind == PIA_GRID ? 2 : 1;
    pia_index rows = directions == 2 ? c->points * c->points : c->points;
    double *points = make_points(c, rows), *knots = make_knots(c->control), *parameters = take(directions * c->points);
    for (pia_index i = 0; i < directions * c->points; i++) parameters[i] = (double)(i % c->points) / (double)(c->points - 1);
    pia_data data;
    pia_fit_options options;
    pia_report report = {.struct_size = sizeof report};
    pia_data_init(&data);
    pia_fit_options_init(&options);
    data.kind = c->kind;
    data.points = points;
    data.dim = c->dim;
    data.parameters = parameters;
    for (int d = 0; d < directions; d++) {
        data.count[d] = c->points;
        options.knots[d] = knots;
        options.knot_count[d] = c->control + 4;
    }
    timing alone = {INFINITY, INFINITY}, told = alone;
    for (int k = 0; k < c->runs; k++) {
        alone = better(alone, fit(context, &data, &options, NULL));
        told = better(told, fit(context, &data, &options, &report));
    }
    double input = 8.0 * (double)(rows * c->dim + directions * c->points);
    printf("%s %.6f %.6f %.6f %.12g %.3g %.3f\n", c->name, alone.seconds, told.seconds, alone.work, report.rms_error,
           report.relative_gradient, peak_bytes() / input);
    free(points);
    free(knots);
    free(parameters);
}

int main(int count, char **names)
{
    pia_context *context = NULL;
    if (pia_context_create(NULL, &context) != PIA_OK) return 1;
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        int wanted = count < 2;
        for (int i = 1; i < count; i++) wanted |= strcmp(names[i], cases[k].name) == 0;
        if (wanted) run(context, &cases[k]);
    }
    pia_context_destroy(context);
    return 0;
}
