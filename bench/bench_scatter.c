/* Scattered points: pia beside Gram matrix + CHOLMOD written by hand on the same points and knots.
 *
 *     bench_scatter [points control [FILE method]]
 *
 * With FILE, only the library runs, on the raw doubles u, v, x, y, z of FILE, and prints seconds and RMS: for scatter_scipy.py. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "peer_cholmod.h"
#include "pia/pia.h"

enum { DEGREE = 3, DIM = 3 };

static double now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static void *take(size_t bytes)
{
    void *block = malloc(bytes);
    if (block == NULL) exit(5);
    return block;
}

/* u, v [count x 2] and points [count x 3] of a wavy sheet with noise, the same on every machine. */
static void make_points(long count, double *parameters, double *points)
{
    uint64_t seed = 7;
    for (long i = 0; i < count; i++) {
        double random[3];
        for (int k = 0; k < 3; k++) {
            seed = seed * 6364136223846793005u + 1442695040888963407u;
            random[k] = (double)(seed >> 11) * 0x1p-53;
        }
        double u = random[0], v = random[1], z = u * (1 - u) * v * (1 + 2 * v * v) + 0.01 * random[2];
        memcpy(parameters + 2 * i, (double[]){u, v}, 2 * sizeof(double));
        memcpy(points + 3 * i, (double[]){u + 0.1 * v, v, z}, 3 * sizeof(double));
    }
}

static void even_knots(int control, double *knots)
{
    for (int i = 0; i < control + DEGREE + 1; i++) {
        int k = i - DEGREE, spans = control - DEGREE;
        knots[i] = k < 0 ? 0 : k > spans ? 1 : (double)k / spans;
    }
}

static double fit(long count, const double *parameters, const double *points, int control, const double *knots, const char *method,
                  double *model_points, pia_report *report)
{
    pia_context *context;
    pia_data data;
    pia_fit_options options;
    pia_model *model;
    if (pia_context_create(NULL, &context) != PIA_OK) exit(6);
    pia_data_init(&data);
    pia_fit_options_init(&options);
    data.kind = PIA_SCATTERED;
    data.points = points;
    data.count[0] = count;
    data.dim = DIM;
    data.parameters = parameters;
    options.knots[0] = options.knots[1] = knots;
    options.knot_count[0] = options.knot_count[1] = control + DEGREE + 1;
    options.method = method;
    options.stop_gradient = 1e-10;
    report->struct_size = sizeof *report;
    double start = now();
    if (pia_fit_data(context, &data, &options, &model, report) != PIA_OK) {
        fprintf(stderr, "%s\n", pia_message(context));
        exit(6);
    }
    double seconds = now() - start;
    if (model_points != NULL) pia_model_control(model, model_points, NULL);
    pia_model_destroy(model);
    pia_context_destroy(context);
    return seconds;
}

static double largest_difference(long count, const double *a, const double *b)
{
    double worst = 0;
    for (long i = 0; i < count; i++) {
        double difference = a[i] > b[i] ? a[i] - b[i] : b[i] - a[i];
        if (!(difference <= worst)) worst = difference;
    }
    return worst;
}

static void compare(long count, int control)
{
    size_t rows = (size_t)count, cols = (size_t)control * (size_t)control;
    double *parameters = take(rows * 2 * sizeof(double)), *points = take(rows * DIM * sizeof(double));
    double *ours = take(cols * DIM * sizeof(double)), *theirs = take(cols * DIM * sizeof(double));
    double *knots = take((size_t)(control + DEGREE + 1) * sizeof(double));
    pia_report report;
    make_points(count, parameters, points);
    even_knots(control, knots);
    double peer = peer_cholmod(count, parameters, points, DIM, control, DEGREE, knots, theirs);
    static const char *const methods[] = {"cg-kron", "direct", "cg"};
    for (int k = 0; k < 3; k++) {
        double seconds = fit(count, parameters, points, control, knots, methods[k], ours, &report);
        printf("%9ld points, %3d x %3d controls, %-8s %8.3f s, %4lld iterations, relative gradient %.1e", count, control, control,
               report.method, seconds, (long long)report.iterations, report.relative_gradient);
        if (peer > 0)
            printf("; Gram + CHOLMOD %.3f s, ratio %.1f, control points differ by %.1e", peer, peer / seconds,
                   largest_difference((long)cols * DIM, ours, theirs));
        printf("\n");
    }
    free(parameters), free(points), free(ours), free(theirs), free(knots);
}

static void fit_file(long count, int control, const char *path, const char *method)
{
    size_t rows = (size_t)count;
    double *parameters = take(rows * 2 * sizeof(double)), *points = take(rows * DIM * sizeof(double));
    double *knots = take((size_t)(control + DEGREE + 1) * sizeof(double));
    FILE *file = fopen(path, "rb");
    pia_report report;
    if (file == NULL || fread(parameters, 2 * sizeof(double), rows, file) != rows ||
        fread(points, DIM * sizeof(double), rows, file) != rows)
        exit(4);
    fclose(file);
    even_knots(control, knots);
    double seconds = fit(count, parameters, points, control, knots, method, NULL, &report);
    printf("%.6f %.17g %lld\n", seconds, report.rms_error, (long long)report.iterations);
    free(parameters), free(points), free(knots);
}

int main(int argc, char **argv)
{
    long count = argc > 1 ? atol(argv[1]) : 1000000;
    int control = argc > 2 ? atoi(argv[2]) : 200;
    if (argc > 4)
        fit_file(count, control, argv[3], argv[4]);
    else
        compare(count, control);
    return 0;
}
