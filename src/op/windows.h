/* Interpolation of long curves, a window at a time. */
#ifndef PIA_OP_WINDOWS_H
#define PIA_OP_WINDOWS_H

#include "op.h"
#include "survey.h"

/* What one step of an interpolation tells. */
typedef struct pia_step_errors {
    pia_errors before, after; /* of the control points it started from, and of those it found */
    double moved;             /* largest Euclidean length of a correction */
} pia_step_errors;

/* Whether a square operator is long enough, and plain enough: an open curve whose unknowns are its control points, none frozen. */
int pia_windows_suit(const pia_op *op);
/* The same of rows and degree alone. */
int pia_windows_suit_rows(pia_index rows, int degree);

/* next [cols x dim] = x + A^-1 (targets - A x), where `next` is not x; x NULL: the targets themselves, as interpolation starts from.
 * One pass over the data, which also measures, and looks at points and parameters unless `survey` is NULL: sets *done to 1. Where a
 * pivot vanishes or a parameter does not rise *done is 0, and the results are undefined.
 *
 * The inverse of a B-spline collocation matrix decays exponentially away from its diagonal (de Boor 1976, Demko 1977), so the
 * correction of a window is that of its equations with a margin on both sides; how well that holds shows in the errors after the step.
 * Windows depend on the problem alone. Errors: PIA_E_MEMORY. */
pia_status pia_windows_step(const pia_op *op, const double *x, const pia_targets *targets, double *next, pia_survey *survey,
                            pia_step_errors *out, int *done);

#endif
