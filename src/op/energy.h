/* The fairing energy: how much a curve or a surface bends, a quadratic form x'E x of the control points. A curve has the integral of
 * |C''|^2, a surface that of a thin plate, |S_uu|^2 + 2 |S_uv|^2 + |S_vv|^2; parameters count as if every direction ran from 0 to 1.
 * Exact: Gauss-Legendre quadrature on every span. E is as banded as H and vanishes on straight lines (x'E x on planes). */
#ifndef PIA_OP_ENERGY_H
#define PIA_OP_ENERGY_H

#include "stencil.h"

typedef struct pia_energy {
    pia_context *context;
    const pia_op *op;
    double strength;     /* relative: 1 gives E the mean diagonal of H */
    double *share[2][3]; /* [direction][order]: for every span the integrals of products of derivatives, a triangle as in span_sums.h */
    double *band[2][3];  /* the same summed: [full x (degree + 1)], entry (j, b) couples the full columns j and j + b */
    double *line[2][3];  /* [unknowns x 2]: the diagonal of the matrix of these integrals, and the sums of |entries| of its rows */
} pia_energy;

/* strength > 0; op is borrowed. Errors: PIA_E_MEMORY, PIA_E_SIZE. */
pia_status pia_energy_open(const pia_op *op, double strength, pia_energy **out);
void pia_energy_close(pia_energy *energy);

/* The factor that makes E as strong as asked beside a matrix of this diagonal [cols]; 0 where nothing can bend. */
double pia_energy_factor(const pia_energy *energy, const double *diagonal);
/* factor E added to the matrix of a curve; or of a surface. */
void pia_energy_add_gram(const pia_energy *energy, double factor, pia_gram *gram);
void pia_energy_add_stencil(const pia_energy *energy, double factor, pia_stencil *stencil);
/* Factor times (at least) the sums of |entries| of the rows of E, added to sums [cols]: with them, steps that converge for H do so for
 * H + factor E. */
void pia_energy_add_sums(const pia_energy *energy, double factor, double *sums);

#endif
