#include "number.h"
#include "text.h"

#include <math.h>
#include <string.h>

/* Wavefront OBJ: vertices are read as points; a curve is written as a polyline, a surface as a mesh of
 * quadrilaterals, those of a trimmed one that have all corners in the face. */

typedef struct vertices {
    double *values; /* [count x 3] */
    pia_index count, capacity;
} vertices;

/* "v x y z ..." at a line; what follows z (weight, colour) is left. */
static pia_status read_vertex(pia_context *context, const pia_input *input, const pia_text_line *line, vertices *list)
{
    void *block = list->values;
    int grown = pia_memory_grow(pia_memory_of(context), &block, &list->capacity, list->count + 1, 3 * sizeof(double));
    list->values = block;
    if (!grown) return pia_fail(context, PIA_E_MEMORY, "%s: out of memory after %lld vertices", input->path, (long long)list->count);
    const char *p = line->begin + 1;
    for (int c = 0; c < 3; c++) {
        while (p < line->end && pia_text_is_blank(*p)) p++;
        const char *after = pia_number_parse(p, line->end, &list->values[3 * list->count + c]);
        if (after == NULL || (after < line->end && !pia_text_is_blank(*after)))
            return pia_input_fail(context, input, line->begin, "a vertex needs three numbers; correct it");
        p = after;
    }
    list->count++;
    return PIA_OK;
}

static pia_status read_points(pia_context *context, const pia_input *input, const pia_points_options *options, pia_points *out)
{
    vertices list = {0};
    pia_status status = PIA_OK;
    pia_text_line line;
    for (const char *p = input->begin; p < input->end && status == PIA_OK; p = line.next) {
        line = pia_text_line_at(p, input->end);
        int vertex = line.end - line.begin > 1 && line.begin[0] == 'v' && pia_text_is_blank(line.begin[1]);
        if (vertex) status = read_vertex(context, input, &line, &list);
    }
    out->points = list.values;
    if (status != PIA_OK) return status;
    if (list.count == 0) return pia_input_fail(context, input, NULL, "holds no vertex (v x y z); give at least one point");
    out->kind = PIA_CURVE;
    out->count[0] = list.count;
    out->count[1] = 1;
    out->dim = 3;
    return pia_points_screen(context, input, options, out);
}

static void write_vertices(pia_output *output, const double *points, pia_index count, int dim)
{
    for (pia_index i = 0; i < count; i++) {
        pia_output_bytes(output, "v", 1);
        for (int c = 0; c < 3; c++) {
            pia_output_bytes(output, " ", 1);
            pia_output_number(output, c < dim ? points[i * dim + c] : 0);
        }
        pia_output_bytes(output, "\n", 1);
    }
}

/* Which vertices lie in the face; NULL for all. */
static pia_status find_inside(pia_context *context, const pia_model *model, const double *parameters, pia_index count, char **out)
{
    *out = NULL;
    if (pia_model_trim_loop_count(model) == 0) return PIA_OK;
    *out = pia_take(context, count, sizeof **out);
    if (*out == NULL) return pia_take_status(context, count, sizeof **out);
    for (pia_index i = 0; i < count; i++) (*out)[i] = (char)pia_model_trim_contains(model, parameters[2 * i], parameters[2 * i + 1]);
    return PIA_OK;
}

/* Lines or quadrilaterals between the [size[0] x size[1]] vertices that follow number `base`, counted from 1. */
static void write_elements(pia_output *output, pia_index base, const pia_index size[2], int directions, const char *inside)
{
    for (pia_index i = 0; i + 1 < size[0]; i++) {
        if (directions == 1) pia_output_text(output, "l %lld %lld\n", (long long)(base + i + 1), (long long)(base + i + 2));
        for (pia_index j = 0; j + 1 < size[1]; j++) {
            const char *in = inside != NULL ? inside + i * size[1] + j : NULL;
            if (in != NULL && !(in[0] && in[1] && in[size[1]] && in[size[1] + 1])) continue;
            long long corner = (long long)(base + i * size[1] + j + 1), next = corner + (long long)size[1];
            pia_output_text(output, "f %lld %lld %lld %lld\n", corner, next, next + 1, corner + 1);
        }
    }
}

static pia_status write_models(pia_context *context, pia_output *output, const pia_model *const *models, pia_index count,
                               const pia_write_options *options)
{
    pia_index base = 0;
    for (pia_index k = 0; k < count; k++) {
        const pia_model *model = models[k];
        double *parameters, *points;
        pia_index size[2];
        if (model->dim > 3)
            return pia_fail(context, PIA_E_SHAPE, "OBJ holds at most 3 components, the model has %d; write another format", model->dim);
        pia_status status = pia_model_sample(context, model, options->samples, &parameters, &points, size);
        if (status != PIA_OK) return status;
        char *inside;
        status = find_inside(context, model, parameters, size[0] * size[1], &inside);
        if (status == PIA_OK) {
            pia_output_text(output, "o model_%lld\n", (long long)k);
            write_vertices(output, points, size[0] * size[1], model->dim);
            write_elements(output, base, size, model->directions, inside);
        }
        pia_give(context, inside);
        base += size[0] * size[1];
        pia_give(context, parameters);
        pia_give(context, points);
        if (status != PIA_OK) return status;
    }
    return PIA_OK;
}

const pia_format pia_format_obj = {
    .name = "obj",
    .title = "Wavefront OBJ",
    .detail = "vertices are read as points; a curve is written as a polyline, a surface as a mesh",
    .extensions = "obj",
    .read_points = read_points,
    .write_models = write_models,
};
