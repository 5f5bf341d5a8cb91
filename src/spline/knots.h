/* Knot vectors: checks, spans, multiplicities. A vector has control + degree + 1 values; the domain is [U[degree], U[control]].
 * Clamped vectors repeat both ends degree+1 times. Cyclic vectors (closed directions while they are being fitted) are unclamped:
 * n distinct control points become control = n + degree, and U[i + n] = U[i] + period. */
#ifndef PIA_SPLINE_KNOTS_H
#define PIA_SPLINE_KNOTS_H

#include "context.h"

/* Finite, non-decreasing, clamped, inside multiplicity at most degree, domain not empty. Errors name the index and the value. */
pia_status pia_knots_check(pia_context *context, int degree, const double *knots, pia_index count, pia_index control);
/* The same, and copy [count] = knots in the same pass; undefined where they are refused. */
pia_status pia_knots_copy(pia_context *context, int degree, const double *knots, pia_index count, pia_index control, double *copy);

/* The span s with U[s] <= t < U[s+1], degree <= s < control; the right end of the domain belongs to the last span that is not
 * empty, and t outside the domain to the first or last one. O(log control). */
pia_index pia_knots_span(const double *knots, int degree, pia_index control, double t);
/* The same, galloping from `hint` (any span): O(1) for t near it. */
pia_index pia_knots_span_near(const double *knots, int degree, pia_index control, double t, pia_index hint);

/* How often the value at U[index] occurs (exact equality). */
int pia_knots_multiplicity(const double *knots, pia_index count, pia_index index);

/* Mean of the degree knots that determine control point i: its Greville abscissa. */
double pia_knots_greville(const double *knots, int degree, pia_index i);

#endif
