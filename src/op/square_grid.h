/* Interpolation of grids in one step, from the points to the control points. */
#ifndef PIA_OP_SQUARE_GRID_H
#define PIA_OP_SQUARE_GRID_H

#include "windows.h"

/* Whether a grid of count[0] x count[1] points is one of at most 8 components and 16384 points a line. */
int pia_square_grid_suits_counts(const pia_index *count, int dim);
/* Whether an operator is such a grid, open or closed, with a control point for each point, none frozen. */
int pia_square_grid_suits(const pia_op *op, int dim);

/* next [cols x dim] = A^-1 (targets - origin), and the errors of the targets and of `next` as control points. Two passes: lines of one
 * direction, which also look at the points unless `survey` is NULL, then those of the other, which measure as well. Errors: PIA_E_DATA
 * where a pivot vanishes, PIA_E_MEMORY, PIA_E_SIZE. */
pia_status pia_square_grid_step(const pia_op *op, const pia_targets *targets, double *next, pia_survey *survey, pia_step_errors *out);

#endif
