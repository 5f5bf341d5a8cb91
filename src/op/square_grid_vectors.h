/* Vectors of LANES doubles, for what solves grids. Included once for each width, with LANE_NUMBERS the numbers of the lanes. */
#include "square_grid_parts.h"
#include "vector_lanes.h"

enum { UNIT = PIA_GRID_UNIT, PARTS = UNIT / LANES /* vectors of a unit */ };

PIA_INLINE masks choose(masks mask, masks yes, masks no)
{
    return (mask & yes) | (~mask & no);
}

static int all_narrow(const unsigned char *narrow, pia_index from, pia_index to)
{
    int all = 1;
    for (pia_index i = from; i < to; i++) all &= narrow[i];
    return all;
}
