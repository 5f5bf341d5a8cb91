/* Gaps of a lattice filled smoothly from what surrounds them. */
#ifndef PIA_REPORT_FILL_H
#define PIA_REPORT_FILL_H

#include "context.h"

/* value [rows x columns], known [rows x columns] flags. Unknown cells take the value of a coarser lattice there, and known becomes 1
 * everywhere; known cells keep theirs (pull-push: Gortler et al., The Lumigraph, SIGGRAPH 1996). Nothing known: all cells become 0.
 * O(rows columns). PIA_E_MEMORY. */
pia_status pia_fill_gaps(pia_context *context, double *value, unsigned char *known, pia_index rows, pia_index columns);

#endif
