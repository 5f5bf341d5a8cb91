/* A fit to a file and back. What the stages made (rows used, parameters, knots) is stored, so that resuming repeats none of their
 * decisions; operator, normal form and constraint rows are made anew from it; histories of method and limiter are stored as numbers. */
#include "checkpoint.h"
#include "fit.h"
#include "param.h"
#include "place.h"
#include "sequence.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* One walk over the state serves both directions: `put` or `get` is what happens to each array. */
typedef struct walk {
    pia_context *context;
    pia_checkpoint_writer *writer; /* saving; NULL: resuming from checkpoint */
    pia_checkpoint *checkpoint;
    pia_status status;
} walk;

static void array(walk *w, const char *name, pia_section_type type, void *data, pia_index count)
{
    if (w->status != PIA_OK || data == NULL) return;
    if (w->writer != NULL)
        pia_checkpoint_put(w->writer, name, type, data, count);
    else
        w->status = pia_checkpoint_copy(w->checkpoint, name, type, data, count);
}

/* An array that may be missing; resuming takes it with pia_take. */
static void optional(walk *w, const char *name, pia_section_type type, void *pointer, pia_index count)
{
    void *data;
    memcpy(&data, pointer, sizeof data);
    if (w->writer != NULL || w->status != PIA_OK) {
        array(w, name, type, data, count);
        return;
    }
    pia_index stored;
    if (!pia_checkpoint_has(w->checkpoint, name, type, &stored)) return;
    if (stored != count) {
        w->status = pia_fail(w->context, PIA_E_FORMAT, "checkpoint: section %s has %lld values, not %lld; it was not written by a fit",
                             name, (long long)stored, (long long)count);
        return;
    }
    w->status = pia_checkpoint_get(w->checkpoint, name, type, &data, &stored);
    if (w->status == PIA_OK) memcpy(pointer, &data, sizeof data);
}

static void put_history(void *user, const char *name, double *numbers, pia_index count)
{
    char section[PIA_SECTION_NAME_SIZE];
    snprintf(section, sizeof section, "history.%s", name);
    array(user, section, PIA_SECTION_DOUBLE, numbers, count);
}

static void put_limit_history(void *user, const char *name, double *numbers, pia_index count)
{
    char section[PIA_SECTION_NAME_SIZE];
    snprintf(section, sizeof section, "limit.%s", name);
    array(user, section, PIA_SECTION_DOUBLE, numbers, count);
}

enum { INDEX_COUNT = 27 };

static void shape(walk *w, pia_fit *fit)
{
    pia_index v[INDEX_COUNT] = {fit->kind,      fit->directions, fit->dim,       fit->function_graph,   fit->count[0],
                                fit->count[1],  fit->rows,       fit->given,     fit->dropped_count,    fit->has_holes,
                                fit->square,    fit->degree[0],  fit->degree[1], fit->closed[0],        fit->closed[1],
                                fit->full[0],   fit->full[1],    fit->map[0],    fit->map[1],           fit->offset[0],
                                fit->offset[1], fit->refining,   fit->round,     fit->constraint_count, fit->parameters_moved,
                                fit->pinned,    fit->was_grid};
    array(w, "shape", PIA_SECTION_INDEX, v, INDEX_COUNT);
    if (w->writer != NULL || w->status != PIA_OK) return;
    fit->kind = (pia_kind)v[0];
    fit->directions = (int)v[1];
    fit->dim = (int)v[2];
    fit->function_graph = (int)v[3];
    fit->rows = v[6];
    fit->given = v[7];
    fit->dropped_count = v[8];
    fit->has_holes = (int)v[9];
    fit->square = (int)v[10];
    fit->refining = (int)v[21];
    fit->round = v[22];
    fit->constraint_count = v[23];
    fit->parameters_moved = (int)v[24];
    fit->pinned = (int)v[25];
    fit->was_grid = (int)v[26];
    for (int d = 0; d < 2; d++) {
        fit->count[d] = v[4 + d];
        fit->degree[d] = (int)v[11 + d];
        fit->closed[d] = (int)v[13 + d];
        fit->full[d] = v[15 + d];
        fit->map[d] = (pia_map)v[17 + d];
        fit->offset[d] = v[19 + d];
    }
}

