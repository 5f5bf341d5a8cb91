#include "overlap.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A row and its cell of the lattice at hand. */
typedef struct entry {
    int64_t cell[2];
    pia_index row;
} entry;

static int by_cell(const void *a, const void *b)
{
    const entry *p = a, *q = b;
    for (int d = 0; d < 2; d++)
        if (p->cell[d] != q->cell[d]) return p->cell[d] < q->cell[d] ? -1 : 1;
    return (p->row > q->row) - (p->row < q->row);
}

/* Twice through the rows of a cell to the farthest of the last one found: not always the farthest pair, but at least 1/sqrt(3) of it.
 */
static void look_at_cell(const entry *e, pia_index count, const double *points, int dim, pia_overlap *out)
{
    pia_index from = e[0].row, far = from;
    for (int turn = 0; turn < 2; turn++) {
        double longest = 0;
        for (pia_index i = 0; i < count; i++) {
            double distance = 0;
            for (int d = 0; d < dim; d++) distance = hypot(distance, points[e[i].row * dim + d] - points[from * dim + d]);
            if (!(distance > longest)) continue;
            longest = distance;
            far = e[i].row;
        }
        if (longest > out->distance) *out = (pia_overlap){{from < far ? from : far, from < far ? far : from}, longest};
        from = far;
    }
}

pia_status pia_overlap_find(pia_context *context, const double *uv, const double *points, pia_index count, int dim, pia_overlap *out)
{
    double low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY}, width[2];
    *out = (pia_overlap){.distance = 0};
    entry *e = pia_take(context, count, sizeof *e);
    if (e == NULL) return pia_take_status(context, count, sizeof *e);
    for (pia_index i = 0; i < 2 * count; i++) {
        low[i % 2] = fmin(low[i % 2], uv[i]);
        high[i % 2] = fmax(high[i % 2], uv[i]);
    }
    for (int d = 0; d < 2; d++) width[d] = high[d] > low[d] ? (high[d] - low[d]) / sqrt((double)count) / 20 : 1;
    for (int shift = 0; shift < 4; shift++) {
        for (pia_index i = 0; i < count; i++) {
            e[i].row = i;
            for (int d = 0; d < 2; d++) e[i].cell[d] = (int64_t)floor((uv[2 * i + d] - low[d]) / width[d] + (shift >> d & 1) * 0.5);
        }
        qsort(e, (size_t)count, sizeof *e, by_cell);
        for (pia_index begin = 0, end; begin < count; begin = end) {
            for (end = begin + 1; end < count && e[end].cell[0] == e[begin].cell[0] && e[end].cell[1] == e[begin].cell[1];) end++;
            if (end > begin + 1) look_at_cell(e + begin, end - begin, points, dim, out);
        }
    }
    pia_give(context, e);
    return PIA_OK;
}
