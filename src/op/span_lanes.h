/* Sums of neighbouring spans of few rows, by their basis values. */
#ifndef PIA_OP_SPAN_LANES_H
#define PIA_OP_SPAN_LANES_H

#include "span_sums.h"

/* The shares (span_sums.h) of spans first .. first + count - 1, count at most PIA_LANES, share [count x room]: each in the order of
 * its rows, the same bits whatever its neighbours are. */
void pia_span_lanes(const pia_span_data *data, pia_index first, int count, double *share);

#endif