/* The numbers of a resumed shape must be possible before anything is allocated from them. */
static pia_status check_shape(pia_context *context, const pia_fit *fit)
{
    int good = fit->kind <= PIA_SCATTERED && fit->directions >= 1 && fit->directions <= 2 && fit->dim >= 1 && fit->dim <= PIA_MAX_DIM;
    good &= fit->rows >= 2 && fit->dropped_count >= 0 && fit->constraint_count >= 0 && fit->count[0] >= 1 && fit->count[1] >= 1;
    pia_index product = 0;
    good &= fit->kind == PIA_SCATTERED || (pia_multiply(fit->count[0], fit->count[1], &product) && product == fit->rows);
    good &= fit->directions == (fit->kind == PIA_CURVE ? 1 : 2);
    for (int d = 0; d < fit->directions && good; d++)
        good &= fit->degree[d] >= 1 && fit->degree[d] <= PIA_MAX_DEGREE && fit->full[d] > fit->degree[d] &&
                fit->map[d] <= PIA_MAP_DOUBLED && fit->offset[d] >= 0 && fit->full[d] <= INT64_MAX / 256;
    return good ? PIA_OK : pia_fail(context, PIA_E_FORMAT, "checkpoint: its shape is not that of a fit");
}

static void data(walk *w, pia_fit *fit)
{
    pia_index first = fit->kind == PIA_SCATTERED ? 2 * fit->rows : fit->count[0];
    array(w, "origin", PIA_SECTION_DOUBLE, fit->origin, PIA_MAX_DIM);
    array(w, "low", PIA_SECTION_DOUBLE, fit->low, PIA_MAX_DIM);
    array(w, "high", PIA_SECTION_DOUBLE, fit->high, PIA_MAX_DIM);
    array(w, "extent", PIA_SECTION_DOUBLE, &fit->extent, 1);
    optional(w, "points", PIA_SECTION_DOUBLE, &fit->own_points, fit->rows * fit->dim);
    optional(w, "row", PIA_SECTION_INDEX, &fit->row, fit->rows);
    optional(w, "dropped", PIA_SECTION_INDEX, &fit->dropped, fit->dropped_count);
    optional(w, "weights", PIA_SECTION_DOUBLE, &fit->weights, fit->rows);
    optional(w, "tolerances", PIA_SECTION_DOUBLE, &fit->tolerances, fit->rows);
    optional(w, "inverse_tolerance", PIA_SECTION_DOUBLE, &fit->inverse_tolerance, fit->rows);
    optional(w, "axis_tolerances", PIA_SECTION_DOUBLE, &fit->axis_tolerances, fit->dim);
    optional(w, "parameters_0", PIA_SECTION_DOUBLE, &fit->parameter[0], first);
    optional(w, "parameters_1", PIA_SECTION_DOUBLE, &fit->parameter[1], fit->count[1]);
    for (int d = 0; d < fit->directions; d++)
        optional(w, d == 0 ? "knots_0" : "knots_1", PIA_SECTION_DOUBLE, &fit->knots[d], fit->full[d] + fit->degree[d] + 1);
    fit->points = fit->own_points;
}

/* The robust loss; the weights for the operator follow from it and the given ones. */
static void robust(walk *w, pia_fit *fit)
{
    pia_robust *r = &fit->robust;
    pia_index v[5] = {r->loss, r->convex, r->settled, r->round, r->outliers};
    array(w, "robust_counts", PIA_SECTION_INDEX, v, 5);
    array(w, "robust", PIA_SECTION_DOUBLE, &r->tuning, 1);
    optional(w, "robust_weight", PIA_SECTION_DOUBLE, &r->weight, fit->rows);
    if (w->writer != NULL || w->status != PIA_OK) return;
    r->loss = v[0] == PIA_LOSS_HUBER ? PIA_LOSS_HUBER : v[0] == PIA_LOSS_TUKEY ? PIA_LOSS_TUKEY : PIA_LOSS_NONE;
    r->convex = (int)v[1];
    r->settled = (int)v[2];
    r->round = v[3];
    r->outliers = r->weight != NULL ? v[4] : 0;
    r->rows = r->weight != NULL ? fit->rows : 0;
}

