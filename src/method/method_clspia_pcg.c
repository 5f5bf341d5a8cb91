/* [2023]'s problem by projected conjugate gradients (Gould, Hribar, Nocedal 2001): steps stay in the plane B P = R, so every iterate
 * meets the constraints, and its squared error is the smallest along each direction. Preconditioned by the diagonal of H. */
#include "conjugate.h"
#include "constraint.h"
#include "method.h"
#include "normalise.h"
#include "vectors.h"

#include <math.h>

static const double DRIFT = 1e-14; /* of the extent, from the constraints */

typedef struct projected {
    pia_conjugate conjugate;
    double *metric; /* [cols] the diagonal of H; without constraints its reciprocals */
} projected;

static pia_status begin(pia_iterate *iterate, const pia_values *values, void *state)
{
    (void)values;
    projected *p = state;
    pia_constraints *constraints = iterate->constraints;
    pia_index cols = iterate->op->cols;
    pia_status status = pia_conjugate_open(iterate, &p->conjugate);
    if (status != PIA_OK) return status;
    p->metric = pia_take(iterate->context, cols, sizeof(double));
    if (p->metric == NULL) return pia_take_status(iterate->context, cols, sizeof(double));
    status = pia_product_diagonal(iterate, p->metric);
    if (status != PIA_OK) return status;
    if (constraints == NULL) {
        pia_reciprocals(cols, p->metric);
        return PIA_OK;
    }
    status = pia_constraints_metric(constraints, p->metric);
    p->conjugate.coupled = pia_constraints_coupled(constraints);
    if (status == PIA_OK) pia_constraints_finish(constraints, iterate->points);
    return status;
}

/* The relative gradient is that of the Lagrangian: what the constraints leave. */
static void condition(pia_iterate *iterate, void *user, double *gradient, double *z)
{
    const projected *p = user;
    if (iterate->constraints == NULL) {
        pia_vectors_scale(iterate, p->metric, gradient, z);
        return;
    }
    pia_constraints_reduce(iterate->constraints, gradient);
    pia_constraints_direction(iterate->constraints, gradient, z);
    double norm = sqrt(pia_iterate_dot(iterate, gradient, gradient));
    iterate->relative_gradient = iterate->right_norm > 0 ? norm / iterate->right_norm : norm;
}

/* Where control points are far out, the rounding of many steps leads away from the plane. */
static void stay_in_plane(pia_iterate *iterate, const projected *p)
{
    const pia_constraints *constraints = iterate->constraints;
    if (constraints == NULL || p->conjugate.age != 0) return;
    if (pia_constraints_violation(constraints, iterate->points, NULL) <= DRIFT * iterate->extent) return;
    pia_constraints_finish(constraints, iterate->points);
    iterate->errors_known = 0;
}

static pia_status adjust(pia_iterate *iterate, void *state)
{
    projected *p = state;
    stay_in_plane(iterate, p);
    pia_conjugate_step(iterate, &p->conjugate, condition, p);
    return PIA_OK;
}

static void end(pia_iterate *iterate, void *state)
{
    projected *p = state;
    pia_conjugate_close(iterate, &p->conjugate);
    pia_give(iterate->context, p->metric);
}

static void history(pia_iterate *iterate, void *state, void (*visit)(void *, const char *, double *, pia_index), void *user)
{
    projected *p = state;
    pia_conjugate_visit(iterate, &p->conjugate, visit, user);
}

const pia_method pia_method_clspia_pcg = {
    .name = "clspia-pcg",
    .title = "constrained least squares by projected conjugate gradients",
    .reference = "chang2023",
    .detail = "least squares with constraints; every iterate meets them, the squared error never rises",
    .needs = PIA_LEAST_SQUARES | PIA_NEEDS_NORMAL | PIA_KNOWS_CONSTRAINTS | PIA_DESCENDS,
    .iterations = 10000,
    .state_size = sizeof(projected),
    .begin = begin,
    .adjust = adjust,
    .end = end,
    .history = history,
};
