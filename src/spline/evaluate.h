/* One point of a model with its derivatives: what closest points, curvature and length are made of. */
#ifndef PIA_SPLINE_EVALUATE_H
#define PIA_SPLINE_EVALUATE_H

#include "model.h"

/* Rows of an evaluation with derivatives up to `order`: order + 1 for a curve, (order + 1)(order + 2) / 2 for a surface, the
 * derivative a times in u and b times in v at row pia_derivative_row(a, b). */
pia_index pia_derivative_rows(int directions, int order);
pia_index pia_derivative_row(int a, int b);

/* Value and derivatives of one point, out [rows x dim] as pia_model_eval. parameter [directions], clamped to the domain; hint
 * [directions] is any span and receives the one found. No allocation. */
void pia_evaluate(const pia_model *model, const double *parameter, int order, pia_index *hint, double *out);

#endif
