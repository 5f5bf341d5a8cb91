/* An edit beside a fresh fit: a point of a cubic through 10^6 points of the plane, 1000 control points, is moved and the fit solved
 * again; open and closed, with and without fairing. The best of some runs of either. Then the same by epia, to a tolerance, beside an
 * edit after which all control points iterate. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#include "pia/pia.h"

enum { COUNT = 1000000, CONTROL = 1000, DIM = 2, FITS = 5, EDITS = 20, GROUPED = 4000 };

static double now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static void check(pia_context *context, pia_status status)
{
    if (status == PIA_OK) return;
    fprintf(stderr, "%s\n", pia_message(context));
    exit(6);
}

static pia_fit *open_and_solve(pia_context *context, const pia_data *data, const pia_fit_options *options, double *best)
{
    pia_fit *fit = NULL;
    for (int k = 0; k < FITS; k++) {
        pia_fit_close(fit);
        double start = now();
        check(context, pia_fit_open(context, data, options, &fit));
        check(context, pia_fit_run(fit, NULL));
        *best = fmin(*best, now() - start);
    }
    return fit;
}

static void edit_and_solve(pia_context *context, pia_fit *fit, const double *points, double *best)
{
    for (pia_index k = 0; k < EDITS; k++) {
        pia_index row = 1000 + k * (COUNT / EDITS - 100);
        const double moved[DIM] = {points[row * DIM] + 0.1, points[row * DIM + 1]};
        double start = now();
        check(context, pia_fit_move_point(fit, row, moved));
        check(context, pia_fit_run(fit, NULL));
        *best = fmin(*best, now() - start);
    }
}

/* A wave of 40 periods, whose control points are found for a tolerance. */
static void wave(double *points, pia_data *data, pia_fit_options *options)
{
    for (int i = 0; i < GROUPED; i++) {
        double t = (double)i / (GROUPED - 1);
        points[i * DIM] = 100 * t;
        points[i * DIM + 1] = sin(251.32741228718345 * t);
    }
    pia_data_init(data);
    pia_fit_options_init(options);
    data->points = points;
    data->count[0] = GROUPED;
    data->dim = DIM;
    options->method = "epia";
    options->tolerance = 0.01;
}

static double edit_by_groups(pia_context *context, double *points, int whole, pia_index *iterations)
{
    pia_data data;
    pia_fit_options options;
    pia_fit *fit = NULL;
    pia_report before = {.struct_size = sizeof before}, after = before;
    wave(points, &data, &options);
    check(context, pia_fit_open(context, &data, &options, &fit));
    check(context, pia_fit_run(fit, &before));
    const double moved[DIM] = {points[GROUPED / 2 * DIM], points[GROUPED / 2 * DIM + 1] + 0.03};
    double start = now();
    check(context, pia_fit_move_point(fit, GROUPED / 2, moved));
    if (whole) check(context, pia_fit_freeze(fit, NULL, 0, 1)); /* an edit of everything */
    check(context, pia_fit_run(fit, &after));
    start = now() - start;
    *iterations = after.iterations - before.iterations;
    pia_fit_close(fit);
    return start;
}

static void compare_groups(pia_context *context, double *points)
{
    pia_index iterations[2];
    double part = edit_by_groups(context, points, 0, &iterations[0]), whole = edit_by_groups(context, points, 1, &iterations[1]);
    printf("epia: %lld iterations of the part in %6.3f ms, %lld of the whole in %6.3f ms, ratio %.1f\n", (long long)iterations[0],
           1e3 * part, (long long)iterations[1], 1e3 * whole, whole / part);
}

static void compare(pia_context *context, double *points, double *parameters, int closed, double fairing)
{
    pia_data data;
    pia_fit_options options;
    for (int i = 0; i < COUNT; i++) {
        parameters[i] = (double)i / (closed ? COUNT : COUNT - 1);
        points[i * DIM] = cos(6.283185307179586 * parameters[i]);
        points[i * DIM + 1] = sin(6.283185307179586 * parameters[i]) + 0.01 * cos(77.0 * i);
    }
    pia_data_init(&data);
    pia_fit_options_init(&options);
    data.points = points;
    data.parameters = parameters;
    data.count[0] = COUNT;
    data.dim = DIM;
    options.control[0] = CONTROL;
    options.closed[0] = closed;
    options.fairing = fairing;
    options.placement = "uniform";
    options.method = "direct";
    double whole = INFINITY, part = INFINITY;
    pia_fit *fit = open_and_solve(context, &data, &options, &whole);
    edit_and_solve(context, fit, points, &part);
    pia_fit_close(fit);
    printf("%-6s fairing %-4g: opened and solved in %6.3f ms, edited and solved in %6.3f ms, ratio %.0f\n", closed ? "closed" : "open",
           fairing, 1e3 * whole, 1e3 * part, whole / part);
}

int main(void)
{
    pia_context *context = NULL;
    double *points = malloc(COUNT * DIM * sizeof *points), *parameters = malloc(COUNT * sizeof *parameters);
    if (points == NULL || parameters == NULL || pia_context_create(NULL, &context) != PIA_OK) return 5;
    for (int faired = 0; faired < 2; faired++)
        for (int closed = 0; closed < 2; closed++) compare(context, points, parameters, closed, 0.01 * faired);
    compare_groups(context, points);
    pia_context_destroy(context);
    free(points);
    free(parameters);
    return 0;
}
