/* The bounding box of points, at the speed of memory. */
#ifndef PIA_KERNEL_BOX_H
#define PIA_KERNEL_BOX_H

#include "context.h"
#include "vector.h"

/* Points come a block of rows after the other; the box does not depend on how they are cut. */
typedef struct pia_box {
    int dim;
    int numbers; /* 1: no NaN was among them */
    double low[PIA_LANES * PIA_MAX_DIM], high[PIA_LANES * PIA_MAX_DIM];
} pia_box;

void pia_box_open(int dim, pia_box *out);
void pia_box_add(pia_box *box, const double *points, pia_index rows);
/* Numbers seen elsewhere: the lowest and the highest [lanes x dim], lanes a multiple of PIA_LANES, in each place that of component
 * place modulo dim. */
void pia_box_join(pia_box *box, int lanes, const double *low, const double *high);
/* low, high [dim] of all points, infinite without any. Returns 0 when a component was not finite: they are then worthless. */
int pia_box_close(const pia_box *box, double *low, double *high);

#endif
