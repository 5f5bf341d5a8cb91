#include "op_scatter.h"

#include "basis.h"
#include "chebyshev.h"
#include "kernel.h"
#include "knots.h"
#include "strips.h"

#include <math.h>
#include <string.h>

#define INLINE static inline __attribute__((always_inline))

enum { GRAIN = 8192, MAX_CHUNKS = 64, MAX_POLYNOMIAL = 7 };

/* ---- basis values ---- */

/* Middle and scale of a span, then coefficient j of all its functions, j = 0 .. degree. */
static pia_index polynomial_size(int degree)
{
    return 2 + (degree + 1) * (degree + 1);
}

/* A small matrix times Chebyshev polynomials, without the divisions of the recursion. */
INLINE void evaluate(const double *polynomial, int degree, double t, double *value)
{
    double x = (t - polynomial[0]) * polynomial[1], before = 1, now = x;
    const double *coefficient = polynomial + 2;
    for (int k = 0; k <= degree; k++) value[k] = coefficient[k];
    for (int j = 1; j <= degree; j++) {
        coefficient += degree + 1;
        for (int k = 0; k <= degree; k++) value[k] += now * coefficient[k];
        double next = 2 * x * now - before;
        before = now;
        now = next;
    }
}

static void values_on(const pia_scatter *scatter, int d, pia_index span, double t, double *value)
{
    const pia_collocation *axis = &scatter->axis[d];
    const double *polynomial = scatter->polynomial[d];
    if (polynomial == NULL)
        pia_basis_values(axis->knots, axis->degree, axis->degree + span, t, value);
    else if (axis->degree == 3)
        evaluate(polynomial + span * polynomial_size(3), 3, t, value);
    else
        evaluate(polynomial + span * polynomial_size(axis->degree), axis->degree, t, value);
}

void pia_scatter_values(const pia_scatter *scatter, pia_index strip, pia_index column, pia_index at, double *u, double *v)
{
    values_on(scatter, 0, strip, scatter->sorted[2 * at], u);
    values_on(scatter, 1, column, scatter->sorted[2 * at + 1], v);
}

/* Empty spans hold no rows and stay as they are. */
static pia_status make_polynomials(pia_context *context, pia_scatter *scatter, int d)
{
    const pia_collocation *axis = &scatter->axis[d];
    int width = axis->degree + 1;
    pia_index size = polynomial_size(axis->degree);
    pia_chebyshev chebyshev;
    double coefficient[(MAX_POLYNOMIAL + 1) * (MAX_POLYNOMIAL + 1)];
    if (axis->degree > MAX_POLYNOMIAL) return PIA_OK;
    double *out = pia_take_zero(context, scatter->cells[d], (size_t)size * sizeof *out);
    scatter->polynomial[d] = out;
    if (out == NULL) return pia_take_status(context, scatter->cells[d], (size_t)size * sizeof *out);
    pia_chebyshev_fill(axis->degree, &chebyshev);
    for (pia_index s = 0; s < scatter->cells[d]; s++, out += size) {
        if (!(axis->knots[axis->degree + s] < axis->knots[axis->degree + s + 1])) continue;
        pia_chebyshev_span(&chebyshev, axis, s, &out[0], &out[1], coefficient);
        for (int k = 0; k < width; k++)
            for (int j = 0; j < width; j++) out[2 + j * width + k] = coefficient[k * width + j];
    }
    return PIA_OK;
}

/* ---- sorting ---- */

typedef struct sorting {
    pia_scatter *scatter;
    const double *parameters;
    pia_index rows, chunks;
    pia_index *cell; /* [rows] */
} sorting;

/* Knots are mostly even: the span that even knots would give is the place to start looking. */
static pia_index span_of(const pia_collocation *axis, double t)
{
    const double *knots = axis->knots;
    pia_index spans = axis->full - axis->degree;
    double first = knots[axis->degree], share = (t - first) / (knots[axis->full] - first) * (double)spans;
    pia_index guess = share > 0 ? share < (double)spans ? (pia_index)share : spans - 1 : 0;
    return pia_knots_span_near(knots, axis->degree, axis->full, t, axis->degree + guess) - axis->degree;
}

