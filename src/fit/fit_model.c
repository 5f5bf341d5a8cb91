/* The model of the current iterate, and what it remembers of the fit. */
#include "fit.h"

#include "kernel.h"
#include "knots.h"
#include "model.h"

#include <string.h>

enum { GRAIN = 16384, MOST_KEPT = 1000000 };

typedef struct controls {
    const pia_fit *fit;
    pia_index count, chunks; /* count: control points, or lines of them where an iterate of a surface has no copies of them */
    double *out;
} controls;

static inline __attribute__((always_inline)) void move_back(const controls *c, pia_index from, pia_index to, int dim)
{
    const double *x = c->fit->iterate.points, *origin = c->fit->origin;
    for (pia_index i = from; i < to; i++)
        for (int d = 0; d < dim; d++) c->out[i * dim + d] = x[i * dim + d] + origin[d];
}

static void move_back_copies(const controls *c, pia_index from, pia_index to)
{
    const pia_fit *fit = c->fit;
    int dim = fit->dim, graph = fit->function_graph, wide = dim + graph;
    for (pia_index i = from; i < to; i++) {
        const double *x = fit->iterate.points + pia_collocation_unknown(fit->op->axis[0], i) * dim;
        if (graph) c->out[i * wide] = pia_knots_greville(fit->knots[0], fit->degree[0], i);
        for (int d = 0; d < dim; d++) c->out[i * wide + graph + d] = x[d] + fit->origin[d];
    }
}

/* Lines of a surface. */
static void move_back_lines(const controls *c, pia_index from, pia_index to)
{
    const pia_op *op = c->fit->op;
    int dim = c->fit->dim;
    for (pia_index i = from; i < to; i++) {
        const double *line = c->fit->iterate.points + pia_collocation_unknown(op->axis[0], i) * op->count[1] * dim;
        double *out = c->out + i * op->full_count[1] * dim;
        for (pia_index j = 0; j < op->full_count[1]; j++) {
            const double *x = line + pia_collocation_unknown(op->axis[1], j) * dim;
            for (int d = 0; d < dim; d++) out[j * dim + d] = x[d] + c->fit->origin[d];
        }
    }
}

/* Whether the iterate is all that the model needs: no copies of control points, no abscissas. */
static int is_plain(const pia_fit *fit)
{
    return fit->op->identity && !fit->function_graph;
}

static int is_at_origin(const pia_fit *fit)
{
    int all = 1;
    for (int d = 0; d < fit->dim; d++) all &= fit->origin[d] == 0;
    return all;
}

static void fill_chunk(void *work, pia_index chunk)
{
    const controls *c = work;
    pia_index from = pia_chunk_begin(c->count, c->chunks, chunk), to = pia_chunk_begin(c->count, c->chunks, chunk + 1);
    if (!is_plain(c->fit) && c->fit->directions == 2)
        move_back_lines(c, from, to);
    else if (!is_plain(c->fit))
        move_back_copies(c, from, to);
    else if (c->fit->dim == 3)
        move_back(c, from, to, 3);
    else
        move_back(c, from, to, c->fit->dim);
}

/* Control points of the model [fulls x (dim + graph)]: the iterate moved back from the origin; a function graph's abscissas are the
 * Greville line, which makes x the identity. A plain iterate may be moved in place. */
static void fill_control(const pia_fit *fit, double *out)
{
    pia_index line = !is_plain(fit) && fit->directions == 2 ? fit->op->full_count[1] : 1, count = fit->op->fulls / line;
    controls c = {fit, count, pia_chunk_count(count, GRAIN / line + 1), out};
    pia_for_each(fit->context, c.chunks, fill_chunk, &c);
}

static pia_status make_clamped(pia_fit *fit, pia_model **out)
{
    pia_status status = pia_model_new(fit->context, fit->directions, fit->degree, fit->full, fit->dim + fit->function_graph, 0, out);
    if (status != PIA_OK) return status;
    for (int d = 0; d < fit->directions; d++)
        pia_copy(fit->context, (*out)->knots[d], fit->knots[d], fit->full[d] + fit->degree[d] + 1);
    fill_control(fit, (*out)->points);
    return PIA_OK;
}

static pia_status make_closed(pia_fit *fit, pia_model **out)
{
    int wide = fit->dim + fit->function_graph;
    double *points = pia_take(fit->context, fit->op->fulls * wide, sizeof *points);
    if (points == NULL) return PIA_E_MEMORY;
    fill_control(fit, points);
    pia_status status = pia_model_from_cyclic(fit->context, fit->directions, fit->degree, (const double *const *)fit->knots, fit->full,
                                              fit->closed, wide, points, out);
    pia_give(fit->context, points);
    return status;
}

