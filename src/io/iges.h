/* What the IGES writer is made of: the entities of a file, and the 80-column lines they become. */
#ifndef PIA_IO_IGES_H
#define PIA_IO_IGES_H

#include "cad_loop.h"

/* Entity types. */
enum { PIA_IGES_COMPOSITE = 102, PIA_IGES_CURVE = 126, PIA_IGES_SURFACE = 128, PIA_IGES_ON_SURFACE = 142, PIA_IGES_TRIMMED = 144 };

/* One entity; its directory number is 2 * index + 1. */
typedef struct pia_iges_entity {
    int type;
    int dependent, in_plane;     /* belongs to another entity; lives in a parameter plane */
    const pia_model *model;      /* of curves and surfaces */
    const pia_cad_edge *segment; /* of a curve without a model: the straight side in the parameter plane */
    pia_index first, count;      /* of the other types: whole numbers, a stretch of the plan's */
} pia_iges_entity;

/* All entities of a file, and what they need meanwhile. */
typedef struct pia_iges_plan {
    pia_context *context;
    pia_iges_entity *entity;
    long long *number;
    struct pia_iges_loop {
        pia_cad_edge *edges;
        pia_index count;
    } * loop; /* owned */
    pia_index entity_count, entity_capacity, number_count, number_capacity, loop_count, loop_capacity;
} pia_iges_plan;

/* Adds a model: a curve, a surface, or a trimmed surface with all that belongs to it. PIA_E_MEMORY; as pia_cad_loop. */
pia_status pia_iges_plan_add(pia_iges_plan *plan, const pia_model *model);
/* Frees all but the plan itself. */
void pia_iges_plan_clear(pia_iges_plan *plan);

/* The whole file. */
void pia_iges_write(pia_output *output, const pia_iges_plan *plan, const pia_write_options *options);

#endif
