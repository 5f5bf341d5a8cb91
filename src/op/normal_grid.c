/* The normal form of a full grid without weights: H = Gu (x) Gv, never formed, and b = A_u' (Q - origin) A_v in one pass, relative to
 * the first point until the origin is known. */
#include "gram.h"
#include "grid_sums.h"
#include "normal.h"
#include "span_sums.h"

#include <math.h>
#include <string.h>

typedef struct grid {
    pia_gram gram[2];
    pia_grid_sums sums;
    double *full; /* [full_u x full_v dim] */
    double *half; /* [cols x dim] of a product, one direction done */
} grid;

/* survey NULL: unwanted. */
static void sum_right(pia_normal *normal, const pia_targets *targets, pia_survey *survey)
{
    const grid *g = normal->state;
    const pia_op *op = normal->op;
    pia_grid_sums_run(&g->sums, targets->points, op->identity ? normal->right : g->full, survey);
    if (!op->identity) pia_op_reduce(op, g->full, targets->dim, normal->right);
}

static pia_status sum_gram(pia_context *context, const pia_collocation *line, pia_gram *gram)
{
    pia_index spans = line->full - line->degree;
    int room = pia_span_room(line->degree, 0);
    pia_span_data data = {context, line, NULL, NULL};
    pia_status status = pia_gram_open(context, line, gram);
    if (status != PIA_OK) return status;
    double *share = pia_take(context, spans, (size_t)room * sizeof *share);
    if (share == NULL) return pia_take_status(context, spans, (size_t)room * sizeof *share);
    pia_span_sums(&data, 0, spans - 1, share, NULL);
    pia_gram_clear(gram);
    for (pia_index s = 0; s < spans; s++) pia_gram_add(gram, s, share + s * room);
    pia_give(context, share);
    return PIA_OK;
}

/* The diagonal of H and its row sums are products of those of Gu and Gv; work [2 x (count_u + count_v)]. */
static void derive(pia_normal *normal, double *work)
{
    const grid *g = normal->state;
    pia_index nu = g->gram[0].count, nv = g->gram[1].count;
    double *diagonal[2] = {work, work + nu}, *sum[2] = {work + nu + nv, work + 2 * nu + nv};
    for (int d = 0; d < 2; d++) {
        for (pia_index i = 0; i < g->gram[d].count; i++) diagonal[d][i] = 1;
        pia_gram_multiply(&g->gram[d], diagonal[d], 1, 1, sum[d]);
        pia_gram_diagonal(&g->gram[d], diagonal[d]);
    }
    for (pia_index i = 0; i < nu; i++)
        for (pia_index j = 0; j < nv; j++) {
            normal->diagonal[i * nv + j] = diagonal[0][i] * diagonal[1][j];
            normal->column_sum[i * nv + j] = sum[0][i] * sum[1][j];
        }
}

static void multiply(const pia_normal *normal, const double *x, int dim, double *y)
{
    const grid *g = normal->state;
    pia_gram_multiply(&g->gram[0], x, 1, g->gram[1].count * dim, g->half);
    pia_gram_multiply(&g->gram[1], g->half, g->gram[0].count, dim, y);
    pia_op_mask(normal->op, y, dim);
}

static pia_status factor(pia_normal *normal)
{
    grid *g = normal->state;
    const unsigned char *frozen = normal->op->frozen;
    pia_index nu = g->gram[0].count, nv = g->gram[1].count;
    if (frozen != NULL && memchr(frozen, 1, (size_t)normal->op->cols) != NULL)
        return pia_fail(normal->op->context, PIA_E_UNAVAILABLE, "a grid with frozen control points has no direct solve; use cg");
    for (int d = 0; d < 2; d++) {
        pia_status status = pia_gram_factor(&g->gram[d], NULL);
        if (status != PIA_OK) return status;
    }
    normal->weak = g->gram[0].weak * nv + g->gram[1].weak * nu - g->gram[0].weak * g->gram[1].weak;
    return PIA_OK;
}

static void solve(const pia_normal *normal, double *b, int dim)
{
    const grid *g = normal->state;
    pia_gram_solve(&g->gram[0], b, 1, g->gram[1].count * dim);
    pia_gram_solve(&g->gram[1], b, g->gram[0].count, dim);
}

static void solve_along(const pia_normal *normal, int direction, double *b, pia_index width)
{
    const grid *g = normal->state;
    pia_gram_solve(&g->gram[direction], b, 1, width);
}

static void refresh(pia_normal *normal, const pia_targets *targets, pia_index first_row, pia_index last_row)
{
    (void)first_row;
    (void)last_row;
    sum_right(normal, targets, NULL);
    pia_normal_move(normal, targets, 0, normal->op->cols);
}

static void close(pia_normal *normal)
{
    grid *g = normal->state;
    pia_context *context = normal->op->context;
    pia_gram_close(&g->gram[0]);
    pia_gram_close(&g->gram[1]);
    pia_grid_sums_close(&g->sums);
    pia_give(context, g->full);
    pia_give(context, g->half);
    pia_give(context, g);
}

static const pia_normal_class kronecker = {.name = "kronecker",
                                           .multiply = multiply,
                                           .factor = factor,
                                           .solve = solve,
                                           .solve_along = solve_along,
                                           .refresh = refresh,
                                           .close = close};

static pia_status take_arrays(pia_context *context, const pia_op *op, int dim, grid *g)
{
    pia_index fulls = op->identity ? 0 : op->fulls;
    g->full = pia_take(context, fulls, (size_t)dim * sizeof *g->full);
    g->half = pia_take(context, op->cols, (size_t)dim * sizeof *g->half);
    if (g->full == NULL || g->half == NULL) return pia_take_status(context, op->fulls, (size_t)dim * sizeof *g->half);
    return pia_grid_sums_open(op, dim, &g->sums);
}

static int has_holes(const pia_normal *normal, int dim)
{
    double sum = 0;
    for (pia_index c = 0; c < normal->op->cols * dim; c++) sum += normal->right[c];
    return isnan(sum);
}

pia_status pia_normal_grid_open(pia_normal *normal, const pia_targets *targets, const pia_addition *addition)
{
    const pia_op *op = normal->op;
    pia_context *context = op->context;
    if (op->weights != NULL) return pia_fail(context, PIA_E_UNAVAILABLE, "a grid with weights is no Kronecker product");
    grid *g = pia_take_zero(context, 1, sizeof *g);
    if (g == NULL) return pia_take_status(context, 1, sizeof *g);
    normal->state = g;
    normal->class = &kronecker;
    g->gram[0].context = g->gram[1].context = context;
    pia_status status = take_arrays(context, op, targets->dim, g);
    for (int d = 0; d < 2 && status == PIA_OK; d++) status = sum_gram(context, op->line[d], &g->gram[d]);
    if (status != PIA_OK) return status;
    pia_survey survey;
    sum_right(normal, targets, addition->look != NULL ? &survey : NULL);
    if (addition->look != NULL) status = addition->look(addition->owner, &survey);
    if (status != PIA_OK) return status;
    if (has_holes(normal, targets->dim)) return pia_fail(context, PIA_E_UNAVAILABLE, "a grid with holes is no Kronecker product");
    pia_index room = 2 * (op->count[0] + op->count[1]);
    double *work = pia_take(context, room, sizeof *work);
    if (work == NULL) return pia_take_status(context, room, sizeof *work);
    derive(normal, work);
    pia_give(context, work);
    pia_normal_move(normal, targets, 0, op->cols);
    return PIA_OK;
}
