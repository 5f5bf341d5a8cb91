/* Sums of cubic runs of up to three components, all weights 1, everything in registers. Rows are dealt to eight lanes in turn, whatever
 * the vectors of the processor are, so that the bits are the same. */
#ifndef PIA_KERNEL_RUN_CUBICS_H
#define PIA_KERNEL_RUN_CUBICS_H

#include "run.h"

enum { PIA_CUBIC_LANES = 8, PIA_CUBIC_SUMS = 18 };

/* Of rows 0 .. rows - 1, a multiple of PIA_CUBIC_LANES, one sum a lane, to be zero before: T_1, T_2, T_3; T_3 T_1, T_3 T_2, T_3 T_3;
 * then for each component q, q T_1, q T_2, q T_3. The scout (NULL: none) sees the rows as well. With vectors of four, and of eight
 * where the processor has them. */
typedef void pia_run_cubics(const pia_run *run, pia_index rows, pia_scout *scout, double sum[PIA_CUBIC_SUMS][PIA_CUBIC_LANES]);
pia_run_cubics pia_run_cubics_by_four, pia_run_cubics_by_eight;

#endif
