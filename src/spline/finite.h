/* The check of every array of numbers that comes from outside. */
#ifndef PIA_SPLINE_FINITE_H
#define PIA_SPLINE_FINITE_H

#include "context.h"

/* Index of the first value that is not finite; count when all are. */
pia_index pia_finite(const double *values, pia_index count);

/* values [count x width], all finite. Errors: PIA_E_ARGUMENT when count is negative or values are missing, PIA_E_SIZE, PIA_E_DATA. They
 * name `what` (one row), its index and its value. */
pia_status pia_check_finite(pia_context *context, const char *what, const double *values, pia_index count, int width);

#endif
