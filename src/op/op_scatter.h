/* Scattered points of a surface: row j is the product of the basis values at (u_j, v_j), parameters in any order. Rows are kept sorted
 * by cell (pair of spans), so that a cell's control points stay in registers and no two threads ever add to the same number. */
#ifndef PIA_OP_OP_SCATTER_H
#define PIA_OP_OP_SCATTER_H

#include "op.h"

typedef struct pia_scatter {
    pia_collocation axis[2]; /* knots and maps, without rows */
    pia_index cells[2];      /* spans a direction */
    pia_index *begin;        /* [cells[0] x cells[1] + 1] first sorted row of a cell */
    pia_index *order;        /* [rows] row of the data behind a sorted row; within a cell ascending */
    double *sorted;          /* [rows x 2] parameters in sorted order */
    double *polynomial[2];   /* basis functions of each span as polynomials; NULL for high degrees */
} pia_scatter;

/* degree, map (identity or cyclic), knots [full[d] + degree[d] + 1] for u and v; parameters [rows x 2] inside the domain. Knots,
 * parameters and weights (NULL: 1) are borrowed and outlive the operator. dim is the most components any call will bring.
 * Cost O(rows). Errors: PIA_E_SHAPE, PIA_E_MEMORY, PIA_E_SIZE. */
pia_status pia_op_scatter_open(pia_context *context, const int *degree, const pia_map *map, const double *const *knots,
                               const pia_index *full, const double *parameters, pia_index rows, const double *weights, int dim,
                               pia_op **out);

/* Basis values u [degree of u + 1] and v at a sorted row of the cell (strip, column). */
void pia_scatter_values(const pia_scatter *scatter, pia_index strip, pia_index column, pia_index at, double *u, double *v);
/* Asks for the data of a sorted row a few rows ahead of `at`: rows of a cell lie anywhere in [rows x dim] numbers. */
static inline void pia_scatter_fetch(const pia_scatter *scatter, pia_index at, pia_index rows, const double *numbers, int dim)
{
    enum { AHEAD = 12 };
    if (at + AHEAD < rows) __builtin_prefetch(numbers + scatter->order[at + AHEAD] * dim);
}

/* The sorted rows of such an operator; NULL for curves and grids. */
const pia_scatter *pia_op_scatter(const pia_op *op);

#endif