/* Control parameters of a direction, a number a line. */
static void sequence_lines(walk *w, pia_fit *fit, int d)
{
    pia_sequence *s = fit->sequence;
    pia_index *flags = pia_take(w->context, s->lines[d], sizeof *flags);
    if (flags == NULL) w->status = PIA_E_MEMORY;
    if (w->status == PIA_OK) pia_sequence_flags(s, d, flags);
    array(w, d == 0 ? "lines_0" : "lines_1", PIA_SECTION_INDEX, flags, s->lines[d]);
    array(w, d == 0 ? "curvature_0" : "curvature_1", PIA_SECTION_DOUBLE, s->curvature[d], s->lines[d]);
    if (w->writer == NULL && w->status == PIA_OK && pia_sequence_restore(s, d, flags) != fit->full[d])
        w->status = pia_fail(w->context, PIA_E_FORMAT, "checkpoint: its control parameters do not fit its knots");
    pia_give(w->context, flags);
}

static void sequence(walk *w, pia_fit *fit)
{
    if (w->status == PIA_OK && w->writer == NULL && pia_fit_by_line(fit)) w->status = pia_sequence_open(fit);
    pia_sequence *s = fit->sequence;
    if (s == NULL || w->status != PIA_OK) return;
    for (int d = 0; d < fit->directions && w->status == PIA_OK; d++) sequence_lines(w, fit, d);
    double v[2] = {s->last_error, s->grows};
    array(w, "lines_loop", PIA_SECTION_DOUBLE, v, 2);
    s->last_error = v[0];
    s->grows = v[1] != 0;
    pia_index zone[PIA_ZONE_NUMBERS];
    pia_zone_numbers(fit, zone);
    array(w, "lines_zone", PIA_SECTION_INDEX, zone, PIA_ZONE_NUMBERS);
    if (w->writer == NULL && w->status == PIA_OK) pia_zone_restore(fit, zone);
}

static void rules(walk *w, pia_fit *fit)
{
    pia_rules *r = &fit->solve.rules;
    pia_index counts[5] = {r->iterations, r->trace_every, fit->options.measure_distance, fit->options.correct,
                           fit->options.max_iterations};
    double v[9] = {r->tolerance,         r->change,    r->gradient,         r->time_limit, fit->options.tolerance, fit->options.soft,
                   fit->options.fairing, fit->seconds, fit->options.between};
    array(w, "rule_counts", PIA_SECTION_INDEX, counts, 5);
    array(w, "rules", PIA_SECTION_DOUBLE, v, 9);
    array(w, "method_numbers", PIA_SECTION_DOUBLE, fit->method_values.number, PIA_MAX_VALUES);
    array(w, "limiter_numbers", PIA_SECTION_DOUBLE, fit->limiter_values.number, PIA_MAX_VALUES);
    pia_index words[2 * PIA_MAX_VALUES];
    for (int i = 0; i < PIA_MAX_VALUES; i++) {
        words[i] = fit->method_values.is_word[i];
        words[PIA_MAX_VALUES + i] = fit->limiter_values.is_word[i];
    }
    array(w, "words", PIA_SECTION_INDEX, words, 2 * PIA_MAX_VALUES);
    if (w->writer != NULL || w->status != PIA_OK) return;
    *r = (pia_rules){
        .tolerance = v[0], .iterations = counts[0], .change = v[1], .gradient = v[2], .time_limit = v[3], .trace_every = counts[1]};
    if (!pia_fit_is_tolerance_alike(fit)) r->keeps = pia_fit_keeps_tolerances;
    fit->options.measure_distance = (int)counts[2];
    fit->options.correct = counts[3];
    fit->options.max_iterations = counts[4];
    fit->options.tolerance = v[4];
    fit->options.soft = v[5];
    fit->options.fairing = v[6];
    fit->seconds = v[7];
    fit->options.between = v[8];
    for (int i = 0; i < PIA_MAX_VALUES; i++) {
        fit->method_values.is_word[i] = (int)words[i];
        fit->limiter_values.is_word[i] = (int)words[PIA_MAX_VALUES + i];
    }
}