static void find_cells(void *work, pia_index chunk)
{
    const sorting *s = work;
    const pia_scatter *scatter = s->scatter;
    pia_index to = pia_chunk_begin(s->rows, s->chunks, chunk + 1);
    for (pia_index row = pia_chunk_begin(s->rows, s->chunks, chunk); row < to; row++)
        s->cell[row] = span_of(&scatter->axis[0], s->parameters[2 * row]) * scatter->cells[1] +
                       span_of(&scatter->axis[1], s->parameters[2 * row + 1]);
}

/* Counting sort, stable: begin[] first counts, then holds where the next row of a cell goes, and ends one cell too far. */
static void sort_rows(const sorting *s, pia_index cells)
{
    pia_scatter *scatter = s->scatter;
    pia_index *begin = scatter->begin;
    memset(begin, 0, (size_t)(cells + 1) * sizeof *begin);
    for (pia_index row = 0; row < s->rows; row++) begin[s->cell[row] + 1]++;
    for (pia_index c = 0; c < cells; c++) begin[c + 1] += begin[c];
    for (pia_index row = 0; row < s->rows; row++) {
        pia_index at = begin[s->cell[row]]++;
        scatter->order[at] = row;
        scatter->sorted[2 * at] = s->parameters[2 * row];
        scatter->sorted[2 * at + 1] = s->parameters[2 * row + 1];
    }
    memmove(begin + 1, begin, (size_t)cells * sizeof *begin);
    begin[0] = 0;
}

