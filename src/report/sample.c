#include "sample.h"

#include "knots.h"

#include <math.h>
#include <string.h>

enum { CURVE_SAMPLES = 20000, CURVE_SPANS = 2000000, MOST_PIECES = 256, TEETH = 500, STROKES = 120 };
static const double largest_drawn = 1e150;

static pia_index count_spans(const double *knots, int degree, pia_index control)
{
    pia_index spans = 0;
    for (pia_index i = degree; i < control; i++) spans += knots[i] < knots[i + 1];
    return spans > 0 ? spans : 1;
}

static void fill_samples(const double *knots, int degree, pia_index control, pia_index pieces, pia_index stride, pia_samples *out)
{
    double begin = knots[degree];
    pia_index at = 0, seen = 0;
    for (pia_index i = degree; i < control; i++) {
        if (!(knots[i] < knots[i + 1])) continue;
        if (++seen % stride != 0 && knots[i + 1] < knots[control]) continue;
        for (pia_index k = 0; k < pieces; k++) {
            out->at_knot[at] = k == 0;
            out->parameter[at++] = begin + (knots[i + 1] - begin) * (double)k / (double)pieces;
        }
        begin = knots[i + 1];
    }
    out->at_knot[at] = 1;
    out->parameter[at] = knots[control];
}

pia_status pia_samples_take(pia_context *context, const pia_model *model, int direction, pia_index wanted, pia_index most,
                            pia_samples *out)
{
    pia_model_info info = {.struct_size = sizeof info};
    pia_model_get_info(model, &info);
    const double *knots = pia_model_knots(model, direction);
    int degree = info.degree[direction];
    pia_index spans = count_spans(knots, degree, info.control[direction]);
    pia_index pieces = wanted / spans < 1 ? 1 : wanted / spans > MOST_PIECES ? MOST_PIECES : wanted / spans;
    pia_index stride = 1 + (spans - 1) / most;
    out->count = (spans + stride - 1) / stride * pieces + 1;
    out->parameter = pia_take(context, out->count, sizeof *out->parameter);
    out->at_knot = pia_take(context, out->count, sizeof *out->at_knot);
    if (out->parameter == NULL || out->at_knot == NULL) {
        pia_samples_give(context, out);
        return PIA_E_MEMORY;
    }
    fill_samples(knots, degree, info.control[direction], pieces, stride, out);
    return PIA_OK;
}

pia_index pia_samples_knots(const pia_samples *samples)
{
    pia_index count = 0;
    for (pia_index i = 0; i < samples->count; i++) count += samples->at_knot[i];
    return count;
}

void pia_samples_give(pia_context *context, pia_samples *samples)
{
    pia_give(context, samples->parameter);
    pia_give(context, samples->at_knot);
    *samples = (pia_samples){0};
}

void pia_figure_place(const pia_model_info *info, const double *parameter, const double *value, double at[3])
{
    int lead = info->dim == 1 ? info->directions : 0;
    int shown = info->dim < 3 - lead ? info->dim : 3 - lead;
    memset(at, 0, 3 * sizeof *at);
    for (int c = 0; c < lead; c++) at[c] = parameter[c];
    for (int c = 0; c < shown; c++) at[lead + c] = value[c];
}

/* Positions of values [count x stride doubles apart], each at its parameter [directions]. */
static pia_status place_all(pia_context *context, const pia_model_info *info, const double *parameter, const double *value,
                            pia_index count, pia_index stride, double *at)
{
    for (pia_index i = 0; i < count; i++) {
        pia_figure_place(info, parameter + i * info->directions, value + i * stride, at + 3 * i);
        for (int c = 0; c < 3; c++)
            if (!(fabs(at[3 * i + c]) < largest_drawn))
                return pia_fail(context, PIA_E_DATA, "a coordinate of %g is too large for a picture; scale the model and its points",
                                at[3 * i + c]);
    }
    return PIA_OK;
}

