/* Deng, Lin 2014: D_i = mu_i sum_j w_j N_i(t_j) (Q_j - C(t_j)), P += D. The step 1 / sum_j w_j N_i(t_j) of each control point makes
 * every D_i a weighted mean of residuals; it converges where the scalar step, its smallest value, takes hundreds of times longer. */
#include "method.h"
#include "normalise.h"
#include "vectors.h"

enum { STEP, COLUMN = 0, SCALAR = 1 };

typedef struct lspia {
    double *step; /* [cols] */
} lspia;

static pia_status begin(pia_iterate *iterate, const pia_values *values, void *state)
{
    lspia *l = state;
    pia_index cols = iterate->op->cols;
    l->step = pia_take(iterate->context, cols, sizeof *l->step);
    if (l->step == NULL) return pia_take_status(iterate->context, cols, sizeof *l->step);
    pia_status status = pia_column_sums(iterate, l->step);
    if (status != PIA_OK) return status;
    int column = values->is_word[STEP] && values->number[STEP] == COLUMN;
    double scalar = values->is_word[STEP] ? 1 / pia_largest(cols, l->step) : values->number[STEP];
    pia_reciprocals(cols, l->step);
    for (pia_index c = 0; c < cols && !column; c++) l->step[c] = scalar;
    return PIA_OK;
}

static pia_status adjust(pia_iterate *iterate, void *state)
{
    const lspia *l = state;
    pia_iterate_gradient(iterate, iterate->adjust);
    pia_vectors_scale(iterate, l->step, iterate->adjust, iterate->adjust);
    return PIA_OK;
}

static void end(pia_iterate *iterate, void *state)
{
    lspia *l = state;
    pia_give(iterate->context, l->step);
}

static const pia_parameter parameters[] = {
    {"step", "column|scalar|number", "column", 1e-300, 1e300,
     "factor on the gradient: column is the reciprocal of each control point's column sum, scalar the smallest of them"},
    {0}};

const pia_method pia_method_lspia = {
    .name = "lspia",
    .title = "least-squares PIA: every control point moves by a weighted mean of the errors around it",
    .reference = "deng2014",
    .detail = "least squares; curves and grids, open and closed, weights, holes; every iterate is a usable model",
    .needs = PIA_LEAST_SQUARES | PIA_NEEDS_NORMAL | PIA_IS_LIMITABLE,
    .iterations = 10000,
    .parameters = parameters,
    .state_size = sizeof(lspia),
    .begin = begin,
    .adjust = adjust,
    .end = end,
};