/* What the data do not hold and what holds it; the operator is there. */
static void support(walk *w, pia_fit *fit)
{
    array(w, "unsupported_count", PIA_SECTION_INDEX, &fit->unsupported_count, 1);
    array(w, "pull", PIA_SECTION_DOUBLE, &fit->pull, 1);
    if (w->status != PIA_OK) return;
    if (fit->unsupported_count < 0 || fit->unsupported_count > fit->op->cols || !(fit->pull >= 0)) {
        fit->unsupported_count = 0;
        w->status = pia_fail(w->context, PIA_E_FORMAT, "checkpoint: its unsupported control points are not possible");
        return;
    }
    optional(w, "unsupported", PIA_SECTION_INDEX, &fit->unsupported, fit->unsupported_count);
    optional(w, "pull_start", PIA_SECTION_DOUBLE, &fit->pull_start, fit->op->cols * fit->dim);
    if (fit->unsupported == NULL) fit->unsupported_count = 0;
    if (w->writer == NULL && w->status == PIA_OK && fit->pull_start != NULL) w->status = pia_fit_open_normal(fit);
}

enum { CONSTRAINT_COUNTS = 6 };

/* Constraints as three tables: what, where, and the values given (zeros where none was). */
static void put_constraints(const pia_fit *fit, pia_index *counts, double *at, double *value)
{
    for (pia_index i = 0; i < fit->constraint_count; i++) {
        const pia_fit_constraint *c = &fit->constraint[i];
        pia_index v[CONSTRAINT_COUNTS] = {c->asked.at_point, c->asked.derivative[0], c->asked.derivative[1], c->asked.direction_only,
                                          c->released,       c->value != NULL};
        memcpy(counts + i * CONSTRAINT_COUNTS, v, sizeof v);
        memcpy(at + 2 * i, c->asked.at_parameter, 2 * sizeof *at);
        if (c->value != NULL) memcpy(value + i * fit->dim, c->value, (size_t)fit->dim * sizeof *value);
    }
}

static pia_status get_constraints(pia_fit *fit, const pia_index *counts, const double *at, const double *value)
{
    for (pia_index i = 0; i < fit->constraint_count; i++) {
        const pia_index *v = counts + i * CONSTRAINT_COUNTS;
        pia_fit_constraint *c = &fit->constraint[i];
        pia_constraint_init(&c->asked);
        c->asked.at_point = v[0];
        c->asked.derivative[0] = (int)v[1];
        c->asked.derivative[1] = (int)v[2];
        c->asked.direction_only = (int)v[3];
        c->released = (int)v[4];
        memcpy(c->asked.at_parameter, at + 2 * i, 2 * sizeof *at);
        if (v[5] == 0) continue;
        c->value = pia_take(fit->context, fit->dim, sizeof *c->value);
        if (c->value == NULL) return PIA_E_MEMORY;
        memcpy(c->value, value + i * fit->dim, (size_t)fit->dim * sizeof *value);
    }
    return PIA_OK;
}

static void constraints(walk *w, pia_fit *fit)
{
    pia_index count = fit->constraint_count;
    if (count == 0 || w->status != PIA_OK) return;
    pia_index *counts = pia_take(w->context, count, CONSTRAINT_COUNTS * sizeof *counts);
    double *at = pia_take(w->context, count, 2 * sizeof *at),
           *value = pia_take_zero(w->context, count, (size_t)fit->dim * sizeof *value);
    if (w->writer == NULL) fit->constraint = pia_take_zero(w->context, count, sizeof *fit->constraint);
    if (counts == NULL || at == NULL || value == NULL || fit->constraint == NULL) {
        w->status = PIA_E_MEMORY;
        if (fit->constraint == NULL) fit->constraint_count = 0;
    } else {
        fit->constraint_room = count;
        if (w->writer != NULL) put_constraints(fit, counts, at, value);
        array(w, "constraints", PIA_SECTION_INDEX, counts, count * CONSTRAINT_COUNTS);
        array(w, "constraints_at", PIA_SECTION_DOUBLE, at, count * 2);
        array(w, "constraints_value", PIA_SECTION_DOUBLE, value, count * fit->dim);
        if (w->writer == NULL && w->status == PIA_OK) w->status = get_constraints(fit, counts, at, value);
    }
    pia_give(w->context, counts);
    pia_give(w->context, at);
    pia_give(w->context, value);
}

