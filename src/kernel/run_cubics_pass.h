/* The pass over the rows of a cubic run, for vectors of LANES doubles (`lanes`), which take a part of the eight lanes at a time.
 * Included once for each width, with `split`, which loads the components of LANES rows; AHEAD: what lies so many rows ahead is
 * fetched; what is seen of the rows in passing (`sight`, `see`); and TARGETS before functions that are made for certain processors. */
#include "run_block.h"
#include "run_cubics.h"

PIA_INLINE void fetch(const double *t, const double *q, int dim)
{
    enum { LINE = 8 /* doubles of a cache line */ };
    __builtin_prefetch(t + AHEAD);
    for (int line = 0; line < dim * LANES; line += LINE) __builtin_prefetch(q + AHEAD * dim + line);
}

/* Lanes first .. first + LANES - 1 of rows from .. to - 1. What is summed and seen is copied, to stay in registers. */
PIA_INLINE void add_lanes(const pia_run *run, pia_index from, pia_index to, int first, int dim, sight *seen,
                          double sum[PIA_CUBIC_SUMS][PIA_CUBIC_LANES])
{
    lanes plain[3], product[3], component[3][4], origin[3];
    sight here = *seen;
    double middle = run->middle, scale = run->scale;
    for (int j = 0; j < 3; j++) plain[j] = lanes_load(sum[j] + first);
    for (int j = 0; j < 3; j++) product[j] = lanes_load(sum[3 + j] + first);
    for (int j = 0; j < 4 * dim; j++) component[j / 4][j % 4] = lanes_load(sum[6 + j] + first);
    for (int d = 0; d < dim; d++) origin[d] = (lanes){0} + run->origin[d];
    for (pia_index row = from + first; row < to; row += PIA_CUBIC_LANES) {
        const double *t = run->t + row, *q = run->points + row * dim;
        lanes value[3], x = (lanes_load(t) - middle) * scale, twice = x + x, p[3] = {x, twice * x - 1};
        p[2] = twice * p[1] - x;
        fetch(t, q, dim);
        see(t, q, dim, &here);
        split(q, dim, value);
        for (int j = 0; j < 3; j++) plain[j] += p[j];
        for (int j = 0; j < 3; j++) product[j] += p[2] * p[j];
        for (int d = 0; d < dim; d++) {
            value[d] -= origin[d];
            component[d][0] += value[d];
            for (int j = 0; j < 3; j++) component[d][j + 1] += value[d] * p[j];
        }
    }
    for (int j = 0; j < 3; j++) memcpy(sum[j] + first, &plain[j], sizeof(lanes));
    for (int j = 0; j < 3; j++) memcpy(sum[3 + j] + first, &product[j], sizeof(lanes));
    for (int j = 0; j < 4 * dim; j++) memcpy(sum[6 + j] + first, &component[j / 4][j % 4], sizeof(lanes));
    *seen = here;
}

/* Rows from .. to - 1. */
TARGETS static void add_rows(const pia_run *run, pia_index from, pia_index to, sight *seen, double sum[PIA_CUBIC_SUMS][PIA_CUBIC_LANES])
{
    for (int first = 0; first < PIA_CUBIC_LANES; first += LANES)
        if (run->dim == 1)
            add_lanes(run, from, to, first, 1, seen, sum);
        else if (run->dim == 2)
            add_lanes(run, from, to, first, 2, seen, sum);
        else
            add_lanes(run, from, to, first, 3, seen, sum);
}
