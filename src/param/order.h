/* An order for points of a curve that have none. */
#ifndef PIA_PARAM_ORDER_H
#define PIA_PARAM_ORDER_H

#include "context.h"

/* order [count] of points [count x dim]; O(count log count) for both.
 * By nearest neighbours: from a point far away from the others always to the nearest that is left. A break is a step of more than ten
 * times the median step: there the walk had to go back for what it had left. */
pia_status pia_order_nearest(pia_context *context, const double *points, pia_index count, int dim, pia_index *order,
                             pia_order_report *report);
/* By the spanning tree: along its longest path; points beside it stand where their twig leaves it. A break is a twig longer than ten
 * times the median edge: there the points branch. */
pia_status pia_order_tree(pia_context *context, const double *points, pia_index count, int dim, pia_index *order,
                          pia_order_report *report);

#endif
