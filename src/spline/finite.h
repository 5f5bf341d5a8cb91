/* The check of every array of numbers that comes from outside. */
#ifndef PIA_SPLINE_FINITE_H
#define PIA_SPLINE_FINITE_H

#include "pia/pia.h"

/* Index of the first value that is not finite; count when all are. */
pia_index pia_finite(const double *values, pia_index count);

#endif
