/* The share of one cell (pair of spans) in the normal form of a surface. Products of basis values separate: over the points of a cell,
 * sum w (N_i N_k)(u) (N_j N_l)(v) needs one number for each pair of pairs, 100 instead of 136 for the bicubic. */
#ifndef PIA_OP_CELL_SUMS_H
#define PIA_OP_CELL_SUMS_H

#include "stencil.h"

enum { PIA_CELL_BLOCK = 4 };

/* A few points at a time: enough that sums are read and written seldom. */
typedef struct pia_cell_block {
    int count;
    double u[PIA_CELL_BLOCK][PIA_MAX_DEGREE + 1], v[PIA_CELL_BLOCK][PIA_MAX_DEGREE + 1]; /* basis values */
    double weight[PIA_CELL_BLOCK];
    double value[PIA_CELL_BLOCK][PIA_MAX_DIM]; /* data relative to the origin */
} pia_cell_block;

/* Doubles of a share: pairs (i <= k) of u by pairs (j <= l) of v, then sums of w N_i N_j value [(p + 1) x (q + 1) x dim]. */
pia_index pia_cell_room(int p, int q, int dim);
/* Adds the block to a share. Points are added in their order. */
void pia_cell_add(const pia_cell_block *block, int p, int q, int dim, double *share);
/* Adds the share of the cell whose lowest control point is (i, j) to the matrix and to right [lines x columns x dim]. */
void pia_cell_spread(const double *share, pia_index i, pia_index j, int dim, const pia_stencil *stencil, double *right);

#endif