/* The iterate and what the loop remembers; resuming does this after the method has begun. */
static void progress(walk *w, pia_fit *fit)
{
    pia_solve *s = &fit->solve;
    pia_iterate *it = &fit->iterate;
    pia_index size = fit->op->cols * fit->dim;
    pia_index v[7] = {it->iteration, (pia_index)s->stop,  s->best_iteration, s->first_iteration,
                      s->blocked,    s->window_iteration, s->standing};
    double r[10] = {s->seconds,    s->start_error, s->rate,        s->safe_error,         s->last_error,
                    s->best_error, it->damping,    it->adjust_max, it->relative_gradient, s->window_error};
    array(w, "points_now", PIA_SECTION_DOUBLE, it->points, size);
    optional(w, "safe", PIA_SECTION_DOUBLE, &s->safe, size);
    array(w, "loop_counts", PIA_SECTION_INDEX, v, 7);
    array(w, "loop", PIA_SECTION_DOUBLE, r, 10);
    if (s->method->history != NULL && s->method_state != NULL) s->method->history(it, s->method_state, put_history, w);
    if (s->limiter != NULL && s->limiter->history != NULL) s->limiter->history(it, s->limiter_state, put_limit_history, w);
    if (w->writer != NULL || w->status != PIA_OK) return;
    it->iteration = v[0];
    s->stop = (pia_stop)v[1];
    s->best_iteration = v[2];
    s->first_iteration = v[3];
    s->blocked = v[4];
    s->window_iteration = v[5];
    s->standing = (int)v[6];
    s->seconds = r[0];
    s->start_error = r[1];
    s->rate = r[2];
    s->safe_error = r[3];
    s->last_error = r[4];
    s->best_error = r[5];
    it->damping = r[6];
    it->adjust_max = r[7];
    it->relative_gradient = r[8];
    s->window_error = r[9];
    it->errors_known = 0;
}

/* Where a refinement is, and what its next search by relaxation begins with. */
static void stage(walk *w, pia_fit *fit)
{
    pia_stage *g = &fit->stage;
    pia_index v[5] = {g->watch.controls, g->sparing, g->spares, g->feet, (pia_index)g->settled};
    double r[3] = {g->watch.worst, g->watch.squares, fit->relaxation};
    array(w, "stage_counts", PIA_SECTION_INDEX, v, 5);
    array(w, "stage", PIA_SECTION_DOUBLE, r, 3);
    optional(w, "relaxed", PIA_SECTION_DOUBLE, &fit->relaxed, fit->rows * fit->dim);
    if (w->writer != NULL || w->status != PIA_OK) return;
    *g = (pia_stage){{r[0], r[1], v[0]}, v[1], v[2] != 0, v[3] != 0, (pia_stop)v[4]};
    fit->relaxation = r[2];
}

static void put_text(walk *w, const char *name, const char *text)
{
    pia_checkpoint_put(w->writer, name, PIA_SECTION_TEXT, text, (pia_index)strlen(text));
}

/* The trace, seven numbers a row. */
static void trace(walk *w, pia_fit *fit)
{
    enum { NUMBERS = 7 };
    pia_trace *t = &fit->solve.trace;
    pia_index count = t->count * NUMBERS;
    if (w->writer == NULL && !pia_checkpoint_has(w->checkpoint, "trace", PIA_SECTION_DOUBLE, &count)) return;
    if (w->status != PIA_OK || count == 0 || count % NUMBERS != 0) return;
    double *v = pia_take(w->context, count, sizeof *v);
    if (v == NULL) {
        w->status = PIA_E_MEMORY;
        return;
    }
    for (pia_index i = 0; w->writer != NULL && i < t->count; i++) {
        const pia_trace_row *r = &t->row[i];
        double row[NUMBERS] = {(double)r->iteration, (double)r->control_count, r->max_error, r->rms_error,
                               r->adjust_max,        r->constraint_error,      r->seconds};
        memcpy(v + i * NUMBERS, row, sizeof row);
    }
    array(w, "trace", PIA_SECTION_DOUBLE, v, count);
    for (pia_index i = 0; w->writer == NULL && w->status == PIA_OK && i < count; i += NUMBERS) {
        pia_trace_row row = {(pia_index)v[i], (pia_index)v[i + 1], v[i + 2], v[i + 3], v[i + 4], v[i + 5], v[i + 6]};
        if (!pia_trace_add(pia_memory_of(w->context), t, &row)) w->status = PIA_E_MEMORY;
    }
    pia_give(w->context, v);
}