static int is_closed(const pia_fit *fit)
{
    return fit->closed[0] || (fit->directions == 2 && fit->closed[1]);
}

pia_status pia_fit_bare_model(pia_fit *fit, pia_model **out)
{
    return is_closed(fit) ? make_closed(fit, out) : make_clamped(fit, out);
}

/* How many data rows before this one were dropped. */
static pia_index dropped_before(const pia_fit *fit, pia_index data_row)
{
    pia_index low = 0, high = fit->dropped_count;
    while (low < high) {
        pia_index middle = low + (high - low) / 2;
        if (fit->dropped[middle] < data_row)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

/* Parameters of rows in the order of the data, which a sorted graph or a turned closed curve has left. */
static void order_by_row(const pia_fit *fit, double *out)
{
    pia_index wide = fit->kind == PIA_SCATTERED ? 2 : 1;
    if (out == NULL || fit->row == NULL || fit->kind == PIA_GRID) return;
    for (pia_index i = 0; i < fit->rows; i++) {
        pia_index place = fit->row[i] - dropped_before(fit, fit->row[i]);
        memcpy(out + place * wide, fit->parameter[0] + i * wide, (size_t)wide * sizeof *out);
    }
}

/* Parameters are kept with the model where they cannot be computed again from the points, given and corrected ones, unless they are so
 * many that a copy would weigh on memory. */
static pia_status attach_parameters(pia_fit *fit, pia_summary *summary)
{
    const double *parameters;
    pia_index count;
    pia_status status = pia_fit_parameters(fit, &parameters, &count, NULL);
    if (status != PIA_OK || (fit->parametrization != NULL && !fit->parameters_moved) || count > MOST_KEPT) return status;
    summary->parameters = pia_take(fit->context, count, sizeof *parameters);
    if (summary->parameters == NULL) return pia_take_status(fit->context, count, sizeof *parameters);
    summary->parameter_count = count;
    pia_copy(fit->context, summary->parameters, parameters, count);
    order_by_row(fit, summary->parameters);
    return PIA_OK;
}

static pia_status attach_summary(pia_fit *fit, const pia_report *report, pia_model *model)
{
    const pia_memory *memory = pia_memory_of(fit->context);
    pia_summary summary = {.report = *report, .notes = fit->notes, .dropped = fit->dropped, .dropped_count = fit->dropped_count};
    model->summary = pia_summary_copy(memory, &summary);
    if (model->summary == NULL) return pia_fail(fit->context, PIA_E_MEMORY, "out of memory for the summary of the fit");
    pia_notes_copy(memory, &model->summary->notes, &fit->outcome);
    return attach_parameters(fit, model->summary);
}

/* The iterate and the knots become the model's own. */
static pia_status give_model(pia_fit *fit, pia_model **out)
{
    if (is_closed(fit) || !is_plain(fit)) return pia_fit_bare_model(fit, out);
    if (!is_at_origin(fit)) fill_control(fit, fit->iterate.points);
    return pia_model_adopt(fit->context, fit->directions, fit->degree, fit->full, fit->dim, 0, fit->knots, &fit->iterate.points, out);
}

/* With a summary of what is known. */
static pia_status model_of(pia_fit *fit, pia_status (*make)(pia_fit *fit, pia_model **out), pia_model **out)
{
    pia_model *model = NULL;
    pia_report report = {.struct_size = sizeof report};
    pia_fit_conclude(fit);
    pia_fit_tell(fit, &report);
    pia_status status = make(fit, &model);
    if (status == PIA_OK) status = attach_summary(fit, &report, model);
    if (status == PIA_OK)
        *out = model;
    else
        pia_model_destroy(model);
    return status;
}

pia_status pia_fit_model(pia_fit *fit, pia_model **out)
{
    if (out == NULL) return pia_fail(fit->context, PIA_E_ARGUMENT, "out is NULL");
    if (pia_fit_whole(fit) != PIA_OK) return PIA_E_MEMORY;
    pia_iterate_measure(&fit->iterate);
    return model_of(fit, pia_fit_bare_model, out);
}

pia_status pia_fit_turn_into_model(pia_fit *fit, pia_model **out)
{
    if (fit->options.tolerance > 0) pia_iterate_measure(&fit->iterate);
    return model_of(fit, give_model, out);
}
