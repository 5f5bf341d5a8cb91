/* The normal form of scattered points, and of grids with holes or weights of their own, which are no Kronecker product: a stencil.
 * Cells are summed strip by strip. CG on it is preconditioned by the Kronecker product of the marginals; the direct solve is sparse. */
#include "cell_sums.h"
#include "energy.h"
#include "normal.h"
#include "op_scatter.h"
#include "sparse.h"
#include "strips.h"

#include "basis.h"

#include <math.h>
#include <string.h>

enum { SMALL = 20000 }; /* rows that are not worth a thread */
static const double weak_pivot = 1e-12, ridge = 1e-9;
static const double rounding = 1e-14; /* basis values of no more are 0 but for rounding: rows on the border of their span */

typedef struct surface {
    pia_stencil stencil;
    pia_gram marginal[2];
    int approximated;
    double *right;  /* [fulls x dim] */
    double *expand; /* [2 x fulls x dim] around a product, unless unknowns are the full control points */
    double *share;  /* [strips / (p + 1) + 1 x room] of the cell at hand, for each strip of a colour */
    double *scale;  /* [cols] 1 / sqrt(diagonal), 0 where frozen or without data */
    pia_sparse *factor;
} surface;

/* ---- sums ---- */

typedef struct pass {
    const pia_normal *normal;
    const surface *s;
    const pia_targets *targets;
} pass;

/* Points of a cell, holes included. */
static pia_index count_points(const pia_op *op, pia_index strip, pia_index column)
{
    const pia_scatter *scatter = pia_op_scatter(op);
    if (scatter != NULL) {
        const pia_index *begin = scatter->begin + strip * scatter->cells[1] + column;
        return begin[1] - begin[0];
    }
    const pia_index *u = op->line[0]->begin + strip, *v = op->line[1]->begin + column;
    return (u[1] - u[0]) * (v[1] - v[0]);
}

/* Basis values of point k of the cell; returns its row. */
static pia_index find_point(const pia_op *op, pia_index strip, pia_index column, pia_index k, double *u, double *v)
{
    const pia_scatter *scatter = pia_op_scatter(op);
    const pia_collocation *const *axis = op->axis;
    pia_index span[2] = {axis[0]->degree + strip, axis[1]->degree + column};
    if (scatter != NULL) {
        pia_index at = scatter->begin[strip * scatter->cells[1] + column] + k;
        pia_scatter_values(scatter, strip, column, at, u, v);
        return scatter->order[at];
    }
    pia_index across = axis[1]->begin[column + 1] - axis[1]->begin[column];
    pia_index row[2] = {axis[0]->begin[strip] + k / across, axis[1]->begin[column] + k % across};
    pia_basis_values(axis[0]->knots, axis[0]->degree, span[0], axis[0]->parameters[row[0]], u);
    pia_basis_values(axis[1]->knots, axis[1]->degree, span[1], axis[1]->parameters[row[1]], v);
    return row[0] * axis[1]->rows + row[1];
}

/* The next point of the cell into the block, unless it is a hole or weighs nothing. */
static void put_point(const pass *p, pia_index strip, pia_index column, pia_index k, pia_cell_block *block)
{
    const pia_op *op = p->normal->op;
    int at = block->count, dim = p->targets->dim;
    double sum = 0;
    pia_index row = find_point(op, strip, column, k, block->u[at], block->v[at]);
    for (int d = 0; d < dim; d++) {
        block->value[at][d] = p->targets->points[row * dim + d] - p->targets->origin[d];
        sum += block->value[at][d];
    }
    block->weight[at] = op->weights != NULL ? op->weights[row] : 1;
    if (!isnan(sum) && block->weight[at] > 0) block->count++;
}

static void sum_cell(const pass *p, pia_index strip, pia_index column, double *share)
{
    const pia_stencil *stencil = &p->s->stencil;
    pia_index points = count_points(p->normal->op, strip, column);
    const pia_scatter *scatter = pia_op_scatter(p->normal->op);
    int dim = p->targets->dim;
    pia_cell_block block = {.count = 0};
    if (points == 0) return;
    memset(share, 0, (size_t)pia_cell_room(stencil->p, stencil->q, dim) * sizeof *share);
    for (pia_index k = 0; k < points; k++) {
        if (scatter != NULL)
            pia_scatter_fetch(scatter, scatter->begin[strip * scatter->cells[1] + column] + k, p->normal->op->rows, p->targets->points,
                              dim);
        put_point(p, strip, column, k, &block);
        if (block.count < PIA_CELL_BLOCK && k + 1 < points) continue;
        pia_cell_add(&block, stencil->p, stencil->q, dim, share);
        block.count = 0;
    }
    pia_cell_spread(share, strip, column, dim, stencil, p->s->right);
}

