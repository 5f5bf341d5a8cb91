/* The point of a Bezier piece closest to a given point, found globally. */
#ifndef PIA_SPLINE_FOOT_H
#define PIA_SPLINE_FOOT_H

#include "bernstein.h"
#include "pieces.h"

/* One search; the caller fills the first group for a point and then searches pieces. Distances are in units of `scale`, so that their
 * squares neither overflow nor vanish. */
typedef struct pia_foot {
    const pia_pieces *pieces;
    const double *point;
    double scale;
    pia_index budget;    /* cells that may still be looked at: a bound on the time, far above what points need */
    double square;       /* squared distance of the best candidate; starts as INFINITY */
    double parameter[2]; /* its parameters */
    int settled;         /* 1: Newton found it; 0: it is a corner of a cell */

    pia_bernstein_scales scales;
    double low[2], high[2];                        /* the knots of the piece at hand */
    double piece[PIA_PIECE_COUNT * PIA_MAX_WIDTH]; /* its control points less the point */
    double cell[PIA_PIECE_COUNT * PIA_MAX_WIDTH];  /* the same over a part of the piece */
    double distance[PIA_SQUARE_COUNT];             /* Bernstein coefficients over that part: squared distance times squared weight */
    double weight[PIA_SQUARE_COUNT];               /* squared weight */
} pia_foot;

/* Improves the best candidate by the closest point of a piece, to 1e-12 of the squared distance. */
void pia_foot_search(pia_foot *foot, const pia_index piece[2]);

#endif
