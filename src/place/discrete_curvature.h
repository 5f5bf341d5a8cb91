/* Discrete curvature of ordered points after adaptive smoothing, by which dominant points are found and fences placed ([2011]
 * section 4; Teh and Chin 1989; Ray and Pandyan 2003). */
#ifndef PIA_PLACE_DISCRETE_CURVATURE_H
#define PIA_PLACE_DISCRETE_CURVATURE_H

#include "context.h"

/* smooth [count x dim], not `points`: every inside point is the Gaussian mean of its region of support, which grows to h points on
 * either side while the chord over it grows and the point's height over that chord, relative to the chord, does not shrink; the
 * standard deviation is h / 2. h is at most `most` (0: a copy) and ends at the ends, which stay. */
void pia_curvature_smooth(const double *points, pia_index count, int dim, pia_index most, double *smooth);

/* curvature [count] >= 0 of points [count x dim], count >= 2: Eq. (29) by central differences, in any dimension; the ends copy their
 * neighbours. A point where the line turns back counts as a turn of 173 degrees. */
void pia_curvature_along(const double *points, pia_index count, int dim, double *curvature);

/* The curvature sequence (30) of a curve: both steps. Errors: PIA_E_MEMORY, PIA_E_SIZE. */
pia_status pia_curvature_of_curve(pia_context *context, const double *points, pia_index count, int dim, pia_index most,
                                  double *curvature);

/* Of a grid [count[0] x count[1] x dim] the sequences (32) rows [count[0]] and (33) columns [count[1]]: means of the total curvature,
 * the sum of the squared curvatures along row and column. Errors: PIA_E_MEMORY, PIA_E_SIZE. */
pia_status pia_curvature_of_grid(pia_context *context, const double *points, const pia_index count[2], int dim, pia_index most,
                                 double *rows, double *columns);

#endif
