/* Arrays shaped like the control points, for methods: what an iteration needs is taken once, before the first one. */
#ifndef PIA_METHOD_VECTORS_H
#define PIA_METHOD_VECTORS_H

#include "iterate.h"

/* `count` arrays [cols x dim] of zeros in one block: vector[0] is the block and is given back by pia_give. Errors: PIA_E_MEMORY,
 * vector[0] is then NULL. */
pia_status pia_vectors_take(const pia_iterate *iterate, int count, double **vector);

/* y = a x + b y. */
void pia_vectors_mix(const pia_iterate *iterate, double a, const double *x, double b, double *y);
/* y = diag(factor [cols]) x. x and y may be the same. */
void pia_vectors_scale(const pia_iterate *iterate, const double *factor, const double *x, double *y);

#endif
