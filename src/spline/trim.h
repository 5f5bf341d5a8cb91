/* Trim loops of a surface: simple closed polylines in its parameter plane. The face is what lies inside loop 0 and outside the others.
 */
#ifndef PIA_SPLINE_TRIM_H
#define PIA_SPLINE_TRIM_H

#include "context.h"

typedef struct pia_trim {
    pia_index loop_count;
    pia_index *start; /* [loop_count + 1] first vertex of each loop, and the total */
    double *uv;       /* [start[loop_count] x 2], no vertex twice; loop 0 counter-clockwise, the others clockwise */
} pia_trim;

/* Loops whose vertices are still to be filled in, room for vertex_count of them; start is 0. PIA_E_MEMORY, PIA_E_SIZE. */
pia_status pia_trim_new(pia_context *context, pia_index loop_count, pia_index vertex_count, pia_trim **out);
/* A deep copy; NULL of NULL. */
pia_status pia_trim_copy(pia_context *context, const pia_trim *trim, pia_trim **out);
void pia_trim_destroy(const pia_memory *memory, pia_trim *trim);

/* Vertex `vertex` of a loop, counted around it: the one after the last is the first. */
const double *pia_trim_vertex(const pia_trim *trim, pia_index loop, pia_index vertex);

/* PIA_E_DATA unless no two edges meet apart from neighbours at their vertex, and every other loop lies inside loop 0 and in no third.
 * Cost O(n log n) for loops that are not folded much; at worst O(n^2). */
pia_status pia_trim_check(pia_context *context, const pia_trim *trim);

/* Whether (u, v) lies in the face. On an edge either answer is possible. O(vertices). */
int pia_trim_contains(const pia_trim *trim, const double uv[2]);

#endif
