/* The point of a model's Bezier pieces closest to a given point, found globally. */
#ifndef PIA_SPLINE_FOOT_H
#define PIA_SPLINE_FOOT_H

#include "minimum.h"
#include "pieces.h"

/* Distances are in units of `scale`, so that their squares neither overflow nor vanish. */
typedef struct pia_foot {
    const pia_pieces *pieces;
    const double *point;
    double scale;
    double parameter[2]; /* of the closest point so far */
    pia_minimum minimum; /* of the squared distance; its value is the best so far */

    pia_bernstein_scales scales;
    double piece[PIA_PIECE_COUNT * PIA_MAX_WIDTH]; /* control points of the piece at hand less the point */
    double cell[PIA_PIECE_COUNT * PIA_MAX_WIDTH];  /* the same over a part of it */
} pia_foot;

/* Once for many points. */
void pia_foot_open(const pia_pieces *pieces, pia_foot *foot);
/* For each point, whose distance to the farthest control point along any axis is scale. */
void pia_foot_start(pia_foot *foot, const double *point, double scale);
/* Improves parameter and minimum.value by the closest point of a piece. */
void pia_foot_search(pia_foot *foot, const pia_index piece[2]);

#endif
