/* The rows of B as data. H + w B'B is solved by the formula of Woodbury, so that bands and Kronecker products stay what they are. */
#include "conditions.h"

#include <math.h>
#include <string.h>

typedef struct soft {
    const pia_constraints *c;
    double weight;
    pia_normal *data;
    pia_schur s;  /* of B H^-1 B' + 1 / weight */
    double *work; /* [cols x dim] */
} soft;

static void multiply(const pia_normal *normal, const double *x, int dim, double *y)
{
    const soft *s = normal->state;
    double value[PIA_MAX_DIM];
    s->data->class->multiply(s->data, x, dim, y);
    for (pia_index i = 0; i < s->c->count; i++) {
        pia_functional_value(&s->c->row[i], x, dim, value);
        if (dim == s->c->dim) pia_row_across(s->c, i, value);
        for (int d = 0; d < dim; d++) value[d] *= s->weight;
        pia_functional_add(&s->c->row[i], value, dim, y);
    }
    pia_op_mask(normal->op, y, dim);
}

static pia_status factor(pia_normal *normal)
{
    soft *s = normal->state;
    pia_status status = s->data->class->factor(s->data);
    if (status == PIA_OK) status = pia_schur_of_normal(s->c, s->data, &s->s);
    if (status != PIA_OK) return status;
    for (pia_index a = 0; a < s->s.size; a++) s->s.matrix[a * s->s.size + a] += 1 / s->weight;
    pia_schur_factor(&s->s, 0);
    normal->weak = s->data->weak;
    return PIA_OK;
}

/* (H + w B'B)^-1 b = x - H^-1 B' (B H^-1 B' + 1/w)^-1 B x, x = H^-1 b. */
static void solve(const pia_normal *normal, double *b, int dim)
{
    const soft *s = normal->state;
    const pia_constraints *c = s->c;
    s->data->class->solve(s->data, b, dim);
    for (pia_index i = 0; i < c->count; i++) pia_functional_value(&c->row[i], b, dim, c->left + i * dim);
    pia_schur_solve(c, &s->s, c->left, c->multiplier);
    memset(s->work, 0, (size_t)(c->op->cols * dim) * sizeof *s->work);
    pia_constraints_add(c, c->multiplier, 1, s->work);
    s->data->class->solve(s->data, s->work, dim);
    for (pia_index i = 0; i < c->op->cols * dim; i++) b[i] -= s->work[i];
}

static void add_rows(const pia_constraints *c, double weight, pia_normal *normal)
{
    pia_constraints_add(c, c->right, weight, normal->right);
    for (pia_index i = 0; i < c->count; i++)
        for (int k = 0; k < pia_functional_size(&c->row[i]); k++) {
            double entry;
            pia_index unknown = pia_functional_unknown(&c->row[i], k, &entry);
            normal->diagonal[unknown] += weight * entry * entry;
            normal->column_sum[unknown] += weight * fabs(entry);
        }
}

/* The sums of the data, and the rows of B on top. */
static void sum(pia_normal *normal)
{
    const soft *s = normal->state;
    pia_index cols = s->c->op->cols;
    memcpy(normal->right, s->data->right, (size_t)(cols * s->c->dim) * sizeof *normal->right);
    memcpy(normal->diagonal, s->data->diagonal, (size_t)cols * sizeof *normal->diagonal);
    memcpy(normal->column_sum, s->data->column_sum, (size_t)cols * sizeof *normal->column_sum);
    add_rows(s->c, s->weight, normal);
}

static void refresh(pia_normal *normal, const pia_targets *targets, pia_index first_row, pia_index last_row)
{
    const soft *s = normal->state;
    pia_normal_refresh(s->data, targets, first_row, last_row);
    sum(normal);
}

static void close_state(pia_normal *normal)
{
    soft *s = normal->state;
    if (s == NULL) return;
    pia_schur_close(s->c, &s->s);
    pia_give(s->c->context, s->work);
    pia_give(s->c->context, s);
    normal->state = NULL;
}

static const pia_normal_class soft_class = {
    .name = "soft", .multiply = multiply, .factor = factor, .solve = solve, .refresh = refresh, .close = close_state};

static pia_status fill(pia_normal *normal, const pia_constraints *c, double weight, pia_normal *data)
{
    pia_index cols = c->op->cols;
    soft *s = pia_take_zero(c->context, 1, sizeof *s);
    normal->state = s;
    if (s == NULL) return pia_take_status(c->context, 1, sizeof *s);
    s->c = c;
    s->weight = weight;
    s->data = data;
    s->work = pia_take(c->context, cols, (size_t)c->dim * sizeof *s->work);
    normal->right = pia_take(c->context, cols, (size_t)c->dim * sizeof *normal->right);
    normal->diagonal = pia_take(c->context, cols, sizeof *normal->diagonal);
    normal->column_sum = pia_take(c->context, cols, sizeof *normal->column_sum);
    if (s->work == NULL || normal->right == NULL || normal->diagonal == NULL || normal->column_sum == NULL)
        return pia_take_status(c->context, cols, (size_t)c->dim * sizeof *s->work);
    sum(normal);
    return pia_schur_open(c, &s->s);
}

pia_status pia_constraints_soften(const pia_constraints *constraints, double weight, pia_normal *data, pia_normal **out)
{
    pia_normal *normal = pia_take_zero(constraints->context, 1, sizeof *normal);
    if (normal == NULL) return pia_take_status(constraints->context, 1, sizeof *normal);
    normal->class = &soft_class;
    normal->op = constraints->op;
    pia_status status = fill(normal, constraints, weight, data);
    if (status == PIA_OK)
        *out = normal;
    else
        pia_normal_close(normal);
    return status;
}
