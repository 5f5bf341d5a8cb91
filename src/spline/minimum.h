/* The global minimum of a function on the unit square (or interval) of a Bezier piece, where the function is a quotient of Bernstein
 * polynomials: squared distance, or one component. */
#ifndef PIA_SPLINE_MINIMUM_H
#define PIA_SPLINE_MINIMUM_H

#include "bernstein.h"

/* A part of the unit square. */
typedef struct pia_cell {
    double low[2], high[2];
} pia_cell;

/* Value, gradient and Hessian (uu, uv, vv) at a place. `safe` is a second derivative in u and v to go by where the Hessian's is not
 * positive; 0: none is known. */
typedef struct pia_look {
    double at[2], value, slope[2], hessian[3], safe[2];
} pia_look;

/* One problem; `user` is the caller's. */
typedef struct pia_minimum {
    int directions;
    int degree[2];   /* of the polynomials below; degree[1] is 0 for a curve */
    int rational;    /* 0: the denominator is 1 */
    double relative; /* a better minimum must gain this much of the value, */
    double absolute; /* and this much */
    void *user;
    void (*expand)(struct pia_minimum *m, const pia_cell *cell); /* fills numerator and denominator over a cell */
    void (*look)(const struct pia_minimum *m, const double at[2], pia_look *out);

    pia_index budget; /* cells that may still be looked at: a bound on the time, far above the need */
    double value;     /* the best so far: INFINITY, or what other pieces gave */
    double at[2];     /* its place */
    int found;        /* 1: this piece gave it */
    int settled;      /* 1: Newton found it; 0: it is a corner of a cell */

    double numerator[PIA_SQUARE_COUNT], denominator[PIA_SQUARE_COUNT];
} pia_minimum;

/* Improves value, at, found and settled by the whole piece. */
void pia_minimum_find(pia_minimum *m);

/* Goes downhill inside a cell from now->at to a local minimum, its place to rounding. At most 60 steps. */
void pia_minimum_descend(const pia_minimum *m, const pia_cell *cell, pia_look *now);

#endif
