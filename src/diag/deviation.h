/* How far points are from a model: pia_model_deviation, and its statistics for distances that are already known. */
#ifndef PIA_DIAG_DEVIATION_H
#define PIA_DIAG_DEVIATION_H

#include "context.h"

/* Statistics of distances [count], count >= 1, all finite and >= 0; the array is reordered. Percentiles by nearest rank: the smallest
 * distance that the share of points does not exceed. Sums are compensated, in an order that depends on the count alone; of equal
 * largest distances the first counts. O(count). Fills in all members but foot_points. PIA_E_MEMORY. */
pia_status pia_deviation_summarize(pia_context *context, double *distances, pia_index count, pia_deviation *out);

#endif
