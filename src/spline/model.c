#include "model.h"

#include <math.h>
#include <string.h>

#include "finite.h"
#include "knots.h"

static pia_status check_shape(pia_context *context, int directions, const int *degree, const pia_index *control, int dim)
{
    if (directions < 1 || directions > 2)
        return pia_fail(context, PIA_E_ARGUMENT, "%d directions; a curve has 1, a surface 2", directions);
    if (dim < 1 || dim > PIA_MAX_DIM) return pia_fail(context, PIA_E_ARGUMENT, "dimension %d is outside 1 to %d", dim, PIA_MAX_DIM);
    for (int d = 0; d < directions; d++) {
        if (degree[d] < 1 || degree[d] > PIA_MAX_DEGREE)
            return pia_fail(context, PIA_E_ARGUMENT, "degree %d is outside 1 to %d", degree[d], PIA_MAX_DEGREE);
        if (control[d] < degree[d] + 1)
            return pia_fail(context, PIA_E_SHAPE, "%lld control points cannot have degree %d; it needs at least %d",
                            (long long)control[d], degree[d], degree[d] + 1);
        if (control[d] > INT64_MAX / 2)
            return pia_fail(context, PIA_E_SIZE, "%lld control points do not fit in 64 bits", (long long)control[d]);
    }
    return PIA_OK;
}

static pia_status take_arrays(pia_context *context, pia_model *model)
{
    pia_index count;
    if (!pia_multiply(model->control[0], model->control[1], &count) || !pia_multiply(count, pia_model_width(model), &count))
        return pia_fail(context, PIA_E_SIZE, "%lld x %lld control points do not fit in 64 bits", (long long)model->control[0],
                        (long long)model->control[1]);
    for (int d = 0; d < model->directions; d++) {
        pia_index knots = model->control[d] + model->degree[d] + 1;
        if (model->knots[d] == NULL) model->knots[d] = pia_take(context, knots, sizeof *model->knots[d]);
        if (model->knots[d] == NULL) return pia_take_status(context, knots, sizeof *model->knots[d]);
    }
    if (model->points == NULL) model->points = pia_take(context, count, sizeof *model->points);
    return model->points != NULL ? PIA_OK : pia_take_status(context, count, sizeof *model->points);
}

pia_status pia_model_adopt(pia_context *context, int directions, const int *degree, const pia_index *control, int dim, int rational,
                           double **knots, double **points, pia_model **out)
{
    pia_status status = check_shape(context, directions, degree, control, dim);
    if (status != PIA_OK) return status;
    pia_model *model = pia_take(context, 1, sizeof *model);
    if (model == NULL) return PIA_E_MEMORY;
    *model = (pia_model){.memory = *pia_memory_of(context),
                         .directions = directions,
                         .dim = dim,
                         .rational = rational != 0,
                         .degree = {degree[0], directions > 1 ? degree[1] : 0},
                         .control = {control[0], directions > 1 ? control[1] : 1},
                         .points = *points};
    for (int d = 0; d < directions; d++) {
        model->knots[d] = knots[d];
        knots[d] = NULL;
    }
    *points = NULL;
    status = take_arrays(context, model);
    if (status == PIA_OK)
        *out = model;
    else
        pia_model_destroy(model);
    return status;
}

pia_status pia_model_new(pia_context *context, int directions, const int *degree, const pia_index *control, int dim, int rational,
                         pia_model **out)
{
    double *knots[2] = {NULL, NULL}, *points = NULL;
    return pia_model_adopt(context, directions, degree, control, dim, rational, knots, &points, out);
}

static pia_status check_points(pia_context *context, const double *points, const double *weights, pia_index count, int dim)
{
    pia_status status = pia_check_finite(context, "control point", points, count, dim);
    if (status != PIA_OK) return status;
    for (pia_index i = 0; weights != NULL && i < count; i++) {
        if (!(weights[i] > 0) || !isfinite(weights[i]))
            return pia_fail(context, PIA_E_DATA, "weight %lld is %g; weights are finite and above 0", (long long)i, weights[i]);
        for (int k = 0; k < dim; k++)
            if (!isfinite(points[i * dim + k] * weights[i]))
                return pia_fail(context, PIA_E_DATA, "control point %lld times its weight %g overflows; scale the weights",
                                (long long)i, weights[i]);
    }
    return PIA_OK;
}

static void fill_points(pia_model *model, const double *points, const double *weights)
{
    pia_index count = model->control[0] * model->control[1];
    double *to = model->points;
    for (pia_index i = 0; i < count; i++) {
        double w = weights != NULL ? weights[i] : 1;
        for (int k = 0; k < model->dim; k++) *to++ = points[i * model->dim + k] * w;
        if (model->rational) *to++ = w;
    }
}

