/* The squared distance from the origin to a Bezier piece, minimised inside a rectangle of its unit square. */
#ifndef PIA_SPLINE_NEWTON_H
#define PIA_SPLINE_NEWTON_H

typedef struct pia_newton {
    int directions, dim, rational, degree[2];
    const double *points;     /* [degree[0] + 1][degree[1] + 1][dim + rational], (w x, w) when rational */
    const double *low, *high; /* [2]: the rectangle */
} pia_newton;

/* Goes downhill from `at` [2] to a local minimum, its parameters to rounding; returns the squared distance there. At most 60 steps. */
double pia_newton_minimise(const pia_newton *problem, double at[2]);

#endif
