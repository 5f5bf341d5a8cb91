/* Parameters of scattered points: (u, v) in the unit square for every point of a cloud, from a base surface found for it. */
#ifndef PIA_PARAM_CLOUD_H
#define PIA_PARAM_CLOUD_H

#include "context.h"

typedef struct pia_cloud {
    const char *name, *title, *reference, *detail;
    int dim; /* components that points need; more are ignored */
    /* uv [count x 2] of points [count x dim], count >= 3. *closed: u is periodic, in [0, 1), because the points go all the way round;
     * where they leave out a sixteenth or more of the turn, the gap becomes the seam and u is open. Errors: PIA_E_DATA when the points
     * do not span the surface (all on a line, for example). O(count). */
    pia_status (*compute)(pia_context *context, const double *points, pia_index count, int dim, double *uv, int *closed);
} pia_cloud;

/* The rules xy, plane, cylinder, sphere; NULL past the end. */
const pia_cloud *pia_cloud_list(pia_index index);
const pia_cloud *pia_cloud_find(const char *name);

#endif
