#include "cell_sums.h"

#include <string.h>

#define INLINE static inline __attribute__((always_inline))

enum { ROOM = (PIA_MAX_DEGREE + 1) * PIA_MAX_DIM }; /* one line of products of a point: pairs, or values times data */
_Static_assert(ROOM >= (PIA_MAX_DEGREE + 1) * (PIA_MAX_DEGREE + 2) / 2, "a line of pairs must fit");

INLINE int pairs(int degree)
{
    return (degree + 1) * (degree + 2) / 2;
}

/* Number of the pair (i, k) or (k, i). */
INLINE int pair(int i, int k, int degree)
{
    int low = i < k ? i : k, high = i < k ? k : i;
    return low * (degree + 1) - low * (low - 1) / 2 + high - low;
}

pia_index pia_cell_room(int p, int q, int dim)
{
    return (pia_index)pairs(p) * pairs(q) + (pia_index)(p + 1) * (q + 1) * dim;
}

INLINE void products(const double *value, int degree, double weight, double *out)
{
    for (int i = 0; i <= degree; i++)
        for (int k = i; k <= degree; k++) *out++ = weight * value[i] * value[k];
}

/* sums [rows x columns] += sum over the points of left [rows] right' [columns], one point after the other; unused places of the block
 * hold zeros. */
INLINE void add_outer(const double *left, const double *right, int rows, int columns, double *restrict sums)
{
    for (int a = 0; a < rows; a++)
        for (int b = 0; b < columns; b++) {
            double sum = sums[a * columns + b];
            for (int k = 0; k < PIA_CELL_BLOCK; k++) sum += left[k * ROOM + a] * right[k * ROOM + b];
            sums[a * columns + b] = sum;
        }
}

INLINE void add(const pia_cell_block *block, int p, int q, int dim, double *share)
{
    double left[PIA_CELL_BLOCK * ROOM], right[PIA_CELL_BLOCK * ROOM];
    int across = pairs(p), along = pairs(q), width = (q + 1) * dim;
    for (int k = 0; k < PIA_CELL_BLOCK; k++) {
        products(block->u[k], p, block->weight[k], left + k * ROOM);
        products(block->v[k], q, 1, right + k * ROOM);
    }
    add_outer(left, right, across, along, share);
    for (int k = 0; k < PIA_CELL_BLOCK; k++) {
        for (int i = 0; i <= p; i++) left[k * ROOM + i] = block->weight[k] * block->u[k][i];
        for (int j = 0; j <= q; j++)
            for (int d = 0; d < dim; d++) right[k * ROOM + j * dim + d] = block->v[k][j] * block->value[k][d];
    }
    add_outer(left, right, p + 1, width, share + across * along);
}

static void clear_unused(pia_cell_block *block, int p, int q, int dim)
{
    for (int k = block->count; k < PIA_CELL_BLOCK; k++) {
        block->weight[k] = 0;
        memset(block->u[k], 0, (size_t)(p + 1) * sizeof(double));
        memset(block->v[k], 0, (size_t)(q + 1) * sizeof(double));
        memset(block->value[k], 0, (size_t)dim * sizeof(double));
    }
}

void pia_cell_add(const pia_cell_block *block, int p, int q, int dim, double *share)
{
    pia_cell_block padded;
    if (block->count < PIA_CELL_BLOCK) {
        padded = *block;
        clear_unused(&padded, p, q, dim);
        block = &padded;
    }
    if (p == 3 && q == 3 && dim == 3)
        add(block, 3, 3, 3, share);
    else if (p == 3 && q == 3 && dim == 1)
        add(block, 3, 3, 1, share);
    else
        add(block, p, q, dim, share);
}

INLINE void spread(const double *share, pia_index i, pia_index j, int p, int q, const pia_stencil *s)
{
    for (int k = 0; k <= p; k++)
        for (int a = 0; k + a <= p; a++) {
            const double *from = share + pair(k, k + a, p) * pairs(q);
            double *to = pia_stencil_line(s, i + k, a, 0) + j;
            for (int l = 0; l <= q; l++)
                for (int b = a == 0 ? 0 : -l; l + b <= q; b++) to[b * s->stride + l] += from[pair(l, l + b, q)];
        }
}

void pia_cell_spread(const double *share, pia_index i, pia_index j, int dim, const pia_stencil *s, double *right)
{
    int p = s->p, q = s->q;
    if (p == 3 && q == 3)
        spread(share, i, j, 3, 3, s);
    else
        spread(share, i, j, p, q, s);
    share += pairs(p) * pairs(q);
    for (int k = 0; k <= p; k++)
        for (int l = 0; l < (q + 1) * dim; l++) right[((i + k) * s->columns + j) * dim + l] += *share++;
}
