#include "part.h"

#include "kernel.h"
#include "op_scatter.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { GRAIN = 32768, MAX_CHUNKS = 64 };

static const double NOWHERE[PIA_MAX_DIM]; /* targets of a part are centred already */

/* ---- which rows ---- */

/* Spans, and the control points they see, on which those of `moving` are not zero. */
static pia_block find_spans(const pia_op *whole, const pia_block *moving, pia_block *control)
{
    pia_block span = {{0, 0}, {1, 1}};
    *control = span;
    for (int d = 0; d < whole->directions; d++) {
        pia_index degree = whole->axis[d]->degree, spans = whole->axis[d]->full - degree;
        span.low[d] = moving->low[d] > degree ? moving->low[d] - degree : 0;
        span.high[d] = moving->high[d] < spans ? moving->high[d] : spans;
        control->low[d] = span.low[d];
        control->high[d] = span.high[d] + degree;
    }
    return span;
}

static pia_index first_row(const pia_collocation *line, pia_index span)
{
    return pia_collocation_begin(line, span + line->degree);
}

/* Rows of a curve, and lines of a grid. */
static pia_block find_lines(const pia_op *whole, const pia_block *span)
{
    pia_block line = {{0, 0}, {1, 1}};
    for (int d = 0; d < whole->directions; d++) {
        line.low[d] = first_row(whole->line[d], span->low[d]);
        line.high[d] = first_row(whole->line[d], span->high[d]);
    }
    return line;
}

static int compare_rows(const void *a, const void *b)
{
    pia_index x = *(const pia_index *)a, y = *(const pia_index *)b;
    return (x > y) - (x < y);
}

/* Scattered rows are sorted by cell: those of a strip of spans are neighbours. */
static pia_index count_scattered(const pia_scatter *scatter, const pia_block *span)
{
    pia_index rows = 0;
    for (pia_index s = span->low[0]; s < span->high[0]; s++) {
        const pia_index *begin = scatter->begin + s * scatter->cells[1];
        rows += begin[span->high[1]] - begin[span->low[1]];
    }
    return rows;
}

static void list_scattered(const pia_scatter *scatter, const pia_block *span, pia_part *part)
{
    pia_index k = 0;
    for (pia_index s = span->low[0]; s < span->high[0]; s++) {
        const pia_index *begin = scatter->begin + s * scatter->cells[1];
        for (pia_index at = begin[span->low[1]]; at < begin[span->high[1]]; at++) part->row[k++] = scatter->order[at];
    }
    qsort(part->row, (size_t)k, sizeof *part->row, compare_rows);
}

static void list_lines(const pia_block *line, pia_part *part)
{
    pia_index k = 0, across = part->whole->directions == 2 ? part->whole->line[1]->rows : 1;
    for (pia_index i = line->low[0]; i < line->high[0]; i++)
        for (pia_index j = line->low[1]; j < line->high[1]; j++) part->row[k++] = i * across + j;
}

/* ---- opening ---- */

static int take_arrays(pia_part *part, int dim)
{
    const pia_op *whole = part->whole;
    pia_index controls = 1;
    for (int d = 0; d < 2; d++) controls *= part->control.high[d] - part->control.low[d];
    part->row = pia_take(part->context, part->rows, sizeof *part->row);
    part->points = pia_take(part->context, part->rows * dim, sizeof *part->points);
    part->residual = pia_take(part->context, part->rows * dim, sizeof *part->residual);
    part->x = pia_take(part->context, controls * dim, sizeof *part->x);
    if (whole->weights != NULL) part->weights = pia_take(part->context, part->rows, sizeof *part->weights);
    if (whole->pairs != NULL) part->pairs = pia_take(part->context, part->rows, 2 * sizeof *part->pairs);
    return part->row != NULL && part->points != NULL && part->residual != NULL && part->x != NULL &&
           (part->weights != NULL || whole->weights == NULL) && (part->pairs != NULL || whole->pairs == NULL);
}

static void copy_rows(pia_part *part, const pia_targets *targets)
{
    const pia_op *whole = part->whole;
    int dim = targets->dim;
    for (pia_index k = 0; k < part->rows; k++) {
        pia_index row = part->row[k];
        for (int d = 0; d < dim; d++) part->points[k * dim + d] = targets->points[row * dim + d] - targets->origin[d];
        if (part->weights != NULL) part->weights[k] = whole->weights[row];
        if (part->pairs != NULL) memcpy(part->pairs + 2 * k, whole->pairs + 2 * row, 2 * sizeof *part->pairs);
    }
}

static pia_status operate(pia_part *part, const pia_block *line, int dim)
{
    const pia_op *whole = part->whole;
    int degree[2] = {0};
    pia_map map[2] = {PIA_MAP_IDENTITY, PIA_MAP_IDENTITY};
    const double *knots[2] = {NULL};
    pia_index full[2] = {1, 1};
    pia_status status = PIA_OK;
    for (int d = 0; d < whole->directions; d++) {
        degree[d] = whole->axis[d]->degree;
        knots[d] = whole->axis[d]->knots + part->control.low[d];
        full[d] = part->control.high[d] - part->control.low[d];
    }
    if (part->pairs != NULL)
        return pia_op_scatter_open(part->context, degree, map, knots, full, part->pairs, part->rows, part->weights, dim, &part->op);
    for (int d = 0; d < whole->directions && status == PIA_OK; d++)
        status =
            pia_collocation_open(part->context, degree[d], map[d], 0, knots[d], full[d], whole->line[d]->parameters + line->low[d],
                                 line->high[d] - line->low[d], whole->line[d]->values != NULL ? PIA_STORE_VALUES : 0, &part->line[d]);
    if (status != PIA_OK) return status;
    return whole->directions == 1 ? pia_op_curve_open(part->context, &part->line[0], part->weights, dim, &part->op)
                                  : pia_op_grid_open(part->context, &part->line[0], &part->line[1], part->weights, dim, &part->op);
}

