/* What a peer of bench_patches reads and writes. Case file: "rows columns heights tolerance" (heights 1: the first two components are a
 * lattice, whose lines are straight), then the points, columns fastest. Result on standard output: "seconds degree_u degree_v control_u
 * control_v counted", the knots of u and v, clamped, the control points, v fastest. A peer that fails prints nothing. */
#ifndef PIA_BENCH_PATCH_H
#define PIA_BENCH_PATCH_H

#include <stdio.h>
#include <stdlib.h>
#include <time.h>

typedef struct patch_case {
    int rows, columns, heights;
    double tolerance, *points;
} patch_case;

static inline double patch_now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static inline patch_case patch_read(const char *path)
{
    patch_case c;
    FILE *file = fopen(path, "r");
    if (file == NULL || fscanf(file, "%d %d %d %lf", &c.rows, &c.columns, &c.heights, &c.tolerance) != 4) exit(4);
    c.points = (double *)malloc((size_t)c.rows * (size_t)c.columns * 3 * sizeof(double));
    for (int i = 0; i < c.rows * c.columns * 3; i++)
        if (fscanf(file, "%lf", &c.points[i]) != 1) exit(4);
    fclose(file);
    return c;
}

#endif
