#include "gram.h"

#include "band.h"
#include "clones.h"
#include "kernel.h"

#include <math.h>
#include <string.h>

enum { GRAIN = 16384 /* numbers a thread should get at least */, MAX_CHUNKS = 256 };

static const double weak_pivot = 1e-13, ridge = 1e-9;

pia_status pia_gram_open(pia_context *context, const pia_collocation *line, pia_gram *out)
{
    pia_gram gram = {.context = context, .line = line, .count = line->unknowns, .width = line->degree};
    gram.band = pia_take(context, gram.count, (size_t)(gram.width + 1) * sizeof *gram.band);
    if (gram.band == NULL) return pia_take_status(context, gram.count, (size_t)(gram.width + 1) * sizeof *gram.band);
    *out = gram;
    return PIA_OK;
}

void pia_gram_close(pia_gram *gram)
{
    pia_give(gram->context, gram->band);
    pia_give(gram->context, gram->factor);
    pia_give(gram->context, gram->border);
    pia_give(gram->context, gram->still);
    *gram = (pia_gram){0};
}

void pia_gram_clear(pia_gram *gram)
{
    memset(gram->band, 0, (size_t)(gram->count * (gram->width + 1)) * sizeof *gram->band);
}

void pia_gram_add_row(pia_gram *gram, pia_index s, int k, const double *row)
{
    pia_index i = pia_collocation_unknown(gram->line, s + k);
    double *to = gram->band + i * (gram->width + 1);
    for (int l = k; l <= gram->width; l++) {
        pia_index apart = gram->line->map == PIA_MAP_DOUBLED ? pia_collocation_unknown(gram->line, s + l) - i : l - k;
        int twice = apart == 0 && l > k; /* two columns that are copies of one unknown meet on its diagonal in both orders */
        to[apart] += twice ? 2 * row[l - k] : row[l - k];
    }
}

void pia_gram_add(pia_gram *gram, pia_index s, const double *share)
{
    for (int k = 0; k <= gram->width; share += gram->width + 1 - k, k++) pia_gram_add_row(gram, s, k, share);
}

static pia_index partner(const pia_gram *gram, pia_index i, int k)
{
    return gram->line->map == PIA_MAP_CYCLIC ? (i + k) % gram->count : i + k;
}

void pia_gram_diagonal(const pia_gram *gram, double *out)
{
    int row = gram->width + 1, reach = gram->line->map == PIA_MAP_CYCLIC ? gram->width : 0; /* how far around copies meet */
    for (pia_index i = 0; i < gram->count; i++) {
        out[i] = gram->band[i * row];
        for (int k = 1; k <= reach; k++)
            if (partner(gram, i, k) == i) out[i] += 2 * gram->band[i * row + k];
    }
}

typedef struct product {
    const pia_gram *gram;
    const double *x;
    pia_index rows, after, chunks;
    double *y;
} product;

PIA_INLINE void add_multiple(double factor, const double *x, pia_index count, double *y)
{
    for (pia_index c = 0; c < count; c++) y[c] += factor * x[c];
}

/* Row i gathers from its neighbours on both sides, farthest before it first, so that rows are independent and their order of summation
 * is fixed. */
PIA_INLINE void gather_near_end(const pia_gram *g, pia_index i, const double *x, pia_index after, double *y)
{
    int cyclic = g->line->map == PIA_MAP_CYCLIC, width = g->width;
    for (int k = width; k >= 1; k--) {
        pia_index j = i - k;
        if (j < 0 && cyclic) j = (j % g->count + g->count) % g->count;
        if (j >= 0) add_multiple(g->band[j * (width + 1) + k], x + j * after, after, y);
    }
    for (int k = 0; k <= width; k++) {
        pia_index j = i + k;
        if (j >= g->count && cyclic) j %= g->count;
        if (j < g->count) add_multiple(g->band[i * (width + 1) + k], x + j * after, after, y);
    }
}

