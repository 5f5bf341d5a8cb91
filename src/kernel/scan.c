#include "scan.h"

#include "clones.h"
#include "kernel.h"

#include <math.h>

/* Item i is the pair of values i, i + 1. */
PIA_CLONES static int never_falls(const void *data, pia_index from, pia_index to)
{
    const double *values = data;
    int all = 1;
    for (pia_index i = from; i < to; i++) all &= values[i] <= values[i + 1];
    return all;
}

int pia_scan_order(const double *values, pia_index from, pia_index to)
{
    return never_falls(values, from, to);
}

PIA_CLONES static int always_rises(const void *data, pia_index from, pia_index to)
{
    const double *values = data;
    int all = 1;
    for (pia_index i = from; i < to; i++) all &= values[i] < values[i + 1];
    return all;
}

/* What lies between finite values in order is finite. */
static int ends_are_finite(const double *values, pia_index count)
{
    return count < 1 || (isfinite(values[0]) && isfinite(values[count - 1]));
}

int pia_scan_ordered(pia_context *context, const double *values, pia_index count)
{
    return ends_are_finite(values, count) && pia_all(context, count - 1, never_falls, values);
}

int pia_scan_rising(pia_context *context, const double *values, pia_index count)
{
    return ends_are_finite(values, count) && pia_all(context, count - 1, always_rises, values);
}
