/* The convex hull of points in the plane. */
#ifndef PIA_DIAG_HULL_H
#define PIA_DIAG_HULL_H

#include "context.h"

/* at [count x 2] becomes the corners of the hull in its first *corners rows, counter-clockwise from the leftmost; none on the line
 * between two others. Andrew's monotone chain, O(count log count). Errors: PIA_E_DATA when all points lie on a line; PIA_E_MEMORY,
 * PIA_E_SIZE. */
pia_status pia_hull(pia_context *context, double *at, pia_index count, pia_index *corners);

#endif
