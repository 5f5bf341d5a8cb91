/* Constraints in a diagonal metric: the projections of projected conjugate gradients (Gould, Hribar, Nocedal 2001) and the step that
 * meets constraints to rounding. */
#include "conditions.h"

#include <math.h>
#include <string.h>

enum { FINISH_ROUNDS = 4 };

static void invert_diagonal(pia_constraints *c, const double *diagonal)
{
    double largest = 0;
    for (pia_index i = 0; diagonal != NULL && i < c->op->cols; i++) largest = fmax(largest, diagonal[i]);
    for (pia_index i = 0; i < c->op->cols; i++) {
        double d = diagonal == NULL || !(largest > 0) ? 1 : diagonal[i] > 0 ? diagonal[i] : largest;
        c->inverse[i] = c->op->frozen != NULL && c->op->frozen[i] ? 0 : 1 / d;
    }
}

pia_status pia_constraints_metric(pia_constraints *c, const double *diagonal)
{
    pia_schur s;
    pia_status status = pia_schur_open(c, &s);
    if (status != PIA_OK) return status;
    invert_diagonal(c, diagonal);
    pia_schur_of_metric(c, &s);
    pia_schur_factor(&s, 1e-15);
    pia_schur_close(c, &c->metric);
    c->metric = s;
    return PIA_OK;
}

static void reduce_once(const pia_constraints *c, double *gradient)
{
    int dim = c->dim;
    for (pia_index i = 0; i < c->count; i++) {
        double *sum = c->left + i * dim, entry;
        int size = pia_functional_size(&c->row[i]);
        for (int d = 0; d < dim; d++) sum[d] = 0;
        for (int k = 0; k < size; k++) {
            pia_index unknown = pia_functional_unknown(&c->row[i], k, &entry);
            for (int d = 0; d < dim; d++) sum[d] += entry * c->inverse[unknown] * gradient[unknown * dim + d];
        }
    }
    pia_schur_solve(c, &c->metric, c->left, c->multiplier);
    pia_constraints_add(c, c->multiplier, -1, gradient);
}

void pia_constraints_reduce(const pia_constraints *c, double *gradient)
{
    reduce_once(c, gradient);
    reduce_once(c, gradient);
}

void pia_constraints_direction(const pia_constraints *c, const double *gradient, double *z)
{
    for (pia_index i = 0; i < c->op->cols; i++)
        for (int d = 0; d < c->dim; d++) z[i * c->dim + d] = c->inverse[i] * gradient[i * c->dim + d];
}

static void step(const pia_constraints *c, double *points)
{
    int dim = c->dim;
    for (pia_index i = 0; i < c->count; i++) {
        double entry;
        int size = pia_functional_size(&c->row[i]);
        for (int k = 0; k < size; k++) {
            pia_index unknown = pia_functional_unknown(&c->row[i], k, &entry);
            for (int d = 0; d < dim; d++) points[unknown * dim + d] += entry * c->inverse[unknown] * c->multiplier[i * dim + d];
        }
    }
}

void pia_constraints_finish(const pia_constraints *c, double *points)
{
    double before = INFINITY, now = pia_constraints_violation(c, points, NULL);
    for (int round = 0; round < FINISH_ROUNDS && now > 0 && now < before / 2; round++) {
        before = now;
        pia_constraints_residual(c, points, c->left);
        pia_schur_solve(c, &c->metric, c->left, c->multiplier);
        step(c, points);
        now = pia_constraints_violation(c, points, NULL);
    }
}
