/* Control points of the same shape over another knot vector, along one direction: insertion, elevation, clamping. */
#ifndef PIA_SPLINE_REBASE_H
#define PIA_SPLINE_REBASE_H

#include "model.h"

/* Coefficients of a new control point: row[k] of P_{span-degree+k}, from the target knots that follow its own (target + j + 1). */
typedef void pia_rebase_rule(const double *knots, int degree, pia_index span, const double *arguments, double *row);

/* One direction of a set of control points [outer x control x inner] and what it becomes. `rule` is pia_basis_blossom for the same
 * degree. target [target_control + its degree + 1] is clamped, over the domain of `knots` or a part of it, and holds the knots inside.
 */
typedef struct pia_rebase {
    const double *knots;
    int degree;
    pia_index control;
    pia_lines lines;
    const double *target;
    pia_index target_control;
    pia_rebase_rule *rule;
} pia_rebase;

/* from [outer x control x inner], to [outer x target_control x inner]; they do not overlap. */
void pia_rebase_points(const pia_rebase *r, const double *from, double *to);

/* A model with `direction` over the target knots, which are checked; everything else is copied, but the summary of a fit is left out.
 */
pia_status pia_model_rebase(pia_context *context, const pia_model *model, int direction, int degree, const double *target,
                            pia_index target_control, pia_rebase_rule *rule, pia_model **out);

#endif
