/* What other parts of this folder use of a curve. */
#ifndef PIA_OP_OP_CURVE_H
#define PIA_OP_OP_CURVE_H

#include "op.h"

/* Errors of rows from .. to - 1 alone, full [fulls x dim]. */
pia_errors pia_op_curve_errors(const pia_op *op, const double *full, const pia_targets *targets, pia_index from, pia_index to);

#endif
