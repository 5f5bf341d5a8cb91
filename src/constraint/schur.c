#include "conditions.h"
#include "dense.h"

#include <string.h>

pia_status pia_schur_open(const pia_constraints *c, pia_schur *out)
{
    pia_schur s = {.size = c->rank, .dim = c->basis != NULL ? 1 : c->dim};
    pia_index entries;
    if (!pia_multiply(s.size, s.size, &entries))
        return pia_fail(c->context, PIA_E_SIZE, "a system of %lld constraints does not fit in 64 bits", (long long)s.size);
    s.matrix = pia_take(c->context, entries, sizeof *s.matrix);
    s.order = pia_take(c->context, s.size, sizeof *s.order);
    s.x = pia_take(c->context, s.size, (size_t)s.dim * sizeof *s.x);
    s.scratch = pia_take(c->context, s.size, (size_t)s.dim * sizeof *s.scratch);
    if (s.matrix == NULL || s.order == NULL || s.x == NULL || s.scratch == NULL) {
        pia_schur_close(c, &s);
        return pia_take_status(c->context, entries, sizeof *s.matrix);
    }
    *out = s;
    return PIA_OK;
}

void pia_schur_close(const pia_constraints *c, pia_schur *s)
{
    pia_give(c->context, s->matrix);
    pia_give(c->context, s->order);
    pia_give(c->context, s->x);
    pia_give(c->context, s->scratch);
    *s = (pia_schur){0};
}

static double product(const double *a, const double *b, int dim)
{
    double sum = 0;
    for (int d = 0; d < dim; d++) sum += a[d] * b[d];
    return sum;
}

/* Conditions are in the order of their rows: the lower triangle of column b begins with b itself. */
void pia_schur_fill(const pia_constraints *c, pia_schur *s, pia_index j, const double *column)
{
    for (pia_index b = c->begin[j]; b < c->begin[j + 1]; b++)
        for (pia_index a = b; a < s->size; a++) {
            double entry = column[c->of[a]];
            if (c->basis != NULL) entry *= product(c->basis + a * c->dim, c->basis + b * c->dim, c->dim);
            s->matrix[a * s->size + b] = entry;
        }
}

void pia_schur_factor(pia_schur *s, double rtol)
{
    s->rank = pia_dense_cholesky(s->matrix, s->size, rtol, s->order);
}

void pia_schur_solve_conditions(const pia_schur *s, double *x)
{
    pia_dense_cholesky_solve(s->matrix, s->size, s->rank, s->order, x, s->dim, s->scratch);
}

void pia_schur_solve(const pia_constraints *c, const pia_schur *s, const double *left, double *multiplier)
{
    pia_conditions_gather(c, left, s->x);
    pia_schur_solve_conditions(s, s->x);
    pia_conditions_scatter(c, s->x, multiplier);
}

/* Row j is spread over the unknowns, scaled by D^-1, met with every row, and wiped out again. */
void pia_schur_of_metric(const pia_constraints *c, pia_schur *s)
{
    double *spread = c->scratch, *column = c->left, entry;
    memset(spread, 0, (size_t)c->op->cols * sizeof *spread);
    for (pia_index j = 0; j < c->count; j++) {
        int size = pia_functional_size(&c->row[j]);
        for (int k = 0; k < size; k++) {
            pia_index unknown = pia_functional_unknown(&c->row[j], k, &entry);
            spread[unknown] += entry * c->inverse[unknown];
        }
        for (pia_index i = j; i < c->count; i++) {
            column[i] = 0;
            if (pia_functional_meets(&c->row[i], &c->row[j])) pia_functional_value(&c->row[i], spread, 1, &column[i]);
        }
        pia_schur_fill(c, s, j, column);
        for (int k = 0; k < size; k++) spread[pia_functional_unknown(&c->row[j], k, &entry)] = 0;
    }
}
