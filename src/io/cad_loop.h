/* A trim loop as edges in space, for the CAD writers. */
#ifndef PIA_IO_CAD_LOOP_H
#define PIA_IO_CAD_LOOP_H

#include "io.h"

typedef struct pia_cad_edge {
    const double *from, *to; /* (u, v), borrowed from the model */
    pia_model *curve;        /* its exact image over [0, 1] */
} pia_cad_edge;

/* One edge a side of the loop, in its order, sides whose image is a point (along the pole of a sphere) left out; each begins where the
 * one before it ends. The caller gives them back. PIA_E_DATA when fewer than two are left; as pia_model_image. */
pia_status pia_cad_loop(pia_context *context, const pia_model *model, pia_index loop, pia_cad_edge **edges, pia_index *count);
void pia_cad_loop_destroy(pia_context *context, pia_cad_edge *edges, pia_index count);

#endif
