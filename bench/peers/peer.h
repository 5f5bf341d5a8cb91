/* What a peer program reads and writes. Case file: "rows dim closed tolerance", then the rows; result on standard output:
 * "seconds degree control counted" (counted: without those a closed curve
 * repeats), the knots, clamped, the control points. A peer that fails prints nothing. */
#ifndef PIA_BENCH_PEER_H
#define PIA_BENCH_PEER_H

#include <stdio.h>
#include <stdlib.h>
#include <time.h>

typedef struct peer_case {
    int rows, dim, closed;
    double tolerance, *points;
} peer_case;

static inline double peer_now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static inline peer_case peer_read(const char *path)
{
    peer_case c;
    FILE *file = fopen(path, "r");
    if (file == NULL || fscanf(file, "%d %d %d %lf", &c.rows, &c.dim, &c.closed, &c.tolerance) != 4) exit(4);
    c.points = (double *)malloc((size_t)c.rows * (size_t)c.dim * sizeof(double));
    for (int i = 0; i < c.rows * c.dim; i++)
        if (fscanf(file, "%lf", &c.points[i]) != 1) exit(4);
    fclose(file);
    return c;
}

#endif