pia_status pia_model_create(pia_context *context, int directions, const int *degree, const double *const *knots,
                            const pia_index *control, int dim, const double *points, const double *weights, pia_model **out)
{
    if (degree == NULL || knots == NULL || control == NULL || points == NULL || out == NULL)
        return pia_fail(context, PIA_E_ARGUMENT, "pia_model_create needs degree, knots, control, points and out");
    pia_model *model = NULL;
    pia_status status = pia_model_new(context, directions, degree, control, dim, weights != NULL, &model);
    for (int d = 0; status == PIA_OK && d < directions; d++) {
        pia_index count = control[d] + degree[d] + 1;
        if (knots[d] == NULL)
            status = pia_fail(context, PIA_E_ARGUMENT, "pia_model_create needs the knots of direction %d", d);
        else
            status = pia_knots_check(context, degree[d], knots[d], count, control[d]);
        if (status == PIA_OK) memcpy(model->knots[d], knots[d], (size_t)count * sizeof **knots);
    }
    if (status == PIA_OK) status = check_points(context, points, weights, model->control[0] * model->control[1], dim);
    if (status != PIA_OK) {
        pia_model_destroy(model);
        return status;
    }
    fill_points(model, points, weights);
    for (int d = 0; d < directions; d++) model->periodic[d] = pia_model_joins(model, d);
    *out = model;
    return PIA_OK;
}

void pia_model_destroy(pia_model *model)
{
    if (model == NULL) return;
    pia_memory memory = model->memory;
    pia_summary_destroy(&memory, model->summary);
    pia_trim_destroy(&memory, model->trim);
    for (int d = 0; d < 2; d++) pia_memory_give(&memory, model->knots[d]);
    pia_memory_give(&memory, model->points);
    pia_memory_give(&memory, model);
}

int pia_model_width(const pia_model *model)
{
    return model->dim + model->rational;
}

pia_lines pia_model_lines(const pia_model *model, int direction)
{
    int width = pia_model_width(model);
    return direction == 0 ? (pia_lines){1, model->control[1] * width} : (pia_lines){model->control[0], width};
}

pia_status pia_model_check_direction(pia_context *context, const pia_model *model, int direction)
{
    if (model == NULL) return pia_fail(context, PIA_E_ARGUMENT, "the model is NULL");
    if (direction < 0 || direction >= model->directions)
        return pia_fail(context, PIA_E_ARGUMENT, "direction %d; this model has directions 0 to %d", direction, model->directions - 1);
    return PIA_OK;
}

void pia_model_get_info(const pia_model *model, pia_model_info *out)
{
    *out =
        (pia_model_info){.struct_size = sizeof *out, .directions = model->directions, .dim = model->dim, .rational = model->rational};
    for (int d = 0; d < 2; d++) {
        out->degree[d] = model->degree[d];
        out->control[d] = model->control[d];
        out->periodic[d] = model->periodic[d];
    }
    for (int d = 0; d < model->directions; d++) {
        out->knot_count[d] = model->control[d] + model->degree[d] + 1;
        out->domain[d][0] = model->knots[d][model->degree[d]];
        out->domain[d][1] = model->knots[d][model->control[d]];
    }
}

const double *pia_model_knots(const pia_model *model, int direction)
{
    return direction >= 0 && direction < model->directions ? model->knots[direction] : NULL;
}

void pia_model_control(const pia_model *model, double *points, double *weights)
{
    pia_index count = model->control[0] * model->control[1];
    const double *from = model->points;
    for (pia_index i = 0; i < count; i++, from += pia_model_width(model)) {
        double w = model->rational ? from[model->dim] : 1;
        for (int k = 0; points != NULL && k < model->dim; k++) points[i * model->dim + k] = from[k] / w;
        if (weights != NULL) weights[i] = w;
    }
}

int pia_model_report(const pia_model *model, pia_report *out)
{
    if (model->summary == NULL) return 0;
    *out = model->summary->report;
    return 1;
}

const char *pia_model_note(const pia_model *model, pia_index index)
{
    const pia_summary *summary = model->summary;
    return summary != NULL && index >= 0 && index < summary->notes.count ? summary->notes.line[index] : NULL;
}

const double *pia_model_parameters(const pia_model *model, pia_index *count)
{
    const pia_summary *summary = model->summary;
    int has = summary != NULL && summary->parameters != NULL;
    *count = has ? summary->parameter_count : 0;
    return has ? summary->parameters : NULL;
}

const pia_index *pia_model_dropped(const pia_model *model, pia_index *count)
{
    const pia_summary *summary = model->summary;
    int has = summary != NULL && summary->dropped != NULL;
    *count = has ? summary->dropped_count : 0;
    return has ? summary->dropped : NULL;
}
