/* A model as the page draws it: its own knots and control points where they are few enough, else the model of degree 1 through a
 * lattice of its points. */
#include "page.h"

#include <math.h>
#include <string.h>

enum { EXACT_BITS = 24, LATTICE_BITS = 16, PLANE_BITS = 32, KNOT_BITS = 32 };

/* What may be kept as it is, and the lattice that replaces the rest: {curve, surface}. */
typedef struct limits {
    pia_index control[2], lattice[2];
} limits;
static const limits final_limits = {{200000, 66000}, {20000, 256}}, frame_limits = {{2000, 2500}, {2000, 80}};

typedef struct drawn {
    int directions, exact;
    int degree[2];
    pia_index control[2];
    double *knots[2]; /* [control + degree + 1]; [1] NULL for a curve */
    double *point;    /* [control[0] x control[1] x 3] */
    double *weight;   /* [control[0] x control[1]]; NULL for polynomial models */
} drawn;

static void drawn_give(pia_context *context, drawn *d)
{
    pia_give(context, d->knots[0]);
    pia_give(context, d->knots[1]);
    pia_give(context, d->point);
    pia_give(context, d->weight);
    *d = (drawn){0};
}

static void copy_knots(const pia_model *model, int d, double *to, pia_index count)
{
    memcpy(to, pia_model_knots(model, d), (size_t)count * sizeof *to);
}

/* Knots of degree 1 at the nodes of a lattice. */
static void even_knots(const double domain[2], double *to, pia_index count)
{
    for (pia_index i = 0; i < count; i++) {
        double share = (double)(i > 0 ? (i < count - 1 ? i - 1 : count - 3) : 0) / (double)(count - 3);
        to[i] = (1 - share) * domain[0] + share * domain[1];
    }
}

static pia_status drawn_take(pia_context *context, const pia_model *model, const limits *most, drawn *out)
{
    pia_model_info info = {.struct_size = sizeof info};
    pia_model_get_info(model, &info);
    int kind = info.directions - 1;
    pia_index count = info.control[0] * info.control[1];
    *out = (drawn){.directions = info.directions, .exact = count <= most->control[kind], .control = {1, 1}};
    for (int d = 0; d < info.directions; d++) {
        out->degree[d] = out->exact ? info.degree[d] : 1;
        out->control[d] = out->exact ? info.control[d] : most->lattice[kind];
        pia_index knots = out->control[d] + out->degree[d] + 1;
        out->knots[d] = pia_take(context, knots, sizeof *out->knots[d]);
        if (out->knots[d] == NULL) return pia_take_status(context, knots, sizeof *out->knots[d]);
        if (out->exact)
            copy_knots(model, d, out->knots[d], knots);
        else
            even_knots(info.domain[d], out->knots[d], knots);
    }
    count = out->control[0] * out->control[1];
    int weighted = out->exact && info.rational;
    out->point = pia_take(context, count, 3 * sizeof *out->point);
    if (weighted) out->weight = pia_take(context, count, sizeof *out->weight);
    if (out->point == NULL || (weighted && out->weight == NULL)) return PIA_E_MEMORY;
    if (weighted) pia_model_control(model, NULL, out->weight);
    return out->exact ? pia_figure_control(context, model, out->point) : pia_figure_lattice(context, model, out->control, out->point);
}

/* Series that the models of one figure share. */
typedef struct quantised {
    pia_series knots[2], point, weight;
} quantised;

static void cover(const double *value, pia_index count, int stride, int components, double *low, double *high)
{
    for (pia_index i = 0; i < count; i++)
        for (int c = 0; c < components; c++) {
            low[c] = fmin(low[c], value[i * stride + c]);
            high[c] = fmax(high[c], value[i * stride + c]);
        }
}

static quantised quantise(const pia_page *page, const drawn *first, const drawn *models, pia_index count, int bits)
{
    double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};
    quantised q = {0};
    for (pia_index k = 0; k < count; k++)
        cover(models[k].point, models[k].control[0] * models[k].control[1], 3, page->components, low, high);
    q.point = pia_series_between(page->components, bits, low, high);
    for (int d = 0; d < first->directions; d++) {
        const double *knots = first->knots[d];
        q.knots[d] = pia_series_between(1, KNOT_BITS, knots, knots + first->control[d] + first->degree[d]);
    }
    low[0] = INFINITY;
    high[0] = -INFINITY;
    for (pia_index k = 0; k < count; k++)
        if (models[k].weight != NULL) cover(models[k].weight, models[k].control[0] * models[k].control[1], 1, 1, low, high);
    q.weight = pia_series_between(1, EXACT_BITS, low, high);
    return q;
}

