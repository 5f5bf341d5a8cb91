/* The operator: the linear map A from the unknowns x to values at the data rows. Only it knows whether a curve, a grid or scattered
 * points are fitted; methods see unknowns [cols x dim] and rows [rows x dim].
 *
 * One mechanism decides what may move. Unknowns map to the full control points of the model (wrapped copies of closed directions,
 * doubled ends of the 2004 format); frozen unknowns keep their value: whatever the operator returns in the space of unknowns
 * (gathered sums, gradients, corrections) is zero there. */
#ifndef PIA_OP_OP_H
#define PIA_OP_OP_H

#include "collocation.h"

typedef struct pia_op pia_op;

/* low .. high - 1 of each direction: control points, spans or data lines. Of a curve 0 .. 0 in the second. */
typedef struct pia_block {
    pia_index low[2], high[2];
} pia_block;

/* Deviation of the rows from their targets. */
typedef struct pia_errors {
    double max;         /* largest Euclidean deviation; 0 without rows */
    pia_index max_row;  /* its row, the smallest of equals; -1 without rows */
    double sum_squares; /* of all deviations, unweighted */
    double weighted;    /* sum of weight times square */
    pia_index count;    /* rows that hold data */
} pia_errors;

/* Targets of the rows: the points as given, minus an origin, so that no copy is needed to centre them. */
typedef struct pia_targets {
    const double *points; /* [rows x dim]; NaN rows of a grid are holes */
    const double *origin; /* [dim] */
    int dim;
} pia_targets;

typedef struct pia_op_class {
    const char *name;
    /* values [rows x dim] = A full. */
    void (*apply)(const pia_op *op, const double *full, int dim, double *values);
    /* full [fulls x dim] = A'W values, weights [rows] (NULL: 1). */
    void (*gather)(const pia_op *op, const double *values, const double *weights, int dim, double *full);
    /* out [rows x dim] = base + factor * (targets - A full), zero difference in holes; base NULL: 0; out NULL: only the errors are
     * wanted. The errors are those of the differences. */
    pia_errors (*residual)(const pia_op *op, const double *full, const pia_targets *targets, const double *base, double factor,
                           double *out);
    void (*close)(pia_op *op);
} pia_op_class;

struct pia_op {
    const pia_op_class *class;
    pia_context *context;
    int directions;           /* 1 or 2 */
    pia_collocation *line[2]; /* of a curve or grid, borrowed; NULL for scattered points */
    const pia_collocation
        *axis[2];        /* knots and maps of every direction; the lines of a curve or grid, without rows for scattered points */
    const double *pairs; /* scattered points: parameters [rows x 2] in the order of the data, borrowed; else NULL */
    pia_index rows, cols, fulls;
    pia_index count[2]; /* unknowns a direction, cols = count[0] * count[1] */
    pia_index full_count[2];
    int identity;          /* unknowns are the full control points: no copy is needed */
    const double *weights; /* [rows], borrowed; NULL: 1 */
    unsigned char *frozen; /* [cols] 1: stays; NULL: all free */
    double *full;          /* work: [fulls x dim] unless identity */
    double *along;         /* work: [rows of u x full_count[1] x dim] of a grid */
    int dim;               /* the dimension the work arrays have room for */
    void *state;           /* of the class */
};

/* The collocations and weights (NULL: 1) are borrowed and outlive the operator. dim is the most components any call will bring. */
pia_status pia_op_curve_open(pia_context *context, pia_collocation *line, const double *weights, int dim, pia_op **out);
pia_status pia_op_grid_open(pia_context *context, pia_collocation *u, pia_collocation *v, const double *weights, int dim, pia_op **out);
void pia_op_close(pia_op *op);

/* For the open functions of the classes: allocates the operator and its work arrays from the collocations (NULL for scattered). */
pia_status pia_op_new(pia_context *context, const pia_op_class *class, int directions, const pia_index *unknowns,
                      const pia_index *fulls, pia_index rows, const double *weights, int dim, pia_op **out);

/* Full control points of unknowns x: x itself when the map is the identity, else the operator's work array (valid until the next
 * call that uses it). */
const double *pia_op_full(const pia_op *op, const double *x, int dim);
/* The same into an array of the caller; and the transposed map, sums of the copies. */
void pia_op_expand(const pia_op *op, const double *x, int dim, double *full);
void pia_op_reduce(const pia_op *op, const double *full, int dim, double *x);

void pia_op_apply(const pia_op *op, const double *x, int dim, double *values);
/* x [cols x dim] = A'W values with weights [rows] (NULL: 1), zero where frozen. */
void pia_op_gather(const pia_op *op, const double *values, const double *weights, int dim, double *x);
/* residual [rows x dim] = targets - A x, or NULL when only the errors are wanted. */
pia_errors pia_op_residual(const pia_op *op, const double *x, const pia_targets *targets, double *residual);
/* One pass of a square operator, whose unknown c is moved by row c: next [cols x dim] = x + factor * (targets - A x), frozen unknowns
 * unchanged. The errors are those of x. */
pia_errors pia_op_move(const pia_op *op, const double *x, const pia_targets *targets, double factor, double *next);

/* Control points of a direction as people count them: with the doubled ends of the 2004 format, without the wrapped copies of closed
 * directions; 1 for a direction that a curve has not. */
pia_index pia_op_controls(const pia_op *op, int direction);

/* Sets frozen unknowns to zero in x [cols x dim]. */
void pia_op_mask(const pia_op *op, double *x, int dim);
/* The unknown behind a full control point (row-major index). */
pia_index pia_op_unknown(const pia_op *op, pia_index control);
pia_status pia_op_freeze(pia_op *op, pia_index unknown, int frozen);

/* Joins the errors of two sets of rows. */
pia_errors pia_errors_join(pia_errors earlier, pia_errors later);

#endif
