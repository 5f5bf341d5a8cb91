/* The limit in one step: the banded (curve) or Kronecker (grid) interpolation equations, or the normal equations of least squares,
 * solved for the correction of the current P. A second step is taken where the first one left more than rounding. */
#include "constraint.h"
#include "method.h"
#include "square.h"
#include "square_grid.h"
#include "windows.h"

#include <math.h>

enum { ENOUGH_STEPS = 4 };

static const double ENOUGH = 1e-14; /* error or gradient of a limit, as far as rounding lets anybody see */
static const double MISSED = 1e-6;  /* of the extent: by more than this constraints are missed, whatever the gradient says */

typedef struct direct {
    double steps, left; /* what the step before left: the largest error, or the relative gradient */
    int factored;
} direct;

/* Whether the step before left what needs no other: an interpolation that told it itself, or a gradient whose length, which takes no
 * array, is rounding. */
static int is_settled(pia_iterate *iterate, const direct *d)
{
    if (!(d->steps > 0)) return 0;
    if (iterate->square) return iterate->errors_known && iterate->errors.max / iterate->extent <= ENOUGH;
    return iterate->constraints == NULL && pia_iterate_gradient_length(iterate) && iterate->relative_gradient <= ENOUGH;
}

/* Residuals go straight into D, so that no second array of them is needed. */
static double remaining_error(pia_iterate *iterate)
{
    iterate->errors = pia_op_residual(iterate->op, iterate->points, &iterate->targets, iterate->adjust);
    iterate->errors_known = iterate->residual == NULL;
    return iterate->errors.max / iterate->extent;
}

/* What the constraints forbid does not count, and does not change the constrained solution; where they are missed, that is enough to
 * know that P is not the limit. */
static double remaining_gradient(pia_iterate *iterate)
{
    const pia_constraints *constraints = iterate->constraints;
    pia_iterate_gradient(iterate, iterate->adjust);
    if (constraints == NULL) return iterate->relative_gradient;
    double violation = pia_constraints_violation(constraints, iterate->points, NULL) / iterate->extent;
    if (violation <= MISSED) {
        pia_constraints_reduce(constraints, iterate->adjust);
        iterate->relative_gradient = sqrt(pia_iterate_dot(iterate, iterate->adjust, iterate->adjust));
        if (iterate->right_norm > 0) iterate->relative_gradient /= iterate->right_norm;
    }
    return iterate->relative_gradient = fmax(iterate->relative_gradient, violation);
}

static pia_status solve(pia_iterate *iterate, direct *d)
{
    if (iterate->square) {
        pia_op_mask(iterate->op, iterate->adjust, iterate->dim);
        return pia_square_solve(iterate->op, iterate->adjust, iterate->dim);
    }
    pia_normal *normal = iterate->normal;
    int first = !d->factored;
    pia_status status = first ? normal->class->factor(normal) : PIA_OK;
    d->factored = 1;
    if (status == PIA_OK && normal->delicate)
        status = normal->class->correct(normal, &iterate->targets, iterate->points, iterate->adjust);
    if (status == PIA_OK && !normal->delicate) normal->class->solve(normal, iterate->adjust, iterate->dim);
    pia_op_mask(iterate->op, iterate->adjust, iterate->dim);
    if (status != PIA_OK || iterate->constraints == NULL) return status;
    if (first) status = pia_constraints_factor(iterate->constraints, normal);
    return status == PIA_OK ? pia_constraints_correct(iterate->constraints, normal, iterate->points, iterate->adjust) : status;
}

static pia_status adjust(pia_iterate *iterate, void *state)
{
    direct *d = state;
    if (!iterate->square && iterate->normal == NULL)
        return pia_fail(iterate->context, PIA_E_ARGUMENT, "direct has no normal equations here; use cg");
    iterate->finished = is_settled(iterate, d);
    if (iterate->finished) return PIA_OK;
    double left = iterate->square ? remaining_error(iterate) : remaining_gradient(iterate);
    iterate->finished = d->steps > 0 && (left <= ENOUGH || left > d->left / 4 || d->steps >= ENOUGH_STEPS);
    if (iterate->finished) return PIA_OK;
    pia_status status = solve(iterate, d);
    d->left = left;
    d->steps++;
    return status;
}

