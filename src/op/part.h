/* A part of a problem: the rows that some of the control points touch, as a problem of its own. While only those control points move,
 * the residuals and errors of all other rows stay, and a pass looks at the part alone. */
#ifndef PIA_OP_PART_H
#define PIA_OP_PART_H

#include "op.h"

typedef struct pia_part {
    pia_context *context;
    const pia_op *whole; /* borrowed */
    pia_block control;   /* what the rows of the part see: those that move, and up to `degree` beside them */
    pia_index rows;      /* may be 0; then there is no operator */
    pia_index *row;      /* [rows] rows of the whole, rising */
    pia_collocation line[2];
    pia_op *op;
    pia_targets targets;
    double *points, *weights, *pairs; /* [rows x dim] targets; [rows] or NULL; [rows x 2] parameters of scattered points, or NULL */
    double *x, *residual;             /* [control x dim], [rows x dim] */
    pia_errors rest;                  /* of the other rows, when rest_known */
    int rest_known;
} pia_part;

/* The rows whose values depend on the control points in `moving`, of an operator whose unknowns are its control points. residual
 * [rows of the whole x dim], or NULL: that of all other rows as it is, so that the first pass need not look at them. Targets are
 * borrowed and copied where the part needs them: open it anew when they change. Errors: PIA_E_MEMORY. O(its rows), and of the whole
 * where residual is given. */
pia_status pia_part_open(const pia_op *whole, const pia_targets *targets, const pia_block *moving, const double *residual,
                         pia_part **out);
void pia_part_close(pia_part *part); /* NULL is allowed */

/* As pia_op_residual of the whole; of the other rows that is known from an earlier call, which has written their residuals. */
pia_errors pia_part_residual(pia_part *part, const double *x, const pia_targets *targets, double *residual);

#endif
