#include "finite.h"

#include <math.h>

pia_index pia_finite(const double *values, pia_index count)
{
    pia_index i = 0;
    while (i < count && isfinite(values[i])) i++;
    return i;
}
