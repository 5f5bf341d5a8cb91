/* Trim loops in geomdl's layout: "trims": {"count", "data": [loop, ...]}, a loop being a planar curve ("spline"), points ("freeform")
 * or curves one after another ("container"). "reversed": 1 keeps what is inside the loop, 0 cuts it away; without any, the first loop
 * is the outer boundary. */
#include "json.h"

#include <stdio.h>
#include <string.h>

/* ---- writing ---- */

/* A polyline is a curve of degree 1; it comes back to its first vertex. */
static void write_loop(pia_output *output, const pia_trim *trim, pia_index loop)
{
    pia_index edges = trim->start[loop + 1] - trim->start[loop];
    pia_output_text(output,
                    "       {\"type\": \"spline\", \"rational\": false, \"dimension\": 2, \"degree\": 1, \"reversed\": %d,\n"
                    "        \"knotvector\": [0",
                    loop == 0);
    for (pia_index i = 0; i <= edges; i++) {
        pia_output_text(output, ", ");
        pia_output_number(output, (double)i / (double)edges);
    }
    pia_output_text(output, ", 1],\n        \"control_points\": {\"points\": [");
    for (pia_index i = 0; i <= edges; i++) {
        if (i > 0) pia_output_text(output, ", ");
        pia_json_write_reals(output, pia_trim_vertex(trim, loop, i), 2);
    }
    pia_output_text(output, "]}}");
}

void pia_json_write_trim(pia_output *output, const pia_trim *trim)
{
    pia_output_text(output, ",\n     \"trims\": {\"count\": %lld, \"data\": [\n", (long long)trim->loop_count);
    for (pia_index l = 0; l < trim->loop_count; l++) {
        write_loop(output, trim, l);
        pia_output_text(output, l + 1 < trim->loop_count ? ",\n" : "]}");
    }
}

/* ---- reading ---- */

/* Loops in the order of the file. */
typedef struct loops {
    pia_index count, *vertices; /* [count] */
    pia_index total, capacity;  /* of uv, in vertices */
    double *uv;
    pia_index outer; /* the loop whose inside is kept; PIA_AUTO: none says so */
    int senses;      /* whether any loop has the key "reversed" */
} loops;

static pia_status append(const pia_json_place *place, const double *points, pia_index count, loops *all)
{
    void *block = all->uv;
    int grown = pia_memory_grow(pia_memory_of(place->context), &block, &all->capacity, all->total + count, 2 * sizeof *all->uv);
    all->uv = block;
    if (!grown) return pia_fail(place->context, PIA_E_MEMORY, "%s: out of memory for trim loops", place->input->path);
    memcpy(all->uv + 2 * all->total, points, (size_t)count * 2 * sizeof *points);
    all->total += count;
    return PIA_OK;
}

/* The control points of a polyline, samples of anything smoother. */
static pia_status append_curve(const pia_json_place *place, const pia_model *curve, loops *all)
{
    double *parameters, *points;
    pia_index count[2];
    if (curve->dim != 2) return pia_json_fail(place, "trims", "must be curves of dimension 2");
    if (curve->degree[0] == 1 && !curve->rational) return append(place, curve->points, curve->control[0], all);
    pia_status status = pia_model_sample(place->context, curve, PIA_AUTO, &parameters, &points, count);
    if (status != PIA_OK) return status;
    status = append(place, points, count[0], all);
    pia_give(place->context, parameters);
    pia_give(place->context, points);
    return status;
}

static pia_status read_piece(const pia_json_place *place, const json_t *piece, loops *all)
{
    const char *type = json_string_value(json_object_get(piece, "type"));
    if (type != NULL && strcmp(type, "freeform") == 0) {
        double *points;
        pia_index count;
        int dim;
        pia_status status = pia_json_get_points(place, json_object_get(piece, "points"), &points, &count, &dim);
        if (status != PIA_OK) return status;
        status = dim == 2 ? append(place, points, count, all) : pia_json_fail(place, "trims", "must have points of dimension 2");
        pia_give(place->context, points);
        return status;
    }
    pia_model *curve = NULL;
    pia_status status = pia_json_read_shape(place, piece, 1, &curve);
    if (status == PIA_OK) status = append_curve(place, curve, all);
    pia_model_destroy(curve);
    return status;
}

