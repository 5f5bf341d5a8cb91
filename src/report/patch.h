/* A surface cut into pieces: shaded quadrilaterals, knot lines, its control net. */
#ifndef PIA_REPORT_PATCH_H
#define PIA_REPORT_PATCH_H

#include "figure_pieces.h"
#include "scene.h"

/* How a surface is coloured. */
typedef enum pia_paint { PIA_PAINT_PLAIN, PIA_PAINT_HEIGHT, PIA_PAINT_DEVIATION } pia_paint;

/* Adds surface number `index` of the scene; net 1: with its control net. Errors: PIA_E_MEMORY; pieces->failed tells of pieces that are
 * missing. */
pia_status pia_patch_add(pia_pieces *pieces, const pia_scene *scene, pia_index index, pia_paint paint, int net);

/* Knot lines are drawn every so many, 1 to n, so that they stay apart. */
pia_index pia_patch_knot_stride(const pia_figure *surface, int direction);

#endif
