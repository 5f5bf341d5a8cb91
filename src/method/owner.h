/* What the interpolating methods share: unknown c is moved by the residual of row c, the row it owns. */
#ifndef PIA_METHOD_OWNER_H
#define PIA_METHOD_OWNER_H

#include "iterate.h"

/* D = factor * R, zero where frozen. */
void pia_owner_adjust(pia_iterate *iterate, double factor);
/* The same, and P + D into `adjust`, in one pass over the data. */
void pia_owner_step(pia_iterate *iterate, double factor);

/* The smallest eigenvalue of the owned rows of A, estimated from below 1 by power iteration on I - A (the eigenvalues of a B-spline
 * collocation matrix are real, in (0, 1]). Never below the true value by more than rounding, so that steps made from it are safe.
 * At most `passes` products with A. */
pia_status pia_owner_smallest(pia_iterate *iterate, int passes, double *smallest);

#endif
