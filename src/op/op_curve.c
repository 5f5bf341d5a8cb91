/* A curve: banded rows, one block of degree + 1 basis values each. Rows are taken as many at a time as a vector has lanes. Chunks of
 * rows, of spans where columns are written, depend on the problem alone. */
#include "op_curve.h"

#include "kernel.h"
#include "lanes.h"
#include "span_sums.h"

#include <math.h>
#include <string.h>

enum { GRAIN = 8192, MAX_CHUNKS = 256 };

typedef struct pass {
    const pia_op *op;
    const pia_collocation *line;
    pia_index chunks;
    const double *full, *weights, *in, *base;
    const pia_targets *targets;
    double factor;
    int dim;
    double *out;
    double *tail;       /* gather: [chunks x degree x dim] sums beyond a chunk's own columns */
    pia_errors *errors; /* [chunks] */
    const pia_chebyshev *chebyshev;
} pass;

static pia_index chunk_count(pia_index rows)
{
    pia_index chunks = pia_chunk_count(rows, GRAIN);
    return chunks < MAX_CHUNKS ? chunks : MAX_CHUNKS;
}

/* Neighbouring rows in the lanes; where only `count` are left, the last one stands in the others too. */
typedef struct rows {
    pia_index at[PIA_LANES], column[PIA_LANES];
    int count;
    pia_lanes value[PIA_MAX_DEGREE + 1];
} rows;

/* Lane by lane in so many words: no loop is left around the search for a span. Returns the span of the last row. */
PIA_INLINE pia_index load_rows(const pia_collocation *c, pia_index row, int count, pia_index span, int degree, rows *out)
{
    out->count = count;
    for (int l = 0; l < PIA_LANES; l++) out->at[l] = l < count ? row + l : row + count - 1;
    pia_index first = pia_collocation_advance(c, out->at[0], span), second = pia_collocation_advance(c, out->at[1], first);
    pia_index third = pia_collocation_advance(c, out->at[2], second), fourth = pia_collocation_advance(c, out->at[3], third);
    out->column[0] = first - degree;
    out->column[1] = second - degree;
    out->column[2] = third - degree;
    out->column[3] = fourth - degree;
    pia_lanes_row(c, out->at, out->column, degree, out->value);
    return fourth;
}

/* Component d of the curve at these rows. */
PIA_INLINE pia_lanes combine(const rows *r, const double *full, int degree, int dim, int d)
{
    pia_lanes sum = r->value[0] * pia_lanes_component(full, r->column, dim, d);
    for (int k = 1; k <= degree; k++) sum += r->value[k] * pia_lanes_component(full + k * dim, r->column, dim, d);
    return sum;
}

PIA_INLINE void store(const rows *r, pia_lanes value, int dim, int d, double *out)
{
    for (int l = 0; l < PIA_LANES; l++) out[r->at[l] * dim + d] = value[l];
}

PIA_INLINE void apply_rows(const pass *p, const rows *r, int degree, int dim)
{
    for (int d = 0; d < dim; d++) store(r, combine(r, p->full, degree, dim, d), dim, d, p->out);
}

PIA_INLINE void apply_chunk_of(const pass *p, pia_index chunk, int degree, int dim)
{
    const pia_collocation *c = p->line;
    pia_index row = pia_chunk_begin(c->rows, p->chunks, chunk), to = pia_chunk_begin(c->rows, p->chunks, chunk + 1);
    pia_index span = pia_collocation_span(c, row);
    rows r;
    for (; row + PIA_LANES <= to; row += PIA_LANES) {
        span = load_rows(c, row, PIA_LANES, span, degree, &r);
        apply_rows(p, &r, degree, dim);
    }
    if (row < to) {
        load_rows(c, row, (int)(to - row), span, degree, &r);
        apply_rows(p, &r, degree, dim);
    }
}

PIA_INLINE void count_square(const double *weights, const rows *r, pia_lanes square, pia_run_errors *e)
{
    for (int l = 0; l < r->count; l++) {
        e->sum_squares += square[l];
        e->weighted += weights != NULL ? weights[r->at[l]] * square[l] : square[l];
        if (square[l] > e->worst) {
            e->worst = square[l];
            e->index = r->at[l];
        }
    }
}

