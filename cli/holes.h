/* Grids with holes: points of NaN, which a fit leaves out and nothing else takes. */
#ifndef PIA_CLI_HOLES_H
#define PIA_CLI_HOLES_H

#include "session.h"

struct solid {
    const double *points;     /* [count x dim] */
    const double *parameters; /* [count x 2]; NULL: none */
    pia_index count;
    const pia_index *row; /* [count] place of each among all points; NULL: there are no holes */
};

/* The points that are none, with their parameters [count[0] x count[1] x 2] (NULL: none). Kept by the session. */
struct solid points_without_holes(struct session *session, const pia_points_info *points, const double *parameters);

#endif
