/* A grid: A = A_u (x) A_v, never formed. Values are contracted first along v, into planes [full control rows x components x data
 * columns], then along u, where the columns are the lanes of vectors. Data rows of one span are taken a block of columns at a time, so
 * that what they share of the planes stays in the first-level cache. */
#include "clones.h"
#include "kernel.h"
#include "op.h"
#include "vector.h"

#include <math.h>
#include <string.h>

/* COLUMNS, ROWS: taken together, so that the planes they need stay in the second-level cache. BLOCK: columns whose squares are counted
 * at once. AHEAD: doubles that are fetched before they are wanted. */
enum { GRAIN = 8192, MAX_CHUNKS = 256, COLUMNS = 2048, ROWS = 16, BLOCK = 64, AHEAD = 512 };

typedef struct pass {
    const pia_op *op;
    const pia_collocation *u, *v;
    pia_index lines, chunks; /* what is cut into chunks: rows of the array at hand */
    pia_index stride;        /* of a plane: columns, up to whole vectors */
    const double *in, *weights, *base;
    const pia_targets *targets;
    double factor;
    int dim;
    double *along, *out;
    pia_errors *errors;
} pass;

static pia_index whole(pia_index columns)
{
    return (columns + PIA_LANES - 1) / PIA_LANES * PIA_LANES;
}

static pass pass_over(const pia_op *op, int dim, pia_index lines, pia_index width)
{
    pia_index chunks = pia_chunk_count(lines * width, GRAIN);
    if (chunks > lines) chunks = lines > 0 ? lines : 1;
    if (chunks > MAX_CHUNKS) chunks = MAX_CHUNKS;
    return (pass){.op = op,
                  .u = op->line[0],
                  .v = op->line[1],
                  .lines = lines,
                  .chunks = chunks,
                  .stride = whole(op->line[1]->rows),
                  .along = op->along,
                  .dim = dim};
}

static double *plane(const pass *p, pia_index control, int d)
{
    return p->along + (control * p->dim + d) * p->stride;
}

/* Planes of control row i: sum_j N_j(v_s) P[i][j]. */
PIA_INLINE void evaluate_along_v(const pass *p, pia_index i, int degree, int dim)
{
    const pia_collocation *v = p->v;
    double scratch[PIA_MAX_DEGREE + 1], *to = plane(p, i, 0);
    for (pia_index s = 0; s < v->full - degree; s++) {
        const double *control = p->in + (i * v->full + s) * dim;
        for (pia_index row = v->begin[s]; row < v->begin[s + 1]; row++) {
            const double *value = pia_collocation_row(v, row, degree + s, scratch);
            for (int d = 0; d < dim; d++) {
                double sum = value[0] * control[d];
                for (int k = 1; k <= degree; k++) sum += value[k] * control[k * dim + d];
                to[d * p->stride + row] = sum;
            }
        }
    }
    for (int d = 0; d < dim; d++)
        for (pia_index row = v->rows; row < p->stride; row++) to[d * p->stride + row] = 0;
}

static void along_v(void *work, pia_index chunk)
{
    const pass *p = work;
    for (pia_index i = pia_chunk_begin(p->lines, p->chunks, chunk); i < pia_chunk_begin(p->lines, p->chunks, chunk + 1); i++)
        if (p->v->degree == 3 && p->dim == 3)
            evaluate_along_v(p, i, 3, 3);
        else
            evaluate_along_v(p, i, p->v->degree, p->dim);
}

/* The rows of a chunk in groups of one span; `take` works on rows [row, row + count) whose planes begin with control row `first`. */
typedef void take_rows(const pass *p, pia_index row, int count, pia_index first, void *user);

static void each_group(const pass *p, pia_index chunk, take_rows *take, void *user)
{
    const pia_collocation *u = p->u;
    pia_index row = pia_chunk_begin(p->lines, p->chunks, chunk), to = pia_chunk_begin(p->lines, p->chunks, chunk + 1);
    while (row < to) {
        pia_index span = pia_collocation_span(u, row), end = u->begin[span - u->degree + 1];
        if (end > to) end = to;
        if (end > row + ROWS) end = row + ROWS;
        take(p, row, (int)(end - row), span - u->degree, user);
        row = end;
    }
}

