/* The limit of interpolating iterations: square operators solved directly, banded in each direction. */
#ifndef PIA_OP_SQUARE_H
#define PIA_OP_SQUARE_H

#include "op.h"

/* Solves A d = r for the corrections d [cols x dim], in place of the residuals r [rows x dim]. Frozen
 * unknowns keep d = 0 and their equations are left out (curves; grids solve with all free). PIA_E_DATA when singular, naming the row.
 */
pia_status pia_square_solve(const pia_op *op, double *r, int dim);

#endif
