/* Knots and operators: placed, given, or those of the start model. */
#include "fit.h"

#include "kernel.h"
#include "knots.h"
#include "model.h"
#include "op_scatter.h"
#include "sequence.h"

#include <math.h>
#include <string.h>

enum { CHEAP_DEGREE = 4 }; /* up to here basis values are computed sooner than fetched from memory */

pia_status pia_fit_take_knots(pia_fit *fit, int d, pia_index full)
{
    fit->full[d] = full;
    pia_give(fit->context, fit->knots[d]);
    fit->knots[d] = pia_take(fit->context, full + fit->degree[d] + 1, sizeof(double));
    return fit->knots[d] != NULL ? PIA_OK : PIA_E_MEMORY;
}

static pia_index wanted_control(const pia_fit *fit, int d)
{
    pia_index asked = fit->options.control[d], rows = fit->kind == PIA_SCATTERED ? fit->rows : fit->count[d];
    if (asked != PIA_AUTO) return asked;
    if (fit->square) return rows;
    if (fit->refining) {
        pia_index start = fit->closed[d] && fit->degree[d] < 3 ? 4 : fit->degree[d] + 1;
        return fit->closed[d] && fit->kind != PIA_SCATTERED && start > rows ? rows : start;
    }
    pia_index tenth = rows / 10, least = fit->degree[d] + 1;
    return tenth > least ? tenth : least < rows ? least : rows;
}

pia_status pia_fit_check_control(pia_fit *fit, int d, pia_index control)
{
    pia_context *context = fit->context;
    pia_index least = fit->closed[d] ? 3 : fit->degree[d] + 1, rows = fit->count[d];
    if (fit->closed[d] && least < fit->degree[d]) least = fit->degree[d];
    int chosen = fit->square || pia_fit_by_line(fit) || fit->options.control[d] == PIA_AUTO; /* by us, not by the caller */
    if (rows < least && fit->kind != PIA_SCATTERED && chosen)
        return pia_fail(context, PIA_E_DATA,
                        "%lld distinct points are too few for degree %d; lower the degree to %lld or give more points", (long long)rows,
                        fit->degree[d], (long long)(rows > 1 ? rows - 1 : 1));
    if (fit->square && control != rows)
        return pia_fail(context, PIA_E_ARGUMENT,
                        "method %s interpolates: it takes %lld control points, not %lld; use lspia or direct for fewer",
                        fit->solve.method->name, (long long)rows, (long long)control);
    if (control < least)
        return pia_fail(context, PIA_E_ARGUMENT, "%lld control points are too few for degree %d; ask for at least %lld",
                        (long long)control, fit->degree[d], (long long)least);
    if (fit->kind != PIA_SCATTERED && control > rows)
        return pia_fail(context, PIA_E_ARGUMENT, "%lld control points are more than the %lld distinct points; ask for fewer",
                        (long long)control, (long long)rows);
    return PIA_OK;
}

static pia_status place_direction(pia_fit *fit, int d)
{
    pia_index control = wanted_control(fit, d);
    pia_status status = pia_fit_check_control(fit, d, control);
    if (status != PIA_OK) return status;
    int doubled = strcmp(fit->placement->name, "pia2004") == 0;
    if (doubled) control += 2;
    fit->map[d] = doubled ? PIA_MAP_DOUBLED : fit->closed[d] ? PIA_MAP_CYCLIC : PIA_MAP_IDENTITY;
    status = pia_fit_take_knots(fit, d, control + (fit->closed[d] ? fit->degree[d] : 0));
    if (status != PIA_OK) return status;
    pia_place_problem problem = {fit->degree[d], fit->closed[d], control, fit->parameter[d], fit->count[d]};
    return fit->placement->place(fit->context, &problem, fit->knots[d]);
}