/* For a step that needs control points as numbers: those of the start, or the targets. */
static pia_status take_points(pia_iterate *iterate)
{
    pia_index count = iterate->op->cols * iterate->dim;
    if (iterate->points != NULL) return PIA_OK;
    if (iterate->start != NULL) return iterate->start(iterate->owner);
    iterate->points = pia_take(iterate->context, count, sizeof *iterate->points);
    if (iterate->points == NULL) return PIA_E_MEMORY;
    for (pia_index i = 0; i < count; i++) iterate->points[i] = iterate->targets.points[i] - iterate->targets.origin[i % iterate->dim];
    return PIA_OK;
}

static pia_status take_adjust(pia_iterate *iterate)
{
    if (iterate->adjust == NULL) iterate->adjust = pia_take(iterate->context, iterate->op->cols * iterate->dim, sizeof(double));
    return iterate->adjust != NULL ? PIA_OK : PIA_E_MEMORY;
}

/* What a step told of itself. */
static void take_errors(pia_iterate *iterate, direct *d, const pia_step_errors *errors)
{
    iterate->errors = errors->before;
    iterate->next_errors = errors->after;
    iterate->errors_known = iterate->next_errors_known = 1;
    iterate->adjust_max = errors->moved;
    d->left = errors->before.max / iterate->extent;
    d->steps++;
}

/* A step that is all of the way. It looks at points that nobody has looked at before. */
static pia_status step_at_once(pia_iterate *iterate, direct *d, int *done)
{
    pia_step_errors errors;
    pia_survey seen, *survey = iterate->look != NULL ? &seen : NULL;
    pia_status status = PIA_OK;
    *done = 1;
    if (iterate->op->directions == 2)
        status = pia_square_grid_step(iterate->op, &iterate->targets, iterate->adjust, survey, &errors);
    else
        status = pia_windows_step(iterate->op, iterate->points, &iterate->targets, iterate->adjust, survey, &errors, done);
    if (status == PIA_OK && survey != NULL)
        status =
            *done ? iterate->look(iterate->owner, survey) : pia_fail(iterate->context, PIA_E_DATA, "the points are to be seen first");
    if (status == PIA_OK && *done) take_errors(iterate, d, &errors);
    return status;
}

/* Long curves, and grids whose control points start at the points. */
static int goes_at_once(const pia_iterate *iterate, const direct *d)
{
    if (!iterate->square || d->steps > 0) return 0;
    return pia_windows_suit(iterate->op) || (iterate->points == NULL && pia_square_grid_suits(iterate->op, iterate->dim));
}

/* From control points that are all 0. */
static pia_status leap(pia_iterate *iterate, direct *d, int *done)
{
    const pia_normal *normal = iterate->normal;
    pia_status status = normal->class->leap(normal, iterate->dim, iterate->adjust, done);
    if (status != PIA_OK || !*done) return status;
    iterate->relative_gradient = d->left = 1;
    iterate->adjust_max = pia_iterate_longest(iterate, iterate->adjust);
    d->steps++;
    return PIA_OK;
}

static int may_leap(const pia_iterate *iterate)
{
    const pia_normal *normal = iterate->normal;
    return iterate->points == NULL && iterate->start != NULL && normal != NULL && normal->class->leap != NULL;
}

static pia_status step(pia_iterate *iterate, void *state)
{
    direct *d = state;
    int done = 0;
    iterate->finished = is_settled(iterate, d);
    if (iterate->finished) return PIA_OK;
    pia_status status = take_adjust(iterate);
    if (status == PIA_OK && goes_at_once(iterate, d)) status = step_at_once(iterate, d, &done);
    if (status == PIA_OK && may_leap(iterate)) status = leap(iterate, d, &done);
    if (status != PIA_OK || done) return status;
    status = take_points(iterate);
    if (status == PIA_OK) status = adjust(iterate, state);
    if (status != PIA_OK || iterate->finished) return status;
    iterate->adjust_max = pia_iterate_longest(iterate, iterate->adjust);
    pia_iterate_add(iterate, iterate->adjust, iterate->points);
    return PIA_OK;
}

const pia_method pia_method_direct = {
    .name = "direct",
    .title = "the limit itself: interpolation or least squares by a direct solve",
    .reference = "piegl1997",
    .detail = "interpolates, or least squares when fewer control points are asked; constraints; finite",
    .needs = PIA_IS_FINITE | PIA_LEAST_SQUARES | PIA_KNOWS_CONSTRAINTS | PIA_NEEDS_NORMAL,
    .iterations = ENOUGH_STEPS,
    .state_size = sizeof(direct),
    .adjust = adjust,
    .step = step,
};
