#include "occt.h"

#include <stdio.h>
#include <string.h>

#include "occt_records.h"

const pia_plugin pia_plugin_occt = {.program = "pia-occt", .part = "OCCT", .packages = "libocct-data-exchange-dev and g++"};

/* The records while they are read: 64-bit values from `at` on. */
typedef struct reader {
    pia_context *context;
    const pia_input *input;
    const char *at, *end;
} reader;

static pia_status fail_cut(reader *r)
{
    return pia_plugin_broke_off(r->context, r->input, &pia_plugin_occt);
}

static pia_status read_integers(reader *r, pia_index *out, pia_index count)
{
    if (count > (r->end - r->at) / (pia_index)sizeof *out) return fail_cut(r);
    memcpy(out, r->at, (size_t)count * sizeof *out);
    r->at += count * (pia_index)sizeof *out;
    return PIA_OK;
}

/* `count` doubles, taken with pia_take. */
static pia_status read_doubles(reader *r, pia_index count, double **out)
{
    if (count < 0 || count > (r->end - r->at) / (pia_index)sizeof **out) return fail_cut(r);
    *out = pia_take(r->context, count, sizeof **out);
    if (*out == NULL) return pia_take_status(r->context, count, sizeof **out);
    memcpy(*out, r->at, (size_t)count * sizeof **out);
    r->at += count * (pia_index)sizeof **out;
    return PIA_OK;
}

/* Counts that a record may claim; what they promise is held against the bytes that are there. */
static pia_status check_head(reader *r, const pia_index head[PIA_OCCT_HEAD])
{
    int good = head[PIA_OCCT_DIRECTIONS] == 1 || head[PIA_OCCT_DIRECTIONS] == 2;
    pia_index values;
    for (pia_index d = 0; good && d < head[PIA_OCCT_DIRECTIONS]; d++)
        good = head[PIA_OCCT_DEGREE_U + d] >= 1 && head[PIA_OCCT_DEGREE_U + d] <= PIA_MAX_DEGREE && head[PIA_OCCT_CONTROL_U + d] >= 2 &&
               head[PIA_OCCT_CONTROL_U + d] <= r->end - r->at;
    if (head[PIA_OCCT_DIRECTIONS] == 1) good = good && head[PIA_OCCT_CONTROL_V] == 1 && head[PIA_OCCT_LOOPS] == 0;
    good = good && head[PIA_OCCT_LOOPS] >= 0 && head[PIA_OCCT_LOOPS] <= r->end - r->at &&
           pia_multiply(head[PIA_OCCT_CONTROL_U], head[PIA_OCCT_CONTROL_V], &values) && values <= r->end - r->at;
    return good ? PIA_OK : fail_cut(r);
}

/* Counts of vertices and all vertices. */
static pia_status read_loops(reader *r, pia_index loops, pia_index *vertices, double **uv)
{
    const char *first = r->at;
    pia_index total = 0;
    pia_status status = PIA_OK;
    for (int pass = 0; pass < 2; pass++) {
        if (pass == 1 && (*uv = pia_take(r->context, total, 2 * sizeof **uv)) == NULL)
            return pia_take_status(r->context, total, 2 * sizeof **uv);
        pia_index done = 0;
        r->at = first;
        for (pia_index l = 0; l < loops && status == PIA_OK; l++) {
            status = read_integers(r, &vertices[l], 1);
            if (status != PIA_OK || vertices[l] < 0 || vertices[l] > (r->end - r->at) / 16) return fail_cut(r);
            if (pass == 1) memcpy(*uv + 2 * done, r->at, (size_t)vertices[l] * 16);
            r->at += vertices[l] * 16;
            done += vertices[l];
        }
        total = done;
    }
    return status;
}

/* Loops that are not simple (a slit, two that touch) are left out: the surface is still what the file holds. */
static pia_status trim(reader *r, pia_index loops, pia_model **model)
{
    if (loops == 0) return PIA_OK;
    double *uv = NULL;
    pia_model *trimmed = NULL;
    pia_index *vertices = pia_take(r->context, loops, sizeof *vertices);
    if (vertices == NULL) return pia_take_status(r->context, loops, sizeof *vertices);
    pia_status status = read_loops(r, loops, vertices, &uv);
    if (status == PIA_OK) {
        status = pia_model_trim(r->context, *model, loops, vertices, uv, &trimmed);
        if (status == PIA_OK) {
            pia_model_destroy(*model);
            *model = trimmed;
        } else if (status != PIA_E_MEMORY) {
            pia_log(r->context, 2, "%s: a face is read as its whole surface: %s", r->input->path,
                    r->context != NULL ? r->context->message : "");
            status = PIA_OK;
        }
    }
    pia_give(r->context, vertices);
    pia_give(r->context, uv);
    return status;
}

