/* The tolerance-driven fit: knots where the error is, then none that can be spared. */
#ifndef PIA_FIT_REFINE_H
#define PIA_FIT_REFINE_H

#include "fit.h"

/* Grows, spares and corrects until the tolerance holds with as few control points as can be found. Ends with fit->solve.stop set:
 * PIA_STOP_TOLERANCE, or why the tolerance could not be had; without one after so many iterations. An iteration is a round of growing,
 * of correcting, or of sparing. */
pia_status pia_refine(pia_fit *fit, pia_index iterations);
/* The same for a curve, and for a surface from a grid or from scattered points. */
pia_status pia_refine_curve(pia_fit *fit);
pia_status pia_refine_surface(pia_fit *fit);
/* 1 when no row deviates more than it may. */
int pia_refine_reached(const pia_fit *fit);

/* One round of growing: knots where the error is, least squares. *grown is 0 when no span could be split. */
pia_status pia_refine_grow(pia_fit *fit, int *grown);
/* Interpolation, where growing ends: every row met. Nothing when parameters repeat, or rows are missing. */
pia_status pia_refine_interpolate(pia_fit *fit);
/* Takes knots away as long as no row deviates more than it may. */
pia_status pia_refine_spare(pia_fit *fit, pia_index *spared);

/* What a row may deviate; the largest deviation over that among rows begin .. end - 1, from the residuals. */
double pia_refine_allowed(const pia_fit *fit, pia_index row);
double pia_refine_worst(const pia_fit *fit, pia_index begin, pia_index end);
/* Between rounds: calls the progress callback and looks at the clock. Returns 1 when the fit is to stop, with solve.stop set, or to
 * pause because the iterations asked are done. */
int pia_refine_stopped(pia_fit *fit);
/* Counts a round that has just been done, and traces it. */
pia_status pia_refine_count(pia_fit *fit);

/* Replaces the knots of a curve by `knots` (borrowed; open: control + degree + 1, closed: one period of `control` knots) and rebuilds
 * operator and normal form. The control points are left undefined. */
pia_status pia_refine_install(pia_fit *fit, const double *knots, pia_index control);
/* Least squares on the current knots: control points, errors, residuals. */
pia_status pia_refine_solve(pia_fit *fit);

/* The knots strictly inside the domain of one direction, rising [count]; the domain stays. The operator is not yet made anew. */
pia_status pia_refine_place(pia_fit *fit, int direction, const double *inside, pia_index count);
/* How little knot number degree + 1 of knot [2 degree + 3] does: the jump of the highest derivative there, as the distance that the
 * curve with control points [(degree + 2) x dim] would move over the spans beside it. */
double pia_refine_knot_cost(const double *knot, const double *points, int degree, int dim);

#endif
