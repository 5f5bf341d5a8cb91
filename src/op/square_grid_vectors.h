/* Vectors of LANES doubles, for what solves grids. Included once for each width, with LANE_NUMBERS the numbers of the lanes. */
#include "square_grid_parts.h"
#include "vector.h"

#include <string.h>

enum { UNIT = PIA_GRID_UNIT, PARTS = UNIT / LANES /* vectors of a unit */ };

typedef double lanes __attribute__((vector_size(LANES * sizeof(double))));
typedef int64_t masks __attribute__((vector_size(LANES * sizeof(int64_t)))); /* -1: true */

PIA_INLINE lanes load(const double *from)
{
    lanes value;
    memcpy(&value, from, sizeof value);
    return value;
}

PIA_INLINE void store(lanes value, double *to)
{
    memcpy(to, &value, sizeof value);
}

PIA_INLINE masks choose(masks mask, masks yes, masks no)
{
    return (mask & yes) | (~mask & no);
}

PIA_INLINE lanes larger(lanes a, lanes b)
{
    return (lanes)choose(a > b, (masks)a, (masks)b);
}

static int all_narrow(const unsigned char *narrow, pia_index from, pia_index to)
{
    int all = 1;
    for (pia_index i = from; i < to; i++) all &= narrow[i];
    return all;
}
