/* S = B H^-1 B' where H = Gu (x) Gv and every row of B is a product as well: b_i' H^-1 b_j = (bu_i' Gu^-1 bu_j) (bv_i' Gv^-1 bv_j), the
 * Hadamard product of two small matrices, each from banded solves in one direction. */
#include "conditions.h"

#include <string.h>

/* Columns Gd^-1 b of all rows, x [unknowns of d x count]. */
static void solve_rows(const pia_constraints *c, const pia_normal *normal, int d, double *x)
{
    memset(x, 0, (size_t)(c->op->count[d] * c->count) * sizeof *x);
    for (pia_index j = 0; j < c->count; j++)
        for (int k = 0; k < c->row[j].width[d]; k++) x[c->row[j].column[d][k] * c->count + j] += c->row[j].entry[d][k];
    normal->class->solve_along(normal, d, x, c->count);
}

static double product(const pia_constraints *c, int d, pia_index i, const double *x, pia_index j)
{
    double sum = 0;
    for (int k = 0; k < c->row[i].width[d]; k++) sum += c->row[i].entry[d][k] * x[c->row[i].column[d][k] * c->count + j];
    return sum;
}

pia_status pia_schur_of_product(const pia_constraints *c, const pia_normal *normal, pia_schur *s)
{
    double *x[2], *column = pia_take(c->context, c->count, sizeof *column);
    for (int d = 0; d < 2; d++) x[d] = pia_take(c->context, c->op->count[d], (size_t)c->count * sizeof *x[d]);
    int ready = column != NULL && x[0] != NULL && x[1] != NULL;
    for (int d = 0; d < 2 && ready; d++) solve_rows(c, normal, d, x[d]);
    for (pia_index j = 0; j < c->count && ready; j++) {
        for (pia_index i = j; i < c->count; i++) column[i] = product(c, 0, i, x[0], j) * product(c, 1, i, x[1], j);
        pia_schur_fill(c, s, j, column);
    }
    pia_give(c->context, x[0]);
    pia_give(c->context, x[1]);
    pia_give(c->context, column);
    return ready ? PIA_OK : pia_take_status(c->context, c->op->count[0] + c->op->count[1], (size_t)c->count * sizeof *column);
}
