/* Iteration counts of the accelerated least-squares methods on analytic data, beside the counts that a study of 2026 published for them
 * (docs/methods/accelerated.md), under its stop rule |g|^2 < 1e-6 |g_0|^2; and what the direct solve does in their place. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#include "pia/pia.h"

enum { METHODS = 5, MOST = 2000 };

static const char *const method[METHODS] = {"lspia-opt", "mlspia", "nmlspia", "alspia", "salspia"};

typedef struct example {
    const char *name;
    int published[METHODS]; /* 0: not given */
    pia_data data;
    pia_fit_options options;
} example;

static double seconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static double *take(pia_index count)
{
    double *block = malloc((size_t)count * sizeof *block);
    if (block == NULL) exit(1);
    return block;
}

static void check(pia_context *context, const char *what, pia_status status)
{
    if (status == PIA_OK) return;
    fprintf(stderr, "bench_published: %s: %s\n", what, pia_message(context));
    exit(1);
}

static double peaks(double x, double y)
{
    return 3 * (1 - x) * (1 - x) * exp(-x * x - (y + 1) * (y + 1)) - 10 * (x / 5 - x * x * x - pow(y, 5)) * exp(-x * x - y * y) -
           exp(-(x + 1) * (x + 1) - y * y) / 3;
}

static double franke(double u, double v)
{
    double a = 9 * u, b = 9 * v;
    return 0.75 * exp(-((a - 2) * (a - 2) + (b - 2) * (b - 2)) / 4) + 0.75 * exp(-(a + 1) * (a + 1) / 49 - (b + 1) / 10) +
           0.5 * exp(-((a - 7) * (a - 7) + (b - 3) * (b - 3)) / 4) - 0.2 * exp(-(a - 4) * (a - 4) - (b - 7) * (b - 7));
}

static int in_hole(double u, double v)
{
    static const double ellipse[4][4] = {
        {0.45, 0.25, 0.11, 0.12}, {0.72, 0.62, 0.11, 0.11}, {0.25, 0.55, 0.12, 0.11}, {0.60, 0.85, 0.11, 0.11}};
    for (int k = 0; k < 4; k++) {
        double a = (u - ellipse[k][0]) / ellipse[k][2], b = (v - ellipse[k][1]) / ellipse[k][3];
        if (a * a + b * b <= 1) return 1;
    }
    return 0;
}

enum { DINI, PEAKS, FRANKE };

static void surface_point(int which, double u, double v, double *q)
{
    const double pi = 3.14159265358979323846;
    double x = which == DINI    ? 4 * pi * u
               : which == PEAKS ? -3 + 6 * u
                                : u,
           y = which == DINI    ? 0.1 + (pi - 0.2) * v
               : which == PEAKS ? -4 + 8 * v
                                : v;
    q[0] = which == DINI ? cos(x) * sin(y) : x;
    q[1] = which == DINI ? sin(x) * sin(y) : y;
    q[2] = which == DINI ? cos(y) + log(tan(y / 2)) + x : which == PEAKS ? peaks(x, y) : in_hole(u, v) ? NAN : franke(u, v);
}

/* Control points picked from the surface at the rows and columns nearest to even spacing, holes included. */
static pia_model *picked(pia_context *context, int which, pia_index count, pia_index control, const double *knots)
{
    const int degree[2] = {3, 3};
    const pia_index controls[2] = {control, control};
    const double *both[2] = {knots, knots};
    double *points = take(control * control * 3);
    pia_model *model = NULL;
    for (pia_index i = 0; i < control * control; i++) {
        double m = (double)(count - 1), step = m / (double)(control - 1);
        double u = round(step * (double)(i / control)) / m, v = round(step * (double)(i % control)) / m;
        surface_point(which, u, v, points + 3 * i);
        if (isnan(points[3 * i + 2])) points[3 * i + 2] = franke(u, v);
    }
    check(context, "start", pia_model_create(context, 2, degree, both, controls, 3, points, NULL, &model));
    free(points);
    return model;
}