static pia_status read_loop(const pia_json_place *place, const json_t *loop, pia_index index, loops *all)
{
    const json_t *pieces = json_object_get(loop, "data"), *sense = json_object_get(loop, "reversed");
    pia_index before = all->total;
    pia_status status = PIA_OK;
    if (!json_is_array(pieces)) status = read_piece(place, loop, all);
    for (size_t i = 0; i < json_array_size(pieces) && status == PIA_OK; i++) status = read_piece(place, json_array_get(pieces, i), all);
    if (status == PIA_OK && all->total == before) status = pia_json_fail(place, "trims", "must not have loops without vertices");
    all->vertices[index] = all->total - before;
    all->senses |= sense != NULL;
    if (json_is_true(sense) || json_number_value(sense) != 0) all->outer = index;
    return status;
}

/* The border of the domain, the outer boundary of surfaces that have holes only. */
static void get_border(const pia_model *model, double border[8])
{
    for (int k = 0; k < 4; k++) {
        int last[2] = {k == 1 || k == 2, k >= 2};
        for (int d = 0; d < 2; d++) border[2 * k + d] = model->knots[d][last[d] ? model->control[d] : model->degree[d]];
    }
}

/* The loops handed to the model, the outer boundary first. */
static pia_status trim_by(const pia_json_place *place, const loops *all, const pia_model *model, pia_model **out)
{
    pia_index outer = all->senses ? all->outer : 0, given = outer == PIA_AUTO, count = all->count + given;
    pia_index *vertices = pia_take(place->context, count, sizeof *vertices);
    double *uv = vertices != NULL ? pia_take(place->context, all->total + 4 * given, 2 * sizeof *uv) : NULL;
    if (uv == NULL) {
        pia_give(place->context, vertices);
        return pia_fail(place->context, PIA_E_MEMORY, "%s: out of memory for trim loops", place->input->path);
    }
    double *to = uv;
    pia_index next = 0;
    if (given) {
        get_border(model, uv);
        vertices[next++] = 4;
        to += 8;
    }
    for (int pass = 0; pass < 2; pass++) {
        const double *from = all->uv;
        for (pia_index l = 0; l < all->count; from += 2 * all->vertices[l++]) {
            if ((l == outer) != (pass == 0)) continue;
            memcpy(to, from, (size_t)all->vertices[l] * 2 * sizeof *to);
            to += 2 * all->vertices[l];
            vertices[next++] = all->vertices[l];
        }
    }
    pia_status status = pia_model_trim(place->context, model, count, vertices, uv, out);
    pia_give(place->context, vertices);
    pia_give(place->context, uv);
    return status;
}

pia_status pia_json_read_trim(const pia_json_place *place, const json_t *trims, pia_model **model)
{
    const json_t *data = json_object_get(trims, "data");
    if (!json_is_array(data)) return pia_json_fail(place, "trims", "must have an array \"data\" of loops");
    loops all = {.count = (pia_index)json_array_size(data), .outer = PIA_AUTO};
    if (all.count == 0) return PIA_OK;
    all.vertices = pia_take(place->context, all.count, sizeof *all.vertices);
    pia_status status = all.vertices != NULL ? PIA_OK : pia_take_status(place->context, all.count, sizeof *all.vertices);
    for (pia_index l = 0; l < all.count && status == PIA_OK; l++) status = read_loop(place, json_array_get(data, (size_t)l), l, &all);
    pia_model *trimmed = NULL;
    if (status == PIA_OK) status = trim_by(place, &all, *model, &trimmed);
    pia_give(place->context, all.vertices);
    pia_give(place->context, all.uv);
    if (status != PIA_OK) return status;
    pia_model_destroy(*model);
    *model = trimmed;
    return PIA_OK;
}
