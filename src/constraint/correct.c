/* Constraints on the direct solve: the Schur complement of the normal equations. */
#include "conditions.h"

#include <math.h>
#include <string.h>

enum { REFINEMENTS = 3, POWER_ROUNDS = 100 };
static const double pull = 1e-9; /* of the mean diagonal of H */
static const double met = 5e-16; /* of the extent: what rounding leaves of constraints */

/* Where there are no data, the normal form leaves unknowns out: they are held by a tiny pull to where they are, so that a constraint
 * inside a gap can still move them. */
static void hold_gaps(const pia_constraints *c, const pia_normal *normal, const double *before, int dim, double *x)
{
    double mean = 0;
    for (pia_index i = 0; i < c->op->cols; i++) mean += normal->diagonal[i] / (double)c->op->cols;
    for (pia_index i = 0; i < c->op->cols; i++)
        for (int d = 0; d < dim && !(normal->diagonal[i] > 0); d++) x[i * dim + d] = before[i * dim + d] / (pull * mean);
}

/* x [cols x dim] := H^-1 x for corrections. before [cols x dim] is work. */
static void solve_held(const pia_constraints *c, const pia_normal *normal, int dim, double *x, double *before)
{
    if (normal->weak > 0) memcpy(before, x, (size_t)(c->op->cols * dim) * sizeof *x);
    normal->class->solve(normal, x, dim);
    if (normal->weak > 0) hold_gaps(c, normal, before, dim, x);
    pia_op_mask(c->op, x, dim);
}

/* Row j of B into column k of y [cols x sides]. */
static void put_column(const pia_constraints *c, pia_index j, pia_index k, pia_index sides, double *y)
{
    double entry;
    int size = pia_functional_size(&c->row[j]);
    for (int i = 0; i < size; i++) {
        pia_index unknown = pia_functional_unknown(&c->row[j], i, &entry);
        y[unknown * sides + k] += entry;
    }
}

/* Columns j .. j + block - 1 of S from those of H^-1 B', y [cols x sides]. column: work [sides x count]. */
static void fill_columns(const pia_constraints *c, pia_schur *s, pia_index j, pia_index block, const double *y, int sides,
                         double *column)
{
    double value[PIA_MAX_DIM]; /* sides are no more */
    for (pia_index i = j; i < c->count; i++) {
        pia_functional_value(&c->row[i], y, sides, value);
        for (pia_index k = 0; k < block; k++) column[k * c->count + i] = value[k];
    }
    for (pia_index k = 0; k < block; k++) pia_schur_fill(c, s, j + k, column + k * c->count);
}

pia_status pia_schur_of_normal(const pia_constraints *c, const pia_normal *normal, pia_schur *s)
{
    if (normal->class->solve_along != NULL && normal->weak == 0) return pia_schur_of_product(c, normal, s);
    int sides = normal->class->sides > 0 ? normal->class->sides : c->dim;
    pia_index size = c->op->cols * sides;
    double *y = pia_take(c->context, size, 2 * sizeof *y), *column = pia_take(c->context, c->count, (size_t)sides * sizeof *column);
    int ready = y != NULL && column != NULL;
    for (pia_index j = 0; ready && j < c->count; j += sides) {
        pia_index block = c->count - j < sides ? c->count - j : sides;
        memset(y, 0, (size_t)size * sizeof *y);
        for (pia_index k = 0; k < block; k++) put_column(c, j + k, k, sides, y);
        pia_op_mask(c->op, y, sides);
        solve_held(c, normal, sides, y, y + size);
        fill_columns(c, s, j, block, y, sides, column);
    }
    pia_give(c->context, y);
    pia_give(c->context, column);
    return ready ? PIA_OK : pia_take_status(c->context, size, 2 * sizeof *y);
}

pia_status pia_constraints_factor(pia_constraints *c, const pia_normal *normal)
{
    pia_schur s;
    pia_status status = pia_schur_open(c, &s);
    if (status != PIA_OK) return status;
    status = pia_schur_of_normal(c, normal, &s);
    if (status == PIA_OK) pia_schur_factor(&s, 1e-14);
    if (status == PIA_OK && s.rank < s.size)
        status =
            pia_fail(c->context, PIA_E_UNAVAILABLE,
                     "the data hold too little of the control points that the constraints need for a direct solve; use clspia-pcg");
    if (status != PIA_OK) {
        pia_schur_close(c, &s);
        return status;
    }
    pia_schur_close(c, &c->direct);
    c->direct = s;
    return PIA_OK;
}

static double longest(const double *rows, pia_index count, int dim)
{
    double most = 0;
    for (pia_index i = 0; i < count; i++) {
        double square = 0;
        for (int d = 0; d < dim; d++) square += rows[i * dim + d] * rows[i * dim + d];
        if (!(square <= most)) most = square;
    }
    return sqrt(most);
}

/* What is left of the constraints at P + d goes through the same complement again: its rounding is that of H^-1. */
pia_status pia_constraints_correct(const pia_constraints *c, const pia_normal *normal, const double *points, double *correction)
{
    pia_index size = c->op->cols * c->dim;
    double *y = pia_take(c->context, size, 2 * sizeof *y);
    if (y == NULL) return pia_take_status(c->context, size, 2 * sizeof *y);
    for (int round = 0; round < REFINEMENTS; round++) {
        for (pia_index i = 0; i < size; i++) y[i] = points[i] + correction[i];
        pia_constraints_residual(c, y, c->left);
        if (longest(c->left, c->count, c->dim) <= met * c->extent) break;
        pia_schur_solve(c, &c->direct, c->left, c->multiplier);
        memset(y, 0, (size_t)size * sizeof *y);
        pia_constraints_add(c, c->multiplier, 1, y);
        solve_held(c, normal, c->dim, y, y + size);
        for (pia_index i = 0; i < size; i++) correction[i] += y[i];
    }
    pia_give(c->context, y);
    return PIA_OK;
}

/* One round in all components at once, on rows [count x dim]; returns the length of the result, to which they are normed. */
static double power_round(const pia_constraints *c, const pia_normal *normal, double *rows, double *y)
{
    double square = 0;
    pia_index numbers = c->count * c->dim;
    memset(y, 0, (size_t)(c->op->cols * c->dim) * sizeof *y);
    pia_constraints_add(c, rows, 1, y);
    solve_held(c, normal, c->dim, y, y + c->op->cols * c->dim);
    for (pia_index i = 0; i < c->count; i++) pia_functional_value(&c->row[i], y, c->dim, rows + i * c->dim);
    for (pia_index i = 0; i < numbers; i++) square += rows[i] * rows[i];
    double length = sqrt(square);
    for (pia_index i = 0; i < numbers && length > 0; i++) rows[i] /= length;
    return length;
}

pia_status pia_constraints_schur_bound(const pia_constraints *c, const pia_normal *normal, double *out)
{
    pia_index size = c->op->cols * c->dim;
    double *y = pia_take(c->context, size, 2 * sizeof *y), value = 0, before = -1;
    if (y == NULL) return pia_take_status(c->context, size, 2 * sizeof *y);
    for (pia_index i = 0; i < c->count * c->dim; i++) c->left[i] = 1 + 0.1 * (double)(i % 7);
    power_round(c, normal, c->left, y);
    for (int round = 0; round < POWER_ROUNDS && fabs(value - before) > 1e-6 * value; round++) {
        before = value;
        value = power_round(c, normal, c->left, y);
    }
    pia_give(c->context, y);
    *out = value;
    return PIA_OK;
}