PIA_INLINE void gather_inside(const double *row, int width, const double *x, pia_index after, double *y)
{
    for (int k = width; k >= 1; k--) add_multiple(row[k - k * (width + 1)], x - k * after, after, y);
    for (int k = 0; k <= width; k++) add_multiple(row[k], x + k * after, after, y);
}

/* y [after] = row i of the product with x [count x after]. */
PIA_INLINE void multiply_row_of(const pia_gram *g, pia_index i, const double *x, int width, pia_index after, double *y)
{
    for (pia_index c = 0; c < after; c++) y[c] = 0;
    if (i >= width && i < g->count - width)
        gather_inside(g->band + i * (width + 1), width, x + i * after, after, y);
    else
        gather_near_end(g, i, x, after, y);
}

PIA_INLINE void multiply_row(const pia_gram *g, pia_index i, const double *x, pia_index after, double *y)
{
    if (g->width == 3 && after == 3)
        multiply_row_of(g, i, x, 3, 3, y);
    else if (g->width == 3 && after == 2)
        multiply_row_of(g, i, x, 3, 2, y);
    else if (g->width == 3 && after == 1)
        multiply_row_of(g, i, x, 3, 1, y);
    else
        multiply_row_of(g, i, x, g->width, after, y);
}

PIA_CLONES static void multiply_chunk(void *work, pia_index chunk)
{
    const product *p = work;
    pia_index row = pia_chunk_begin(p->rows, p->chunks, chunk), end = pia_chunk_begin(p->rows, p->chunks, chunk + 1);
    for (pia_index i = row % p->gram->count; row < end; row++, i = i + 1 < p->gram->count ? i + 1 : 0)
        multiply_row(p->gram, i, p->x + (row - i) * p->after, p->after, p->y + row * p->after);
}

void pia_gram_multiply(const pia_gram *gram, const double *x, pia_index before, pia_index after, double *y)
{
    product p = {gram, x, before * gram->count, after, 1, y};
    p.chunks = pia_chunk_count(p.rows * after, GRAIN);
    pia_for_each(gram->context, p.chunks, multiply_chunk, &p);
}

typedef struct residual {
    const pia_gram *gram;
    const double *x, *b;
    double *r, *square; /* r [count x dim] or NULL; square [chunks] */
    pia_index chunks;
    int dim;
} residual;

PIA_INLINE double subtract_rows(const residual *s, pia_index from, pia_index end, int dim)
{
    double sum[PIA_MAX_DIM], square = 0;
    for (pia_index i = from; i < end; i++) {
        multiply_row(s->gram, i, s->x, dim, sum);
        for (int d = 0; d < dim; d++) {
            double difference = s->b[i * dim + d] - sum[d];
            square += difference * difference;
            if (s->r != NULL) s->r[i * dim + d] = difference;
        }
    }
    return square;
}

PIA_CLONES static void subtract_chunk(void *work, pia_index chunk)
{
    const residual *s = work;
    pia_index from = pia_chunk_begin(s->gram->count, s->chunks, chunk), end = pia_chunk_begin(s->gram->count, s->chunks, chunk + 1);
    s->square[chunk] = s->dim == 3   ? subtract_rows(s, from, end, 3)
                       : s->dim == 2 ? subtract_rows(s, from, end, 2)
                                     : subtract_rows(s, from, end, s->dim);
}

double pia_gram_residual(const pia_gram *gram, const double *x, const double *b, int dim, double *r)
{
    double square[MAX_CHUNKS], sum = 0;
    pia_index chunks = pia_chunk_count(gram->count * dim, GRAIN);
    residual s = {gram, x, b, r, square, chunks < MAX_CHUNKS ? chunks : MAX_CHUNKS, dim};
    pia_for_each(gram->context, s.chunks, subtract_chunk, &s);
    for (pia_index c = 0; c < s.chunks; c++) sum += square[c];
    return sum;
}

