#include "product.h"

#include "normalise.h"

#include <math.h>
#include <string.h>

pia_status pia_product_open(const pia_iterate *iterate, pia_product *out)
{
    *out = (pia_product){iterate, NULL};
    if (iterate->normal != NULL) return PIA_OK;
    pia_index size;
    if (!pia_multiply(iterate->op->rows, iterate->dim, &size)) size = -1;
    out->rows = pia_take(iterate->context, size, sizeof *out->rows);
    return out->rows != NULL ? PIA_OK : pia_take_status(iterate->context, size, sizeof *out->rows);
}

void pia_product_close(pia_product *product)
{
    if (product->iterate != NULL) pia_give(product->iterate->context, product->rows);
    *product = (pia_product){0};
}

/* A hole is a row whose equation is missing. */
static void clear_holes(const pia_iterate *iterate, int dim, double *rows)
{
    const double *target = iterate->targets.points;
    for (pia_index row = 0; row < iterate->op->rows; row++, target += iterate->dim)
        for (int d = 0; d < iterate->dim; d++)
            if (isnan(target[d])) memset(rows + row * dim, 0, (size_t)dim * sizeof *rows);
}

void pia_product_apply(const pia_product *product, const double *x, int dim, double *y)
{
    const pia_iterate *iterate = product->iterate;
    if (iterate->normal != NULL) {
        iterate->normal->class->multiply(iterate->normal, x, dim, y);
        return;
    }
    pia_op_apply(iterate->op, x, dim, product->rows);
    clear_holes(iterate, dim, product->rows);
    pia_op_gather(iterate->op, product->rows, iterate->op->weights, dim, y);
}

pia_status pia_product_diagonal(const pia_iterate *iterate, double *out)
{
    if (iterate->normal == NULL) return pia_column_sums(iterate, out);
    memcpy(out, iterate->normal->diagonal, (size_t)iterate->op->cols * sizeof *out);
    return PIA_OK;
}