/* Notes as one text, a line each. */
static void put_notes(walk *w, const pia_fit *fit)
{
    size_t size = 1, used = 0;
    for (pia_index i = 0; i < fit->notes.count; i++) size += strlen(fit->notes.line[i]) + 1;
    char *text = pia_take(w->context, (pia_index)size, 1);
    if (text == NULL) {
        w->status = PIA_E_MEMORY;
        return;
    }
    for (pia_index i = 0; i < fit->notes.count; i++) {
        size_t length = strlen(fit->notes.line[i]);
        memcpy(text + used, fit->notes.line[i], length);
        text[used + length] = '\n';
        used += length + 1;
    }
    pia_checkpoint_put(w->writer, "notes", PIA_SECTION_TEXT, text, (pia_index)used);
    pia_give(w->context, text);
}

static void put_rest(walk *w, pia_fit *fit)
{
    pia_report names;
    pia_fit_names(fit, &names);
    put_text(w, "method", names.method);
    put_text(w, "parametrization", names.parametrization);
    put_text(w, "placement", names.placement);
    put_text(w, "limiter", names.limiter);
    put_notes(w, fit);
    if (fit->op->frozen == NULL) return;
    pia_index *frozen = pia_take(w->context, fit->op->cols, sizeof *frozen);
    if (frozen == NULL) {
        w->status = PIA_E_MEMORY;
        return;
    }
    for (pia_index c = 0; c < fit->op->cols; c++) frozen[c] = fit->op->frozen[c];
    pia_checkpoint_put(w->writer, "frozen", PIA_SECTION_INDEX, frozen, fit->op->cols);
    pia_give(w->context, frozen);
}

pia_status pia_fit_save(pia_fit *fit, const char *path)
{
    pia_output *output;
    if (path == NULL) return pia_fail(fit->context, PIA_E_ARGUMENT, "no path to save the fit to");
    pia_status status = pia_fit_whole(fit);
    if (status == PIA_OK) status = pia_output_open(fit->context, path, &output);
    if (status != PIA_OK) return status;
    pia_checkpoint_writer writer;
    walk w = {fit->context, &writer, NULL, PIA_OK};
    pia_checkpoint_begin(&writer, output);
    shape(&w, fit);
    data(&w, fit);
    robust(&w, fit);
    rules(&w, fit);
    sequence(&w, fit);
    support(&w, fit);
    constraints(&w, fit);
    progress(&w, fit);
    stage(&w, fit);
    trace(&w, fit);
    put_rest(&w, fit);
    pia_checkpoint_end(&writer);
    if (w.status == PIA_OK) return pia_output_commit(output);
    pia_output_abandon(output);
    return w.status;
}

/* ---- resuming ---- */

static pia_status get_name(walk *w, const char *section, char *out, size_t size)
{
    void *text;
    pia_index length;
    pia_status status = pia_checkpoint_get(w->checkpoint, section, PIA_SECTION_TEXT, &text, &length);
    if (status != PIA_OK) return status;
    int fits = (size_t)length < size;
    if (fits) memcpy(out, text, (size_t)length + 1);
    pia_give(w->context, text);
    return fits ? PIA_OK : pia_fail(w->context, PIA_E_FORMAT, "checkpoint: the name in section %s is too long", section);
}

static pia_status get_records(walk *w, pia_fit *fit)
{
    char method[32], parametrization[32], placement[32], limiter[32];
    pia_status status = get_name(w, "method", method, sizeof method);
    if (status == PIA_OK) status = get_name(w, "parametrization", parametrization, sizeof parametrization);
    if (status == PIA_OK) status = get_name(w, "placement", placement, sizeof placement);
    if (status == PIA_OK) status = get_name(w, "limiter", limiter, sizeof limiter);
    if (status != PIA_OK) return status;
    fit->solve.method = pia_method_find(method);
    fit->parametrization = pia_param_find(parametrization);
    fit->cloud = pia_cloud_find(parametrization);
    fit->placement = pia_place_find(placement);
    fit->solve.limiter = strcmp(limiter, "none") == 0 ? NULL : pia_limit_find(limiter);
    if (fit->solve.method != NULL && (fit->solve.limiter != NULL || strcmp(limiter, "none") == 0)) return PIA_OK;
    return pia_fail(w->context, PIA_E_UNAVAILABLE, "checkpoint: this build has no method %s or no limiter %s", method, limiter);
}