static void relax_row(const product *p, const unsigned char *frozen, const double *diagonal, const double *b, pia_index i, double *x)
{
    double sum[PIA_MAX_DIM];
    if ((frozen != NULL && frozen[i]) || !(diagonal[i] > 0)) return;
    multiply_row(p->gram, i, x, p->after, sum);
    for (pia_index d = 0; d < p->after; d++) x[i * p->after + d] += (b[i * p->after + d] - sum[d]) / diagonal[i];
}

void pia_gram_sweep(const pia_gram *gram, const unsigned char *frozen, const double *diagonal, const double *b, int dim, double *x)
{
    product p = {gram, x, gram->count, dim, 1, NULL};
    for (pia_index i = 0; i < gram->count; i++) relax_row(&p, frozen, diagonal, b, i, x);
    for (pia_index i = gram->count - 1; i >= 0; i--) relax_row(&p, frozen, diagonal, b, i, x);
}

/* A closed direction of few unknowns: the band reaches around, and the whole matrix is taken. */
static int is_small(const pia_gram *gram)
{
    return gram->line->map == PIA_MAP_CYCLIC && gram->count <= 2 * gram->width;
}

static int is_bordered(const pia_gram *gram)
{
    return gram->line->map == PIA_MAP_CYCLIC && !is_small(gram);
}

static pia_status take_factor(pia_gram *gram)
{
    if (gram->factor != NULL) return PIA_OK;
    gram->factor_width = is_small(gram) ? (int)gram->count - 1 : gram->width;
    pia_index row = gram->factor_width + 1;
    gram->still = pia_take(gram->context, gram->count, sizeof *gram->still);
    gram->factor = pia_take(gram->context, gram->count, (size_t)row * sizeof *gram->factor);
    pia_index border = is_bordered(gram) ? gram->count + gram->width : 0;
    gram->border = pia_take(gram->context, border, (size_t)row * sizeof *gram->border);
    if (gram->still != NULL && gram->factor != NULL && gram->border != NULL) return PIA_OK;
    pia_give(gram->context, gram->factor);
    pia_give(gram->context, gram->still);
    pia_give(gram->context, gram->border);
    gram->factor = gram->border = NULL;
    gram->still = NULL;
    return pia_take_status(gram->context, gram->count, (size_t)row * sizeof *gram->factor);
}

/* Which unknowns stay. Returns how many of them for want of data. */
static pia_index find_still(pia_gram *gram, const unsigned char *frozen)
{
    pia_index empty = 0;
    double *diagonal = gram->factor; /* for now */
    pia_gram_diagonal(gram, diagonal);
    gram->any_still = 0;
    for (pia_index i = 0; i < gram->count; i++) {
        int asked = frozen != NULL && frozen[i], held = diagonal[i] > 0;
        gram->still[i] = asked || !held;
        gram->any_still |= gram->still[i];
        empty += !held && !asked;
    }
    return empty;
}

/* The matrix, its diagonal times `more`, with rows of the identity for unknowns that stay. */
static void copy_rows(const pia_gram *gram, double more, pia_index from, pia_index to)
{
    int width = gram->width;
    for (pia_index i = from; i < to; i++) {
        const double *row = gram->band + i * (width + 1);
        double *out = gram->factor + i * (width + 1);
        for (int k = 0; k <= width; k++) out[k] = row[k];
        for (int k = 0; k <= width && gram->any_still; k++) {
            pia_index j = partner(gram, i, k);
            if (gram->still[i] || j >= gram->count || gram->still[j]) out[k] = 0;
        }
        out[0] = gram->any_still && gram->still[i] ? 1 : out[0] * more;
    }
}

