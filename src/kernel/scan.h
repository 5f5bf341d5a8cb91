/* Checks of whole arrays, at the speed of memory. */
#ifndef PIA_KERNEL_SCAN_H
#define PIA_KERNEL_SCAN_H

#include "context.h"

/* 1 when the values are finite and never decrease. */
int pia_scan_ordered(pia_context *context, const double *values, pia_index count);
/* 1 when the values are finite and always increase. */
int pia_scan_rising(pia_context *context, const double *values, pia_index count);
/* 1 when none of values[from + 1 .. to] is less than the one before it, and none is NaN. */
int pia_scan_order(const double *values, pia_index from, pia_index to);

#endif