static void sum_strip(void *work, pia_index strip)
{
    const pass *p = work;
    const pia_stencil *stencil = &p->s->stencil;
    double *share = p->s->share + strip / (stencil->p + 1) * pia_cell_room(stencil->p, stencil->q, p->targets->dim);
    for (pia_index column = 0; column < stencil->columns - stencil->q; column++) sum_cell(p, strip, column, share);
}

static void multiply_all(const pia_normal *normal, const double *x, int dim, double *y)
{
    const surface *s = normal->state;
    const pia_op *op = normal->op;
    if (op->identity) {
        pia_stencil_multiply(&s->stencil, x, dim, y);
        return;
    }
    double *product = s->expand + op->fulls * dim;
    pia_op_expand(op, x, dim, s->expand);
    pia_stencil_multiply(&s->stencil, s->expand, dim, product);
    pia_op_reduce(op, product, dim, y);
}

/* How strong the energy is depends on the sums of the data, which are complete now. Unknowns are pulled at their first copy. */
static void add_more(pia_normal *normal, int dim)
{
    surface *s = normal->state;
    const pia_op *op = normal->op;
    if (normal->energy != NULL) {
        double factor = pia_energy_factor(normal->energy, normal->diagonal);
        pia_energy_add_stencil(normal->energy, factor, &s->stencil);
        pia_energy_add_sums(normal->energy, factor, normal->column_sum);
        pia_stencil_diagonal(&s->stencil, op, normal->diagonal);
    }
    if (normal->pull == 0) return;
    for (pia_index i = 0; i < op->count[0]; i++)
        for (pia_index j = 0; j < op->count[1]; j++) pia_stencil_line(&s->stencil, i, 0, 0)[j] += normal->pull;
    pia_normal_add_pull(normal, dim);
}

static void sum_all(pia_normal *normal, const pia_targets *targets)
{
    surface *s = normal->state;
    const pia_op *op = normal->op;
    pass p = {normal, s, targets};
    pia_stencil_clear(&s->stencil);
    memset(s->right, 0, (size_t)(op->fulls * targets->dim) * sizeof *s->right);
    pia_each_strip(op->rows < SMALL ? NULL : op->context, s->stencil.lines - s->stencil.p, s->stencil.p, sum_strip, &p);
    pia_op_reduce(op, s->right, targets->dim, normal->right);
    pia_op_mask(op, normal->right, targets->dim);
    pia_stencil_diagonal(&s->stencil, op, normal->diagonal);
    for (pia_index c = 0; c < op->cols; c++) s->scale[c] = 1; /* H 1: basis functions sum to 1 */
    multiply_all(normal, s->scale, 1, normal->column_sum);
    add_more(normal, targets->dim);
    s->approximated = 0;
}

/* ---- the class ---- */

static void multiply(const pia_normal *normal, const double *x, int dim, double *y)
{
    multiply_all(normal, x, dim, y);
    pia_op_mask(normal->op, y, dim);
}

/* Scaled to a unit diagonal, so that a pivot says how well the data hold an unknown. Returns how many have no data. */
static pia_index find_scale(const pia_normal *normal)
{
    const surface *s = normal->state;
    pia_index empty = 0;
    for (pia_index c = 0; c < normal->op->cols; c++) {
        int frozen = normal->op->frozen != NULL && normal->op->frozen[c], held = normal->diagonal[c] > rounding * normal->column_sum[c];
        s->scale[c] = held && !frozen ? 1 / sqrt(normal->diagonal[c]) : 0;
        empty += !held && !frozen;
    }
    return empty;
}

/* Where the data leave the matrix singular, 1e-9 of the diagonal is added: corrections stay small where the data say nothing. */
static pia_status factor_triplets(pia_normal *normal, pia_triplets *t)
{
    surface *s = normal->state;
    pia_context *context = normal->op->context;
    pia_index weak;
    pia_status status = pia_sparse_factor(context, t, weak_pivot, &s->factor, &weak);
    if (status != PIA_OK || weak == 0) return status;
    normal->weak += weak;
    pia_sparse_close(s->factor);
    for (pia_index k = 0; k < t->n; k++) {
        t->row[t->count] = t->column[t->count] = k;
        t->value[t->count++] = ridge;
    }
    status = pia_sparse_factor(context, t, 0, &s->factor, &weak);
    if (status == PIA_OK && s->factor == NULL)
        status = pia_fail(context, PIA_E_DATA, "the equations of the surface are singular; use cg-kron or fewer control points");
    return status;
}

