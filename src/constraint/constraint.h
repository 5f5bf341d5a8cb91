/* Hard constraints on the unknowns: B P = R, every row of B a linear functional (a value or a derivative at a parameter), shared by the
 * components of the points ([2023] Eqs. 5, 6, 13). Rows are scaled to absolute sum 1, so that residuals are in the units of the points.
 *
 * A constraint on a direction alone asks that the derivative is parallel to a vector: the part of B P across that vector vanishes. Such
 * a row holds dim - 1 scalar conditions that couple the components; with one of them present, the small systems of this module are set
 * up in scalar conditions instead of rows.
 *
 * Frozen unknowns need no special care: corrections are zero there, and residuals R - B P see their values. */
#ifndef PIA_CONSTRAINT_CONSTRAINT_H
#define PIA_CONSTRAINT_CONSTRAINT_H

#include "normal.h"
#include "notes.h"
#include "op.h"

typedef struct pia_constraints pia_constraints;

/* From a list in which at_point is a row of the operator; row_name [rows] gives the data rows that messages speak of (NULL: the same).
 * points [cols x dim], relative to the targets' origin, are the current unknowns: what is frozen there decides what a constraint can
 * still reach. extent: diagonal of the data's bounding box, > 0. Everything is copied but op, which is borrowed.
 * Rows that others imply are kept for pia_constraints_violation but not for solving; a note names them (notes NULL: none). soft: rows
 * may repeat and contradict each other, nothing is left out.
 * Errors: PIA_E_ARGUMENT (out of range, naming the constraint), PIA_E_CONSTRAINT (contradictory, naming the points; too many, with the
 * counts), PIA_E_MEMORY, PIA_E_SIZE. Cost O(count^2 (degree + 1)^directions + count^3 / 3). */
pia_status pia_constraints_build(const pia_op *op, const pia_targets *targets, const double *points, double extent,
                                 const pia_constraint *list, pia_index count, const pia_index *row_name, int soft, pia_notes *notes,
                                 pia_constraints **out);
void pia_constraints_close(pia_constraints *constraints);

/* Rows, as many as were given; and those (of them, or of scalar conditions where directions are constrained) that are independent. */
pia_index pia_constraints_count(const pia_constraints *constraints);
pia_index pia_constraints_rank(const pia_constraints *constraints);

/* 1 when row i is solved for; 0 when others imply it. */
int pia_constraints_keeps(const pia_constraints *constraints, pia_index i);

/* 1 when the rows are independent rows of A: each asks for the place of another data point. */
int pia_constraints_are_points(const pia_constraints *constraints);

/* 1 when a direction couples the components: scalars of an iteration are then those of all components together. */
int pia_constraints_coupled(const pia_constraints *constraints);

/* residual [count x dim] = R - B P, without the free component of directions. */
void pia_constraints_residual(const pia_constraints *constraints, const double *points, double *residual);
/* The largest Euclidean length of a row of it; `index` (NULL allowed) receives the row. */
double pia_constraints_violation(const pia_constraints *constraints, const double *points, pia_index *index);

/* multipliers [count x dim] = value, 0 in the free component of directions. */
void pia_constraints_multipliers(const pia_constraints *constraints, double value, double *multipliers);
/* y += factor * B' multipliers, multipliers [count x dim], zero in frozen unknowns. */
void pia_constraints_add(const pia_constraints *constraints, const double *multipliers, double factor, double *y);
/* The largest over the unknowns of the sum of |entries| of B in its column: with rows of sum 1 it bounds the eigenvalues of B B'. */
double pia_constraints_column_bound(const pia_constraints *constraints);

/* Sets the diagonal metric D [cols] in which the three calls below measure: NULL is 1, entries that are not positive count as the
 * largest one. A fresh set of constraints has D = 1. Errors: PIA_E_MEMORY. Cost as above. */
pia_status pia_constraints_metric(pia_constraints *constraints, const double *diagonal);
/* The part of a gradient that the constraints leave: gradient -= B' S^-1 B D^-1 gradient, S = B D^-1 B', with one refinement. */
void pia_constraints_reduce(const pia_constraints *constraints, double *gradient);
/* z = D^-1 gradient; of a reduced gradient it is a direction along which B P does not change. */
void pia_constraints_direction(const pia_constraints *constraints, const double *gradient, double *z);
/* P += D^-1 B' S^-1 (R - B P), repeated while it helps: constraints to rounding. */
void pia_constraints_finish(const pia_constraints *constraints, double *points);

/* S = B H^-1 B' of a factored normal form, for pia_constraints_correct. Cost: rank / dim solves with H. Returns PIA_E_UNAVAILABLE when
 * S is singular: H decouples unknowns that the constraints need. */
pia_status pia_constraints_factor(pia_constraints *constraints, const pia_normal *normal);
/* Turns the unconstrained correction d [cols x dim] = H^-1 (b - H P) into the constrained one: d += H^-1 B' S^-1 (R - B (P + d))
 * ([2023] Eq. 1). Errors: PIA_E_MEMORY. */
pia_status pia_constraints_correct(const pia_constraints *constraints, const pia_normal *normal, const double *points,
                                   double *correction);
/* The largest eigenvalue of B H^-1 B' by power iteration, from below; normal is factored. Cost: a solve with H a round, at most 100. */
pia_status pia_constraints_schur_bound(const pia_constraints *constraints, const pia_normal *normal, double *out);

/* Soft constraints: a normal form of the data and, with weight `weight` > 0 each, the rows of B: H + weight B'B, b + weight B'R. Every
 * method sees them as data. constraints were built as soft ones; neither they nor data are owned, both outlive it. */
pia_status pia_constraints_soften(const pia_constraints *constraints, double weight, pia_normal *data, pia_normal **out);

#endif