/* The same of a matrix whose band reaches around. */
static void copy_small(const pia_gram *gram, double more)
{
    int width = gram->factor_width;
    memset(gram->factor, 0, (size_t)(gram->count * (width + 1)) * sizeof *gram->factor);
    for (pia_index i = 0; i < gram->count; i++) {
        for (int k = 0; k <= gram->width; k++) {
            pia_index j = partner(gram, i, k), row = j < i ? j : i, apart = j < i ? i - j : j - i;
            double entry = gram->still[i] || gram->still[j] ? 0 : gram->band[i * (gram->width + 1) + k];
            gram->factor[row * (width + 1) + apart] += apart == 0 && k > 0 ? 2 * entry : entry;
        }
    }
    for (pia_index i = 0; i < gram->count; i++) {
        double *diagonal = gram->factor + i * (width + 1);
        *diagonal = gram->still[i] ? 1 : *diagonal * more;
    }
}

typedef struct copies {
    const pia_gram *gram;
    double more;
    pia_index chunks;
} copies;

static void copy_chunk(void *work, pia_index chunk)
{
    const copies *c = work;
    pia_index count = c->gram->count;
    copy_rows(c->gram, c->more, pia_chunk_begin(count, c->chunks, chunk), pia_chunk_begin(count, c->chunks, chunk + 1));
}

/* Returns how many pivots were weak, each beside its own diagonal: the scale of the unknowns does not matter. */
static pia_index factor_matrix(pia_gram *gram, double more)
{
    copies c = {gram, more, pia_chunk_count(gram->count * (gram->width + 1), GRAIN)};
    if (is_small(gram))
        copy_small(gram, more);
    else
        pia_for_each(gram->context, c.chunks, copy_chunk, &c);
    if (is_bordered(gram)) return pia_band_cyclic_factor(gram->factor, gram->count, gram->width, weak_pivot, gram->border);
    return pia_band_ldl_factor(gram->factor, gram->count, gram->factor_width, weak_pivot, NULL, 0);
}

pia_status pia_gram_factor(pia_gram *gram, const unsigned char *frozen)
{
    pia_status status = take_factor(gram);
    if (status != PIA_OK) return status;
    gram->weak = find_still(gram, frozen);
    gram->refused = factor_matrix(gram, 1);
    if (gram->refused > 0) factor_matrix(gram, 1 + ridge);
    gram->weak += gram->refused;
    return PIA_OK;
}

static void settle(const pia_gram *gram, pia_index after, double *b)
{
    for (pia_index i = 0; i < gram->count && gram->any_still; i++)
        for (pia_index c = 0; c < after && gram->still[i]; c++) b[i * after + c] = 0;
}

typedef struct solution {
    const pia_gram *gram;
    pia_index before, after, chunks;
    double *b;
} solution;

static void solve_chunk(void *work, pia_index chunk)
{
    const solution *s = work;
    const pia_gram *g = s->gram;
    pia_index end = pia_chunk_begin(s->before, s->chunks, chunk + 1);
    for (pia_index k = pia_chunk_begin(s->before, s->chunks, chunk); k < end; k++) {
        double *b = s->b + k * g->count * s->after;
        settle(g, s->after, b);
        if (is_bordered(g))
            pia_band_cyclic_solve(g->factor, g->border, g->count, g->factor_width, b, (int)s->after);
        else
            pia_band_ldl_solve(g->factor, g->count, g->factor_width, b, (int)s->after);
    }
}

void pia_gram_solve(const pia_gram *gram, double *b, pia_index before, pia_index after)
{
    solution s = {gram, before, after, 1, b};
    s.chunks = pia_chunk_count(before * gram->count * after, GRAIN);
    if (s.chunks > before) s.chunks = before > 0 ? before : 1;
    pia_for_each(gram->context, s.chunks, solve_chunk, &s);
}

pia_status pia_gram_leap(const pia_gram *gram, const double *b, int dim, double *x, int *done)
{
    pia_band_system system = {gram->band, b, gram->count, gram->width, dim, gram->line->map == PIA_MAP_CYCLIC, weak_pivot};
    *done = 0;
    return pia_band_windows_suit(gram->count, gram->width) ? pia_band_windows_solve(gram->context, &system, x, done) : PIA_OK;
}