static pia_status given_direction(pia_fit *fit, int d, const double *knots, pia_index count)
{
    pia_index full = count - fit->degree[d] - 1, n = fit->closed[d] ? full - fit->degree[d] : full;
    if (knots == NULL || full <= fit->degree[d])
        return pia_fail(fit->context, PIA_E_SHAPE,
                        "%lld knots are too few for degree %d; a clamped vector has control points + degree + 1", (long long)count,
                        fit->degree[d]);
    if (fit->options.control[d] != PIA_AUTO && fit->options.control[d] != n)
        return pia_fail(fit->context, PIA_E_SHAPE,
                        "%lld knots make %lld control points of degree %d, but %lld were asked; leave one out", (long long)count,
                        (long long)n, fit->degree[d], (long long)fit->options.control[d]);
    fit->map[d] = fit->closed[d] ? PIA_MAP_CYCLIC : PIA_MAP_IDENTITY;
    pia_status status = pia_fit_check_control(fit, d, n);
    if (status == PIA_OK) status = pia_fit_take_knots(fit, d, full);
    if (status != PIA_OK) return status;
    if (!fit->closed[d]) return pia_knots_copy(fit->context, fit->degree[d], knots, count, full, fit->knots[d]);
    pia_copy(fit->context, fit->knots[d], knots, count);
    return PIA_OK;
}

pia_status pia_fit_adopt_knots(pia_fit *fit, const pia_model *start)
{
    double *knots[2] = {NULL, NULL};
    if (start->directions != fit->directions || start->dim != fit->dim + fit->function_graph || start->rational)
        return pia_fail(fit->context, PIA_E_SHAPE,
                        "the start model is a %s%s of dimension %d; the data need a polynomial %s of dimension %d",
                        start->rational ? "rational " : "", start->directions == 1 ? "curve" : "surface", start->dim,
                        fit->directions == 1 ? "curve" : "surface", fit->dim + fit->function_graph);
    for (int d = 0; d < fit->directions; d++) {
        fit->degree[d] = start->degree[d];
        fit->closed[d] = start->periodic[d];
        pia_index n = start->control[d] - (start->periodic[d] ? start->degree[d] : 0);
        fit->map[d] = fit->closed[d] ? PIA_MAP_CYCLIC : PIA_MAP_IDENTITY;
        if (fit->square && n == fit->count[d] + 2 && fit->degree[d] == 3) fit->map[d] = PIA_MAP_DOUBLED;
        pia_status status = fit->map[d] == PIA_MAP_DOUBLED ? PIA_OK : pia_fit_check_control(fit, d, n);
        if (status == PIA_OK) status = pia_fit_take_knots(fit, d, start->control[d]);
        if (status != PIA_OK) return status;
        knots[d] = fit->knots[d];
    }
    double *points = pia_take(fit->context, start->control[0] * start->control[1] * start->dim, sizeof(double));
    if (points == NULL) return PIA_E_MEMORY;
    pia_status status = pia_model_to_cyclic(fit->context, start, knots, points);
    pia_give(fit->context, points);
    return status;
}

/* Parameters computed for [0, 1] are carried over to the domain of knots that came from elsewhere. */
static pia_status fit_into_domain(pia_fit *fit, int d)
{
    double low = fit->knots[d][fit->degree[d]], high = fit->knots[d][fit->full[d]];
    pia_index count = fit->kind == PIA_SCATTERED ? fit->rows : fit->count[d], stride = fit->kind == PIA_SCATTERED ? 2 : 1;
    double *t = fit->kind == PIA_SCATTERED ? fit->parameter[0] + d : fit->parameter[d];
    if (fit->parametrization != NULL && !fit->closed[d] && !(low == 0 && high == 1) && fit->placement == NULL)
        for (pia_index i = 0; i < count; i++) t[i * stride] = i == count - 1 ? high : low + (high - low) * t[i * stride];
    if (stride == 1 && t[0] >= low && t[count - 1] <= high) return PIA_OK; /* they are in order */
    for (pia_index i = 0; i < count && !fit->closed[d]; i++)
        if (!(t[i * stride] >= low && t[i * stride] <= high))
            return pia_fail(fit->context, PIA_E_DATA,
                            "parameter %.17g of row %lld lies outside the domain [%.17g, %.17g]; give knots that reach it",
                            t[i * stride], (long long)i, low, high);
    return PIA_OK;
}

static void rotate(void *base, pia_index count, size_t size, pia_index by, void *spare)
{
    char *bytes = base;
    memcpy(spare, bytes, (size_t)by * size);
    memmove(bytes, bytes + (size_t)by * size, (size_t)(count - by) * size);
    memcpy(bytes + (size_t)(count - by) * size, spare, (size_t)by * size);
}

/* Closed: the period that the knots cover starts where they start. Parameters are brought into it, and rows turned so that they rise.
 */
