/* Pieces of a picture in space, drawn from far to near (painter's algorithm). */
#ifndef PIA_REPORT_FIGURE_PIECES_H
#define PIA_REPORT_FIGURE_PIECES_H

#include "view.h"

typedef struct pia_piece {
    double depth;
    pia_index order; /* of two pieces at one depth, the later one lies above */
    pia_spot spot[4];
    int corners; /* 1 disc, 2 line, 4 quadrilateral */
    double size; /* radius or width */
    pia_colour colour;
} pia_piece;

typedef struct pia_pieces {
    const pia_memory *memory;
    const pia_view *view;
    pia_piece *piece;
    pia_index count, capacity;
    int failed; /* 1: memory was short, some pieces are missing */
} pia_pieces;

/* One piece of `corners` positions; `lift` stretched units nearer to the viewer than it is, to lie on top of what it belongs to. */
void pia_piece_add(pia_pieces *pieces, const double *const *at, int corners, double size, double lift, pia_colour colour);
/* Sorts and draws. */
void pia_pieces_draw(pia_canvas *canvas, pia_pieces *pieces);
void pia_pieces_clear(pia_pieces *pieces);

#endif
