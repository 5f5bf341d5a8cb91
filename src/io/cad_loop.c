#include "cad_loop.h"

#include "cad.h"
#include "image.h"

/* Whether a curve stays at a point, beside the surface it lies on. */
static int is_point(const pia_model *curve, double size)
{
    return pia_cad_size(curve) <= 1e-12 * size;
}

pia_status pia_cad_loop(pia_context *context, const pia_model *model, pia_index loop, pia_cad_edge **edges, pia_index *count)
{
    pia_index sides, kept = 0;
    pia_model_trim_loop(model, loop, &sides);
    double size = pia_cad_size(model);
    pia_cad_edge *list = pia_take(context, sides, sizeof *list);
    if (list == NULL) return pia_take_status(context, sides, sizeof *list);
    pia_status status = PIA_OK;
    for (pia_index i = 0; i < sides && status == PIA_OK; i++) {
        pia_cad_edge e = {pia_trim_vertex(model->trim, loop, i), pia_trim_vertex(model->trim, loop, i + 1), NULL};
        status = pia_model_image(context, model, e.from, e.to, &e.curve);
        if (status != PIA_OK) break;
        if (is_point(e.curve, size))
            pia_model_destroy(e.curve);
        else
            list[kept++] = e;
    }
    if (status == PIA_OK && kept < 2)
        status = pia_fail(context, PIA_E_DATA, "trim loop %lld shrinks to a point on the surface; leave it out", (long long)loop);
    if (status != PIA_OK) {
        pia_cad_loop_destroy(context, list, kept);
        return status;
    }
    *edges = list;
    *count = kept;
    return PIA_OK;
}

void pia_cad_loop_destroy(pia_context *context, pia_cad_edge *edges, pia_index count)
{
    for (pia_index i = 0; i < count; i++) pia_model_destroy(edges[i].curve);
    pia_give(context, edges);
}