pia_status pia_fit_turn(pia_fit *fit, int d)
{
    double *t = fit->parameter[d], low = fit->knots[d][fit->degree[d]];
    pia_index lines = fit->count[d], other = fit->rows / lines, shift = 0;
    for (pia_index i = 0; i < lines; i++) {
        t[i] -= floor(t[i] - low);
        if (t[i] >= low + 1) t[i] -= 1;
        if (t[i] < low) t[i] = low;
    }
    for (pia_index i = 1; i < lines && shift == 0; i++)
        if (t[i] < t[i - 1]) shift = i;
    fit->offset[d] = shift; /* of this turn: interpolation turns once */
    if (shift == 0) return PIA_OK;
    size_t point = (size_t)fit->dim * sizeof(double);
    pia_index block = d == 0 ? other : 1, blocks = d == 0 ? 1 : other;
    pia_status status = pia_fit_own_rows(fit);
    if (status != PIA_OK) return status;
    void *spare = pia_take(fit->context, fit->rows, point);
    if (spare == NULL) return PIA_E_MEMORY;
    rotate(t, lines, sizeof *t, shift, spare);
    for (pia_index b = 0; b < blocks; b++) {
        pia_index at = b * lines;
        rotate(fit->own_points + at * fit->dim, lines * block, point, shift * block, spare);
        rotate(fit->row + at, lines * block, sizeof *fit->row, shift * block, spare);
        double *per_row[] = {fit->weights, fit->tolerances, fit->inverse_tolerance};
        for (size_t k = 0; k < sizeof per_row / sizeof *per_row; k++)
            if (per_row[k] != NULL) rotate(per_row[k] + at, lines * block, sizeof(double), shift * block, spare);
    }
    pia_give(fit->context, spare);
    return PIA_OK;
}

/* Scattered parameters are placed by their range alone. */
static pia_status place_scattered(pia_fit *fit, int d)
{
    double range[2] = {INFINITY, -INFINITY};
    for (pia_index i = 0; i < fit->rows; i++) {
        range[0] = fmin(range[0], fit->parameter[0][2 * i + d]);
        range[1] = fmax(range[1], fit->parameter[0][2 * i + d]);
    }
    if (!(range[0] < range[1]))
        return pia_fail(fit->context, PIA_E_DATA, "all %c parameters equal %g; a surface needs a range", 'u' + d, range[0]);
    if (fit->closed[d] && !(range[0] >= 0 && range[1] <= 1))
        return pia_fail(fit->context, PIA_E_DATA, "parameters of a closed direction lie in [0, 1]; %c runs from %g to %g", 'u' + d,
                        range[0], range[1]);
    if (fit->closed[d]) {
        range[0] = 0;
        range[1] = 0.5;
    }
    pia_index control = wanted_control(fit, d);
    if (fit->options.control[d] == PIA_AUTO) {
        control = (pia_index)sqrt((double)fit->rows / 10);
        if (control < fit->degree[d] + 1) control = fit->degree[d] + 1;
    }
    pia_status status = pia_fit_check_control(fit, d, control);
    if (status != PIA_OK) return status;
    fit->map[d] = fit->closed[d] ? PIA_MAP_CYCLIC : PIA_MAP_IDENTITY;
    status = pia_fit_take_knots(fit, d, control + (fit->closed[d] ? fit->degree[d] : 0));
    if (status != PIA_OK) return status;
    pia_place_problem problem = {fit->degree[d], fit->closed[d], control, range, 2};
    return fit->placement->place(fit->context, &problem, fit->knots[d]);
}

/* Knots that follow control parameters, chosen by curvature. */
static pia_status place_by_curvature(pia_fit *fit)
{
    pia_status status = pia_sequence_open(fit);
    if (status == PIA_OK) status = pia_sequence_choose(fit);
    return status == PIA_OK ? pia_sequence_place(fit) : status;
}

/* Control parameters for knots that came from elsewhere. */
static pia_status follow_knots(pia_fit *fit)
{
    pia_status status = pia_sequence_open(fit);
    return status == PIA_OK ? pia_sequence_from_knots(fit) : status;
}

