#include "finite.h"

#include <math.h>

pia_status pia_check_finite(pia_context *context, const char *what, const double *values, pia_index count, int width)
{
    pia_index total;
    if (count < 0 || (count > 0 && values == NULL))
        return pia_fail(context, PIA_E_ARGUMENT, "%lld %ss given; give an array and how many it holds", (long long)count, what);
    if (!pia_multiply(count, width * (pia_index)sizeof *values, &total))
        return pia_fail(context, PIA_E_SIZE, "%lld %ss do not fit in 64 bits", (long long)count, what);
    for (pia_index i = 0; i < count * width; i++)
        if (!isfinite(values[i]))
            return pia_fail(context, PIA_E_DATA, "component %d of %s %lld is %g; it must be finite", (int)(i % width), what,
                            (long long)(i / width), values[i]);
    return PIA_OK;
}