static void get_notes(walk *w, pia_fit *fit)
{
    void *text;
    pia_index length;
    if (w->status != PIA_OK) return;
    w->status = pia_checkpoint_get(w->checkpoint, "notes", PIA_SECTION_TEXT, &text, &length);
    if (w->status != PIA_OK) return;
    char *end;
    for (char *line = text; (end = strchr(line, '\n')) != NULL; line = end + 1) pia_fit_note_add(fit, "%.*s", (int)(end - line), line);
    pia_give(w->context, text);
}

static pia_status thaw(walk *w, pia_fit *fit)
{
    void *frozen;
    pia_index count;
    if (!pia_checkpoint_has(w->checkpoint, "frozen", PIA_SECTION_INDEX, &count)) return PIA_OK;
    if (count != fit->op->cols) return pia_fail(w->context, PIA_E_FORMAT, "checkpoint: frozen control points do not fit the model");
    pia_status status = pia_checkpoint_get(w->checkpoint, "frozen", PIA_SECTION_INDEX, &frozen, &count);
    for (pia_index c = 0; status == PIA_OK && c < count; c++) status = pia_op_freeze(fit->op, c, ((pia_index *)frozen)[c] != 0);
    if (status == PIA_OK) pia_give(w->context, frozen);
    return status;
}

static pia_status rebuild(walk *w, pia_fit *fit)
{
    shape(w, fit);
    if (w->status == PIA_OK) w->status = check_shape(w->context, fit);
    if (w->status == PIA_OK) w->status = get_records(w, fit);
    data(w, fit);
    robust(w, fit);
    rules(w, fit);
    if (w->status == PIA_OK &&
        (fit->own_points == NULL || fit->parameter[0] == NULL || fit->knots[0] == NULL ||
         (fit->directions == 2 && fit->knots[1] == NULL) || (fit->kind == PIA_GRID && fit->parameter[1] == NULL)))
        w->status = pia_fail(w->context, PIA_E_FORMAT, "checkpoint: points, parameters or knots are missing");
    sequence(w, fit);
    if (w->status == PIA_OK) w->status = pia_fit_assemble(fit);
    if (w->status == PIA_OK) support(w, fit);
    constraints(w, fit);
    if (w->status == PIA_OK) array(w, "points_now", PIA_SECTION_DOUBLE, fit->iterate.points, fit->op->cols * fit->dim);
    if (w->status == PIA_OK) w->status = thaw(w, fit);
    if (w->status == PIA_OK) w->status = pia_fit_bind(fit);
    if (w->status != PIA_OK) return w->status;
    fit->solve.iterate = &fit->iterate;
    w->status = pia_solve_begin(&fit->solve, &fit->method_values, &fit->limiter_values);
    progress(w, fit);
    stage(w, fit);
    trace(w, fit);
    get_notes(w, fit);
    return w->status;
}

pia_status pia_fit_resume(pia_context *context, const char *path, pia_fit **out)
{
    if (context == NULL || path == NULL || out == NULL) return pia_fail(context, PIA_E_ARGUMENT, "context, path or out is NULL");
    walk w = {context, NULL, NULL, PIA_OK};
    pia_status status = pia_checkpoint_open(context, path, &w.checkpoint);
    if (status != PIA_OK) return status;
    pia_fit *fit = pia_take_zero(context, 1, sizeof *fit);
    status = fit != NULL ? PIA_OK : PIA_E_MEMORY;
    if (status == PIA_OK) {
        fit->context = context;
        pia_fit_options_init(&fit->options);
        status = rebuild(&w, fit);
    }
    pia_checkpoint_close(w.checkpoint);
    if (status == PIA_OK)
        *out = fit;
    else
        pia_fit_close(fit);
    return status;
}
