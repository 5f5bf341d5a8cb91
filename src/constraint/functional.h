/* One linear functional of the unknowns: the product of one short row a direction. */
#ifndef PIA_CONSTRAINT_FUNCTIONAL_H
#define PIA_CONSTRAINT_FUNCTIONAL_H

#include "op.h"

typedef struct pia_functional {
    int width[2];                            /* entries a direction; width[1] is 1 for a curve */
    pia_index column[2][PIA_MAX_DEGREE + 1]; /* unknown of the direction */
    double entry[2][PIA_MAX_DEGREE + 1];
    pia_index low[2], high[2]; /* the columns lie between them */
    pia_index stride;          /* unknowns of the second direction */
} pia_functional;

/* Derivative of orders derivative[] at the parameters t[] inside the domain. Returns the factor that scaled the row to absolute sum 1,
 * 0 when the row vanishes. */
double pia_functional_make(const pia_op *op, const double *t, const int *derivative, pia_functional *out);

/* value [dim] = row times x [cols x dim]. */
void pia_functional_value(const pia_functional *f, const double *x, int dim, double *value);
/* y [cols x dim] += row' value. */
void pia_functional_add(const pia_functional *f, const double *value, int dim, double *y);
/* 0 when no unknown is in both rows. */
int pia_functional_meets(const pia_functional *a, const pia_functional *b);
/* Unknown number k of the row, 0 <= k < size, and its entry; one unknown may come twice. */
int pia_functional_size(const pia_functional *f);
pia_index pia_functional_unknown(const pia_functional *f, int k, double *entry);

#endif
