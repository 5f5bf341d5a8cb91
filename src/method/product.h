/* H x for methods: by the normal form where there is one, else by a pass over the data. */
#ifndef PIA_METHOD_PRODUCT_H
#define PIA_METHOD_PRODUCT_H

#include "iterate.h"

typedef struct pia_product {
    const pia_iterate *iterate;
    double *rows; /* work [rows x dim]; NULL with a normal form */
} pia_product;

/* Errors: PIA_E_MEMORY. */
pia_status pia_product_open(const pia_iterate *iterate, pia_product *out);
void pia_product_close(pia_product *product);
/* y [cols x dim] = A'WA x, zero where frozen; dim at most the iterate's. */
void pia_product_apply(const pia_product *product, const double *x, int dim, double *y);

/* Diagonal of H, or, where no normal form tells it, the row sums that bound it: [cols]. Errors: PIA_E_MEMORY. */
pia_status pia_product_diagonal(const pia_iterate *iterate, double *out);

#endif
