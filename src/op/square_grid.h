/* Interpolation of grids in one step, from the points to the control points. */
#ifndef PIA_OP_SQUARE_GRID_H
#define PIA_OP_SQUARE_GRID_H

#include "windows.h"

/* Whether an operator is a grid whose unknowns are its control points, none frozen, of at most 8 components and 16384 points a line. */
int pia_square_grid_suits(const pia_op *op, int dim);

/* next [cols x dim] = A^-1 (targets - origin), and the errors of the targets and of `next` as control points: two passes over
 * lines of one direction and one over those of the other, each of which takes what it needs through the cache once. The operator's work
 * array is used. Errors: PIA_E_DATA where a pivot vanishes, PIA_E_MEMORY, PIA_E_SIZE. */
pia_status pia_square_grid_step(const pia_op *op, const pia_targets *targets, double *next, pia_step_errors *out);

#endif
