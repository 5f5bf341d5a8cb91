/* A curve through some of its points: 10,001 points, 300 control points, 40 points met exactly.
 *
 *     bench_constrained [FILE]
 *
 * With FILE (count, control, constraints, then parameters, knots, points [count x 3], rows, all as raw doubles) the fit is timed on it
 * and its error, its violation and its seconds are printed, for constrained_scipy.py. Without, the methods are compared on a curve of
 * its own. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#include "pia/pia.h"

enum { DIM = 3, DEGREE = 3, ROUNDS = 100 };

static double now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static double *take(pia_index count)
{
    double *block = malloc((size_t)count * sizeof *block);
    if (block == NULL) exit(5);
    return block;
}

/* Fits once; returns the seconds. */
static double fit(const pia_data *data, const pia_fit_options *options, pia_report *report)
{
    pia_context *context;
    if (pia_context_create(NULL, &context) != PIA_OK) exit(6);
    report->struct_size = sizeof *report;
    double start = now();
    if (pia_fit_data(context, data, options, NULL, report) != PIA_OK) {
        fprintf(stderr, "%s\n", pia_message(context));
        exit(6);
    }
    double seconds = now() - start;
    pia_context_destroy(context);
    return seconds;
}

static double best_fit(const pia_data *data, const pia_fit_options *options, pia_report *report)
{
    double best = INFINITY;
    for (int round = 0; round < ROUNDS; round++) best = fmin(best, fit(data, options, report));
    return best;
}

static void compare_methods(void)
{
    enum { COUNT = 10001, CONTROL = 300, EVERY = 250 };
    static const char *const methods[] = {"direct", "clspia-pcg", "clspia"};
    pia_index rows[COUNT / EVERY];
    double *points = take(COUNT * DIM);
    for (int i = 0; i < COUNT; i++) {
        double s = 6.283185307179586 * i / (COUNT - 1.0);
        points[DIM * i] = cos(s) * (1 + 0.2 * sin(9 * s));
        points[DIM * i + 1] = sin(s) * (1 + 0.2 * cos(7 * s));
        points[DIM * i + 2] = 0.3 * sin(5 * s) + 1e-3 * sin(1e4 * s * s);
    }
    for (int i = 0; i < COUNT / EVERY; i++) rows[i] = EVERY / 2 + (pia_index)EVERY * i;
    pia_data data;
    pia_fit_options options;
    pia_data_init(&data);
    pia_fit_options_init(&options);
    data.points = points;
    data.count[0] = COUNT;
    data.dim = DIM;
    options.control[0] = CONTROL;
    options.interpolate = rows;
    options.interpolate_count = COUNT / EVERY;
    options.stop_gradient = 1e-10;
    for (int k = 0; k < 3; k++) {
        pia_report report;
        options.method = methods[k];
        double seconds = fit(&data, &options, &report);
        printf("%d points, %d controls, %d met: %-10s %9.2f ms, %6lld iterations, constraints to %.1e, relative gradient %.1e\n", COUNT,
               CONTROL, COUNT / EVERY, report.method, 1e3 * seconds, (long long)report.iterations, report.constraint_error,
               report.relative_gradient);
    }
    free(points);
}

static double *read_doubles(FILE *file, pia_index count)
{
    double *numbers = take(count);
    if (fread(numbers, sizeof *numbers, (size_t)count, file) != (size_t)count) exit(4);
    return numbers;
}

static void fit_file(const char *path)
{
    FILE *file = fopen(path, "rb");
    if (file == NULL) exit(4);
    double *size = read_doubles(file, 3);
    pia_index count = (pia_index)size[0], control = (pia_index)size[1], met = (pia_index)size[2];
    double *parameters = read_doubles(file, count), *knots = read_doubles(file, control + DEGREE + 1);
    double *points = read_doubles(file, count * DIM), *numbers = read_doubles(file, met);
    pia_index *rows = malloc((size_t)met * sizeof *rows);
    if (rows == NULL) exit(5);
    for (pia_index i = 0; i < met; i++) rows[i] = (pia_index)numbers[i];
    fclose(file);
    pia_data data;
    pia_fit_options options;
    pia_report report;
    pia_data_init(&data);
    pia_fit_options_init(&options);
    data.points = points;
    data.count[0] = count;
    data.dim = DIM;
    data.parameters = parameters;
    options.knots[0] = knots;
    options.knot_count[0] = control + DEGREE + 1;
    options.interpolate = rows;
    options.interpolate_count = met;
    double seconds = best_fit(&data, &options, &report);
    printf("%.9f %.17g %.3g\n", seconds, report.rms_error, report.constraint_error);
    free(size), free(parameters), free(knots), free(points), free(numbers), free(rows);
}

int main(int argc, char **argv)
{
    if (argc > 1)
        fit_file(argv[1]);
    else
        compare_methods();
    return 0;
}
