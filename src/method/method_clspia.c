/* [2023] CLSPIA: LSPIA steps on the Lagrangian, with the multipliers of the constraints following by Uzawa's rule. One loop: the
 * multipliers move after every step, with the new P. Nested loops: they wait until P has settled (Algorithm 2). */
#include "constraint.h"
#include "method.h"
#include "normalise.h"
#include "spectrum.h"

#include <math.h>

static const double MET = 1e-10; /* the recipe ends where no point is missed by more, in the units of the points */
static const double ALL = 1 - 1e-9;

enum { MU, MU1, LAMBDA0, LOOPS, INNER_TOLERANCE, RECIPE };

typedef struct clspia {
    double mu, mu1;
    double inner_tolerance;  /* units of the points; INFINITY: one loop */
    double *lambda, *excess; /* multipliers and R - B P, [constraints x dim] */
    int recipe;              /* the published one: absolute stop */
    int apart;               /* the points that are met do not count among those approximated */
} clspia;

/* The step of P: at least the largest eigenvalue of H. The paper takes the eigenvalue itself, we the column sum that bounds it. */
static pia_status choose_mu1(const pia_iterate *iterate, const pia_values *values, clspia *c)
{
    c->mu1 = values->number[MU1];
    if (!values->is_word[MU1]) return PIA_OK;
    if (values->number[RECIPE] > 0) {
        pia_spectrum spectrum;
        pia_status status = pia_spectrum_of_gradient(iterate, &spectrum);
        if (status == PIA_OK) c->mu1 = spectrum.largest;
        return status;
    }
    pia_index cols = iterate->op->cols;
    double *sums = pia_take(iterate->context, cols, sizeof *sums);
    if (sums == NULL) return pia_take_status(iterate->context, cols, sizeof *sums);
    pia_status status = pia_column_sums(iterate, sums);
    c->mu1 = pia_largest(cols, sums);
    pia_give(iterate->context, sums);
    return status;
}

/* The recipe's start: LSPIA on all points, with the step as the paper has it. That step may be as long as turns the slowest vector
 * round, so that an end is set. */
static pia_status warm_up(pia_iterate *iterate)
{
    enum { MOST = 10000 };
    static const double settled = 1e-2; /* root mean square of the steps, units of the points */
    pia_index cols = iterate->op->cols, size = cols * iterate->dim;
    double *sums = pia_take(iterate->context, cols, sizeof *sums), moved = INFINITY;
    if (sums == NULL) return pia_take_status(iterate->context, cols, sizeof *sums);
    pia_status status = pia_column_sums(iterate, sums);
    double largest = pia_largest(cols, sums), length = largest > 0 ? 2 / largest : 0, *step = iterate->adjust;
    pia_give(iterate->context, sums);
    for (int k = 0; k < MOST && status == PIA_OK && !(moved < settled); k++) {
        pia_iterate_gradient(iterate, step);
        for (pia_index i = 0; i < size; i++) step[i] *= length;
        pia_iterate_add(iterate, iterate->points, step);
        moved = sqrt(pia_iterate_dot(iterate, step, step) / (double)cols);
    }
    iterate->errors_known = 0;
    return status;
}

/* The step of the multipliers: in one loop below 2 mu1 / |B B'|, in nested loops 1 / lambda_max(B H^-1 B'). With the met points apart,
 * H - B'B takes the place of H, and every eigenvalue b of B H^-1 B' becomes b / (1 - b); where b is 1, the other points do not hold all
 * control points, and none is set apart. */
static pia_status choose_mu(const pia_iterate *iterate, const pia_values *values, clspia *c)
{
    c->mu = values->number[MU];
    if (!values->is_word[MU]) return PIA_OK;
    if (isinf(c->inner_tolerance)) {
        c->mu = c->mu1 / pia_constraints_column_bound(iterate->constraints);
        return PIA_OK;
    }
    double bound;
    pia_normal *normal = iterate->normal;
    if (normal == NULL)
        return pia_fail(iterate->context, PIA_E_ARGUMENT, "clspia: nested loops need normal equations to find mu; give mu=NUMBER");
    pia_status status = normal->class->factor(normal);
    if (status == PIA_OK) status = pia_constraints_schur_bound(iterate->constraints, normal, &bound);
    if (status != PIA_OK) return status;
    c->apart = c->apart && bound < ALL;
    if (c->apart) bound /= 1 - bound;
    c->mu = bound > 0 ? 1 / bound : 0;
    return PIA_OK;
}

