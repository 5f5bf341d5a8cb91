#include "trim.h"

#include <math.h>
#include <string.h>

#include "finite.h"
#include "insert.h"
#include "model.h"

/* A vertex this close to the domain's border, of the domain's width, is meant to be on it. */
static const double near_border = 1e-9;

pia_status pia_trim_new(pia_context *context, pia_index loop_count, pia_index vertex_count, pia_trim **out)
{
    pia_index numbers;
    if (!pia_multiply(vertex_count, 2, &numbers) || loop_count == INT64_MAX)
        return pia_fail(context, PIA_E_SIZE, "%lld trim vertices do not fit in 64 bits", (long long)vertex_count);
    pia_trim *trim = pia_take_zero(context, 1, sizeof *trim);
    if (trim == NULL) return pia_take_status(context, 1, sizeof *trim);
    trim->loop_count = loop_count;
    pia_status status = PIA_OK;
    if ((trim->start = pia_take_zero(context, loop_count + 1, sizeof *trim->start)) == NULL)
        status = pia_take_status(context, loop_count + 1, sizeof *trim->start);
    else if ((trim->uv = pia_take(context, numbers, sizeof *trim->uv)) == NULL)
        status = pia_take_status(context, numbers, sizeof *trim->uv);
    if (status == PIA_OK)
        *out = trim;
    else
        pia_trim_destroy(pia_memory_of(context), trim);
    return status;
}

pia_status pia_trim_copy(pia_context *context, const pia_trim *trim, pia_trim **out)
{
    *out = NULL;
    if (trim == NULL) return PIA_OK;
    pia_index vertices = trim->start[trim->loop_count];
    pia_status status = pia_trim_new(context, trim->loop_count, vertices, out);
    if (status != PIA_OK) return status;
    memcpy((*out)->start, trim->start, (size_t)(trim->loop_count + 1) * sizeof *trim->start);
    memcpy((*out)->uv, trim->uv, (size_t)vertices * 2 * sizeof *trim->uv);
    return PIA_OK;
}

void pia_trim_destroy(const pia_memory *memory, pia_trim *trim)
{
    if (trim == NULL) return;
    pia_memory_give(memory, trim->start);
    pia_memory_give(memory, trim->uv);
    pia_memory_give(memory, trim);
}

const double *pia_trim_vertex(const pia_trim *trim, pia_index loop, pia_index vertex)
{
    pia_index first = trim->start[loop], count = trim->start[loop + 1] - first;
    return trim->uv + 2 * (first + vertex % count);
}

/* The loops together cross a ray from a point of the face an odd number of times. */
int pia_trim_contains(const pia_trim *trim, const double uv[2])
{
    int inside = 0;
    for (pia_index l = 0; l < trim->loop_count; l++) {
        const double *a = pia_trim_vertex(trim, l, trim->start[l + 1] - trim->start[l] - 1);
        for (const double *b = trim->uv + 2 * trim->start[l], *end = trim->uv + 2 * trim->start[l + 1]; b < end; a = b, b += 2)
            if ((a[1] > uv[1]) != (b[1] > uv[1]) && uv[0] < a[0] + (uv[1] - a[1]) / (b[1] - a[1]) * (b[0] - a[0])) inside = !inside;
    }
    return inside;
}

/* Twice the signed area of a loop: above 0 when it is counter-clockwise. */
static double signed_area(const pia_trim *trim, pia_index loop)
{
    const double *origin = pia_trim_vertex(trim, loop, 0);
    double sum = 0;
    for (pia_index i = 1; i + 1 < trim->start[loop + 1] - trim->start[loop]; i++) {
        const double *a = pia_trim_vertex(trim, loop, i), *b = pia_trim_vertex(trim, loop, i + 1);
        sum += (a[0] - origin[0]) * (b[1] - origin[1]) - (a[1] - origin[1]) * (b[0] - origin[0]);
    }
    return sum;
}

static void turn_around(pia_trim *trim, pia_index loop)
{
    double *low = trim->uv + 2 * trim->start[loop], *high = trim->uv + 2 * (trim->start[loop + 1] - 1);
    for (; low < high; low += 2, high -= 2)
        for (int d = 0; d < 2; d++) {
            double kept = low[d];
            low[d] = high[d];
            high[d] = kept;
        }
}

/* One parameter of a vertex, moved onto the border when it is beyond it by rounding. */
static pia_status take_parameter(pia_context *context, const pia_model *model, int d, double given, pia_index loop, pia_index vertex,
                                 double *out)
{
    double first = model->knots[d][model->degree[d]], last = model->knots[d][model->control[d]], near = near_border * (last - first);
    *out = fabs(given - first) <= near ? first : fabs(given - last) <= near ? last : given;
    if (*out >= first && *out <= last) return PIA_OK;
    return pia_fail(context, PIA_E_DATA, "trim loop %lld, vertex %lld: %c = %.17g is outside the domain [%.17g, %.17g]",
                    (long long)loop, (long long)vertex, d == 0 ? 'u' : 'v', given, first, last);
}