pia_status pia_fit_place(pia_fit *fit)
{
    pia_status status = PIA_OK;
    if (fit->options.start != NULL) {
        status = pia_fit_adopt_knots(fit, fit->options.start);
    } else if (fit->placement != NULL && fit->placement->by_curvature) {
        status = place_by_curvature(fit);
    } else {
        for (int d = 0; d < fit->directions && status == PIA_OK; d++) {
            if (fit->options.knots[0] != NULL)
                status = given_direction(fit, d, fit->options.knots[d], fit->options.knot_count[d]);
            else
                status = fit->kind == PIA_SCATTERED ? place_scattered(fit, d) : place_direction(fit, d);
        }
    }
    for (int d = 0; d < fit->directions && status == PIA_OK; d++) {
        status = fit_into_domain(fit, d);
        if (status == PIA_OK && fit->closed[d] && fit->kind != PIA_SCATTERED) status = pia_fit_turn(fit, d);
    }
    if (status == PIA_OK && fit->sequence == NULL && pia_fit_is_grouped(fit)) status = follow_knots(fit);
    return status;
}

/* Interpolation: unknown c is the one whose basis function is centred on row c (place_average: column (row + degree / 2)). */
static pia_index cyclic_offset(const pia_fit *fit, int d)
{
    pia_index n = fit->full[d] - fit->degree[d];
    return fit->square && fit->closed[d] ? ((-(fit->offset[d] + fit->degree[d] / 2)) % n + n) % n : 0;
}

/* Whether the basis function of unknown `row` is positive at row's parameter. */
static int is_held(const pia_collocation *c, pia_index row)
{
    double scratch[PIA_MAX_DEGREE + 1];
    pia_index span = pia_collocation_span(c, row);
    const double *value = pia_collocation_row(c, row, span, scratch);
    int held = 0;
    for (int k = 0; k <= c->degree; k++) held |= pia_collocation_unknown(c, span - c->degree + k) == row && value[k] > 0;
    return held;
}

/* Without copies, a parameter inside the support of its row's function is enough; at an end of it, the value decides. */
static int are_held(const void *data, pia_index from, pia_index to)
{
    const pia_collocation *c = data;
    for (pia_index row = from; row < to; row++) {
        double t = c->parameters[row];
        int inside = c->map == PIA_MAP_IDENTITY && c->knots[row] < t && t < c->knots[row + c->degree + 1];
        if (!inside && !is_held(c, row)) return 0;
    }
    return 1;
}

static pia_status check_held(pia_fit *fit, int d)
{
    const pia_collocation *c = &fit->line[d];
    if (!fit->square || pia_all(fit->context, c->rows, are_held, c)) return PIA_OK;
    for (pia_index row = 0; row < c->rows; row++)
        if (!is_held(c, row))
            return pia_fail(fit->context, PIA_E_DATA,
                            "knots and parameters do not belong together: control point %lld of direction %c has no hold on its data "
                            "point (Schoenberg-Whitney); place knots by --knots average",
                            (long long)row, 'u' + d);
    return PIA_OK;
}

pia_status pia_fit_operate(pia_fit *fit)
{
    pia_status status = pia_fit_take_loss(fit);
    if (status != PIA_OK) return status;
    int keep = fit->kind == PIA_GRID ? PIA_STORE_VALUES : 0;
    if (fit->kind == PIA_CURVE && (fit->solve.method->needs & PIA_NEEDS_ROWS) != 0 && fit->degree[0] > CHEAP_DEGREE)
        keep |= PIA_STORE_VALUES;
    if (fit->kind == PIA_CURVE && fit->square) keep |= PIA_WITHOUT_BEGINS;
    if (fit->kind == PIA_SCATTERED)
        return pia_op_scatter_open(fit->context, fit->degree, fit->map, (const double *const *)fit->knots, fit->full, fit->parameter[0],
                                   fit->rows, pia_fit_row_weights(fit), fit->dim, &fit->op);
    for (int d = 0; d < fit->directions && status == PIA_OK; d++) {
        status = pia_collocation_open(fit->context, fit->degree[d], fit->map[d], cyclic_offset(fit, d), fit->knots[d], fit->full[d],
                                      fit->parameter[d], fit->count[d], keep, &fit->line[d]);
    }
    if (status != PIA_OK) return status;
    const double *weights = fit->square ? NULL : pia_fit_row_weights(fit);
    if (fit->directions == 1)
        status = pia_op_curve_open(fit->context, &fit->line[0], weights, fit->dim, &fit->op);
    else
        status = pia_op_grid_open(fit->context, &fit->line[0], &fit->line[1], weights, fit->dim, &fit->op);
    for (int d = 0; d < fit->directions && status == PIA_OK && fit->placement == NULL && !pia_fit_is_trusting(fit); d++)
        status = check_held(fit, d);
    return status;
}
