/* B-spline basis functions on any knot vector, clamped or not (The NURBS Book, A2.2 and A2.3). `span` is not empty. */
#ifndef PIA_SPLINE_BASIS_H
#define PIA_SPLINE_BASIS_H

#include "pia/pia.h"

/* The degree+1 functions that live on `span`, at t: values[k] = N_{span-degree+k}(t). Outside the span: the polynomials that the
 * functions are there. Cost O(degree^2). */
void pia_basis_values(const double *knots, int degree, pia_index span, double t, double *values);

/* Derivatives up to `count`: out[order * (degree + 1) + k]; orders above the degree are 0. */
void pia_basis_derivatives(const double *knots, int degree, pia_index span, double t, int count, double *out);

/* Coefficients of the blossom (polar form) of the polynomial on `span` at degree arguments: its value is the sum over k of
 * values[k] P_{span-degree+k}. All arguments t give pia_basis_values; the knots U[i+1..i+degree] give P_i itself. Coefficients of the
 * control points of a refined knot vector are never negative when U[span] <= the refined knot before the arguments < U[span+1]
 * (Ramshaw, "Blossoming: a connect-the-dots approach to splines"; Cohen, Lyche, Riesenfeld, the Oslo algorithm). */
void pia_basis_blossom(const double *knots, int degree, pia_index span, const double *arguments, double *values);

#endif
