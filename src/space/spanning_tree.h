/* The Euclidean minimum spanning tree: how points hang together when nothing tells their order. */
#ifndef PIA_SPACE_SPANNING_TREE_H
#define PIA_SPACE_SPANNING_TREE_H

#include "context.h"

typedef struct pia_tree_edge {
    pia_index row[2]; /* row[0] < row[1] */
    double length;
} pia_tree_edge;

/* The count - 1 edges of the tree of points [count x dim], shortest first, equally long ones by rows; the caller gives them back. By
 * Boruvka's rounds with a k-d tree. O(count log^2 count) for points that fill lines or surfaces evenly. Errors: PIA_E_MEMORY,
 * PIA_E_SIZE, PIA_E_DATA (squares of distances overflow). */
pia_status pia_spanning_tree(pia_context *context, const double *points, pia_index count, int dim, pia_tree_edge **edges);

#endif
