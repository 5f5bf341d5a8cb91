/* Contours of a raster: closed polylines around where a function is positive. */
#ifndef PIA_DIAG_CONTOUR_H
#define PIA_DIAG_CONTOUR_H

#include "distance_map.h"

typedef struct pia_loops {
    pia_index loop_count, loop_room;
    pia_index *vertex_count; /* [loop_count] */
    double *at;              /* [sum of vertex_count x 2], loop after loop */
    pia_index vertex_total, vertex_room;
} pia_loops;

/* Marching squares over value [nodes], with everything outside the raster negative: loops run along its border through the border
 * nodes. Nodes that touch at corners only are apart. Positive nodes lie to the left of the loops: outer ones run counter-clockwise,
 * holes clockwise. Loops do not touch each other or themselves; coordinates are node numbers times step. O(nodes). The caller clears
 * them. Errors: PIA_E_MEMORY, PIA_E_SIZE. */
pia_status pia_contour(pia_context *context, const pia_raster *raster, const double *value, pia_loops *out);
void pia_loops_clear(pia_context *context, pia_loops *loops);

/* Signed area of `count` vertices; positive counter-clockwise. */
double pia_loop_area(const double *at, pia_index count);
/* Douglas-Peucker: drops vertices that lie within `tolerance` of the chords that stay, between the lowest vertex and the one farthest
 * from it. Returns how many stay; fewer than 4 vertices stay as they are. keep: work [count]. The result may cross itself where the
 * loop comes closer to itself than the tolerance. */
pia_index pia_loop_simplify(double *at, pia_index count, double tolerance, unsigned char *keep);

#endif
