/* The value of a given rank without sorting. */
#ifndef PIA_BASE_SELECT_H
#define PIA_BASE_SELECT_H

#include "context.h"

/* The value that would stand at `rank` were values [count] sorted, 0 <= rank < count. Reorders: what stands before rank is not greater,
 * what stands after it not smaller. No NaN. O(count) on average, O(count^2) for contrived orders. */
double pia_select(double *values, pia_index count, pia_index rank);

#endif
