/* The limit of interpolating iterations: square operators solved directly, banded in each direction. */
#ifndef PIA_OP_SQUARE_H
#define PIA_OP_SQUARE_H

#include "op.h"

/* Solves A d = r for the corrections d [cols x dim], in place of r, r[c] being the residual of the row that owns unknown c. Frozen
 * unknowns keep d = 0 and their equations are left out (curves; grids solve with all free). PIA_E_DATA when singular, naming the row. */
pia_status pia_square_solve(const pia_op *op, double *r, int dim);

/* One direction: A d = r for an array [unknowns x width] of right-hand sides. frozen [unknowns] or NULL. */
pia_status pia_square_line(pia_context *context, const pia_collocation *c, const unsigned char *frozen, double *r, int width);

#endif
