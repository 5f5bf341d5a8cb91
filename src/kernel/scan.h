/* Checks of whole arrays, at the speed of memory. */
#ifndef PIA_KERNEL_SCAN_H
#define PIA_KERNEL_SCAN_H

#include "context.h"

/* low, high [dim] become the bounding box of points [rows x dim]. Returns 0 when a component is not finite: the box is then worthless.
 */
int pia_scan_box(const double *points, pia_index rows, int dim, double *low, double *high);

/* 1 when the values are finite and never decrease. */
int pia_scan_ordered(pia_context *context, const double *values, pia_index count);
/* 1 when the values are finite and always increase. */
int pia_scan_rising(pia_context *context, const double *values, pia_index count);

#endif
