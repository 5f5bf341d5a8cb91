/* Runs of any degree and dimension are taken in blocks that stay in the first-level cache, a component after the other, in lanes; cubic
 * runs of up to three components a vector at a time, everything in registers. */
#ifndef PIA_KERNEL_RUN_BLOCK_H
#define PIA_KERNEL_RUN_BLOCK_H

#include <string.h>

#include "run.h"
#include "vector.h"

enum { PIA_BLOCK = 64 };

/* What lies so many rows ahead is fetched: processors do not look past the end of a page themselves. */
enum { PIA_ROWS_AHEAD = 1024 };

PIA_INLINE int pia_block_count(const pia_run *run, pia_index done)
{
    return run->count - done < PIA_BLOCK ? (int)(run->count - done) : PIA_BLOCK;
}

PIA_INLINE void pia_block_split(const double *q, const double *origin, int count, int dim, double (*component)[PIA_BLOCK])
{
    for (int d = 0; d < dim; d++)
        for (int k = 0; k < count; k++) component[d][k] = q[k * dim + d] - origin[d];
}

PIA_INLINE void pia_run_fetch(const double *t, const double *q, int dim)
{
    __builtin_prefetch(t + PIA_ROWS_AHEAD);
    __builtin_prefetch(q + PIA_ROWS_AHEAD * dim);
    if (dim > 2) __builtin_prefetch(q + PIA_ROWS_AHEAD * dim + 8);
}

PIA_INLINE int pia_run_is_cubic(const pia_run *run)
{
    return run->degree == 3 && run->dim >= 1 && run->dim <= 3;
}

/* T_1, T_2, T_3 of the next rows. */
PIA_INLINE void pia_run_cubic(const pia_run *run, const double *t, pia_lanes *polynomial)
{
    pia_lanes x = (pia_vector_load(t) - run->middle) * run->scale, twice = x + x;
    polynomial[0] = x;
    polynomial[1] = twice * x - 1;
    polynomial[2] = twice * polynomial[1] - x;
}

/* `count` points from `done` on: x and the components less the origin, with zeros up to whole lanes. Returns the whole count. */
PIA_INLINE int pia_block_fill(const pia_run *run, pia_index done, int count, double *x, double (*component)[PIA_BLOCK])
{
    int whole = (count + PIA_LANES - 1) / PIA_LANES * PIA_LANES, dim = run->dim;
    const double *t = run->t + done, *q = dim > 0 ? run->points + done * dim : NULL;
    for (int k = 0; k < count; k++) x[k] = (t[k] - run->middle) * run->scale;
    if (dim == 3)
        pia_block_split(q, run->origin, count, 3, component);
    else if (dim == 2)
        pia_block_split(q, run->origin, count, 2, component);
    else
        pia_block_split(q, run->origin, count, dim, component);
    for (int k = count; k < whole; k++) {
        x[k] = 0;
        for (int d = 0; d < dim; d++) component[d][k] = 0;
    }
    return whole;
}

#endif
