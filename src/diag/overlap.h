/* Scattered points that lie over each other: nearly the same parameters, far apart in space. No surface over such parameters comes
 * closer than half their distance. */
#ifndef PIA_DIAG_OVERLAP_H
#define PIA_DIAG_OVERLAP_H

#include "context.h"

typedef struct pia_overlap {
    pia_index row[2]; /* the pair that is farthest apart; both 0 where no two parameters are close */
    double distance;
} pia_overlap;

/* uv [count x 2], points [count x dim], count >= 1. Close means within a twentieth of the mean spacing of the parameters. A pair is
 * found when both fall into one of four shifted lattices of that width: every pair within half the width. O(count log count). Errors:
 * PIA_E_MEMORY, PIA_E_SIZE. */
pia_status pia_overlap_find(pia_context *context, const double *uv, const double *points, pia_index count, int dim, pia_overlap *out);

#endif
