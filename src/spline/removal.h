/* One knot taken out of one direction: the control points that change, and a bound of what the shape changes by. */
#ifndef PIA_SPLINE_REMOVAL_H
#define PIA_SPLINE_REMOVAL_H

#include "model.h"

/* Knot U[index], the last of `multiplicity` equal ones, leaves. Boehm's insertion of it ties count = degree - multiplicity + 1 old
 * control points, slots first to first + count - 1, to count - 1 new ones: P_k = a_k Q_k + (1 - a_k) Q_(k-1), where Q_(-1) and
 * Q_(count-1) are the old neighbours. That is one condition too many; `null` is its left null vector, scaled to sum |null| = 1. */
typedef struct pia_removal {
    pia_index index, first;
    int multiplicity, count;
    double a[PIA_MAX_DEGREE], null[PIA_MAX_DEGREE];
} pia_removal;

void pia_removal_open(const double *knots, int degree, pia_index index, int multiplicity, pia_removal *out);

/* The new control points of one line, whose largest residual is the smallest possible: all are as large as the defect, [width], by
 * which the old points miss the condition. line: slot 0, slots are `stride` apart. points [count - 1][width]. */
void pia_removal_solve(const pia_removal *r, const double *line, pia_index stride, int width, double *points, double *defect);

#endif