/* Parameters [first_count x second_count x directions] of the lattice of two directions; a curve has second_count 1. */
static void cross(int directions, const double *first, pia_index first_count, const double *second, pia_index second_count, double *out)
{
    for (pia_index i = 0; i < first_count; i++) {
        for (pia_index j = 0; j < second_count; j++) {
            *out++ = first[i];
            if (directions == 2) *out++ = second[j];
        }
    }
}

/* Drawn positions at the lattice of parameters first x second. */
static pia_status place_lattice(pia_context *context, const pia_model *model, const double *first, pia_index first_count,
                                const double *second, pia_index second_count, double *at)
{
    pia_model_info info = {.struct_size = sizeof info};
    pia_model_get_info(model, &info);
    pia_index count = first_count * second_count;
    double *parameter = pia_take(context, count, (size_t)info.directions * sizeof *parameter);
    double *value = pia_take(context, count, (size_t)info.dim * sizeof *value);
    pia_status status = PIA_E_MEMORY;
    if (parameter != NULL && value != NULL) {
        cross(info.directions, first, first_count, second, second_count, parameter);
        status = pia_model_eval(context, model, parameter, count, 0, value);
        if (status == PIA_OK) status = place_all(context, &info, parameter, value, count, info.dim, at);
    }
    pia_give(context, parameter);
    pia_give(context, value);
    return status;
}

static pia_status sample_shape(pia_context *context, pia_figure *figure)
{
    const pia_samples *s = figure->samples;
    figure->at = pia_take(context, s[0].count * s[1].count, 3 * sizeof *figure->at);
    if (figure->at == NULL) return PIA_E_MEMORY;
    return place_lattice(context, figure->model, s[0].parameter, s[0].count, s[1].parameter, s[1].count, figure->at);
}

/* Strokes along a side of a loop, which is straight in the parameters and bent in space: STROKES across the domain. */
static pia_index stroke_count(const pia_model_info *info, const double *a, const double *b)
{
    double share = 0;
    for (int d = 0; d < 2; d++) share = fmax(share, fabs(b[d] - a[d]) / (info->domain[d][1] - info->domain[d][0]));
    return 1 + (pia_index)(STROKES * share);
}

/* The two ends of every stroke of a loop, to `to` unless it is NULL; returns their number. */
static pia_index stroke_loop(const pia_model_info *info, const double *loop, pia_index count, double *to)
{
    pia_index ends = 0;
    for (pia_index i = 0; i < count; i++) {
        const double *a = loop + 2 * i, *b = loop + 2 * ((i + 1) % count);
        pia_index strokes = stroke_count(info, a, b);
        for (pia_index k = 0; k < 2 * strokes && to != NULL; k++)
            for (int d = 0; d < 2; d++) *to++ = a[d] + (b[d] - a[d]) * (double)((k + 1) / 2) / (double)strokes;
        ends += 2 * strokes;
    }
    return ends;
}

static pia_index stroke_loops(const pia_figure *figure, double *to)
{
    pia_index ends = 0, count = 0;
    for (pia_index k = 0; k < pia_model_trim_loop_count(figure->model); k++) {
        const double *loop = pia_model_trim_loop(figure->model, k, &count);
        ends += stroke_loop(&figure->info, loop, count, to != NULL ? to + 2 * ends : NULL);
    }
    return ends;
}

