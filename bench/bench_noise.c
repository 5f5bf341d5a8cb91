/* A long noisy curve in memory: Q(t) = (cos 20 pi t, sin 20 pi t, t + 0.1 sin 14 pi t) at 100,000 parameters, plus uniform noise of
 * width 1e-3, tolerance 2e-3. (a) chord parameters of the raw points; (b) parameters corrected, true distance. The best of five runs.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#include "pia/pia.h"

enum { ROWS = 100000, RUNS = 5 };

static double seconds_of(clockid_t clock)
{
    struct timespec t;
    clock_gettime(clock, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static double noise(uint64_t *seed)
{
    *seed = *seed * 6364136223846793005u + 1442695040888963407u;
    return 1e-3 * ((double)(*seed >> 11) * 0x1p-53 - 0.5);
}

static double *noisy_points(void)
{
    double *points = malloc(3 * ROWS * sizeof *points);
    uint64_t seed = 1;
    for (int i = 0; i < ROWS; i++) {
        const double pi = 3.14159265358979323846, t = i / (ROWS - 1.0);
        points[3 * i] = cos(20 * pi * t) + noise(&seed);
        points[3 * i + 1] = sin(20 * pi * t) + noise(&seed);
        points[3 * i + 2] = t + 0.1 * sin(14 * pi * t) + noise(&seed);
    }
    return points;
}

static void measure(pia_context *context, const double *points, int distance)
{
    pia_data data;
    pia_fit_options options;
    pia_report report = {.struct_size = sizeof report};
    pia_deviation deviation = {.struct_size = sizeof deviation};
    double wall = INFINITY, processor = INFINITY;
    pia_data_init(&data);
    data.points = points;
    data.count[0] = ROWS;
    data.dim = 3;
    pia_fit_options_init(&options);
    options.tolerance = 2e-3;
    options.measure_distance = distance;
    for (int run = 0; run < RUNS; run++) {
        pia_model *model;
        double start = seconds_of(CLOCK_MONOTONIC), used = seconds_of(CLOCK_PROCESS_CPUTIME_ID);
        if (pia_fit_data(context, &data, &options, &model, &report) != PIA_OK) exit(6);
        wall = fmin(wall, seconds_of(CLOCK_MONOTONIC) - start);
        processor = fmin(processor, seconds_of(CLOCK_PROCESS_CPUTIME_ID) - used);
        if (run == 0 && pia_model_deviation(context, model, points, ROWS, NULL, &deviation, NULL) != PIA_OK) exit(6);
        pia_model_destroy(model);
    }
    printf("(%c) %s: %lld control points, deviation %.6f, true distance %.6f, %.1f ms, %.1f ms of processors\n", "ab"[distance],
           distance ? "free parameters" : "raw chord parameters", (long long)report.control_count, report.max_error,
           deviation.max_error, 1e3 * wall, 1e3 * processor);
}

int main(void)
{
    pia_context *context;
    if (pia_context_create(NULL, &context) != PIA_OK || pia_context_set_threads(context, 2) != PIA_OK) return 6;
    double *points = noisy_points();
    measure(context, points, 0);
    measure(context, points, 1);
    free(points);
    pia_context_destroy(context);
    return 0;
}
