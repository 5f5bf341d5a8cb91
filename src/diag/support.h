/* Which control points the data cannot hold: found before solving. */
#ifndef PIA_DIAG_SUPPORT_H
#define PIA_DIAG_SUPPORT_H

#include "context.h"

typedef struct pia_support_line {
    int degree, closed;  /* closed: cyclic knots (spline/knots.h), `control` counts the distinct control points */
    const double *knots; /* [control + degree + 1]; closed: [control + 2 degree + 1] */
    pia_index control;
    const double *parameters; /* [count], non-decreasing, inside the domain */
    const double *weights;    /* [count], NULL: 1; rows of weight 0 hold nothing */
    pia_index count;
} pia_support_line;

/* Schoenberg and Whitney: each control point needs a parameter of its own where its basis function is positive, in order. held
 * [control] receives 1, or 0 where a largest matching leaves none (which of the neighbours of a gap that is is a matter of choice; how
 * many is not). Returns the number of zeroes: the columns by which the collocation matrix lacks full rank (closed: at least so many;
 * uniform parameters at the knots of an even degree lack one more). A grid is held when both its directions are. O(count + control),
 * closed: up to degree + 1 times that. */
pia_index pia_support_find(const pia_support_line *line, unsigned char *held);

/* Scattered points: data [control[0] x control[1]] receives how many pairs (u, v) lie in the support of each control point. knots[d]
 * has control[d] + degree[d] + 1 values (closed directions: with the wrapped copies, which count apart). pairs [count x 2], weights as
 * above. Returns the number of zeroes. O(count log control + control[0] control[1]). */
pia_index pia_support_count(const int degree[2], const double *const knots[2], const pia_index control[2], const double *pairs,
                            const double *weights, pia_index count, pia_index *data);

#endif
