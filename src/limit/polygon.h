/* Turns of a planar polygon P + s D, the control points of a curve that a limiter guards. Closed polygons wrap. */
#ifndef PIA_LIMIT_POLYGON_H
#define PIA_LIMIT_POLYGON_H

#include "iterate.h"

/* PIA_E_ARGUMENT unless the iterate is a planar curve. */
pia_status pia_polygon_check(const pia_iterate *iterate, const char *limiter);
/* Vertices with a turn: first and one past the last. Open: 1 .. n - 1; closed: 0 .. n. */
void pia_polygon_turns(const pia_iterate *iterate, pia_index *first, pia_index *end);
/* Twice the signed area of the triangle at vertex i of P + scale D (scale NULL: P itself; else a factor for each vertex). */
double pia_polygon_orientation(const pia_iterate *iterate, const double *scale, pia_index i);
/* Its sign, 0 when |cross| <= 1e-12 |e1| |e2|. */
int pia_polygon_sign(const pia_iterate *iterate, const double *scale, pia_index i);
/* Neighbouring vertex numbers, wrapped where the polygon is closed. */
pia_index pia_polygon_vertex(const pia_iterate *iterate, pia_index i);
int pia_polygon_closed(const pia_iterate *iterate);
/* Vertex i of P + scale D. */
void pia_polygon_point(const pia_iterate *iterate, const double *scale, pia_index i, double xy[2]);

/* The sign that each turn of P + scale D is to keep, [cols], 0 at vertices without a turn: vertices that coincide share a turn,
 * straight ones take the sign of their neighbours, half of them each between opposite ones; an odd middle one may bend as it likes and
 * gets 0. Returns 0 when all of them are straight, 1 otherwise. O(cols). */
int pia_polygon_targets(const pia_iterate *iterate, const double *scale, double *sign);

/* Once a limiter has chosen a factor for each step: D *= scale, and the fit is stalled where steps of delta or more were asked but none
 * is left. */
void pia_polygon_shorten(pia_iterate *iterate, const double *scale, double delta);

#endif
