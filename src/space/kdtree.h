/* Points in space, for questions about their neighbours. */
#ifndef PIA_SPACE_KDTREE_H
#define PIA_SPACE_KDTREE_H

#include "context.h"

/* A balanced tree: a node is the middle point of a stretch of `order`, by the coordinate in which the stretch is longest. */
typedef struct pia_kdtree {
    const double *points; /* borrowed [count x dim] */
    pia_index count;
    int dim;
    pia_index *order; /* [count] rows; the node of a stretch stands in its middle, what lies below it before, above it behind */
    int *axis;        /* [count] of the node at that place of `order` */
} pia_kdtree;

/* Points are finite. The same points give the same tree. O(count log count). Errors: PIA_E_MEMORY, PIA_E_SIZE. */
pia_status pia_kdtree_open(pia_context *context, const double *points, pia_index count, int dim, pia_kdtree *out);
void pia_kdtree_close(pia_context *context, pia_kdtree *tree);

/* The row closest to `point` [dim] among those whose `group` differs from `own` (group NULL: among those not marked in `gone`, NULL:
 * all); of equally close ones the smallest. -1 when there is none, or none closer than *square, which becomes the squared distance.
 * all_group [count]: of the stretch below a node, by its place in `order`: the group of all its rows, or -1; with `group` only. */
typedef struct pia_kdtree_filter {
    const pia_index *group, *all_group;
    pia_index own;
    const unsigned char *gone;    /* [count] by row */
    const pia_index *still_there; /* [count] rows not gone in the stretch, by the place of its node; with `gone` only */
} pia_kdtree_filter;
pia_index pia_kdtree_nearest(const pia_kdtree *tree, const double *point, const pia_kdtree_filter *filter, double *square);

#endif
