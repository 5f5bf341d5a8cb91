/* Whether points look as if they stood in no order along their curve. */
#ifndef PIA_CLI_ORDER_HINT_H
#define PIA_CLI_ORDER_HINT_H

#include "session.h"

/* How many times as long as their spanning tree the way through points [count x dim] is; 0 where it is short enough not to ask, because
 * its steps are small beside the extent. Points that are not finite: 0. */
double order_ratio(struct session *session, const double *points, pia_index count, int dim);
/* From which ratio on an order looks random. */
#define ORDER_LOOKS_RANDOM 4.0

#endif
