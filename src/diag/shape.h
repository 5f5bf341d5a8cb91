/* Shape of planar polygons and curves: turns and inflections. */
#ifndef PIA_DIAG_SHAPE_H
#define PIA_DIAG_SHAPE_H

#include "context.h"

/* Sign of the turn between two planar edges, 1 to the left; 0 when |cross| <= 1e-12 |a||b|. */
int pia_turn_sign(const double a[2], const double b[2]);

/* Changes of the turn sign along a polygon points [count x 2]; turns of sign 0 and edges of length 0 are passed over. closed: the edge
 * from the last point to the first and the turns at both count too. */
pia_index pia_polygon_inflections(const double *points, pia_index count, int closed);

/* Whether the turns of a control polygon carry over to its B-spline curve: every `degree` consecutive legs must turn by less than pi in
 * all (the hodograph then stays in an open half-plane). Returns the first leg of a group that turns further, -1 when there is
 * none. For rational curves with positive weights it says the same. O(count degree). */
pia_index pia_polygon_first_wide_turn(const double *points, pia_index count, int degree);

/* Inflections of a planar curve (dim 2): changes of the sign of its curvature, passing over places where |C' x C''| <= 1e-12 |C'||C''|,
 * and of the turns at corners (degree-fold knots). Several samples a span, and a search wherever the curvature comes near to 0
 * between them. PIA_E_SHAPE unless the model is a planar curve. */
pia_status pia_curve_inflections(pia_context *context, const pia_model *model, pia_index *count);

#endif
