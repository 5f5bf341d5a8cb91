/* The right-hand side of a grid, A_u' (Q - q0) A_v, q0 the first point, in one pass over the data: a span of u at a time, its rows of
 * data first summed into degree + 1 lines, with the columns side by side in vectors; lines that are complete are then contracted along
 * v. */
#ifndef PIA_OP_GRID_SUMS_H
#define PIA_OP_GRID_SUMS_H

#include "op.h"
#include "survey.h"

typedef struct pia_grid_sums {
    const pia_op *op;
    int dim;
    pia_index chunks, width; /* tasks; doubles of a line of data */
    double *lines;           /* [chunks x (degree_u + 1) x width] */
    double *tail;            /* [chunks x degree_u x full_v dim] what a task has to say of control rows that are another's */
    double *origin;          /* [width] q0 over and over */
} pia_grid_sums;

/* Work space for targets of this dimension. Errors: PIA_E_MEMORY, PIA_E_SIZE. */
pia_status pia_grid_sums_open(const pia_op *op, int dim, pia_grid_sums *out);
void pia_grid_sums_close(pia_grid_sums *sums);
/* full [full_u x full_v x dim] of points [rows x dim]; NaN where there are holes. The same bits for any number of threads. survey:
 * receives what there is to know of the points; NULL: unwanted. */
void pia_grid_sums_run(const pia_grid_sums *sums, const double *points, double *full, pia_survey *survey);

#endif