/* Component d of A P at PIA_LANES columns from `at` on. */
PIA_INLINE pia_lanes combine(const pass *p, const double *value, pia_index first, int degree, int d, pia_index at)
{
    pia_lanes sum = value[0] * pia_vector_load(plane(p, first, d) + at);
    for (int k = 1; k <= degree; k++) sum += value[k] * pia_vector_load(plane(p, first + k, d) + at);
    return sum;
}

PIA_INLINE void store(pia_lanes value, int count, int dim, double *out)
{
    for (int l = 0; l < count; l++) out[l * dim] = value[l];
}

PIA_INLINE int lanes_at(const pass *p, pia_index at)
{
    return p->v->rows - at < PIA_LANES ? (int)(p->v->rows - at) : PIA_LANES;
}

PIA_CLONES static void apply_group(const pass *p, pia_index row, int count, pia_index first, void *user)
{
    double scratch[PIA_MAX_DEGREE + 1];
    (void)user;
    for (pia_index r = row; r < row + count; r++) {
        const double *value = pia_collocation_row(p->u, r, first + p->u->degree, scratch);
        for (pia_index at = 0; at < p->v->rows; at += PIA_LANES)
            for (int d = 0; d < p->dim; d++)
                store(combine(p, value, first, p->u->degree, d, at), lanes_at(p, at), p->dim,
                      p->out + (r * p->v->rows + at) * p->dim + d);
    }
}

static void apply_chunk(void *work, pia_index chunk)
{
    each_group(work, chunk, apply_group, NULL);
}

/* ---- differences and their errors ---- */

typedef struct tally {
    double worst;
    pia_errors errors;
} tally;

static void count_point(const pass *p, double square, pia_index at, tally *t)
{
    pia_errors *e = &t->errors;
    e->count++;
    e->sum_squares += square;
    e->weighted += p->weights != NULL ? p->weights[at] * square : square;
    if (square < t->worst || (square == t->worst && at > e->max_row)) return;
    t->worst = square;
    e->max_row = at;
}

/* Squares of `count` points from `at` on. Where none is larger than the largest so far, and all count alike, nobody looks closer. A
 * hole makes the sum no number. */
PIA_INLINE void count_block(const pass *p, const double *square, int count, pia_index at, tally *t)
{
    pia_lanes sum = {0}, most = {0};
    int k = 0;
    for (; k + PIA_LANES <= count; k += PIA_LANES) {
        pia_lanes next = pia_vector_load(square + k);
        sum += next;
        most = pia_vector_upper(next, most);
    }
    double total = pia_vector_sum(sum), largest = 0;
    for (int l = 0; l < PIA_LANES; l++) largest = most[l] > largest ? most[l] : largest;
    if (isnan(total) || largest >= t->worst || p->weights != NULL) {
        k = 0;
    } else {
        t->errors.count += k;
        t->errors.sum_squares += total;
        t->errors.weighted += total;
    }
    for (; k < count; k++)
        if (!isnan(square[k])) count_point(p, square[k], at + k, t);
}

/* PIA_LANES points, fewer at the end of a row. The last lanes then repeat the last point. */
PIA_INLINE pia_lanes load_component(const double *points, int count, int dim, int d)
{
    if (count == PIA_LANES) return pia_vector_component(points, dim, d);
    double value[PIA_LANES];
    for (int l = 0; l < PIA_LANES; l++) value[l] = points[(l < count ? l : count - 1) * dim + d];
    return pia_vector_load(value);
}

/* What the points of one span have in common, at hand for the compiler. */
typedef struct piece {
    const pass *p;
    const double *plane[PIA_MAX_DEGREE + 1][PIA_MAX_DIM];
    double origin[PIA_MAX_DIM];
} piece;

static piece piece_of(const pass *p, pia_index first)
{
    piece c = {.p = p};
    for (int d = 0; d < p->dim; d++) {
        c.origin[d] = p->targets->origin[d];
        for (int k = 0; k <= p->u->degree; k++) c.plane[k][d] = plane(p, first + k, d);
    }
    return c;
}

