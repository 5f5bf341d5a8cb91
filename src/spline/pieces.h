/* The Bezier pieces of a model under a hierarchy of bounding boxes. */
#ifndef PIA_SPLINE_PIECES_H
#define PIA_SPLINE_PIECES_H

#include "model.h"

typedef struct pia_pieces {
    pia_model *bezier;  /* every inside knot degree-fold */
    pia_index count[2]; /* pieces a direction; count[1] is 1 for a curve */
    double *box;        /* [2 count[0] count[1] - 1][2][dim]: low and high corner of each node */
} pia_pieces;

/* Pieces [begin, end) of each direction. The root holds all; a block of more than one piece is halved in its longer direction. Nodes
 * are stored in preorder. */
typedef struct pia_block {
    pia_index node;
    pia_index begin[2], end[2];
} pia_block;

/* Cost O(control points). */
pia_status pia_pieces_open(pia_context *context, const pia_model *model, pia_pieces *out);
void pia_pieces_close(pia_context *context, pia_pieces *pieces);

pia_block pia_block_root(const pia_pieces *pieces);
int pia_block_is_piece(const pia_block *block);
void pia_block_halve(const pia_block *block, pia_block half[2]);

/* Control points of one piece, [degree[0] + 1][degree[1] + 1][width], as stored in the model. */
void pia_piece_control(const pia_pieces *pieces, const pia_index piece[2], double *out);
/* The knots of a piece in direction d. */
void pia_piece_interval(const pia_pieces *pieces, pia_index piece, int d, double *low, double *high);

#endif