static pia_status read_spline(reader *r, pia_model **out)
{
    pia_index head[PIA_OCCT_HEAD] = {0}, control[2];
    double *knots[2] = {NULL, NULL}, *points = NULL, *weights = NULL;
    pia_model *model = NULL;
    pia_status status = read_integers(r, head, PIA_OCCT_HEAD);
    if (status == PIA_OK) status = check_head(r, head);
    int directions = (int)head[PIA_OCCT_DIRECTIONS], degree[2];
    for (int d = 0; d < 2; d++) {
        degree[d] = (int)head[PIA_OCCT_DEGREE_U + d];
        control[d] = head[PIA_OCCT_CONTROL_U + d];
    }
    for (int d = 0; d < directions && status == PIA_OK; d++) status = read_doubles(r, control[d] + degree[d] + 1, &knots[d]);
    if (status == PIA_OK) status = read_doubles(r, 3 * control[0] * control[1], &points);
    if (status == PIA_OK && head[PIA_OCCT_RATIONAL]) status = read_doubles(r, control[0] * control[1], &weights);
    if (status == PIA_OK)
        status = pia_model_create(r->context, directions, degree, (const double *const *)knots, control, 3, points, weights, &model);
    if (status == PIA_OK) status = trim(r, head[PIA_OCCT_LOOPS], &model);
    if (status == PIA_OK)
        *out = model;
    else
        pia_model_destroy(model);
    for (int d = 0; d < 2; d++) pia_give(r->context, knots[d]);
    pia_give(r->context, points);
    pia_give(r->context, weights);
    return status;
}

static pia_status read_error(reader *r)
{
    pia_index length = 0;
    pia_status status = read_integers(r, &length, 1);
    if (status != PIA_OK || length < 0 || length > r->end - r->at) return fail_cut(r);
    char text[301];
    snprintf(text, sizeof text, "%.*s", length > 300 ? 300 : (int)length, r->at);
    for (char *c = text; *c != '\0'; c++)
        if ((unsigned char)*c < ' ') *c = ' ';
    return pia_input_fail(r->context, r->input, NULL, "%s", text);
}

pia_status pia_occt_parse(pia_context *context, const pia_input *input, const char *bytes, pia_index size, pia_model ***out,
                          pia_index *count)
{
    reader r = {context, input, bytes, bytes + size};
    pia_model **list = NULL;
    pia_index found = 0, capacity = 0, kind = 0;
    pia_status status = PIA_OK;
    while (status == PIA_OK && kind != PIA_OCCT_END) {
        status = read_integers(&r, &kind, 1);
        if (status != PIA_OK || kind == PIA_OCCT_END) break;
        void *block = list;
        int grown = pia_memory_grow(pia_memory_of(context), &block, &capacity, found + 1, sizeof *list);
        list = block;
        if (!grown)
            status = pia_fail(context, PIA_E_MEMORY, "%s: out of memory for its models; free memory", input->path);
        else if (kind == PIA_OCCT_SPLINE)
            status = pia_input_judge(context, input, NULL, "holds a spline that is none: ", read_spline(&r, &list[found]));
        else
            status = kind == PIA_OCCT_ERROR ? read_error(&r) : fail_cut(&r);
        if (status == PIA_OK) found++;
    }
    if (status == PIA_OK && found == 0) status = pia_input_fail(context, input, NULL, "holds no curve and no surface");
    if (status == PIA_OK) {
        *out = list;
        *count = found;
        return PIA_OK;
    }
    for (pia_index i = 0; i < found; i++) pia_model_destroy(list[i]);
    pia_give(context, list);
    return status;
}

pia_status pia_occt_read(pia_context *context, const pia_input *input, const char *format, pia_model ***out, pia_index *count)
{
    char *bytes;
    pia_index size;
    pia_status status = pia_plugin_run(context, input, &pia_plugin_occt, format, &bytes, &size);
    if (status != PIA_OK) return status;
    status = pia_occt_parse(context, input, bytes, size, out, count);
    pia_give(context, bytes);
    return status;
}
