/* B-spline basis functions on any knot vector, clamped or not (The NURBS Book, A2.2 and A2.3). */
#ifndef PIA_SPLINE_BASIS_H
#define PIA_SPLINE_BASIS_H

#include "pia/pia.h"

/* The degree+1 functions that live on `span`, at t: values[k] = N_{span-degree+k}(t). */
void pia_basis_values(const double *knots, int degree, pia_index span, double t, double *values);

/* Derivatives up to `count`: out[order * (degree + 1) + k]; orders above the degree are 0. */
void pia_basis_derivatives(const double *knots, int degree, pia_index span, double t, int count, double *out);

#endif