/* The first strip of a chunk: strips are dealt out so that chunks hold about the same number of rows. */
static pia_index first_strip(const pia_scatter *scatter, pia_index chunks, pia_index chunk)
{
    pia_index low = 0, high = scatter->cells[0], rows = scatter->begin[scatter->cells[0] * scatter->cells[1]];
    if (chunk == chunks) return high;
    while (low < high) {
        pia_index middle = low + (high - low) / 2;
        if (scatter->begin[middle * scatter->cells[1]] < pia_chunk_begin(rows, chunks, chunk))
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

static pia_index chunk_count(const pia_scatter *scatter)
{
    pia_index chunks = pia_chunk_count(scatter->begin[scatter->cells[0] * scatter->cells[1]], GRAIN);
    if (chunks > scatter->cells[0]) chunks = scatter->cells[0];
    return chunks < MAX_CHUNKS ? chunks : MAX_CHUNKS;
}

/* ---- passes ---- */

typedef struct pass {
    const pia_scatter *scatter;
    pia_index chunks;
    const double *full, *weights, *in, *base;
    const pia_targets *targets;
    double factor;
    int dim;
    double *out;
    pia_errors *errors; /* [chunks] */
} pass;

/* The rows of one cell and the control point of its lowest corner. */
typedef struct cell {
    pia_index strip, column, begin, end;
    int p, q;
} cell;

static cell cell_at(const pia_scatter *scatter, pia_index strip, pia_index column)
{
    pia_index c = strip * scatter->cells[1] + column;
    return (cell){strip, column, scatter->begin[c], scatter->begin[c + 1], scatter->axis[0].degree, scatter->axis[1].degree};
}

/* sum [dim] = value of the model at a sorted row. */
INLINE void add_row(const pass *p, const cell *c, pia_index at, int degree_u, int degree_v, int dim, double *sum)
{
    double u[PIA_MAX_DEGREE + 1], v[PIA_MAX_DEGREE + 1];
    pia_index line = p->scatter->axis[1].full;
    pia_scatter_values(p->scatter, c->strip, c->column, at, u, v);
    for (int d = 0; d < dim; d++) sum[d] = 0;
    for (int i = 0; i <= degree_u; i++) {
        const double *control = p->full + ((c->strip + i) * line + c->column) * dim;
        double along[PIA_MAX_DIM] = {0};
        for (int j = 0; j <= degree_v; j++)
            for (int d = 0; d < dim; d++) along[d] += v[j] * control[j * dim + d];
        for (int d = 0; d < dim; d++) sum[d] += u[i] * along[d];
    }
}

static void model_value(const pass *p, const cell *c, pia_index at, double *sum)
{
    if (c->p == 3 && c->q == 3 && p->dim == 3)
        add_row(p, c, at, 3, 3, 3, sum);
    else if (c->p == 3 && c->q == 3 && p->dim == 1)
        add_row(p, c, at, 3, 3, 1, sum);
    else
        add_row(p, c, at, c->p, c->q, p->dim, sum);
}

static void apply_chunk(void *work, pia_index chunk)
{
    const pass *p = work;
    const pia_scatter *scatter = p->scatter;
    pia_index to = first_strip(scatter, p->chunks, chunk + 1);
    for (pia_index strip = first_strip(scatter, p->chunks, chunk); strip < to; strip++)
        for (pia_index column = 0; column < scatter->cells[1]; column++) {
            cell c = cell_at(scatter, strip, column);
            for (pia_index at = c.begin; at < c.end; at++) model_value(p, &c, at, p->out + scatter->order[at] * p->dim);
        }
}

/* Joins errors of rows in any order: the smallest row of equals. */
static void note_square(pia_errors *e, double *worst, double square, double weight, pia_index row)
{
    e->count++;
    e->sum_squares += square;
    e->weighted += weight * square;
    if (square > *worst || (square == *worst && row < e->max_row)) {
        *worst = square;
        e->max_row = row;
    }
}

static void residual_chunk(void *work, pia_index chunk)
{
    const pass *p = work;
    const pia_scatter *scatter = p->scatter;
    int dim = p->dim;
    double sum[PIA_MAX_DIM], worst = -1;
    pia_errors e = {0, -1, 0, 0, 0};
    pia_index to = first_strip(scatter, p->chunks, chunk + 1);
    for (pia_index strip = first_strip(scatter, p->chunks, chunk); strip < to; strip++)
        for (pia_index column = 0; column < scatter->cells[1]; column++) {
            cell c = cell_at(scatter, strip, column);
            for (pia_index at = c.begin; at < c.end; at++) {
                pia_index row = scatter->order[at];
                pia_scatter_fetch(scatter, at, scatter->begin[scatter->cells[0] * scatter->cells[1]], p->targets->points, dim);
                const double *target = p->targets->points + row * dim;
                double square = 0;
                model_value(p, &c, at, sum);
                for (int d = 0; d < dim; d++) {
                    double difference = target[d] - p->targets->origin[d] - sum[d];
                    square += difference * difference;
                    if (p->out != NULL)
                        p->out[row * dim + d] = p->base != NULL ? p->base[row * dim + d] + p->factor * difference : difference;
                }
                note_square(&e, &worst, square, p->weights != NULL ? p->weights[row] : 1, row);
            }
        }
    e.max = worst > 0 ? sqrt(worst) : 0;
    p->errors[chunk] = e;
}

/* Strip `strip` adds to the lines of control points that begin with it. */
static void gather_strip(void *work, pia_index strip)
{
    const pass *p = work;
    const pia_scatter *scatter = p->scatter;
    double u[PIA_MAX_DEGREE + 1], v[PIA_MAX_DEGREE + 1];
    pia_index line = scatter->axis[1].full;
    int dim = p->dim;
    for (pia_index column = 0; column < scatter->cells[1]; column++) {
        cell c = cell_at(scatter, strip, column);
        for (pia_index at = c.begin; at < c.end; at++) {
            pia_index row = scatter->order[at];
            const double *value = p->in + row * dim;
            double w = p->weights != NULL ? p->weights[row] : 1;
            pia_scatter_values(scatter, strip, column, at, u, v);
            for (int i = 0; i <= c.p; i++) {
                double *to = p->out + ((strip + i) * line + column) * dim, wu = w * u[i];
                for (int j = 0; j <= c.q; j++)
                    for (int d = 0; d < dim; d++) to[j * dim + d] += wu * v[j] * value[d];
            }
        }
    }
}

static pass pass_over(const pia_op *op, int dim)
{
    const pia_scatter *scatter = op->state;
    return (pass){.scatter = scatter, .chunks = chunk_count(scatter), .dim = dim, .weights = op->weights};
}

static void apply(const pia_op *op, const double *full, int dim, double *values)
{
    pass p = pass_over(op, dim);
    p.full = full;
    p.out = values;
    pia_for_each(op->context, p.chunks, apply_chunk, &p);
}

static pia_errors residual(const pia_op *op, const double *full, const pia_targets *targets, const double *base, double factor,
                           double *out)
{
    pia_errors errors[MAX_CHUNKS];
    pass p = pass_over(op, targets->dim);
    p.full = full;
    p.targets = targets;
    p.base = base;
    p.factor = factor;
    p.out = out;
    p.errors = errors;
    pia_for_each(op->context, p.chunks, residual_chunk, &p);
    for (pia_index c = 1; c < p.chunks; c++) /* rows are not in order here: of equals, the smaller row counts as the earlier one */
        errors[0] =
            errors[c].max_row < errors[0].max_row ? pia_errors_join(errors[c], errors[0]) : pia_errors_join(errors[0], errors[c]);
    return errors[0];
}

static void gather(const pia_op *op, const double *values, const double *weights, int dim, double *full)
{
    pass p = pass_over(op, dim);
    p.in = values;
    p.weights = weights;
    p.out = full;
    memset(full, 0, (size_t)(op->fulls * dim) * sizeof *full);
    pia_each_strip(p.chunks > 1 ? op->context : NULL, p.scatter->cells[0], p.scatter->axis[0].degree, gather_strip, &p);
}

/* ---- opening ---- */

static void close_state(pia_op *op)
{
    pia_scatter *scatter = op->state;
    if (scatter == NULL) return;
    for (int d = 0; d < 2; d++) pia_collocation_close(op->context, &scatter->axis[d]);
    pia_give(op->context, scatter->begin);
    pia_give(op->context, scatter->order);
    pia_give(op->context, scatter->sorted);
    for (int d = 0; d < 2; d++) pia_give(op->context, scatter->polynomial[d]);
    pia_give(op->context, scatter);
}

static const pia_op_class scatter_class = {"scatter", apply, gather, residual, close_state};

static pia_status take_rows(pia_op *op, const double *parameters)
{
    pia_scatter *scatter = op->state;
    pia_index cells = scatter->cells[0] * scatter->cells[1];
    scatter->begin = pia_take(op->context, cells + 1, sizeof *scatter->begin);
    scatter->order = pia_take(op->context, op->rows, sizeof *scatter->order);
    scatter->sorted = pia_take(op->context, op->rows, 2 * sizeof *scatter->sorted);
    pia_index *cell_of = pia_take(op->context, op->rows, sizeof *cell_of);
    int ready = scatter->begin != NULL && scatter->order != NULL && scatter->sorted != NULL && cell_of != NULL;
    if (ready) {
        sorting s = {scatter, parameters, op->rows, pia_chunk_count(op->rows, GRAIN), cell_of};
        pia_for_each(op->context, s.chunks, find_cells, &s);
        sort_rows(&s, cells);
    }
    pia_give(op->context, cell_of);
    return ready ? PIA_OK : pia_take_status(op->context, op->rows, 2 * sizeof *scatter->sorted);
}

static pia_status fill(pia_op *op, pia_collocation *axis, const double *parameters)
{
    pia_scatter *scatter = pia_take_zero(op->context, 1, sizeof *scatter);
    if (scatter == NULL) return pia_take_status(op->context, 1, sizeof *scatter);
    op->state = scatter;
    op->pairs = parameters;
    for (int d = 0; d < 2; d++) {
        scatter->axis[d] = axis[d];
        axis[d] = (pia_collocation){0};
        op->axis[d] = &scatter->axis[d];
        scatter->cells[d] = scatter->axis[d].full - scatter->axis[d].degree;
    }
    pia_status status = take_rows(op, parameters);
    for (int d = 0; d < 2 && status == PIA_OK; d++) status = make_polynomials(op->context, scatter, d);
    return status;
}

pia_status pia_op_scatter_open(pia_context *context, const int *degree, const pia_map *map, const double *const *knots,
                               const pia_index *full, const double *parameters, pia_index rows, const double *weights, int dim,
                               pia_op **out)
{
    pia_collocation axis[2] = {{0}, {0}};
    pia_op *op = NULL;
    pia_status status = PIA_OK;
    for (int d = 0; d < 2 && status == PIA_OK; d++)
        status = pia_collocation_open(context, degree[d], map[d], 0, knots[d], full[d], NULL, 0, 0, &axis[d]);
    if (status == PIA_OK) {
        pia_index unknowns[2] = {axis[0].unknowns, axis[1].unknowns};
        status = pia_op_new(context, &scatter_class, 2, unknowns, full, rows, weights, dim, &op);
    }
    if (status == PIA_OK) status = fill(op, axis, parameters);
    for (int d = 0; d < 2; d++) pia_collocation_close(context, &axis[d]);
    if (status == PIA_OK)
        *out = op;
    else
        pia_op_close(op);
    return status;
}

const pia_scatter *pia_op_scatter(const pia_op *op)
{
    return op->class == &scatter_class ? op->state : NULL;
}
