#include "stencil.h"

#include "kernel.h"

#include <string.h>

#define INLINE static inline __attribute__((always_inline))

enum { GRAIN = 4096 }; /* control points a thread should get at least */

pia_status pia_stencil_open(const pia_op *op, int dim, pia_stencil *out)
{
    pia_stencil s = {.context = op->context, .p = op->axis[0]->degree, .q = op->axis[1]->degree, .dim = dim};
    pia_index size, work;
    s.lines = op->full_count[0];
    s.columns = op->full_count[1];
    s.stride = s.columns + 2 * s.q;
    if (!pia_multiply(s.lines, s.stride, &size) || !pia_multiply(size, dim, &work) ||
        !pia_multiply(size, (s.p + 1) * (2 * s.q + 1), &size))
        return pia_fail(op->context, PIA_E_SIZE, "the equations of %lld control points do not fit in 64 bits; ask for fewer",
                        (long long)op->fulls);
    s.entry = pia_take_zero(op->context, size, sizeof *s.entry);
    s.x = pia_take_zero(op->context, work, sizeof *s.x);
    s.y = pia_take(op->context, work, sizeof *s.y);
    if (s.entry == NULL || s.x == NULL || s.y == NULL) {
        pia_stencil_close(&s);
        return pia_take_status(op->context, size, sizeof *s.entry);
    }
    *out = s;
    return PIA_OK;
}

void pia_stencil_close(pia_stencil *s)
{
    pia_give(s->context, s->entry);
    pia_give(s->context, s->x);
    pia_give(s->context, s->y);
    *s = (pia_stencil){0};
}

void pia_stencil_clear(pia_stencil *s)
{
    memset(s->entry, 0, (size_t)(s->lines * (s->p + 1) * (2 * s->q + 1) * s->stride) * sizeof *s->entry);
}

/* ---- products ---- */

typedef struct product {
    const pia_stencil *s;
    int dim;
    pia_index chunks;
    double *out;
} product;

/* y[j] += sum over b = from .. q of line_b[j] x[j + b]; the zeros around lines and x make every j alike. back: the transposed entries,
 * y[j + b] += line_b[j] x[j] gathered by j + b. One component, and three that share the entries. */
INLINE void add_one(const double *line, pia_index stride, int from, int q, int back, pia_index count, const double *restrict x,
                    double *restrict y)
{
    for (pia_index j = 0; j < count; j++) {
        double sum = 0;
        for (int b = from; b <= q; b++) sum += line[b * stride + (back ? j - b : j)] * x[back ? j - b : j + b];
        y[j] += sum;
    }
}

INLINE void add_three(const double *line, pia_index stride, int from, int q, int back, pia_index count, const double *restrict x,
                      double *restrict y)
{
    for (pia_index j = 0; j < count; j++) {
        double sum0 = 0, sum1 = 0, sum2 = 0;
        for (int b = from; b <= q; b++) {
            double entry = line[b * stride + (back ? j - b : j)];
            const double *at = x + (back ? j - b : j + b);
            sum0 += entry * at[0];
            sum1 += entry * at[stride];
            sum2 += entry * at[2 * stride];
        }
        y[j] += sum0;
        y[stride + j] += sum1;
        y[2 * stride + j] += sum2;
    }
}

INLINE void add(const product *p, pia_index line, int a, int from, int q, int back, const double *x, double *y)
{
    const pia_stencil *s = p->s;
    const double *entries = pia_stencil_line(s, line, a, 0);
    int d = 0;
    for (; d + 3 <= p->dim; d += 3) add_three(entries, s->stride, from, q, back, s->columns, x + d * s->stride, y + d * s->stride);
    for (; d < p->dim; d++) add_one(entries, s->stride, from, q, back, s->columns, x + d * s->stride, y + d * s->stride);
}

INLINE void multiply_line(const product *p, pia_index i, int q)
{
    const pia_stencil *s = p->s;
    pia_index size = p->dim * s->stride;
    const double *x = s->x + i * size + q;
    double *y = s->y + i * size + q;
    memset(s->y + i * size, 0, (size_t)size * sizeof *y);
    for (int a = s->p; a >= 1; a--)
        if (i >= a) add(p, i - a, a, -q, q, 1, x - a * size, y);
    add(p, i, 0, 1, q, 1, x, y);
    add(p, i, 0, 0, q, 0, x, y);
    for (int a = 1; a <= s->p && i + a < s->lines; a++) add(p, i, a, -q, q, 0, x + a * size, y);
}

static void multiply_chunk(void *work, pia_index chunk)
{
    const product *p = work;
    const pia_stencil *s = p->s;
    for (pia_index i = pia_chunk_begin(s->lines, p->chunks, chunk); i < pia_chunk_begin(s->lines, p->chunks, chunk + 1); i++) {
        if (s->q == 3)
            multiply_line(p, i, 3);
        else
            multiply_line(p, i, s->q);
        for (int d = 0; d < p->dim; d++) {
            const double *y = s->y + (i * p->dim + d) * s->stride + s->q;
            for (pia_index j = 0; j < s->columns; j++) p->out[(i * s->columns + j) * p->dim + d] = y[j];
        }
    }
}