/* What is written: nothing, the differences, or base + factor * differences. */
typedef enum output { NOTHING, DIFFERENCES, MOVED } output;

PIA_INLINE void residual_rows(const pass *p, const rows *r, output kind, int degree, int dim, pia_run_errors *e)
{
    pia_lanes square = {0}, difference[PIA_MAX_DIM];
    for (int d = 0; d < dim; d++) difference[d] = pia_lanes_component(p->targets->points, r->at, dim, d) - p->targets->origin[d];
    for (int d = 0; d < dim; d++) difference[d] -= combine(r, p->full, degree, dim, d);
    for (int d = 0; d < dim; d++) square += difference[d] * difference[d];
    for (int d = 0; d < dim && kind == MOVED; d++)
        difference[d] = pia_lanes_component(p->base, r->at, dim, d) + p->factor * difference[d];
    for (int d = 0; d < dim && kind != NOTHING; d++) store(r, difference[d], dim, d, p->out);
    count_square(p->weights, r, square, e);
}

/* Squares without weights, lane by lane. */
typedef struct tally {
    pia_lanes sum, worst;
    pia_lane_masks row; /* of the worst */
} tally;

static void tally_close(const tally *t, pia_run_errors *e)
{
    for (int l = 0; l < PIA_LANES; l++) {
        e->sum_squares += t->sum[l];
        e->weighted += t->sum[l];
        if (t->worst[l] > e->worst || (t->worst[l] == e->worst && t->row[l] < e->index)) {
            e->worst = t->worst[l];
            e->index = t->row[l];
        }
    }
}

/* PIA_LANES rows on neighbouring spans, whose numbers are all neighbours. */
PIA_INLINE void residual_neighbours(const pass *p, pia_index row, pia_index column, const pia_lanes *value, const pia_lanes *origin,
                                    output kind, int degree, int dim, tally *t)
{
    pia_lanes square[PIA_MAX_DIM];
    for (int part = 0; part < dim; part++) {
        pia_index at = row * dim + part * PIA_LANES;
        const double *x = p->full + column * dim + part * PIA_LANES;
        pia_lanes sum = pia_lanes_spread(value[0], dim, part) * pia_vector_load(x);
        for (int k = 1; k <= degree; k++) sum += pia_lanes_spread(value[k], dim, part) * pia_vector_load(x + k * dim);
        pia_lanes difference = pia_vector_load(p->targets->points + at) - origin[part] - sum;
        square[part] = difference * difference;
        if (kind == MOVED) difference = pia_vector_load(p->base + at) + p->factor * difference;
        if (kind != NOTHING) pia_lanes_write(difference, p->out + at);
    }
    pia_lanes all = pia_lanes_row_sums(square, dim);
    pia_lane_masks larger = all > t->worst;
    t->sum += all;
    t->worst = pia_lanes_choose(larger, all, t->worst);
    t->row = (larger & (row + (pia_lane_masks){0, 1, 2, 3})) | (~larger & t->row);
}

PIA_INLINE void residual_range(const pass *given, pia_index row, pia_index to, output kind, int degree, int dim, pia_run_errors *e)
{
    if (row >= to) return;
    /* Copies, because what is written could overlap the originals as far as the compiler knows. */
    const pia_collocation line = *given->line, *c = &line;
    const pia_targets targets = *given->targets;
    pass copy = *given, *p = &copy;
    copy.targets = &targets;
    pia_index span = pia_collocation_span(c, row);
    tally t = {.worst = {-1, -1, -1, -1}};
    pia_lanes origin[PIA_MAX_DIM] = {{0}};
    rows r;
    for (int k = 0; k < dim * PIA_LANES; k++) origin[k / PIA_LANES][k % PIA_LANES] = targets.origin[k % dim];
    for (; row + PIA_LANES <= to; row += PIA_LANES) {
        span = pia_collocation_advance(c, row, span);
        if (dim <= 3 && p->weights == NULL && pia_lanes_neighbours(c, row, span, degree, r.value)) {
            residual_neighbours(p, row, span - degree, r.value, origin, kind, degree, dim, &t);
            span += PIA_LANES - 1;
        } else {
            span = load_rows(c, row, PIA_LANES, span, degree, &r);
            residual_rows(p, &r, kind, degree, dim, e);
        }
    }
    tally_close(&t, e);
    if (row < to) {
        load_rows(c, row, (int)(to - row), span, degree, &r);
        residual_rows(p, &r, kind, degree, dim, e);
    }
}