static int same(const double *a, const double *b)
{
    return a[0] == b[0] && a[1] == b[1];
}

/* The vertices of one loop appended, those that repeat their neighbour left out. */
static pia_status take_loop(pia_context *context, const pia_model *model, pia_index loop, const double *uv, pia_index count,
                            pia_trim *trim)
{
    pia_index first = trim->start[loop], next = first;
    for (pia_index i = 0; i < count; i++) {
        double *to = trim->uv + 2 * next;
        for (int d = 0; d < 2; d++) {
            pia_status status = take_parameter(context, model, d, uv[2 * i + d], loop, i, to + d);
            if (status != PIA_OK) return status;
        }
        if (next == first || !same(to, to - 2)) next++;
    }
    while (next > first + 1 && same(trim->uv + 2 * first, trim->uv + 2 * (next - 1))) next--;
    trim->start[loop + 1] = next;
    if (next - first < 3)
        return pia_fail(context, PIA_E_DATA, "trim loop %lld has %lld different vertices; it needs at least 3", (long long)loop,
                        (long long)(next - first));
    if ((signed_area(trim, loop) > 0) != (loop == 0)) turn_around(trim, loop);
    return PIA_OK;
}

static pia_status take_loops(pia_context *context, const pia_model *model, pia_index loop_count, const pia_index *vertex_counts,
                             const double *uv, pia_trim **out)
{
    pia_index total = 0;
    if (vertex_counts == NULL || uv == NULL) return pia_fail(context, PIA_E_ARGUMENT, "trim loops need vertex counts and vertices");
    for (pia_index l = 0; l < loop_count; l++) {
        if (vertex_counts[l] < 3 || vertex_counts[l] > INT64_MAX / 2 - total)
            return pia_fail(context, PIA_E_ARGUMENT, "trim loop %lld has %lld vertices; it needs at least 3", (long long)l,
                            (long long)vertex_counts[l]);
        total += vertex_counts[l];
    }
    pia_status status = pia_check_finite(context, "trim vertex", uv, total, 2);
    if (status == PIA_OK) status = pia_trim_new(context, loop_count, total, out);
    if (status != PIA_OK) return status;
    for (pia_index l = 0; l < loop_count && status == PIA_OK; uv += 2 * vertex_counts[l++])
        status = take_loop(context, model, l, uv, vertex_counts[l], *out);
    return status == PIA_OK ? pia_trim_check(context, *out) : status;
}

/* The model and what its fit said of it. */
static pia_status copy_whole(pia_context *context, const pia_model *model, pia_model **out)
{
    pia_status status = pia_model_copy(context, model, out);
    if (status != PIA_OK) return status;
    memcpy((*out)->periodic, model->periodic, sizeof model->periodic);
    if (model->summary == NULL) return PIA_OK;
    (*out)->summary = pia_summary_copy(pia_memory_of(context), model->summary);
    if ((*out)->summary != NULL) return PIA_OK;
    pia_model_destroy(*out);
    return pia_fail(context, PIA_E_MEMORY, "out of memory for the report of the fit; free memory");
}

pia_status pia_model_trim(pia_context *context, const pia_model *model, pia_index loop_count, const pia_index *vertex_counts,
                          const double *uv, pia_model **out)
{
    if (model == NULL || out == NULL || loop_count < 0)
        return pia_fail(context, PIA_E_ARGUMENT, "pia_model_trim needs a model, a count of loops of at least 0, and out");
    if (model->directions != 2) return pia_fail(context, PIA_E_ARGUMENT, "a curve cannot be trimmed by loops; surfaces can");
    pia_trim *trim = NULL;
    pia_model *made = NULL;
    pia_status status = loop_count > 0 ? take_loops(context, model, loop_count, vertex_counts, uv, &trim) : PIA_OK;
    if (status == PIA_OK) status = copy_whole(context, model, &made);
    if (status != PIA_OK) {
        pia_trim_destroy(pia_memory_of(context), trim);
        return status;
    }
    pia_trim_destroy(&made->memory, made->trim);
    made->trim = trim;
    *out = made;
    return PIA_OK;
}

pia_index pia_model_trim_loop_count(const pia_model *model)
{
    return model->trim != NULL ? model->trim->loop_count : 0;
}

const double *pia_model_trim_loop(const pia_model *model, pia_index loop, pia_index *count)
{
    int there = loop >= 0 && loop < pia_model_trim_loop_count(model);
    *count = there ? model->trim->start[loop + 1] - model->trim->start[loop] : 0;
    return there ? model->trim->uv + 2 * model->trim->start[loop] : NULL;
}

int pia_model_trim_contains(const pia_model *model, double u, double v)
{
    return model->trim == NULL || pia_trim_contains(model->trim, (double[2]){u, v});
}