/* Components apart and lines padded: the inner loops run along v over contiguous numbers. */
void pia_stencil_multiply(const pia_stencil *s, const double *x, int dim, double *y)
{
    pia_index chunks = pia_chunk_count(s->lines * s->columns, GRAIN);
    product p = {s, dim, chunks < s->lines ? chunks : s->lines, y};
    for (pia_index i = 0; i < s->lines; i++)
        for (int d = 0; d < dim; d++) {
            double *to = s->x + (i * dim + d) * s->stride;
            for (int k = 0; k < s->q; k++) to[k] = to[s->q + s->columns + k] = 0;
            for (pia_index j = 0; j < s->columns; j++) to[s->q + j] = x[(i * s->columns + j) * dim + d];
        }
    pia_for_each(s->context, p.chunks, multiply_chunk, &p);
}

/* ---- the matrix over the unknowns ---- */

/* Calls visit for every stored entry: full control points (i, j) and (i + a, j + b). */
typedef void visit_entry(void *user, pia_index first, pia_index second, double value);

static void visit_all(const pia_stencil *s, visit_entry *visit, void *user)
{
    for (pia_index i = 0; i < s->lines; i++)
        for (int a = 0; a <= s->p && i + a < s->lines; a++)
            for (int b = a == 0 ? 0 : -s->q; b <= s->q; b++) {
                const double *line = pia_stencil_line(s, i, a, b);
                pia_index from = b < 0 ? -b : 0, to = b > 0 ? s->columns - b : s->columns;
                for (pia_index j = from; j < to; j++) visit(user, i * s->columns + j, (i + a) * s->columns + j + b, line[j]);
            }
}

typedef struct assembly {
    const pia_op *op;
    const double *scale;
    pia_index count;
    pia_index *row, *column;
    double *value;
} assembly;

/* Two different full control points that are copies of one unknown meet on its diagonal in both orders. */
static void add_triplet(void *user, pia_index first, pia_index second, double value)
{
    assembly *t = user;
    pia_index i = pia_op_unknown(t->op, first), j = pia_op_unknown(t->op, second);
    double scaled = value * t->scale[i] * t->scale[j];
    if (scaled == 0) return;
    t->row[t->count] = i > j ? i : j;
    t->column[t->count] = i > j ? j : i;
    t->value[t->count++] = i == j && first != second ? 2 * scaled : scaled;
}

pia_index pia_stencil_room(const pia_stencil *s, const pia_op *op)
{
    return s->lines * s->columns * ((pia_index)s->p * (2 * s->q + 1) + s->q + 1) + op->cols;
}

pia_index pia_stencil_triplets(const pia_stencil *s, const pia_op *op, const double *scale, pia_index *row, pia_index *column,
                               double *value)
{
    assembly t = {op, scale, 0, row, column, value};
    visit_all(s, add_triplet, &t);
    for (pia_index i = 0; i < op->cols; i++) {
        if (scale[i] != 0) continue;
        row[t.count] = column[t.count] = i;
        value[t.count++] = 1;
    }
    return t.count;
}

static void add_diagonal(void *user, pia_index first, pia_index second, double value)
{
    assembly *t = user;
    pia_index i = pia_op_unknown(t->op, first);
    if (first == second)
        t->value[i] += value;
    else if (!t->op->identity && pia_op_unknown(t->op, second) == i)
        t->value[i] += 2 * value;
}

void pia_stencil_diagonal(const pia_stencil *s, const pia_op *op, double *diagonal)
{
    assembly t = {.op = op, .value = diagonal};
    memset(diagonal, 0, (size_t)op->cols * sizeof *diagonal);
    visit_all(s, add_diagonal, &t);
}

/* ---- marginals ---- */

static double sum_line(const double *line, pia_index count)
{
    double sum = 0;
    for (pia_index j = 0; j < count; j++) sum += line[j];
    return sum;
}

static void add_band(pia_gram *gram, const pia_op *op, int direction, pia_index full, int apart, double value)
{
    pia_index unknown = pia_collocation_unknown(op->axis[direction], full);
    gram[direction].band[unknown * (gram[direction].width + 1) + apart] += value;
}

void pia_stencil_marginals(const pia_stencil *s, const pia_op *op, pia_gram *gram)
{
    double total = 0;
    for (int d = 0; d < 2; d++) pia_gram_clear(&gram[d]);
    for (pia_index i = 0; i < s->lines; i++)
        for (int a = 0; a <= s->p; a++)
            for (int b = a == 0 ? 0 : -s->q; b <= s->q; b++) {
                const double *line = pia_stencil_line(s, i, a, b);
                double sum = (a == 0 && b > 0 ? 2 : 1) * sum_line(line, s->columns);
                total += a == 0 ? sum : 2 * sum;
                if (sum != 0) add_band(gram, op, 0, i, a, sum);
                double twice = a > 0 && b == 0 ? 2 : 1; /* (i, j), (i + a, j) counts in both orders */
                for (pia_index j = 0; j < s->columns; j++)
                    if (line[j] != 0) add_band(gram, op, 1, b < 0 ? j + b : j, b < 0 ? -b : b, twice * line[j]);
            }
    for (pia_index k = 0; total > 0 && k < gram[1].count * (gram[1].width + 1); k++) gram[1].band[k] /= total;
}