/* In spans of many rows the curve is a polynomial of the local parameter, and no basis function is evaluated for a row. */
static void polynomial_residual(const pass *p, pia_index s, int count, pia_run_errors *e)
{
    const pia_collocation *line = p->line;
    pia_chebyshev_curves curves;
    pia_chebyshev_take(p->chebyshev, line, s, count, p->full, p->dim, &curves);
    for (int l = 0; l < count; l++) {
        pia_index from = line->begin[s + l];
        pia_run run = {.degree = line->degree,
                       .dim = p->dim,
                       .origin = p->targets->origin,
                       .middle = curves.middle[l],
                       .scale = curves.scale[l],
                       .t = line->parameters + from,
                       .points = p->targets->points + from * p->dim,
                       .weights = p->weights != NULL ? p->weights + from : NULL,
                       .count = line->begin[s + l + 1] - from};
        pia_run_residual(&run, curves.coefficient[l], from, p->out != NULL ? p->out + from * p->dim : NULL, e);
    }
}

/* First column of a chunk: that of the first span whose rows begin at or after the chunk's share of rows. */
static pia_index chunk_column(const pia_collocation *c, pia_index chunks, pia_index chunk)
{
    pia_index row = pia_chunk_begin(c->rows, chunks, chunk);
    if (chunk == chunks) return c->full - c->degree;
    return row > 0 ? pia_collocation_span(c, row - 1) + 1 - c->degree : 0;
}

/* Rows of the spans from .. to - 1, which some may have many of. */
PIA_INLINE void residual_spans(const pass *p, pia_index from, pia_index to, output kind, int degree, int dim, pia_run_errors *e)
{
    const pia_collocation *c = p->line;
    for (pia_index s = from, next; s < to; s = next) {
        for (next = s; next < to && !pia_span_is_full(c, next);) next++;
        residual_range(p, c->begin[s], c->begin[next], kind, degree, dim, e);
        int count = 0;
        while (count < PIA_LANES && next + count < to && pia_span_is_full(c, next + count)) count++;
        if (count > 0) polynomial_residual(p, next, count, e);
        next += count;
    }
}

static pia_errors errors_of(const pia_run_errors *e, pia_index count)
{
    return (pia_errors){e->worst > 0 ? sqrt(e->worst) : 0, e->index, e->sum_squares, e->weighted, count};
}

/* Operators that step have a row a span; others tell which rows a span has. */
PIA_INLINE void residual_chunk_of(const pass *p, pia_index chunk, int degree, int dim)
{
    const pia_collocation *c = p->line;
    pia_index from = chunk_column(c, p->chunks, chunk), to = chunk_column(c, p->chunks, chunk + 1);
    pia_index first = pia_collocation_begin(c, from + degree), last = pia_collocation_begin(c, to + degree);
    pia_run_errors e = {0, 0, -1, -1};
    if (p->base != NULL)
        residual_range(p, first, last, MOVED, degree, dim, &e);
    else if (c->begin != NULL)
        residual_spans(p, from, to, p->out != NULL ? DIFFERENCES : NOTHING, degree, dim, &e);
    else
        residual_range(p, first, last, p->out != NULL ? DIFFERENCES : NOTHING, degree, dim, &e);
    p->errors[chunk] = errors_of(&e, last - first);
}

PIA_INLINE void gather_chunk_of(const pass *p, pia_index chunk, int degree, int dim)
{
    const pia_collocation *c = p->line;
    pia_index from = chunk_column(c, p->chunks, chunk), to = chunk_column(c, p->chunks, chunk + 1), span = from + degree;
    pia_index end = pia_collocation_begin(c, to + degree);
    double scratch[PIA_MAX_DEGREE + 1], *tail = p->tail + chunk * degree * dim;
    memset(p->out + from * dim, 0, (size_t)((to - from) * dim) * sizeof *p->out);
    memset(tail, 0, (size_t)(degree * dim) * sizeof *tail);
    for (pia_index row = pia_collocation_begin(c, span); row < end; row++) {
        span = pia_collocation_advance(c, row, span);
        const double *value = pia_collocation_row(c, row, span, scratch);
        pia_index column = span - degree;
        double w = p->weights != NULL ? p->weights[row] : 1;
        for (int k = 0; k <= degree; k++) {
            double *to_column = column + k < to ? p->out + (column + k) * dim : tail + (column + k - to) * dim;
            for (int d = 0; d < dim; d++) to_column[d] += w * value[k] * p->in[row * dim + d];
        }
    }
}

