/* Steps without eigenvalues: the step length is the minimiser of a model of the error along the gradient, made from two gradients, and
 * is accepted by a nonmonotone line search. In normal form the error along the gradient is a parabola that H g tells exactly, so that a
 * trial costs no pass. */
#include "method.h"
#include "normalise.h"
#include "product.h"
#include "vectors.h"

#include <math.h>
#include <string.h>

enum { WINDOW = 10, HALVINGS = 60 };
enum { GRADIENT, IMAGE, VECTORS }; /* g of the step before, H g */

static const double sufficient = 1e-4, all_curved = 1e-8;

typedef struct adaptive {
    pia_product product;
    double bound;         /* C, the largest column sum */
    double count, step;   /* steps done, the last step length */
    double last_square;   /* |g|^2 of the step before */
    double error[WINDOW]; /* half the squared error after the last steps, less that of the start */
    double *vector[VECTORS];
} adaptive;

static pia_status begin(pia_iterate *iterate, const pia_values *values, void *state)
{
    (void)values;
    adaptive *a = state;
    pia_status status = pia_product_open(iterate, &a->product);
    if (status == PIA_OK) status = pia_vectors_take(iterate, VECTORS, a->vector);
    if (status == PIA_OK) status = pia_column_sums(iterate, a->vector[IMAGE]);
    if (status == PIA_OK) a->bound = pia_largest(iterate->op->cols, a->vector[IMAGE]);
    return status;
}

/* With g the last gradient, b = g'Hg and c = |Hg|^2 are known from the difference of two gradients: rp / b was the step that makes the
 * error smallest, b / c the one that makes the gradient smallest. The root of (1 - s) c a^2 + (2 s - 1) b a - s rp = 0 lies between
 * them, s from how much of the spectrum the last step met. */
static double model_step(const adaptive *a, double square, double between)
{
    double rp = a->last_square, b = (rp - between) / a->step, c = (rp - 2 * between + square) / (a->step * a->step);
    if (!(b > 0) || !(c > 0)) return 1 / a->bound;
    double h = fmin(b / (a->bound * rp), 1), s = fmax(1 - h, all_curved);
    if (1 - h <= all_curved) return b / c;
    double lead = (1 - s) * c, half = 0.5 * (2 * s - 1) * b, root = sqrt(half * half + lead * s * rp);
    if (!(lead > 1e-14 * b * b / rp)) return rp / b;
    return half > 0 ? s * rp / (half + root) : (root - half) / lead;
}

/* Halves the trial until half the squared error is low enough beside the largest of the last WINDOW; returns its change. */
static double accept(const adaptive *a, double square, double curvature, double *trial)
{
    int known = a->count < WINDOW - 1 ? (int)a->count + 1 : WINDOW, now = (int)fmod(a->count, WINDOW);
    double highest = a->error[now], change = 0;
    for (int k = 0; k < known; k++) highest = fmax(highest, a->error[k]);
    for (int k = 0; k < HALVINGS; k++) {
        change = *trial * (0.5 * *trial * curvature - square);
        if (a->error[now] + change <= highest - sufficient * *trial * square) break;
        *trial *= 0.5;
    }
    return change;
}

static pia_status adjust(pia_iterate *iterate, void *state)
{
    adaptive *a = state;
    double *g = iterate->adjust, *last = a->vector[GRADIENT], *image = a->vector[IMAGE];
    pia_iterate_gradient(iterate, g);
    double square = pia_iterate_dot(iterate, g, g);
    if (!(square > 0)) return PIA_OK;
    double trial = a->count > 0 ? model_step(a, square, pia_iterate_dot(iterate, last, g)) : 1 / a->bound;
    pia_product_apply(&a->product, g, iterate->dim, image);
    double change = accept(a, square, pia_iterate_dot(iterate, g, image), &trial);
    double error = a->error[(int)fmod(a->count, WINDOW)] + change;
    memcpy(last, g, (size_t)(iterate->op->cols * iterate->dim) * sizeof *g);
    pia_vectors_mix(iterate, 0, g, trial, g);
    a->count++;
    a->step = trial;
    a->last_square = square;
    a->error[(int)fmod(a->count, WINDOW)] = error;
    return PIA_OK;
}

static void end(pia_iterate *iterate, void *state)
{
    adaptive *a = state;
    pia_product_close(&a->product);
    pia_give(iterate->context, a->vector[0]);
}

static void history(pia_iterate *iterate, void *state, void (*visit)(void *, const char *, double *, pia_index), void *user)
{
    adaptive *a = state;
    visit(user, "count", &a->count, 1);
    visit(user, "step", &a->step, 1);
    visit(user, "last_square", &a->last_square, 1);
    visit(user, "error", a->error, WINDOW);
    visit(user, "gradient", a->vector[GRADIENT], iterate->op->cols * iterate->dim);
}

const pia_method pia_method_salspia = {
    .name = "salspia",
    .title = "LSPIA with step lengths that adapt to the gradients seen",
    .reference = "barzilai1988",
    .detail = "least squares; needs no eigenvalues",
    .needs = PIA_LEAST_SQUARES | PIA_NEEDS_NORMAL,
    .iterations = 10000,
    .state_size = sizeof(adaptive),
    .begin = begin,
    .adjust = adjust,
    .end = end,
    .history = history,
};
