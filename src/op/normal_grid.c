/* The normal form of a full grid without weights: H = Gu (x) Gv, never formed, and b = A_u' (Q - origin) A_v in one pass. */
#include "clones.h"
#include "gram.h"
#include "kernel.h"
#include "normal.h"
#include "span_sums.h"

#include <math.h>
#include <string.h>

enum { GRAIN = 16384, MAX_CHUNKS = 64 };

typedef struct grid {
    pia_gram gram[2];
    pia_index chunks; /* tasks of the pass over the data */
    double *line;     /* [chunks x full_v dim] a data row times A_v, for each task */
    double *tail;     /* [chunks x degree_u x full_v dim] sums beyond a task's own control rows */
    double *full;     /* [full_u x full_v dim] */
    double *half;     /* [cols x dim] of a product, one direction done */
} grid;

typedef struct pass {
    const grid *grid;
    const pia_collocation *u, *v;
    const pia_targets *targets;
    pia_index width;
} pass;

/* One v-span of a data row: the products of its points with the degree + 1 functions of the span stay in registers. */
PIA_INLINE void contract_span(const pass *p, const double *points, pia_index s, int degree, int dim, double *to)
{
    const pia_collocation *v = p->v;
    const double *origin = p->targets->origin;
    double sum[(PIA_MAX_DEGREE + 1) * PIA_MAX_DIM], scratch[PIA_MAX_DEGREE + 1];
    for (int k = 0; k < (degree + 1) * dim; k++) sum[k] = 0;
    for (pia_index row = v->begin[s]; row < v->begin[s + 1]; row++) {
        const double *value = pia_collocation_row(v, row, degree + s, scratch);
        for (int d = 0; d < dim; d++) {
            double q = points[row * dim + d] - origin[d];
            for (int k = 0; k <= degree; k++) sum[k * dim + d] += value[k] * q;
        }
    }
    for (int k = 0; k < (degree + 1) * dim; k++) to[k] += sum[k];
}

PIA_CLONES static void contract_row(const pass *p, pia_index row, double *line)
{
    const pia_collocation *v = p->v;
    int degree = v->degree, dim = p->targets->dim;
    const double *points = p->targets->points + row * v->rows * dim;
    memset(line, 0, (size_t)p->width * sizeof *line);
    for (pia_index s = 0; s < v->full - degree; s++) {
        if (degree == 3 && dim == 3)
            contract_span(p, points, s, 3, 3, line + s * dim);
        else if (degree == 3 && dim == 1)
            contract_span(p, points, s, 3, 1, line + s * dim);
        else
            contract_span(p, points, s, degree, dim, line + s * dim);
    }
}

/* A chunk of u-spans owns the control rows that begin with them; the degree rows beyond go to its tail. */
static void gather_chunk(void *work, pia_index chunk)
{
    const pass *p = work;
    const pia_collocation *u = p->u;
    pia_index all = u->full - u->degree, chunks = p->grid->chunks;
    pia_index from = pia_chunk_begin(all, chunks, chunk), to = pia_chunk_begin(all, chunks, chunk + 1);
    double *line = p->grid->line + chunk * p->width, *tail = p->grid->tail + chunk * u->degree * p->width;
    double scratch[PIA_MAX_DEGREE + 1];
    memset(p->grid->full + from * p->width, 0, (size_t)((to - from) * p->width) * sizeof(double));
    memset(tail, 0, (size_t)(u->degree * p->width) * sizeof(double));
    for (pia_index s = from; s < to; s++)
        for (pia_index row = u->begin[s]; row < u->begin[s + 1]; row++) {
            const double *value = pia_collocation_row(u, row, u->degree + s, scratch);
            contract_row(p, row, line);
            for (int k = 0; k <= u->degree; k++) {
                double *sum = s + k < to ? p->grid->full + (s + k) * p->width : tail + (s + k - to) * p->width;
                for (pia_index c = 0; c < p->width; c++) sum[c] += value[k] * line[c];
            }
        }
}

static void sum_right(pia_normal *normal, const pia_targets *targets)
{
    const grid *g = normal->state;
    const pia_op *op = normal->op;
    pass p = {g, op->line[0], op->line[1], targets, op->line[1]->full * targets->dim};
    pia_index all = p.u->full - p.u->degree, degree = p.u->degree;
    pia_for_each(op->context, g->chunks, gather_chunk, &p);
    memset(g->full + all * p.width, 0, (size_t)(degree * p.width) * sizeof(double));
    for (pia_index chunk = 0; chunk < g->chunks; chunk++) {
        double *to = g->full + pia_chunk_begin(all, g->chunks, chunk + 1) * p.width;
        const double *tail = g->tail + chunk * degree * p.width;
        for (pia_index c = 0; c < degree * p.width; c++) to[c] += tail[c];
    }
    pia_op_reduce(op, g->full, targets->dim, normal->right);
    pia_op_mask(op, normal->right, targets->dim);
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

static void refresh(pia_normal *normal, const pia_targets *targets, pia_index first_row, pia_index last_row)
{
    (void)first_row;
    (void)last_row;
    sum_right(normal, targets);
}

static void close(pia_normal *normal)
{
    grid *g = normal->state;
    pia_context *context = normal->op->context;
    pia_gram_close(&g->gram[0]);
    pia_gram_close(&g->gram[1]);
    pia_give(context, g->line);
    pia_give(context, g->tail);
    pia_give(context, g->full);
    pia_give(context, g->half);
    pia_give(context, g);
}

static const pia_normal_class kronecker = {
    .name = "kronecker", .multiply = multiply, .factor = factor, .solve = solve, .refresh = refresh, .close = close};

static pia_index count_chunks(const pia_op *op)
{
    pia_index chunks = pia_chunk_count(op->rows, GRAIN), spans = op->line[0]->full - op->line[0]->degree;
    if (chunks > spans) chunks = spans;
    return chunks < MAX_CHUNKS ? chunks : MAX_CHUNKS;
}

static pia_status take_arrays(pia_context *context, const pia_op *op, int dim, grid *g)
{
    pia_index width = op->full_count[1] * dim;
    g->chunks = count_chunks(op);
    g->line = pia_take(context, g->chunks * width, sizeof *g->line);
    g->tail = pia_take(context, g->chunks * op->line[0]->degree * width, sizeof *g->tail);
    g->full = pia_take(context, op->full_count[0] * width, sizeof *g->full);
    g->half = pia_take(context, op->cols, (size_t)dim * sizeof *g->half);
    if (g->line != NULL && g->tail != NULL && g->full != NULL && g->half != NULL) return PIA_OK;
    return pia_take_status(context, op->full_count[0] * width, sizeof *g->full);
}

static int has_holes(const pia_normal *normal, int dim)
{
    double sum = 0;
    for (pia_index c = 0; c < normal->op->cols * dim; c++) sum += normal->right[c];
    return isnan(sum);
}

pia_status pia_normal_grid_open(pia_normal *normal, const pia_targets *targets)
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
    sum_right(normal, targets);
    if (has_holes(normal, targets->dim)) return pia_fail(context, PIA_E_UNAVAILABLE, "a grid with holes is no Kronecker product");
    pia_index room = 2 * (op->count[0] + op->count[1]);
    double *work = pia_take(context, room, sizeof *work);
    if (work == NULL) return pia_take_status(context, room, sizeof *work);
    derive(normal, work);
    pia_give(context, work);
    return PIA_OK;
}
