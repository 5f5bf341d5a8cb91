/* Scattered points that lie on sheets over each other: evidence that no surface over their parameters is near all of them, unless it
 * goes to and fro between the sheets at about every point. */
#ifndef PIA_DIAG_SHEETS_H
#define PIA_DIAG_SHEETS_H

#include "context.h"

typedef struct pia_sheets {
    double share;     /* of the neighbourhoods in the parameter plane that fall apart into sheets */
    pia_index row[2]; /* of all neighbours in the parameter plane on different sheets, those whose parameters are nearest */
    double distance;  /* between the two in space; 0 where there are none */
} pia_sheets;

/* uv [count x 2], points [count x dim], count >= 1. The rows are divided into neighbourhoods of 16 to 32 that are near in the parameter
 * plane. One falls apart where its points, less their linear trend, stand in groups along a line with gaps of more than `apart` between
 * them, wider than the groups are thick, and the groups are mixed in the parameter plane: a wall is no gap where it has points, a step
 * does not mix, noise has no gaps, outliers are no group. O(count log count). Errors: PIA_E_MEMORY, PIA_E_SIZE. */
pia_status pia_sheets_find(pia_context *context, const double *uv, const double *points, pia_index count, int dim, double apart,
                           pia_sheets *out);

#endif