PIA_INLINE void write_points(const pass *p, const pia_lanes *difference, pia_lanes square, int count, pia_index at)
{
    for (int l = 0; l < count; l++)
        for (int d = 0; d < p->dim; d++) {
            pia_index i = (at + l) * p->dim + d;
            double step = isnan(square[l]) ? 0 : difference[d][l];
            p->out[i] = p->base != NULL ? p->base[i] + p->factor * step : step;
        }
}

/* Points at columns from `column` on, of the data row whose point 0 is number `row`. */
PIA_INLINE pia_lanes take_points(const piece *c, const double *value, pia_index row, pia_index column, int degree, int dim)
{
    int count = lanes_at(c->p, column);
    pia_lanes difference[PIA_MAX_DIM], square = {0};
    const double *q = c->p->targets->points + (row + column) * dim;
    __builtin_prefetch(q + AHEAD);
    if (dim > 2) __builtin_prefetch(q + AHEAD + 8);
    for (int d = 0; d < dim; d++) {
        difference[d] = load_component(q, count, dim, d) - c->origin[d];
        for (int k = 0; k <= degree; k++) difference[d] -= value[k] * pia_vector_load(c->plane[k][d] + column);
        square += difference[d] * difference[d];
    }
    if (c->p->out != NULL) write_points(c->p, difference, square, count, row + column);
    return square;
}

PIA_INLINE void take_row(const piece *c, const double *value, pia_index row, pia_index from, pia_index to, int degree, int dim,
                         tally *t)
{
    double square[BLOCK];
    for (pia_index column = from; column < to; column += BLOCK) {
        int count = to - column < BLOCK ? (int)(to - column) : BLOCK;
        for (int k = 0; k < count; k += PIA_LANES) {
            pia_lanes squares = take_points(c, value, row, column + k, degree, dim);
            memcpy(square + k, &squares, sizeof squares);
        }
        count_block(c->p, square, count, row + column, t);
    }
}

PIA_CLONES static void residual_group(const pass *p, pia_index row, int count, pia_index first, void *user)
{
    double scratch[PIA_MAX_DEGREE + 1];
    piece c = piece_of(p, first);
    pia_index columns = p->v->rows;
    for (pia_index from = 0; from < columns; from += COLUMNS)
        for (pia_index r = row; r < row + count; r++) {
            const double *value = pia_collocation_row(p->u, r, first + p->u->degree, scratch);
            pia_index to = from + COLUMNS < columns ? from + COLUMNS : columns;
            if (p->u->degree == 3 && p->dim == 3)
                take_row(&c, value, r * columns, from, to, 3, 3, user);
            else if (p->u->degree == 3 && p->dim == 1)
                take_row(&c, value, r * columns, from, to, 3, 1, user);
            else
                take_row(&c, value, r * columns, from, to, p->u->degree, p->dim, user);
        }
}

static void residual_chunk(void *work, pia_index chunk)
{
    const pass *p = work;
    tally t = {-1, {0, -1, 0, 0, 0}};
    each_group(p, chunk, residual_group, &t);
    t.errors.max = t.worst > 0 ? sqrt(t.worst) : 0;
    p->errors[chunk] = t.errors;
}

static void contract_v(const pia_op *op, const double *full, int dim)
{
    pass p = pass_over(op, dim, op->full_count[0], op->line[1]->rows);
    p.in = full;
    pia_for_each(op->context, p.chunks, along_v, &p);
}

static void apply(const pia_op *op, const double *full, int dim, double *values)
{
    contract_v(op, full, dim);
    pass p = pass_over(op, dim, op->line[0]->rows, op->line[1]->rows);
    p.out = values;
    pia_for_each(op->context, p.chunks, apply_chunk, &p);
}

static pia_errors residual(const pia_op *op, const double *full, const pia_targets *targets, const double *base, double factor,
                           double *out)
{
    pia_errors errors[MAX_CHUNKS];
    contract_v(op, full, targets->dim);
    pass p = pass_over(op, targets->dim, op->line[0]->rows, op->line[1]->rows);
    p.targets = targets;
    p.weights = op->weights;
    p.base = base;
    p.factor = factor;
    p.out = out;
    p.errors = errors;
    pia_for_each(op->context, p.chunks, residual_chunk, &p);
    for (pia_index c = 1; c < p.chunks; c++) errors[0] = pia_errors_join(errors[0], errors[c]);
    return errors[0];
}

