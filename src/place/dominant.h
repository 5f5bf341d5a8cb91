/* Dominant points: the lines of the data (points of a curve, rows or columns of a grid) that control points stand for ([2011] Eq. (31),
 * (34), (35); Park and Lee 2007; Park 2011). A set of lines is an array `mark` [count] of 0 and 1. */
#ifndef PIA_PLACE_DOMINANT_H
#define PIA_PLACE_DOMINANT_H

#include "context.h"

/* Marks both ends and the local maxima of the curvature [count] that exceed `share` of the largest one; of a plateau, within 1e-9 of
 * the largest, its middle. Marks that are there stay. Returns how many lines are marked. O(count). */
pia_index pia_dominant_mark(const double *curvature, pia_index count, double share, unsigned char *mark);

/* Takes away marks, those of least curvature first, until `wanted` are left; the ends and the lines in `pinned` [count] (NULL: none)
 * stay. Returns PIA_E_MEMORY, or PIA_OK even where the pinned ones are more. O(count log count). */
pia_status pia_dominant_thin(pia_context *context, const double *curvature, pia_index count, pia_index wanted,
                             const unsigned char *pinned, unsigned char *mark);

/* Splits the widest gap between marks at the parameter nearest to its middle until `wanted` lines are marked; the ends are marked.
 * Returns how many are: fewer where there are no more lines. parameters [count] rise. O(count) a line that is added. */
pia_index pia_dominant_fill(const double *parameters, pia_index count, pia_index wanted, unsigned char *mark);

#endif
