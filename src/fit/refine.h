/* The tolerance-driven fit: knots where the error is, then none that can be spared. */
#ifndef PIA_FIT_REFINE_H
#define PIA_FIT_REFINE_H

#include "draft.h"
#include "fit.h"

/* Grows, spares and corrects until the tolerance holds with as few control points as can be found. Ends with fit->solve.stop set:
 * PIA_STOP_TOLERANCE, or why the tolerance could not be had; without one after so many iterations. Goes on after a stop that is an
 * interruption; what is settled stays so. An iteration is a round of growing,
 * of correcting, or of sparing. */
pia_status pia_refine(pia_fit *fit, pia_index iterations);
/* The same for a curve, and for a surface from a grid or from scattered points. */
pia_status pia_refine_curve(pia_fit *fit);
pia_status pia_refine_surface(pia_fit *fit);
/* 1 when no row deviates more than it may. */
int pia_refine_reached(const pia_fit *fit);

/* The knots to begin with: corners, and as many as the constraints need to hold, which they then do. Errors: PIA_E_CONSTRAINT when they
 * contradict each other or leave a row that has to be within its tolerance no chance. */
pia_status pia_refine_begin(pia_fit *fit);
/* Parameter of a row in a direction. */
double pia_refine_parameter(const pia_fit *fit, int direction, pia_index row);

/* One round of growing: knots where the error is, least squares. *grown is 0 when no span could be split. */
pia_status pia_refine_grow(pia_fit *fit, int *grown);
/* Interpolation, where growing ends: every row met. Nothing when parameters repeat, or rows are missing. */
pia_status pia_refine_interpolate(pia_fit *fit);
/* Moves the least-squares fit at hand to one that keeps the tolerance, if one is found on the same knots; else
 * nothing changes. */
pia_status pia_refine_relax(pia_fit *fit);
/* Takes knots of a curve away as long as no row deviates more than it may, whatever that does to the other rows. */
pia_status pia_refine_spare(pia_fit *fit, pia_index *spared);
/* Gaps between rows where a curve is to be held near the straight line: *wanted [rows], how far it may be from there, INFINITY where a
 * gap is narrow beside its span; and swing of the data, that or how far it is now where that is more. All NULL where there are none.
 * Errors: PIA_E_MEMORY. Then their end. */
pia_status pia_refine_find_gaps(const pia_fit *fit, pia_draft_data *data, double **wanted);
void pia_refine_drop_gaps(const pia_fit *fit, pia_draft_data *data, double **wanted);
/* Adds knots in gaps of a draft whose data->swing is more than wanted [rows], which then becomes what is wanted, where that succeeds
 * and the draft has room. Returns how many. */
pia_index pia_refine_hold(pia_draft *draft, const double *wanted);
/* How far control points move for that. */
enum { PIA_HOLD_REACH = 3 };
/* The same for knot lines of any fit, the whole of which is fitted anew each time: by least squares, which weights and fairing enter.
 */
pia_status pia_refine_spare_lines(pia_fit *fit, pia_index *spared);

/* A fit to come back to: what it had inside its domain, and its control points. */
typedef struct pia_saved {
    double *inside[2], *points;
    pia_index count[2], cols;
} pia_saved;
/* Errors: PIA_E_MEMORY, which leaves nothing to drop. */
pia_status pia_refine_save(pia_fit *fit, pia_saved *saved);
pia_status pia_refine_go_back(pia_fit *fit, const pia_saved *saved);
void pia_refine_drop(pia_fit *fit, pia_saved *saved);
/* Least squares with other knots in one direction. */
pia_status pia_refine_refit(pia_fit *fit, int direction, const double *inside, pia_index count);
/* The knots strictly inside the domain of a direction. */
pia_index pia_refine_inside_count(const pia_fit *fit, int direction);
const double *pia_refine_inside(const pia_fit *fit, int direction);

/* The constraints of a curve that has been grown, as conditions on its drafts: a direction keeps the length that it has now. Both
 * arrays are the caller's to give back, NULL without constraints; *values holds what the conditions point to. Errors: PIA_E_MEMORY. */
pia_status pia_refine_conditions(const pia_fit *fit, pia_draft_condition **conditions, pia_index *count, double **values);

/* What a row may deviate; how much a deviation [dim] is over that; the largest deviation over that among rows begin .. end - 1, from
 * the residuals. */
double pia_refine_allowed(const pia_fit *fit, pia_index row);
double pia_refine_ratio(const pia_fit *fit, pia_index row, const double *deviation);
double pia_refine_worst(const pia_fit *fit, pia_index begin, pia_index end);
/* The same among all rows, from the errors just measured where all may deviate alike. */
double pia_refine_worst_of_all(const pia_fit *fit);
/* Between rounds: calls the progress callback and looks at the clock. Returns 1 when the fit is to stop, with solve.stop set, or to
 * pause because the iterations asked are done. */
int pia_refine_stopped(pia_fit *fit);
/* Counts a round that has just been done, and traces it. */
pia_status pia_refine_count(pia_fit *fit);

/* Nothing is settled any more: the tolerance, or what is to keep it, is another one. */
void pia_refine_reopen(pia_fit *fit);

/* Whether growth still helps, by fit->stage.watch, which the second brings up to the round just done. Scattered points only; for others
 * always 1. */
int pia_refine_helps(const pia_fit *fit);
void pia_refine_watch(pia_fit *fit);
/* Makes scattered rows at their foot points of a grid; knots and control points stay. */
pia_status pia_refine_scatter(pia_fit *fit);
/* Scattered points whose true distance counts: parameters to the foot points, and least squares there. Taken back, with
 * fit->stage.feet 0, where that brings nothing, or loses the tolerance. */
pia_status pia_refine_move_to_feet(pia_fit *fit);
/* Before growth: where scattered points mostly lie on sheets over each other, the fit ends with a surface in their middle, and a note
 * says so: solve.stop is set then. */
pia_status pia_refine_look_for_sheets(pia_fit *fit);
/* A note that says why the tolerance cannot be had by scattered points. */
pia_status pia_refine_explain(pia_fit *fit);

/* Replaces the knots of a curve by `knots` (borrowed; open: control + degree + 1, closed: one period of `control` knots) and rebuilds
 * operator and normal form. The control points are left undefined. */
pia_status pia_refine_install(pia_fit *fit, const double *knots, pia_index control);
/* Least squares on the current knots: control points, errors, residuals. */
pia_status pia_refine_solve(pia_fit *fit);

/* Constraints, and the factors of the equations, for the current knots. */
pia_status pia_refine_factor(pia_fit *fit);

/* The knots strictly inside the domain of one direction, rising [count]; the domain stays. The operator is not yet made anew. */
pia_status pia_refine_place(pia_fit *fit, int direction, const double *inside, pia_index count);
/* The same as an array of the caller's; NULL: no memory. */
double *pia_refine_knots(const pia_fit *fit, int direction, const double *inside, pia_index count);
/* How little knot number degree + 1 of knot [2 degree + 3] does: the jump of the highest derivative there, as the distance that the
 * curve with control points [(degree + 2) x dim] would move over the spans beside it. */
double pia_refine_knot_cost(const double *knot, const double *points, int degree, int dim);

#endif
