/* What the placements share: counts, ends, cyclic copies, the last check. */
#ifndef PIA_PLACE_SPACING_H
#define PIA_PLACE_SPACING_H

#include "place.h"

/* Degree in range, control > degree, count > 1, parameters finite, non-decreasing and not all equal; closed ones inside [0, 1). */
pia_status pia_spacing_check_problem(pia_context *context, const pia_place_problem *problem);
/* The same, and control == count. */
pia_status pia_spacing_check_square(pia_context *context, const pia_place_problem *problem);

/* Parameter `index` of the closed sequence: any index, a period of 1 every count parameters. */
double pia_spacing_cyclic(const pia_place_problem *problem, pia_index index);

/* Clamped ends: the first and the last parameter, degree + 1 times. */
void pia_spacing_clamp(const pia_place_problem *problem, double *knots);
/* Completes a vector whose knots[degree .. degree + control - 1] (closed) or inside knots between clamped ends (open) are placed: puts
 * right what rounding has disordered, adds the cyclic copies, for which knots are first rounded to multiples of 2^-51 so that a
 * period of 1 is added without rounding, and refuses inside knots that are more than degree-fold (PIA_E_SHAPE), as equal parameters
 * make them. */
pia_status pia_spacing_finish(pia_context *context, const pia_place_problem *problem, double *knots);

#endif
