/* Placements: from parameters to knots, one file each. */
#ifndef PIA_PLACE_PLACE_H
#define PIA_PLACE_PLACE_H

#include "context.h"

typedef struct pia_place_problem {
    int degree;
    int closed;               /* 1: cyclic knots are wanted (spline/knots.h), `control` counts the distinct control points */
    pia_index control;        /* control points wanted */
    const double *parameters; /* [count], non-decreasing in [0, 1] (closed: [0, 1), period 1) */
    pia_index count;
} pia_place_problem;

typedef struct pia_placement {
    const char *name, *title, *reference, *detail;
    int square; /* 1: as many control points as parameters (interpolation); 0: any number from degree + 1 */
    /* Clamped: knots [control + degree + 1]. Closed: knots [control + 2 degree + 1]. Errors: PIA_E_SHAPE when the rule cannot make that
     * many knots from these parameters, naming the number it can. */
    pia_status (*place)(pia_context *context, const pia_place_problem *problem, double *knots);
} pia_placement;

/* The registry, collected from the files place_*.c; NULL past the end. */
const pia_placement *pia_place_list(pia_index index);
const pia_placement *pia_place_find(const char *name);

#endif
