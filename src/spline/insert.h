/* Knots added to a model, for splitting and Bezier pieces as well. */
#ifndef PIA_SPLINE_INSERT_H
#define PIA_SPLINE_INSERT_H

#include "model.h"

/* The same shape with every inside knot of `direction` degree-fold. */
pia_status pia_model_saturate(pia_context *context, const pia_model *model, int direction, pia_model **out);

/* A copy over the same knots, without the summary of a fit. */
pia_status pia_model_copy(pia_context *context, const pia_model *model, pia_model **out);

#endif