static pia_status fill(pia_part *part, const pia_targets *targets, const pia_block *span)
{
    const pia_op *whole = part->whole;
    const pia_scatter *scatter = pia_op_scatter(whole);
    pia_block line = scatter == NULL ? find_lines(whole, span) : *span;
    part->rows = scatter != NULL ? count_scattered(scatter, span) : (line.high[0] - line.low[0]) * (line.high[1] - line.low[1]);
    if (part->rows == 0) return PIA_OK;
    if (!take_arrays(part, targets->dim)) return PIA_E_MEMORY;
    if (scatter != NULL)
        list_scattered(scatter, span, part);
    else
        list_lines(&line, part);
    copy_rows(part, targets);
    part->targets = (pia_targets){part->points, NOWHERE, targets->dim};
    return operate(part, &line, targets->dim);
}

/* ---- the other rows ---- */

typedef struct pass {
    const pia_part *part;
    const double *residual;
    int dim;
    pia_index chunks;
    pia_errors *errors; /* [chunks] */
} pass;

static void count_rows(const pass *p, pia_index row, pia_index to, double *worst, pia_errors *e)
{
    const double *weights = p->part->whole->weights;
    for (; row < to; row++) {
        double square = 0;
        for (int d = 0; d < p->dim; d++) square += p->residual[row * p->dim + d] * p->residual[row * p->dim + d];
        e->sum_squares += square;
        e->weighted += weights != NULL ? weights[row] * square : square;
        e->count++;
        if (square <= *worst) continue;
        *worst = square;
        e->max_row = row;
    }
}

/* The first row of the part from `row` on, as its place in the list. */
static pia_index place_from(const pia_part *part, pia_index row)
{
    pia_index low = 0, high = part->rows;
    while (low < high) {
        pia_index middle = low + (high - low) / 2;
        if (part->row[middle] < row)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

static void rest_chunk(void *work, pia_index chunk)
{
    const pass *p = work;
    const pia_part *part = p->part;
    pia_index row = pia_chunk_begin(part->whole->rows, p->chunks, chunk), to = pia_chunk_begin(part->whole->rows, p->chunks, chunk + 1);
    pia_errors e = {.max_row = -1};
    double worst = -1;
    for (pia_index k = place_from(part, row); k < part->rows && part->row[k] < to; k++) {
        count_rows(p, row, part->row[k], &worst, &e);
        row = part->row[k] + 1;
    }
    count_rows(p, row, to, &worst, &e);
    e.max = worst > 0 ? sqrt(worst) : 0;
    p->errors[chunk] = e;
}

static void measure_rest(pia_part *part, const double *residual, int dim)
{
    pia_errors errors[MAX_CHUNKS];
    pia_index chunks = pia_chunk_count(part->whole->rows, GRAIN);
    pass p = {part, residual, dim, chunks < MAX_CHUNKS ? chunks : MAX_CHUNKS, errors};
    pia_for_each(part->context, p.chunks, rest_chunk, &p);
    for (pia_index c = 1; c < p.chunks; c++) errors[0] = pia_errors_join(errors[0], errors[c]);
    part->rest = errors[0];
    part->rest_known = 1;
}

pia_status pia_part_open(const pia_op *whole, const pia_targets *targets, const pia_block *moving, const double *residual,
                         pia_part **out)
{
    pia_part *part = pia_take_zero(whole->context, 1, sizeof *part);
    if (part == NULL) return PIA_E_MEMORY;
    part->context = whole->context;
    part->whole = whole;
    pia_block span = find_spans(whole, moving, &part->control);
    pia_status status = fill(part, targets, &span);
    if (status != PIA_OK) {
        pia_part_close(part);
        return status;
    }
    if (residual != NULL) measure_rest(part, residual, targets->dim);
    *out = part;
    return PIA_OK;
}

void pia_part_close(pia_part *part)
{
    if (part == NULL) return;
    pia_context *context = part->context;
    pia_op_close(part->op);
    for (int d = 0; d < 2; d++) pia_collocation_close(context, &part->line[d]);
    void *blocks[] = {part->row, part->points, part->residual, part->x, part->weights, part->pairs, part};
    for (size_t k = 0; k < sizeof blocks / sizeof *blocks; k++) pia_give(context, blocks[k]);
}

/* ---- measuring ---- */

static void take_control(pia_part *part, const double *x, int dim)
{
    const pia_block *c = &part->control;
    pia_index across = part->whole->count[1], width = (c->high[1] - c->low[1]) * dim;
    for (pia_index i = c->low[0]; i < c->high[0]; i++)
        memcpy(part->x + (i - c->low[0]) * width, x + (i * across + c->low[1]) * dim, (size_t)width * sizeof *x);
}

pia_errors pia_part_residual(pia_part *part, const double *x, const pia_targets *targets, double *residual)
{
    int dim = targets->dim;
    if (!part->rest_known) {
        pia_op_residual(part->whole, x, targets, residual);
        measure_rest(part, residual, dim);
    }
    if (part->rows == 0) return part->rest;
    take_control(part, x, dim);
    pia_errors errors = pia_op_residual(part->op, part->x, &part->targets, part->residual);
    for (pia_index k = 0; k < part->rows; k++)
        memcpy(residual + part->row[k] * dim, part->residual + k * dim, (size_t)dim * sizeof *residual);
    if (errors.max_row >= 0) errors.max_row = part->row[errors.max_row];
    return pia_errors_join(part->rest, errors);
}
