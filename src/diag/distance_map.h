/* Exact Euclidean distances on a raster. */
#ifndef PIA_DIAG_DISTANCE_MAP_H
#define PIA_DIAG_DISTANCE_MAP_H

#include "context.h"

typedef struct pia_raster {
    pia_index count[2]; /* nodes in u and v; node (i, j) at i * count[1] + j */
    double step[2];     /* distance of neighbours */
} pia_raster;

/* square [nodes]: on entry 0 at the sites and INFINITY elsewhere; on return the squared distance to the nearest site, INFINITY where
 * there is none. Lower envelopes of parabolas, a direction at a time (Felzenszwalb, Huttenlocher 2012). O(nodes). Errors: PIA_E_MEMORY,
 * PIA_E_SIZE. */
pia_status pia_distance_map(pia_context *context, const pia_raster *raster, double *square);

#endif
