#include "finite.h"

#include <math.h>

pia_index pia_finite(const double *values, pia_index count)
{
    pia_index i = 0;
    while (i < count && isfinite(values[i])) i++;
    return i;
}

pia_status pia_check_finite(pia_context *context, const char *what, const double *values, pia_index count, int width)
{
    pia_index bytes;
    if (count < 0 || (count > 0 && values == NULL))
        return pia_fail(context, PIA_E_ARGUMENT, "%lld %ss given; give an array and how many it holds", (long long)count, what);
    if (!pia_multiply(count, width * (pia_index)sizeof *values, &bytes))
        return pia_fail(context, PIA_E_SIZE, "%lld %ss do not fit in 64 bits", (long long)count, what);
    pia_index total = count * width, bad = pia_finite(values, total);
    if (bad < total)
        return pia_fail(context, PIA_E_DATA, "component %d of %s %lld is %g; it must be finite", (int)(bad % width), what,
                        (long long)(bad / width), values[bad]);
    return PIA_OK;
}