static pia_status factor(pia_normal *normal)
{
    surface *s = normal->state;
    pia_context *context = normal->op->context;
    pia_index room = pia_stencil_room(&s->stencil, normal->op) + normal->op->cols;
    pia_triplets t = {.n = normal->op->cols};
    pia_sparse_close(s->factor);
    s->factor = NULL;
    normal->weak = find_scale(normal);
    t.row = pia_take(context, room, sizeof *t.row);
    t.column = pia_take(context, room, sizeof *t.column);
    t.value = pia_take(context, room, sizeof *t.value);
    pia_status status = PIA_OK;
    if (t.row == NULL || t.column == NULL || t.value == NULL) status = pia_take_status(context, room, sizeof *t.row);
    if (status == PIA_OK) {
        t.count = pia_stencil_triplets(&s->stencil, normal->op, s->scale, t.row, t.column, t.value);
        status = factor_triplets(normal, &t);
    }
    pia_give(context, t.row);
    pia_give(context, t.column);
    pia_give(context, t.value);
    return status;
}

static void scale_rows(const pia_normal *normal, double *b, int dim)
{
    const surface *s = normal->state;
    for (pia_index c = 0; c < normal->op->cols; c++)
        for (int d = 0; d < dim; d++) b[c * dim + d] *= s->scale[c];
}

static void solve(const pia_normal *normal, double *b, int dim)
{
    const surface *s = normal->state;
    scale_rows(normal, b, dim);
    pia_sparse_solve(s->factor, b, dim);
    scale_rows(normal, b, dim);
}

static pia_status approximate(pia_normal *normal)
{
    surface *s = normal->state;
    if (s->approximated) return PIA_OK;
    pia_stencil_marginals(&s->stencil, normal->op, s->marginal);
    for (int d = 0; d < 2; d++) {
        pia_status status = pia_gram_factor(&s->marginal[d], NULL);
        if (status != PIA_OK) return status;
    }
    s->approximated = 1;
    return PIA_OK;
}

static void precondition(const pia_normal *normal, double *b, int dim)
{
    const surface *s = normal->state;
    const pia_op *op = normal->op;
    pia_gram_solve(&s->marginal[0], b, 1, op->count[1] * dim);
    pia_gram_solve(&s->marginal[1], b, op->count[0], dim);
    pia_op_mask(op, b, dim);
}

static void refresh(pia_normal *normal, const pia_targets *targets, pia_index first_row, pia_index last_row)
{
    (void)first_row;
    (void)last_row;
    sum_all(normal, targets);
}

static void close_state(pia_normal *normal)
{
    surface *s = normal->state;
    pia_context *context = normal->op->context;
    pia_stencil_close(&s->stencil);
    for (int d = 0; d < 2; d++) pia_gram_close(&s->marginal[d]);
    pia_sparse_close(s->factor);
    pia_give(context, s->right);
    pia_give(context, s->expand);
    pia_give(context, s->share);
    pia_give(context, s->scale);
    pia_give(context, s);
}

static const pia_normal_class stencil_class = {.name = "stencil",
                                               .multiply = multiply,
                                               .factor = factor,
                                               .solve = solve,
                                               .approximate = approximate,
                                               .precondition = precondition,
                                               .refresh = refresh,
                                               .close = close_state};

static pia_status take_arrays(const pia_op *op, int dim, surface *s)
{
    pia_context *context = op->context;
    pia_index fulls = op->fulls, strips = s->stencil.lines - s->stencil.p;
    pia_index shares = (strips / (s->stencil.p + 1) + 1) * pia_cell_room(s->stencil.p, s->stencil.q, dim);
    size_t point = (size_t)dim * sizeof(double);
    s->right = pia_take(context, fulls, point);
    s->expand = pia_take(context, op->identity ? 0 : fulls, 2 * point);
    s->share = pia_take(context, shares, sizeof *s->share);
    s->scale = pia_take(context, op->cols, sizeof *s->scale);
    int ready = s->right != NULL && s->expand != NULL && s->share != NULL && s->scale != NULL;
    return ready ? PIA_OK : pia_take_status(context, fulls, 2 * point);
}

pia_status pia_normal_stencil_open(pia_normal *normal, const pia_targets *targets)
{
    const pia_op *op = normal->op;
    surface *s = pia_take_zero(op->context, 1, sizeof *s);
    if (s == NULL) return pia_take_status(op->context, 1, sizeof *s);
    s->stencil.context = s->marginal[0].context = s->marginal[1].context = op->context;
    normal->state = s;
    normal->class = &stencil_class;
    pia_status status = pia_stencil_open(op, targets->dim, &s->stencil);
    if (status == PIA_OK) status = take_arrays(op, targets->dim, s);
    for (int d = 0; d < 2 && status == PIA_OK; d++) status = pia_gram_open(op->context, op->axis[d], &s->marginal[d]);
    if (status == PIA_OK) sum_all(normal, targets);
    return status;
}
