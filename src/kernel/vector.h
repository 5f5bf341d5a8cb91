/* Vectors of doubles for the hot loops: four lanes, which newer processors have in one register and others in two. */
#ifndef PIA_KERNEL_VECTOR_H
#define PIA_KERNEL_VECTOR_H

#include <string.h>

#include "clones.h"

enum { PIA_LANES = 4 };

typedef double pia_lanes __attribute__((vector_size(PIA_LANES * sizeof(double))));
typedef int64_t pia_lane_masks __attribute__((vector_size(PIA_LANES * sizeof(int64_t)))); /* -1: true */

PIA_INLINE pia_lanes pia_vector_load(const double *from)
{
    pia_lanes value;
    memcpy(&value, from, sizeof value);
    return value;
}

/* Component d of PIA_LANES neighbouring rows of points [rows x dim]. */
PIA_INLINE pia_lanes pia_vector_component(const double *points, int dim, int d)
{
    return (pia_lanes){points[d], points[dim + d], points[2 * dim + d], points[3 * dim + d]};
}

/* The lower, the upper one in each lane; b where a is not a number. Loops over arrays are what compilers turn into one instruction. */
PIA_INLINE pia_lanes pia_vector_lower(pia_lanes a, pia_lanes b)
{
    double x[PIA_LANES], y[PIA_LANES];
    memcpy(x, &a, sizeof x);
    memcpy(y, &b, sizeof y);
    for (int l = 0; l < PIA_LANES; l++) y[l] = x[l] < y[l] ? x[l] : y[l];
    return pia_vector_load(y);
}

PIA_INLINE pia_lanes pia_vector_upper(pia_lanes a, pia_lanes b)
{
    double x[PIA_LANES], y[PIA_LANES];
    memcpy(x, &a, sizeof x);
    memcpy(y, &b, sizeof y);
    for (int l = 0; l < PIA_LANES; l++) y[l] = x[l] > y[l] ? x[l] : y[l];
    return pia_vector_load(y);
}

PIA_INLINE double pia_vector_sum(pia_lanes a)
{
    return (a[0] + a[1]) + (a[2] + a[3]);
}

#endif
