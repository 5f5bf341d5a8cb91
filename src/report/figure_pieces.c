#include "figure_pieces.h"

#include <stdlib.h>

void pia_piece_add(pia_pieces *pieces, const double *const *at, int corners, double size, double lift, pia_colour colour)
{
    void *block = pieces->piece;
    if (!pia_memory_grow(pieces->memory, &block, &pieces->capacity, pieces->count + 1, sizeof *pieces->piece)) {
        pieces->failed = 1;
        return;
    }
    pieces->piece = block;
    pia_piece *piece = &pieces->piece[pieces->count];
    *piece = (pia_piece){.depth = lift, .order = pieces->count, .corners = corners, .size = size, .colour = colour};
    for (int k = 0; k < corners; k++) {
        piece->spot[k] = pia_view_spot(pieces->view, at[k]);
        piece->depth += pia_view_depth(pieces->view, at[k]) / corners;
    }
    pieces->count++;
}

static int compare_depths(const void *a, const void *b)
{
    const pia_piece *p = a, *q = b;
    if (p->depth != q->depth) return p->depth < q->depth ? -1 : 1;
    return p->order < q->order ? -1 : p->order > q->order;
}

/* A quadrilateral also gets a hair-line rim of its own colour: without it the paper would shine through between neighbours. */
static void draw_piece(pia_canvas *canvas, const pia_piece *piece)
{
    pia_pen pen = {piece->colour, piece->size, 0};
    if (piece->corners == 1) canvas->disc(canvas, piece->spot[0], piece->size, piece->colour, (pia_pen){.width = 0});
    if (piece->corners == 2) canvas->line(canvas, piece->spot, 2, pen);
    if (piece->corners == 4) canvas->polygon(canvas, piece->spot, 4, piece->colour, pen);
}

void pia_pieces_draw(pia_canvas *canvas, pia_pieces *pieces)
{
    if (pieces->count > 0) qsort(pieces->piece, (size_t)pieces->count, sizeof *pieces->piece, compare_depths);
    for (pia_index i = 0; i < pieces->count; i++) draw_piece(canvas, &pieces->piece[i]);
}

void pia_pieces_clear(pia_pieces *pieces)
{
    pia_memory_give(pieces->memory, pieces->piece);
    pieces->piece = NULL;
    pieces->count = pieces->capacity = 0;
}
