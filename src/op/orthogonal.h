/* Least squares of a curve by orthogonal transformations of its rows: digits lost grow with the condition of A, not with that of A'A,
 * which is 1e11 and more for high degrees. */
#ifndef PIA_OP_ORTHOGONAL_H
#define PIA_OP_ORTHOGONAL_H

#include "band.h"
#include "normal.h"

/* Whether the rows of a normal form can be taken this way: those of an open curve, without fairing. */
int pia_orthogonal_suits(const pia_normal *normal);
/* d [cols x dim]: the correction of x that makes it the minimiser; 0 where frozen or where the rows say nothing, of which *weak tells
 * the number. The pull of the normal form makes rows too. out keeps the upper triangular R of W^1/2 A = Z R, to be closed by
 * pia_band_qr_close. Cost O(rows (degree + 1)^2). Errors: PIA_E_MEMORY, PIA_E_SIZE. */
pia_status pia_orthogonal_correct(const pia_normal *normal, const pia_targets *targets, const double *x, double *d, pia_band_qr *out,
                                  pia_index *weak);
/* b [cols x dim] := (R'R)^-1 b. */
void pia_orthogonal_solve(const pia_band_qr *r, double *b, int dim);

#endif
