/* A window of a draft: a piece of the curve as a spline of its own, some of whose control points may move. */
#ifndef PIA_OP_WINDOW_H
#define PIA_OP_WINDOW_H

#include "draft.h"

enum {
    PIA_WINDOW_FREE = 48,  /* most unknowns */
    PIA_WINDOW_SHORT = 24, /* closed curves of at most this many control points can be windows of their own */
    PIA_WINDOW_CONTROL = PIA_WINDOW_FREE + 2 * PIA_MAX_DEGREE,
    PIA_WINDOW_KNOTS = PIA_WINDOW_CONTROL + PIA_MAX_DEGREE + 1
};

typedef struct pia_window {
    int count;       /* control points, on knots 0 .. count + degree */
    int first, free; /* those that move. In a cyclic draft all do, and the last `degree` ones are copies of the first */
    pia_index base;  /* number of control point 0 in the draft */
    double knots[PIA_WINDOW_KNOTS];
    double point[PIA_WINDOW_CONTROL * PIA_MAX_DIM];
    pia_index row, rows; /* data rows that moving control points touch, unrolled */
    double begin, end;   /* parameters that they touch */
    int has_end;         /* 1: `end` is among them: it is that of the curve */
    pia_index gap;       /* unrolled row, from which on so many gaps got knots: all their places take part */
    int gaps;
} pia_window;

/* Moves the control points until no row deviates more than it may, if that can be had: least squares, reweighted towards the smallest
 * largest deviation (Lawson 1961) at most `rounds` times, on a few rows of each span; then the worst of all other rows join them, and
 * so on. Given up early when the weighted root mean square, a bound from below, proves that it cannot be had. Returns the largest
 * deviation over what is allowed, at most 1 only if all rows were seen to keep it. */
double pia_window_fit(pia_draft *draft, pia_window *window, int rounds);

#endif
