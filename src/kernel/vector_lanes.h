/* Vectors of LANES doubles, for what is included once for each width: LANES is defined before. */
#ifndef PIA_KERNEL_VECTOR_LANES_H
#define PIA_KERNEL_VECTOR_LANES_H

#include "vector.h"

#include <string.h>

typedef double lanes __attribute__((vector_size(LANES * sizeof(double))));
typedef int64_t masks __attribute__((vector_size(LANES * sizeof(int64_t)))); /* -1: true */

PIA_INLINE lanes lanes_load(const double *from)
{
    lanes value;
    memcpy(&value, from, sizeof value);
    return value;
}

PIA_INLINE void lanes_store(lanes value, double *to)
{
    memcpy(to, &value, sizeof value);
}

/* As pia_vector_lower and pia_vector_upper. */
PIA_INLINE lanes lanes_lower(lanes a, lanes b)
{
    double x[LANES], y[LANES];
    memcpy(x, &a, sizeof x);
    memcpy(y, &b, sizeof y);
    for (int l = 0; l < LANES; l++) y[l] = x[l] < y[l] ? x[l] : y[l];
    return lanes_load(y);
}

PIA_INLINE lanes lanes_upper(lanes a, lanes b)
{
    double x[LANES], y[LANES];
    memcpy(x, &a, sizeof x);
    memcpy(y, &b, sizeof y);
    for (int l = 0; l < LANES; l++) y[l] = x[l] > y[l] ? x[l] : y[l];
    return lanes_load(y);
}

#endif
