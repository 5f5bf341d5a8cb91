/* Placements: from parameters to knots, one file each. */
#ifndef PIA_PLACE_PLACE_H
#define PIA_PLACE_PLACE_H

#include "context.h"

typedef struct pia_place_problem {
    int degree;
    int closed;               /* 1: cyclic knots are wanted (spline/knots.h), `control` counts the distinct control points */
    pia_index control;        /* control points wanted */
    const double *parameters; /* [count], non-decreasing; closed: in [0, 1), period 1. pia2004: raw chords */
    pia_index count;
} pia_place_problem;

typedef struct pia_placement {
    const char *name, *title, *reference, *detail;
    int square; /* 1: the number of control points follows from that of the parameters (interpolation): as many, closed or not; for
                   pia2004 two more. 0: any number from degree + 1 */
    int by_curvature; /* 1: the parameters are to be those of the lines that dominant.h chooses, one a control point */
    int adds_lines;   /* 1: towards a tolerance, the lines of the worst points are added to them */
    /* Clamped at the first and the last parameter: knots [control + degree + 1]. Closed: knots [control + 2 degree + 1], period 1,
     * knots[i + control] == knots[i] + 1 exactly, and the domain [knots[degree], knots[degree] + 1] starts near 0 but seldom at it:
     * parameters are folded into it. Inside knots are at most degree-fold. Errors: PIA_E_SHAPE when the rule cannot make that many
     * knots from these parameters, naming the number it can; PIA_E_ARGUMENT for a degree it does not know, PIA_E_MEMORY. */
    pia_status (*place)(pia_context *context, const pia_place_problem *problem, double *knots);
} pia_placement;

/* The registry, collected from the files place_*.c; NULL past the end. */
const pia_placement *pia_place_list(pia_index index);
const pia_placement *pia_place_find(const char *name);

/* Square closed placements: the data point whose parameter the basis function of distinct control point `column` is centred on,
 * (column - degree / 2) mod control. Its inverse, the column of a row, is (row + degree / 2) mod control. */
pia_index pia_place_owner(int degree, pia_index control, pia_index column);

#endif
