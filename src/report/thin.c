#include "thin.h"

#include <math.h>
#include <stdlib.h>

/* Moves first, lowest, highest and last of [begin, end) to `kept`; returns the new end of what stays. */
static pia_index keep_outline(pia_spot *spots, pia_index begin, pia_index end, pia_index kept)
{
    pia_index low = begin, high = begin;
    for (pia_index i = begin + 1; i < end; i++) {
        if (spots[i].y < spots[low].y) low = i;
        if (spots[i].y > spots[high].y) high = i;
    }
    pia_index outline[4] = {begin, low < high ? low : high, low < high ? high : low, end - 1};
    for (int k = 0; k < 4; k++)
        if (k == 0 || outline[k] > outline[k - 1]) spots[kept++] = spots[outline[k]];
    return kept;
}

pia_index pia_thin_line(pia_spot *spots, pia_index count, double width)
{
    pia_index kept = 0;
    for (pia_index begin = 0, end; begin < count; begin = end) {
        double column = floor(spots[begin].x / width);
        for (end = begin + 1; end < count && floor(spots[end].x / width) == column;) end++;
        kept = keep_outline(spots, begin, end, kept);
    }
    return kept;
}

typedef struct dot {
    double value;
    pia_index index;
} dot;

static int compare_dots(const void *a, const void *b)
{
    const dot *p = a, *q = b;
    if (p->value != q->value) return p->value < q->value ? -1 : 1;
    return p->index < q->index ? -1 : p->index > q->index;
}

/* One entry a cell, empty cells with index -1; gathers the filled ones at the front. */
static pia_index gather(dot *cell, pia_index cells)
{
    pia_index kept = 0;
    for (pia_index c = 0; c < cells; c++)
        if (cell[c].index >= 0) cell[kept++] = cell[c];
    return kept;
}

pia_status pia_thin_dots(pia_context *context, const pia_spot *spots, const double *value, pia_index count, const pia_box *box,
                         double size, pia_index *order, pia_index *kept)
{
    pia_index columns = 1 + (pia_index)((box->right - box->left) / size), rows = 1 + (pia_index)((box->bottom - box->top) / size);
    dot *cell = pia_take(context, columns * rows, sizeof *cell);
    if (cell == NULL) return pia_take_status(context, columns * rows, sizeof *cell);
    for (pia_index c = 0; c < columns * rows; c++) cell[c].index = -1;
    for (pia_index i = 0; i < count; i++) {
        double column = floor((spots[i].x - box->left) / size), row = floor((spots[i].y - box->top) / size);
        if (!(column >= 0 && column < (double)columns && row >= 0 && row < (double)rows)) continue;
        dot *c = &cell[(pia_index)row * columns + (pia_index)column];
        double v = value != NULL ? value[i] : 0;
        if (c->index < 0 || v > c->value) *c = (dot){v, i};
    }
    *kept = gather(cell, columns * rows);
    qsort(cell, (size_t)*kept, sizeof *cell, compare_dots);
    for (pia_index k = 0; k < *kept; k++) order[k] = cell[k].index;
    pia_give(context, cell);
    return PIA_OK;
}
