/* The tolerance-driven fit: knots where the error is, then none that can be spared. */
#ifndef PIA_FIT_REFINE_H
#define PIA_FIT_REFINE_H

#include "fit.h"

/* Grows, spares and corrects a curve until the tolerance holds with as few control points as can be found. Ends with fit->solve.stop
 * set: PIA_STOP_TOLERANCE, or why the tolerance could not be had. */
pia_status pia_refine_curve(pia_fit *fit);

/* Replaces the knots of a curve by `knots` (borrowed; open: control + degree + 1, closed: one period of `control` knots) and rebuilds
 * operator and normal form. The control points are left undefined. */
pia_status pia_refine_install(pia_fit *fit, const double *knots, pia_index control);
/* Least squares on the current knots: control points, errors, residuals. */
pia_status pia_refine_solve(pia_fit *fit);

#endif
