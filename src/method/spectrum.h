/* The ends of the spectrum of H = A'WA, which accelerated iterations choose their steps by. */
#ifndef PIA_METHOD_SPECTRUM_H
#define PIA_METHOD_SPECTRUM_H

#include "iterate.h"

typedef struct pia_spectrum {
    double largest;  /* never below the largest eigenvalue by more than rounding; 0: H is zero */
    double smallest; /* of the positive ones, about; never below it by more than the accuracy reached, 1 % on ordinary problems */
} pia_spectrum;

/* Of S H S, S = diag(scale [cols]), NULL: of H. Lanczos with a fixed start inside the range of H, without reorthogonalisation, at most
 * 300 products with H. `bound` is a known upper bound of the largest eigenvalue. Errors: PIA_E_MEMORY. */
pia_status pia_spectrum_estimate(const pia_iterate *iterate, const double *scale, double bound, pia_spectrum *out);

/* Of H itself, bounded by its largest row sum. */
pia_status pia_spectrum_of_gradient(const pia_iterate *iterate, pia_spectrum *out);

#endif