/* The cubic in up to three dimensions is what nearly everybody fits: those loops are unrolled by giving the compiler the counts. */
#define PIA_UNROLL(body, p, chunk)                                                                                                     \
    do {                                                                                                                               \
        int degree_ = (p)->line->degree, dim_ = (p)->dim;                                                                              \
        if (degree_ == 3 && dim_ == 3)                                                                                                 \
            body(p, chunk, 3, 3);                                                                                                      \
        else if (degree_ == 3 && dim_ == 2)                                                                                            \
            body(p, chunk, 3, 2);                                                                                                      \
        else if (degree_ == 3 && dim_ == 1)                                                                                            \
            body(p, chunk, 3, 1);                                                                                                      \
        else                                                                                                                           \
            body(p, chunk, degree_, dim_);                                                                                             \
    } while (0)

PIA_CLONES static void apply_chunk(void *work, pia_index chunk)
{
    const pass *p = work;
    PIA_UNROLL(apply_chunk_of, p, chunk);
}

PIA_CLONES static void residual_chunk(void *work, pia_index chunk)
{
    const pass *p = work;
    PIA_UNROLL(residual_chunk_of, p, chunk);
}

static void gather_chunk(void *work, pia_index chunk)
{
    const pass *p = work;
    PIA_UNROLL(gather_chunk_of, p, chunk);
}

static pass pass_over(const pia_op *op, int dim)
{
    return (pass){.op = op, .line = op->line[0], .chunks = chunk_count(op->rows), .dim = dim, .weights = op->weights};
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
    pia_chebyshev chebyshev;
    pia_chebyshev_fill(p.line->degree, &chebyshev);
    p.chebyshev = &chebyshev;
    pia_for_each(op->context, p.chunks, residual_chunk, &p);
    for (pia_index c = 1; c < p.chunks; c++) errors[0] = pia_errors_join(errors[0], errors[c]);
    return errors[0];
}

static void gather(const pia_op *op, const double *values, const double *weights, int dim, double *full)
{
    pass p = pass_over(op, dim);
    p.in = values;
    p.weights = weights;
    p.out = full;
    p.tail = op->along;
    pia_for_each(op->context, p.chunks, gather_chunk, &p);
    int degree = p.line->degree;
    memset(full + (op->fulls - degree) * dim, 0, (size_t)(degree * dim) * sizeof *full);
    for (pia_index chunk = 0; chunk < p.chunks; chunk++) {
        double *to = full + chunk_column(p.line, p.chunks, chunk + 1) * dim;
        for (int k = 0; k < degree * dim; k++) to[k] += p.tail[chunk * degree * dim + k];
    }
}

pia_errors pia_op_curve_errors(const pia_op *op, const double *full, const pia_targets *targets, pia_index from, pia_index to)
{
    pass p = pass_over(op, targets->dim);
    p.full = full;
    p.targets = targets;
    pia_run_errors e = {0, 0, -1, -1};
    residual_range(&p, from, to, NOTHING, p.line->degree, p.dim, &e);
    return errors_of(&e, to - from);
}

static const pia_op_class curve = {"curve", apply, gather, residual, NULL};

pia_status pia_op_curve_open(pia_context *context, pia_collocation *line, const double *weights, int dim, pia_op **out)
{
    pia_op *op;
    pia_status status = pia_op_new(context, &curve, 1, &line->unknowns, &line->full, line->rows, weights, dim, &op);
    if (status != PIA_OK) return status;
    pia_index tails = chunk_count(line->rows) * line->degree * dim;
    op->axis[0] = op->line[0] = line;
    op->along = pia_take(context, tails, sizeof *op->along);
    if (op->along == NULL) {
        pia_op_close(op);
        return pia_take_status(context, tails, sizeof *op->along);
    }
    *out = op;
    return PIA_OK;
}
