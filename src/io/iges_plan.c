#include "iges.h"

static pia_status short_of_memory(pia_iges_plan *plan)
{
    return pia_fail(plan->context, PIA_E_MEMORY, "out of memory for the entities of an IGES file; free memory");
}

static pia_status add_entity(pia_iges_plan *plan, pia_iges_entity entity)
{
    void *block = plan->entity;
    int grown =
        pia_memory_grow(pia_memory_of(plan->context), &block, &plan->entity_capacity, plan->entity_count + 1, sizeof *plan->entity);
    plan->entity = block;
    if (!grown) return short_of_memory(plan);
    plan->entity[plan->entity_count++] = entity;
    return PIA_OK;
}

/* A whole number of the entity to be added next. */
static pia_status add_number(pia_iges_plan *plan, long long value)
{
    void *block = plan->number;
    int grown =
        pia_memory_grow(pia_memory_of(plan->context), &block, &plan->number_capacity, plan->number_count + 1, sizeof *plan->number);
    plan->number = block;
    if (!grown) return short_of_memory(plan);
    plan->number[plan->number_count++] = value;
    return PIA_OK;
}

/* An entity made of the numbers from `first` on. */
static pia_status add_structure(pia_iges_plan *plan, int type, int dependent, int in_plane, pia_index first)
{
    return add_entity(
        plan, (pia_iges_entity){
                  .type = type, .dependent = dependent, .in_plane = in_plane, .first = first, .count = plan->number_count - first});
}

static long long directory(pia_index entity)
{
    return 2 * (long long)entity + 1;
}

static pia_status take_loop(pia_iges_plan *plan, const pia_model *model, pia_index l, struct pia_iges_loop *out)
{
    void *block = plan->loop;
    int grown = pia_memory_grow(pia_memory_of(plan->context), &block, &plan->loop_capacity, plan->loop_count + 1, sizeof *plan->loop);
    plan->loop = block;
    if (!grown) return short_of_memory(plan);
    pia_status status = pia_cad_loop(plan->context, model, l, &out->edges, &out->count);
    if (status == PIA_OK) plan->loop[plan->loop_count++] = *out;
    return status;
}

/* A composite of every second of the curves from `curve` on. */
static pia_status add_composite(pia_iges_plan *plan, pia_index curve, pia_index count, int in_plane)
{
    pia_index first = plan->number_count;
    pia_status status = add_number(plan, (long long)count);
    for (pia_index k = 0; k < count && status == PIA_OK; k++) status = add_number(plan, directory(curve + 2 * k));
    return status == PIA_OK ? add_structure(plan, PIA_IGES_COMPOSITE, 1, in_plane, first) : status;
}

/* Loop l of the surface: its sides in the parameter plane and in space in turn, a composite of each, and the curve on the surface,
 * whose entity is *out. */
static pia_status add_loop(pia_iges_plan *plan, const pia_model *model, pia_index l, pia_index surface, pia_index *out)
{
    struct pia_iges_loop loop;
    pia_status status = take_loop(plan, model, l, &loop);
    pia_index curve = plan->entity_count;
    for (pia_index k = 0; k < loop.count && status == PIA_OK; k++) {
        status = add_entity(plan, (pia_iges_entity){.type = PIA_IGES_CURVE, .dependent = 1, .in_plane = 1, .segment = &loop.edges[k]});
        if (status == PIA_OK)
            status = add_entity(plan, (pia_iges_entity){.type = PIA_IGES_CURVE, .dependent = 1, .model = loop.edges[k].curve});
    }
    pia_index plane = plan->entity_count;
    if (status == PIA_OK) status = add_composite(plan, curve, loop.count, 1);
    if (status == PIA_OK) status = add_composite(plan, curve + 1, loop.count, 0);
    /* made in an unspecified way; surface, curve in the plane, curve in space; neither preferred */
    const long long field[] = {0, directory(surface), directory(plane), directory(plane + 1), 3};
    pia_index first = plan->number_count;
    for (size_t i = 0; i < sizeof field / sizeof *field && status == PIA_OK; i++) status = add_number(plan, field[i]);
    *out = plan->entity_count;
    return status == PIA_OK ? add_structure(plan, PIA_IGES_ON_SURFACE, 1, 0, first) : status;
}

static pia_status add_trimmed(pia_iges_plan *plan, const pia_model *model)
{
    pia_index loops = pia_model_trim_loop_count(model), surface = plan->entity_count;
    pia_index *on_surface = pia_take(plan->context, loops, sizeof *on_surface);
    if (on_surface == NULL) return pia_take_status(plan->context, loops, sizeof *on_surface);
    pia_status status = add_entity(plan, (pia_iges_entity){.type = PIA_IGES_SURFACE, .dependent = 1, .model = model});
    for (pia_index l = 0; l < loops && status == PIA_OK; l++) status = add_loop(plan, model, l, surface, &on_surface[l]);
    /* surface; 1: the outer boundary is a loop; how many holes; the loops */
    const long long field[] = {directory(surface), 1, (long long)loops - 1};
    pia_index first = plan->number_count;
    for (size_t i = 0; i < sizeof field / sizeof *field && status == PIA_OK; i++) status = add_number(plan, field[i]);
    for (pia_index l = 0; l < loops && status == PIA_OK; l++) status = add_number(plan, directory(on_surface[l]));
    pia_give(plan->context, on_surface);
    return status == PIA_OK ? add_structure(plan, PIA_IGES_TRIMMED, 0, 0, first) : status;
}

pia_status pia_iges_plan_add(pia_iges_plan *plan, const pia_model *model)
{
    if (pia_model_trim_loop_count(model) > 0) return add_trimmed(plan, model);
    return add_entity(plan, (pia_iges_entity){.type = model->directions == 2 ? PIA_IGES_SURFACE : PIA_IGES_CURVE, .model = model});
}

void pia_iges_plan_clear(pia_iges_plan *plan)
{
    for (pia_index l = 0; l < plan->loop_count; l++) pia_cad_loop_destroy(plan->context, plan->loop[l].edges, plan->loop[l].count);
    pia_give(plan->context, plan->loop);
    pia_give(plan->context, plan->number);
    pia_give(plan->context, plan->entity);
}