static void quantised_close(pia_context *context, quantised *q)
{
    pia_series_close(context, &q->knots[0]);
    pia_series_close(context, &q->knots[1]);
    pia_series_close(context, &q->point);
    pia_series_close(context, &q->weight);
}

static pia_status put_drawn(pia_page *page, const drawn *d, quantised *q)
{
    const pia_index degree[2] = {d->degree[0], d->degree[1]};
    pia_json_counts(&page->json, "degree", degree, d->directions);
    pia_json_counts(&page->json, "control", d->control, d->directions);
    pia_json_truth(&page->json, "exact", d->exact);
    pia_status status = PIA_OK;
    pia_json_open(&page->json, "knots", '[');
    for (int k = 0; k < d->directions && status == PIA_OK; k++)
        status = pia_page_lattice(page, NULL, &q->knots[k], d->knots[k], 1, d->control[k] + d->degree[k] + 1, 1);
    pia_json_close(&page->json, ']');
    if (status == PIA_OK) status = pia_page_lattice(page, "points", &q->point, d->point, 3, d->control[0], d->control[1]);
    if (status == PIA_OK && d->weight != NULL)
        status = pia_page_lattice(page, "weights", &q->weight, d->weight, 1, d->control[0], d->control[1]);
    return status;
}

static void put_frame_report(pia_json *json, const pia_model *frame)
{
    pia_report report = {.struct_size = sizeof report};
    if (!pia_model_report(frame, &report)) return;
    pia_json_count(json, "iteration", report.iterations);
    pia_json_count(json, "control_count", report.control_count);
    pia_json_number(json, "max_error", report.max_error);
    pia_json_number(json, "rms_error", report.rms_error);
}

static pia_status put_frames(pia_page *page, const pia_model *const *frames, const drawn *all, pia_index count)
{
    int bits = LATTICE_BITS;
    for (pia_index k = 0; k < count; k++)
        if (all[k].exact) bits = EXACT_BITS;
    quantised q = quantise(page, &all[0], all, count, bits);
    pia_status status = PIA_OK;
    pia_json_open(&page->json, "frames", '[');
    for (pia_index k = 0; k < count && status == PIA_OK; k++) {
        pia_json_open(&page->json, NULL, '{');
        put_frame_report(&page->json, frames[k]);
        status = put_drawn(page, &all[k], &q);
        pia_json_close(&page->json, '}');
    }
    pia_json_close(&page->json, ']');
    quantised_close(page->context, &q);
    return status;
}

static pia_status take_and_put_frames(pia_page *page, const pia_model *const *frames, pia_index count)
{
    drawn *all = pia_take_zero(page->context, count, sizeof *all);
    if (all == NULL) return pia_take_status(page->context, count, sizeof *all);
    pia_status status = PIA_OK;
    for (pia_index k = 0; k < count && status == PIA_OK; k++) status = drawn_take(page->context, frames[k], &frame_limits, &all[k]);
    if (status == PIA_OK) status = put_frames(page, frames, all, count);
    for (pia_index k = 0; k < count; k++) drawn_give(page->context, &all[k]);
    pia_give(page->context, all);
    return status;
}

pia_status pia_page_model(pia_page *page, pia_index model)
{
    const pia_page_options *o = page->options;
    const pia_figure *figure = &page->scene.figure[model];
    drawn final;
    pia_status status = drawn_take(page->context, figure->model, &final_limits, &final);
    if (status == PIA_OK) {
        quantised q = quantise(page, &final, &final, 1, final.directions == 1 ? PLANE_BITS : EXACT_BITS);
        pia_json_counts(&page->json, "own_control", figure->info.control, figure->info.directions);
        status = put_drawn(page, &final, &q);
        quantised_close(page->context, &q);
    }
    drawn_give(page->context, &final);
    pia_index begin = o->frame_start != NULL ? o->frame_start[model] : 0;
    pia_index end = o->frame_start != NULL ? o->frame_start[model + 1] : model == 0 ? o->frame_count : 0;
    if (status == PIA_OK && end > begin) status = take_and_put_frames(page, o->frames + begin, end - begin);
    return status;
}