/* ---- the transposed map ---- */

/* line [columns x dim] += value, times the weight of each column, times from. */
PIA_INLINE void add_row(double value, const double *from, const double *weights, pia_index columns, int dim, double *line)
{
    pia_index width = columns * dim;
    if (weights == NULL)
        for (pia_index k = 0; k < width; k++) line[k] += value * from[k];
    else
        for (pia_index k = 0; k < width; k++) line[k] += weights[k / dim] * value * from[k];
}

/* Sum over data rows r of N_i(u_r) values[r]. */
PIA_CLONES static void gather_along_u(const pass *p, pia_index i, double *line)
{
    const pia_collocation *u = p->u;
    pia_index columns = p->v->rows;
    double scratch[PIA_MAX_DEGREE + 1];
    memset(line, 0, (size_t)(columns * p->dim) * sizeof *line);
    for (pia_index s = i > u->degree ? i - u->degree : 0; s <= i && s < u->full - u->degree; s++)
        for (pia_index row = u->begin[s]; row < u->begin[s + 1]; row++)
            add_row(pia_collocation_row(u, row, u->degree + s, scratch)[i - s], p->in + row * columns * p->dim,
                    p->weights != NULL ? p->weights + row * columns : NULL, columns, p->dim, line);
}

/* to = line A_v. */
PIA_INLINE void gather_along_v(const pass *p, const double *line, double *to, int degree, int dim)
{
    const pia_collocation *v = p->v;
    double scratch[PIA_MAX_DEGREE + 1];
    memset(to, 0, (size_t)(v->full * dim) * sizeof *to);
    for (pia_index s = 0; s < v->full - degree; s++)
        for (pia_index row = v->begin[s]; row < v->begin[s + 1]; row++) {
            const double *value = pia_collocation_row(v, row, degree + s, scratch);
            for (int k = 0; k <= degree; k++)
                for (int d = 0; d < dim; d++) to[(s + k) * dim + d] += value[k] * line[row * dim + d];
        }
}

static void gather_chunk(void *work, pia_index chunk)
{
    const pass *p = work;
    const pia_collocation *v = p->v;
    for (pia_index i = pia_chunk_begin(p->lines, p->chunks, chunk); i < pia_chunk_begin(p->lines, p->chunks, chunk + 1); i++) {
        double *line = p->along + i * v->rows * p->dim, *to = p->out + i * v->full * p->dim;
        gather_along_u(p, i, line);
        if (v->degree == 3 && p->dim == 3)
            gather_along_v(p, line, to, 3, 3);
        else
            gather_along_v(p, line, to, v->degree, p->dim);
    }
}

static void gather(const pia_op *op, const double *values, const double *weights, int dim, double *full)
{
    pass p = pass_over(op, dim, op->full_count[0], op->line[1]->rows);
    p.in = values;
    p.weights = weights;
    p.out = full;
    pia_for_each(op->context, p.chunks, gather_chunk, &p);
}

static const pia_op_class grid = {"grid", apply, gather, residual, NULL};

pia_status pia_op_grid_open(pia_context *context, pia_collocation *u, pia_collocation *v, const double *weights, int dim, pia_op **out)
{
    pia_index unknowns[2] = {u->unknowns, v->unknowns}, fulls[2] = {u->full, v->full}, rows, size;
    pia_op *op;
    if (!pia_multiply(u->rows, v->rows, &rows) || !pia_multiply(u->full, v->rows + PIA_LANES, &size) || !pia_multiply(size, dim, &size))
        return pia_fail(context, PIA_E_SIZE, "a grid of %lld x %lld points does not fit in 64 bits", (long long)u->rows,
                        (long long)v->rows);
    pia_status status = pia_op_new(context, &grid, 2, unknowns, fulls, rows, weights, dim, &op);
    if (status != PIA_OK) return status;
    op->axis[0] = op->line[0] = u;
    op->axis[1] = op->line[1] = v;
    size = u->full * whole(v->rows) * dim;
    op->along = pia_take(context, size, sizeof *op->along);
    if (op->along == NULL) {
        pia_op_close(op);
        return pia_take_status(context, size, sizeof *op->along);
    }
    *out = op;
    return PIA_OK;
}