/* Which samples the trim loops of a surface cut away, and where its edges are. */
static pia_status sample_trim(pia_context *context, pia_figure *figure)
{
    const pia_samples *s = figure->samples;
    pia_index ends = stroke_loops(figure, NULL), sample = 0;
    if (ends == 0) return PIA_OK;
    figure->edge_count = ends / 2;
    double *parameter = pia_take(context, ends, 2 * sizeof *parameter);
    double *value = pia_take(context, ends, (size_t)figure->info.dim * sizeof *value);
    figure->edge = pia_take(context, ends, 3 * sizeof *figure->edge);
    figure->outside = pia_take(context, s[0].count * s[1].count, 1);
    int all = parameter != NULL && value != NULL && figure->edge != NULL && figure->outside != NULL;
    if (all) stroke_loops(figure, parameter);
    pia_status status = all ? pia_model_eval(context, figure->model, parameter, ends, 0, value) : PIA_E_MEMORY;
    if (status == PIA_OK) status = place_all(context, &figure->info, parameter, value, ends, figure->info.dim, figure->edge);
    for (pia_index i = 0; i < s[0].count && status == PIA_OK; i++)
        for (pia_index j = 0; j < s[1].count; j++)
            figure->outside[sample++] = !pia_model_trim_contains(figure->model, s[0].parameter[i], s[1].parameter[j]);
    pia_give(context, parameter);
    pia_give(context, value);
    return status;
}

pia_status pia_figure_lattice(pia_context *context, const pia_model *model, const pia_index count[2], double *at)
{
    pia_model_info info = {.struct_size = sizeof info};
    pia_model_get_info(model, &info);
    double *parameter = pia_take_zero(context, count[0] + count[1], sizeof *parameter);
    if (parameter == NULL) return pia_take_status(context, count[0] + count[1], sizeof *parameter);
    double *line[2] = {parameter, parameter + count[0]};
    for (int d = 0; d < info.directions; d++)
        for (pia_index i = 0; i < count[d]; i++) {
            double share = (double)i / (double)(count[d] - 1);
            line[d][i] = (1 - share) * info.domain[d][0] + share * info.domain[d][1];
        }
    pia_status status = place_lattice(context, model, line[0], count[0], line[1], count[1], at);
    pia_give(context, parameter);
    return status;
}

pia_status pia_figure_control(pia_context *context, const pia_model *model, double *at)
{
    pia_model_info info = {.struct_size = sizeof info};
    pia_model_get_info(model, &info);
    pia_index count = info.control[0] * info.control[1];
    double *abscissa = pia_take(context, info.control[0] + info.control[1], sizeof *abscissa);
    double *parameter = pia_take(context, count, (size_t)info.directions * sizeof *parameter);
    double *value = pia_take(context, count, (size_t)info.dim * sizeof *value);
    pia_status status = PIA_E_MEMORY;
    if (abscissa != NULL && parameter != NULL && value != NULL) {
        double *greville[2] = {abscissa, abscissa + info.control[0]};
        for (int d = 0; d < info.directions; d++)
            for (pia_index i = 0; i < info.control[d]; i++)
                greville[d][i] = pia_knots_greville(pia_model_knots(model, d), info.degree[d], i);
        cross(info.directions, greville[0], info.control[0], greville[1], info.control[1], parameter);
        pia_model_control(model, value, NULL);
        status = place_all(context, &info, parameter, value, count, info.dim, at);
    }
    pia_give(context, abscissa);
    pia_give(context, parameter);
    pia_give(context, value);
    return status;
}

static pia_status sample_control(pia_context *context, pia_figure *figure)
{
    figure->control = pia_take(context, figure->info.control[0] * figure->info.control[1], 3 * sizeof *figure->control);
    return figure->control != NULL ? pia_figure_control(context, figure->model, figure->control) : PIA_E_MEMORY;
}

/* The curvature vector k = (c'' - c' (c'.c'')/(c'.c')) / (c'.c') lives in every dimension; 0 where the curve stands still. */
static void bend_of(const double *first, const double *second, int dim, pia_tooth *tooth)
{
    double speed = 0, along = 0, size = 0;
    for (int c = 0; c < dim; c++) {
        speed += first[c] * first[c];
        along += first[c] * second[c];
    }
    for (int c = 0; c < dim; c++) {
        double bend = speed > 0 ? (second[c] - first[c] * along / speed) / speed : 0;
        if (!isfinite(bend)) bend = 0;
        size += bend * bend;
        if (c < 3) tooth->bend[c] = bend;
    }
    tooth->curvature = sqrt(size);
}

