#include "functional.h"

#include "band.h"
#include "basis.h"
#include "knots.h"

#include <math.h>

/* One direction; returns the sum of |entries|. */
static double make_line(const pia_collocation *axis, double t, int order, pia_index *column, double *entry)
{
    double values[(PIA_MAX_DEGREE + 1) * (PIA_MAX_DEGREE + 1)], sum = 0;
    pia_index span = pia_knots_span(axis->knots, axis->degree, axis->full, t);
    pia_basis_derivatives(axis->knots, axis->degree, span, t, order, values);
    for (int k = 0; k <= axis->degree; k++) {
        column[k] = pia_collocation_unknown(axis, span - axis->degree + k);
        entry[k] = values[order * (axis->degree + 1) + k];
        sum += fabs(entry[k]);
    }
    return sum;
}

static void find_range(const pia_index *column, int width, pia_index *low, pia_index *high)
{
    *low = *high = column[0];
    for (int k = 1; k < width; k++) {
        if (column[k] < *low) *low = column[k];
        if (column[k] > *high) *high = column[k];
    }
}

double pia_functional_make(const pia_op *op, const double *t, const int *derivative, pia_functional *out)
{
    double scale = 1;
    out->stride = op->count[1];
    out->width[1] = 1;
    out->column[1][0] = 0;
    out->entry[1][0] = 1;
    for (int d = 0; d < op->directions; d++) {
        int degree = op->axis[d]->degree;
        out->width[d] = degree + 1;
        double sum = derivative[d] <= degree ? make_line(op->axis[d], t[d], derivative[d], out->column[d], out->entry[d]) : 0;
        if (!(sum > 0)) return 0;
        for (int k = 0; k <= degree; k++) out->entry[d][k] /= sum;
        scale /= sum;
    }
    for (int d = 0; d < 2; d++) find_range(out->column[d], out->width[d], &out->low[d], &out->high[d]);
    return scale;
}

int pia_functional_meets(const pia_functional *a, const pia_functional *b)
{
    for (int d = 0; d < 2; d++)
        if (a->low[d] > b->high[d] || b->low[d] > a->high[d]) return 0;
    return 1;
}

static inline __attribute__((always_inline)) void sum_entries(const pia_functional *f, const double *x, int across, int dim,
                                                              double *value)
{
    for (int d = 0; d < dim; d++) value[d] = 0;
    for (int i = 0; i < f->width[0]; i++)
        for (int j = 0; j < across; j++) {
            const double *from = x + (f->column[0][i] * f->stride + f->column[1][j]) * dim;
            double entry = f->entry[0][i] * f->entry[1][j];
            for (int d = 0; d < dim; d++) value[d] += entry * from[d];
        }
}

/* Small systems are made of nothing else: the curve in usual numbers of components has its counts known. */
void pia_functional_value(const pia_functional *f, const double *x, int dim, double *value)
{
    if (f->width[1] == 1 && dim == 1)
        sum_entries(f, x, 1, 1, value);
    else if (f->width[1] == 1 && dim == 3)
        sum_entries(f, x, 1, 3, value);
    else if (f->width[1] == 1 && dim == PIA_LDL_SIDES)
        sum_entries(f, x, 1, PIA_LDL_SIDES, value);
    else
        sum_entries(f, x, f->width[1], dim, value);
}

void pia_functional_add(const pia_functional *f, const double *value, int dim, double *y)
{
    for (int i = 0; i < f->width[0]; i++)
        for (int j = 0; j < f->width[1]; j++) {
            double *to = y + (f->column[0][i] * f->stride + f->column[1][j]) * dim;
            double entry = f->entry[0][i] * f->entry[1][j];
            for (int d = 0; d < dim; d++) to[d] += entry * value[d];
        }
}

int pia_functional_size(const pia_functional *f)
{
    return f->width[0] * f->width[1];
}

pia_index pia_functional_unknown(const pia_functional *f, int k, double *entry)
{
    int i = k / f->width[1], j = k % f->width[1];
    *entry = f->entry[0][i] * f->entry[1][j];
    return f->column[0][i] * f->stride + f->column[1][j];
}