static example surface(pia_context *context, const char *name, int which, pia_index count, pia_index control)
{
    example e = {.name = name};
    double *points = take(count * count * 3), *parameters = take(2 * count), *knots = take(control + 4);
    for (pia_index i = 0; i < count; i++) parameters[i] = parameters[count + i] = (double)i / (double)(count - 1);
    for (pia_index i = 0; i < count * count; i++) surface_point(which, parameters[i / count], parameters[i % count], points + 3 * i);
    for (pia_index i = 0; i < control + 4; i++) knots[i] = i < 4 ? 0 : i >= control ? 1 : (double)(i - 3) / (double)(control - 3);
    pia_data_init(&e.data);
    pia_fit_options_init(&e.options);
    e.data.kind = PIA_GRID;
    e.data.points = points;
    e.data.parameters = parameters;
    e.data.dim = 3;
    for (int d = 0; d < 2; d++) {
        e.data.count[d] = count;
        e.options.control[d] = control;
    }
    e.options.start = picked(context, which, count, control, knots);
    free(knots);
    return e;
}

/* 10,001 points to 2001 control points, chord parameters, knots of The NURBS Book (9.68), (9.69). */
static example helix(void)
{
    example e = {.name = "helix"};
    const pia_index count = 10001;
    double *points = take(3 * count), pi = 3.14159265358979323846;
    for (pia_index i = 0; i < count; i++) {
        double turn = pi / 3 * (2 * pi * (double)i / (double)(count - 1));
        points[3 * i] = 10 * cos(turn);
        points[3 * i + 1] = 10 * sin(turn);
        points[3 * i + 2] = turn;
    }
    pia_data_init(&e.data);
    pia_fit_options_init(&e.options);
    e.data.points = points;
    e.data.count[0] = count;
    e.data.dim = 3;
    e.options.control[0] = 2001;
    e.options.parametrization = "chord";
    e.options.placement = "lsq";
    return e;
}

static void release(const example *e)
{
    free((void *)(uintptr_t)e->data.points);
    free((void *)(uintptr_t)e->data.parameters);
    pia_model_destroy((pia_model *)(uintptr_t)e->options.start);
}

/* Steps one by one until the square of the gradient has fallen by 1e-6. A step reports the gradient it started from. */
static void run(pia_context *context, const example *e, const char *name, int published)
{
    pia_fit *fit = NULL;
    pia_report report = {.struct_size = sizeof report};
    pia_fit_options options = e->options;
    options.method = name;
    options.max_iterations = MOST;
    options.stop_gradient = options.stop_change = 0;
    double start = seconds(), first = NAN;
    check(context, e->name, pia_fit_open(context, &e->data, &options, &fit));
    pia_index count = 0;
    for (;; count++) {
        check(context, e->name, pia_fit_step(fit, 1, &report));
        if (count == 0) first = report.relative_gradient;
        if (report.relative_gradient * report.relative_gradient < 1e-6 * first * first || count >= MOST - 1) break;
    }
    double time = seconds() - start;
    char told[16] = "-";
    if (published > 0) snprintf(told, sizeof told, "%d", published);
    printf("| %s | %s | %s | %s%lld | %.4f | %.3e | %.3e |\n", e->name, name, told, count == MOST - 1 ? "over " : "", (long long)count,
           time, report.max_error, report.rms_error);
    pia_fit_close(fit);
}

static void solve(pia_context *context, const example *e)
{
    pia_report report = {.struct_size = sizeof report};
    double start = seconds();
    check(context, e->name, pia_fit_data(context, &e->data, &e->options, NULL, &report));
    printf("| %s | auto: %s | - | %lld | %.4f | %.3e | %.3e |\n", e->name, report.method, (long long)report.iterations,
           seconds() - start, report.max_error, report.rms_error);
}

int main(void)
{
    pia_context *context = NULL;
    if (pia_context_create(NULL, &context) != PIA_OK) return 1;
    example examples[] = {helix(), surface(context, "Dini", DINI, 81, 31), surface(context, "peaks", PEAKS, 121, 41),
                          surface(context, "Franke", FRANKE, 101, 41)};
    static const int published[][METHODS] = {{77, 25, 6, 7, 4}, {213, 82, 30, 37, 14}, {1091, 109, 17, 15, 8}, {0, 0, 0, 0, 14}};
    printf("| data | method | published | here | seconds | largest error | RMS error |\n| --- | --- | --- | --- | --- | --- | --- |\n");
    for (int k = 0; k < 4; k++) {
        for (int i = 0; i < METHODS; i++) run(context, &examples[k], method[i], published[k][i]);
        solve(context, &examples[k]);
        release(&examples[k]);
    }
    pia_context_destroy(context);
    return 0;
}
