/* Where the points of a surface end: the outline of their parameters, with holes. */
#ifndef PIA_DIAG_OUTLINE_H
#define PIA_DIAG_OUTLINE_H

#include "contour.h"

typedef struct pia_outline_problem {
    const double *uv; /* [count x 2], inside the domain */
    pia_index count;
    double domain[2][2]; /* [direction][first, last] */
    int closed[2];
    double scale[2]; /* length in space of a unit of u and of v */
    int hull;        /* 1: the convex hull; 0: an alpha shape */
    double radius;   /* of the alpha shape, a length in space; 0: from the spacing of the points */
} pia_outline_problem;

typedef struct pia_outline {
    pia_loops
        loops;     /* in the domain; the first one is outside, the others are holes in it; none where the outline is the whole domain */
    double radius; /* that was used; 0 for a hull */
    double coarseness; /* by how much loops may be simplified with all points inside, a length in space */
    pia_index outside; /* points that lie in islands of their own, outside the first loop */
} pia_outline;

/* The alpha shape: what no disc of `radius` covers that is free of points; a gap narrower than two radii is none. Found on a raster of
 * an eighth of the radius (300 to 1000 nodes a direction), and wider than the points by less than two of its steps. The radius
 * chosen is one and a half times the length below which 99.5 % of the edges of the spanning tree of the points are, so that single
 * points do not stretch it. O(count log count + nodes). Errors: PIA_E_MEMORY, PIA_E_SIZE. */
pia_status pia_outline_find(pia_context *context, const pia_outline_problem *problem, pia_outline *out);

#endif