static pia_status begin(pia_iterate *iterate, const pia_values *values, void *state)
{
    clspia *c = state;
    c->recipe = values->number[RECIPE] > 0;
    c->inner_tolerance = INFINITY;
    if (values->number[LOOPS] > 0 || c->recipe)
        c->inner_tolerance = values->number[INNER_TOLERANCE] * (c->recipe ? 1 : iterate->extent);
    pia_status status = c->recipe && iterate->iteration == 0 ? warm_up(iterate) : PIA_OK;
    if (status == PIA_OK) status = choose_mu1(iterate, values, c);
    if (status != PIA_OK || iterate->constraints == NULL) return status;
    pia_index count = pia_constraints_count(iterate->constraints);
    size_t vector = (size_t)iterate->dim * sizeof(double);
    c->lambda = pia_take(iterate->context, count, vector);
    c->excess = pia_take(iterate->context, count, vector);
    if (c->lambda == NULL || c->excess == NULL) return pia_take_status(iterate->context, count, vector);
    pia_constraints_multipliers(iterate->constraints, values->number[LAMBDA0], c->lambda);
    c->apart = c->recipe && values->is_word[MU] && iterate->op->weights == NULL && pia_constraints_are_points(iterate->constraints);
    return choose_mu(iterate, values, c);
}

/* D = (A'W(Q - AP) - B' lambda) / mu1. Small only when P is optimal for its multipliers, so the violation counts as gradient too; the
 * recipe looks at nothing else. */
static pia_status adjust(pia_iterate *iterate, void *state)
{
    const clspia *c = state;
    const pia_constraints *constraints = iterate->constraints;
    double *step = iterate->adjust, violation = 0;
    pia_iterate_gradient(iterate, step);
    if (constraints != NULL) {
        pia_constraints_add(constraints, c->lambda, -1, step);
        if (c->apart) {
            pia_constraints_residual(constraints, iterate->points, c->excess);
            pia_constraints_add(constraints, c->excess, -1, step);
        }
        violation = pia_constraints_violation(constraints, iterate->points, NULL) / iterate->extent;
    }
    double norm = sqrt(pia_iterate_dot(iterate, step, step));
    iterate->relative_gradient = fmax(iterate->right_norm > 0 ? norm / iterate->right_norm : norm, violation);
    if (c->recipe && constraints != NULL)
        iterate->relative_gradient = violation * iterate->extent < MET ? 0 : violation * iterate->extent;
    double length = c->mu1 > 0 ? 1 / c->mu1 : 0;
    for (pia_index i = 0; i < iterate->op->cols * iterate->dim; i++) step[i] *= length;
    return PIA_OK;
}

static pia_status update(pia_iterate *iterate, void *state)
{
    const clspia *c = state;
    for (pia_index i = 0; i < iterate->op->cols * iterate->dim; i++) iterate->points[i] += iterate->adjust[i];
    if (iterate->constraints == NULL || !(iterate->adjust_max < c->inner_tolerance)) return PIA_OK;
    pia_constraints_residual(iterate->constraints, iterate->points, c->excess);
    pia_index numbers = pia_constraints_count(iterate->constraints) * iterate->dim;
    for (pia_index i = 0; i < numbers; i++) c->lambda[i] -= c->mu * c->excess[i];
    return PIA_OK;
}

static void end(pia_iterate *iterate, void *state)
{
    clspia *c = state;
    pia_give(iterate->context, c->lambda);
    pia_give(iterate->context, c->excess);
}

static void history(pia_iterate *iterate, void *state, void (*visit)(void *, const char *, double *, pia_index), void *user)
{
    clspia *c = state;
    visit(user, "mu", &c->mu, 1);
    visit(user, "mu1", &c->mu1, 1);
    if (c->lambda != NULL) visit(user, "lambda", c->lambda, pia_constraints_count(iterate->constraints) * iterate->dim);
}

static const pia_parameter parameters[] = {
    {"mu", "auto|number", "auto", 0, 1e300,
     "step of the multipliers; auto is mu1 / largest column sum of |B|, nested: 1 / lambda_max(B H^-1 B')"},
    {"mu1", "auto|number", "auto", 1e-300, 1e300, "divisor of the steps of control points; auto is the largest column sum of WA"},
    {"lambda0", NULL, "0", -1e300, 1e300, "multipliers at the start"},
    {"loops", "single|nested", "single", 0, 0, "multipliers follow every step, or wait until control points settle (Algorithm 2)"},
    {"inner-tolerance", NULL, "1e-3", 0, 1e300, "nested: settled means that no control point moves more, relative to the extent"},
    {"recipe", "none|paper", "none", 0, 0,
     "paper: as published: LSPIA first, nested, mu1 = lambda_max(H), met points not approximated, stops in the units of the points"},
    {0}};

const pia_method pia_method_clspia = {
    .name = "clspia",
    .title = "constrained LSPIA: some points met exactly, the rest in the least-squares sense",
    .reference = "chang2023",
    .detail = "least squares with constraints, met in the limit; shape limiters act on its steps",
    .needs = PIA_LEAST_SQUARES | PIA_NEEDS_NORMAL | PIA_KNOWS_CONSTRAINTS | PIA_IS_LIMITABLE,
    .iterations = 100000,
    .parameters = parameters,
    .state_size = sizeof(clspia),
    .begin = begin,
    .adjust = adjust,
    .update = update,
    .end = end,
    .history = history,
};
