/* The curve on a surface above a straight segment of its parameter plane. */
#ifndef PIA_SPLINE_IMAGE_H
#define PIA_SPLINE_IMAGE_H

#include "model.h"

/* The curve t -> S(from + t (to - from)), t in [0, 1], exactly: a spline of degree p + q for degrees p and q of the surface, a Bezier
 * piece between any two knots that the segment crosses, rational as the surface. Both ends inside the domain. PIA_E_ARGUMENT when
 * p + q exceeds PIA_MAX_DEGREE. Cost O((p + 1)^2 (q + 1)^2) a piece. */
pia_status pia_model_image(pia_context *context, const pia_model *surface, const double from[2], const double to[2], pia_model **out);

#endif