static pia_status sample_comb(pia_context *context, pia_figure *figure)
{
    pia_samples samples = {0};
    pia_status status = pia_samples_take(context, figure->model, 0, TEETH, TEETH, &samples);
    if (status != PIA_OK) return status;
    int dim = figure->info.dim;
    double *value = pia_take(context, samples.count, 3 * (size_t)dim * sizeof *value);
    figure->tooth = pia_take_zero(context, samples.count, sizeof *figure->tooth);
    status = value == NULL || figure->tooth == NULL
                 ? PIA_E_MEMORY
                 : pia_model_eval(context, figure->model, samples.parameter, samples.count, 2, value);
    for (pia_index i = 0; status == PIA_OK && i < samples.count; i++) {
        const double *v = value + 3 * dim * i;
        pia_figure_place(&figure->info, samples.parameter + i, v, figure->tooth[i].root);
        bend_of(v + dim, v + 2 * dim, dim, &figure->tooth[i]);
    }
    figure->tooth_count = samples.count;
    pia_give(context, value);
    pia_samples_give(context, &samples);
    return status;
}

pia_status pia_figure_take(pia_context *context, const pia_model *model, pia_index most, int comb, pia_figure *out)
{
    *out = (pia_figure){.model = model, .info.struct_size = sizeof out->info, .samples[1].count = 1};
    pia_model_get_info(model, &out->info);
    int surface = out->info.directions == 2;
    pia_status status =
        pia_samples_take(context, model, 0, surface ? most : CURVE_SAMPLES, surface ? most : CURVE_SPANS, &out->samples[0]);
    if (status == PIA_OK && surface) status = pia_samples_take(context, model, 1, most, most, &out->samples[1]);
    if (status == PIA_OK) status = sample_shape(context, out);
    if (status == PIA_OK) status = sample_trim(context, out);
    if (status == PIA_OK) status = sample_control(context, out);
    if (status == PIA_OK && comb && !surface && out->info.dim > 1) status = sample_comb(context, out);
    if (status != PIA_OK) pia_figure_give(context, out);
    return status;
}

void pia_figure_give(pia_context *context, pia_figure *figure)
{
    pia_samples_give(context, &figure->samples[0]);
    pia_samples_give(context, &figure->samples[1]);
    pia_give(context, figure->at);
    pia_give(context, figure->outside);
    pia_give(context, figure->edge);
    pia_give(context, figure->control);
    pia_give(context, figure->tooth);
    *figure = (pia_figure){0};
}

int pia_figure_is_graph(const pia_figure *curve)
{
    const pia_samples *s = &curve->samples[0];
    double first = curve->at[0], range = curve->at[3 * (s->count - 1)] - first;
    double begin = s->parameter[0], length = s->parameter[s->count - 1] - begin;
    for (pia_index i = 0; i < s->count; i++)
        if (!(fabs(curve->at[3 * i] - first - range * (s->parameter[i] - begin) / length) <= 1e-6 * range)) return 0;
    return range > 0;
}

int pia_figure_is_monotone(const pia_figure *curve)
{
    for (pia_index i = 1; i < curve->samples[0].count; i++)
        if (curve->at[3 * i] < curve->at[3 * (i - 1)]) return 0;
    return 1;
}

int pia_figure_is_terrain(const pia_figure *surface)
{
    pia_index rows = surface->samples[0].count, columns = surface->samples[1].count, up = 0, down = 0;
    for (pia_index i = 0; i + 1 < rows; i++) {
        for (pia_index j = 0; j + 1 < columns; j++) {
            const double *a = surface->at + 3 * (i * columns + j), *b = a + 3 * columns, *c = a + 3;
            double turn = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
            up += turn > 0;
            down += turn < 0;
        }
    }
    return rows > 1 && columns > 1 && (up == 0 || down == 0) && up + down > 0;
}
