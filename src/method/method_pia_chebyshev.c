/* Chebyshev semi-iteration on the interpolation equations (Golub, Varga 1961): PIA's residuals, each step also carrying a part of the
 * one before. The eigenvalues of a B-spline collocation matrix are real and lie in [smallest, 1], which is all it needs: with
 * c = (1 + s) / 2, h = (1 - s) / 2 the steps are D_0 = R_0 / c and D_k = w_k (R_k / c + D_{k-1}) - D_{k-1},
 * w_1 = 2 / (2 - (h/c)^2), w_{k+1} = 1 / (1 - (h/c)^2 w_k / 4). */
#include "method.h"
#include "owner.h"

#include <math.h>
#include <string.h>

enum { SMALLEST, PASSES = 100 };

typedef struct semi {
    double smallest, weight, steps;
    double damping; /* the loop's, as last seen */
    double *last;   /* D of the step before [cols x dim] */
} semi;

static pia_status begin(pia_iterate *iterate, const pia_values *values, void *state)
{
    semi *s = state;
    double smallest = values->number[SMALLEST];
    pia_status status = PIA_OK;
    if (values->is_word[SMALLEST]) {
        status = pia_owner_smallest(iterate, PASSES, &smallest);
        smallest *= 0.95; /* the estimate comes from above */
    }
    if (status != PIA_OK) return status;
    s->last = pia_take_zero(iterate->context, iterate->op->cols * iterate->dim, sizeof *s->last);
    if (s->last == NULL) return PIA_E_MEMORY;
    s->smallest = smallest;
    s->damping = iterate->damping;
    return PIA_OK;
}

/* Steps grew and were taken back: shorter ones, and no memory of those. */
static void start_over(pia_iterate *iterate, semi *s)
{
    s->damping = iterate->damping;
    s->steps = 0;
    memset(s->last, 0, (size_t)(iterate->op->cols * iterate->dim) * sizeof *s->last);
}

static pia_status adjust(pia_iterate *iterate, void *state)
{
    semi *s = state;
    pia_index count = iterate->op->cols * iterate->dim;
    if (iterate->damping < s->damping) start_over(iterate, s);
    double ratio = (1 - s->smallest) / (1 + s->smallest), square = ratio * ratio;
    s->weight = s->steps == 0 ? 1 : s->steps == 1 ? 2 / (2 - square) : 1 / (1 - square * s->weight / 4);
    s->steps++;
    pia_owner_adjust(iterate, 2 * iterate->damping / (1 + s->smallest));
    for (pia_index i = 0; i < count; i++) iterate->adjust[i] = s->weight * (iterate->adjust[i] + s->last[i]) - s->last[i];
    memcpy(s->last, iterate->adjust, (size_t)count * sizeof *s->last);
    return PIA_OK;
}

static void end(pia_iterate *iterate, void *state)
{
    pia_give(iterate->context, ((semi *)state)->last);
}

static void history(pia_iterate *iterate, void *state, void (*visit)(void *, const char *, double *, pia_index), void *user)
{
    semi *s = state;
    visit(user, "smallest", &s->smallest, 1);
    visit(user, "damping", &s->damping, 1);
    visit(user, "weight", &s->weight, 1);
    visit(user, "steps", &s->steps, 1);
    visit(user, "last", s->last, iterate->op->cols * iterate->dim);
}

static const pia_parameter parameters[] = {
    {"smallest", "auto|number", "auto", 1e-9, 1, "smallest eigenvalue of the collocation matrix; auto estimates it"}, {0}};

const pia_method pia_method_pia_chebyshev = {
    .name = "pia-chebyshev",
    .title = "PIA with Chebyshev momentum: each step carries a part of the one before",
    .reference = "golub1961",
    .detail = "interpolates; needs about the square root of pia's iterations where data are uneven",
    .needs = PIA_NEEDS_SQUARE | PIA_NEEDS_ROWS,
    .iterations = 1000,
    .parameters = parameters,
    .state_size = sizeof(semi),
    .begin = begin,
    .adjust = adjust,
    .end = end,
    .history = history,
};
