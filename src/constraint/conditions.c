#include "conditions.h"

#include <math.h>
#include <string.h>

static int is_directed(const pia_constraints *c, pia_index i)
{
    if (c->axis == NULL) return 0;
    for (int d = 0; d < c->dim; d++)
        if (c->axis[i * c->dim + d] != 0) return 1;
    return 0;
}

/* dim - 1 orthonormal vectors across the unit vector a: the columns of a Householder reflection that takes a to a coordinate axis. */
static int across(const double *a, int dim, double *basis)
{
    int pivot = 0, count = 0;
    for (int d = 1; d < dim; d++)
        if (fabs(a[d]) > fabs(a[pivot])) pivot = d;
    double sign = a[pivot] < 0 ? -1 : 1, h = 1 + fabs(a[pivot]);
    for (int column = 0; column < dim; column++) {
        if (column == pivot) continue;
        for (int d = 0; d < dim; d++) {
            double vector = a[d] + (d == pivot ? sign : 0);
            basis[count * dim + d] = (d == column) - vector * a[column] / h;
        }
        count++;
    }
    return count;
}

static int along_axes(int dim, double *basis)
{
    for (int i = 0; i < dim * dim; i++) basis[i] = i % (dim + 1) == 0;
    return dim;
}

pia_status pia_conditions_open(pia_constraints *c)
{
    int most = c->axis != NULL ? c->dim : 1;
    pia_index room;
    if (!pia_multiply(c->count, most, &room)) return PIA_E_SIZE;
    c->begin = pia_take(c->context, c->count + 1, sizeof *c->begin);
    c->of = pia_take(c->context, room, sizeof *c->of);
    if (c->begin == NULL || c->of == NULL) return pia_take_status(c->context, room, sizeof *c->of);
    if (c->axis != NULL) {
        c->basis = pia_take(c->context, room, (size_t)c->dim * sizeof *c->basis);
        if (c->basis == NULL) return pia_take_status(c->context, room, (size_t)c->dim * sizeof *c->basis);
    }
    c->rank = 0;
    for (pia_index i = 0; i < c->count; i++) {
        c->begin[i] = c->rank;
        int added = 1;
        if (c->axis != NULL) {
            double *basis = c->basis + c->rank * c->dim;
            added = is_directed(c, i) ? across(c->axis + i * c->dim, c->dim, basis) : along_axes(c->dim, basis);
        }
        for (int k = 0; k < added; k++) c->of[c->rank++] = i;
    }
    c->begin[c->count] = c->rank;
    return PIA_OK;
}

void pia_conditions_keep(pia_constraints *c, const unsigned char *keep)
{
    pia_index kept = 0, from = 0;
    for (pia_index i = 0; i < c->count; i++) {
        pia_index to = c->begin[i + 1];
        c->begin[i] = kept;
        for (; from < to; from++) {
            if (!keep[from]) continue;
            c->of[kept] = i;
            if (c->basis != NULL) memmove(c->basis + kept * c->dim, c->basis + from * c->dim, (size_t)c->dim * sizeof *c->basis);
            kept++;
        }
    }
    c->begin[c->count] = c->rank = kept;
}

static double product(const double *a, const double *b, int dim)
{
    double sum = 0;
    for (int d = 0; d < dim; d++) sum += a[d] * b[d];
    return sum;
}

void pia_conditions_gather(const pia_constraints *c, const double *rows, double *x)
{
    int dim = c->dim;
    for (pia_index a = 0; a < c->rank; a++) {
        const double *row = rows + c->of[a] * dim;
        if (c->basis != NULL)
            x[a] = product(c->basis + a * dim, row, dim);
        else
            memcpy(x + a * dim, row, (size_t)dim * sizeof *x);
    }
}

void pia_conditions_scatter(const pia_constraints *c, const double *x, double *rows)
{
    int dim = c->dim;
    memset(rows, 0, (size_t)(c->count * dim) * sizeof *rows);
    for (pia_index a = 0; a < c->rank; a++)
        for (int d = 0; d < dim; d++) rows[c->of[a] * dim + d] += c->basis != NULL ? c->basis[a * dim + d] * x[a] : x[a * dim + d];
}
