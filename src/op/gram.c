#include "gram.h"

#include "band.h"
#include "clones.h"
#include "kernel.h"

#include <math.h>
#include <string.h>

enum { GRAIN = 16384 }; /* numbers a thread should get at least */

static const double weak_pivot = 1e-13, ridge = 1e-9;

pia_status pia_gram_open(pia_context *context, const pia_collocation *line, pia_gram *out)
{
    pia_gram gram = {.context = context, .line = line, .count = line->unknowns, .width = line->degree};
    gram.band = pia_take_zero(context, gram.count, (size_t)(gram.width + 1) * sizeof *gram.band);
    if (gram.band == NULL) return pia_take_status(context, gram.count, (size_t)(gram.width + 1) * sizeof *gram.band);
    *out = gram;
    return PIA_OK;
}

void pia_gram_close(pia_gram *gram)
{
    pia_give(gram->context, gram->band);
    pia_give(gram->context, gram->factor);
    pia_give(gram->context, gram->border);
    pia_give(gram->context, gram->scale);
    *gram = (pia_gram){0};
}

void pia_gram_clear(pia_gram *gram)
{
    memset(gram->band, 0, (size_t)(gram->count * (gram->width + 1)) * sizeof *gram->band);
}

/* Two columns that are copies of one unknown meet on its diagonal in both orders. */
void pia_gram_add(pia_gram *gram, pia_index s, const double *share)
{
    int cyclic = gram->line->map == PIA_MAP_CYCLIC;
    for (int k = 0; k <= gram->width; k++) {
        pia_index i = pia_collocation_unknown(gram->line, s + k);
        for (int l = k; l <= gram->width; l++, share++) {
            pia_index apart = cyclic ? l - k : pia_collocation_unknown(gram->line, s + l) - i;
            int twice = !cyclic && apart == 0 && l > k;
            gram->band[i * (gram->width + 1) + apart] += twice ? 2 * *share : *share;
        }
    }
}

static pia_index partner(const pia_gram *gram, pia_index i, int k)
{
    return gram->line->map == PIA_MAP_CYCLIC ? (i + k) % gram->count : i + k;
}

void pia_gram_diagonal(const pia_gram *gram, double *out)
{
    for (pia_index i = 0; i < gram->count; i++) {
        const double *row = gram->band + i * (gram->width + 1);
        out[i] = row[0];
        for (int k = 1; k <= gram->width; k++)
            if (partner(gram, i, k) == i) out[i] += 2 * row[k];
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

/* Row i gathers from its neighbours on both sides, so that rows are independent and their order of summation is fixed. */
PIA_INLINE void gather_row(const product *p, pia_index i, const double *x, pia_index after, double *y)
{
    const pia_gram *g = p->gram;
    int cyclic = g->line->map == PIA_MAP_CYCLIC, width = g->width;
    for (pia_index c = 0; c < after; c++) y[c] = 0;
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

static void multiply_row(const product *p, pia_index i, const double *x, double *y)
{
    switch (p->after) {
    case 1: gather_row(p, i, x, 1, y); break;
    case 2: gather_row(p, i, x, 2, y); break;
    case 3: gather_row(p, i, x, 3, y); break;
    default: gather_row(p, i, x, p->after, y); break;
    }
}

static void multiply_chunk(void *work, pia_index chunk)
{
    const product *p = work;
    for (pia_index r = pia_chunk_begin(p->rows, p->chunks, chunk); r < pia_chunk_begin(p->rows, p->chunks, chunk + 1); r++) {
        pia_index i = r % p->gram->count;
        multiply_row(p, i, p->x + (r - i) * p->after, p->y + r * p->after);
    }
}

void pia_gram_multiply(const pia_gram *gram, const double *x, pia_index before, pia_index after, double *y)
{
    product p = {gram, x, before * gram->count, after, 1, y};
    p.chunks = pia_chunk_count(p.rows * after, GRAIN);
    pia_for_each(gram->context, p.chunks, multiply_chunk, &p);
}

static void relax_row(const product *p, const unsigned char *frozen, const double *diagonal, const double *b, pia_index i, double *x)
{
    double sum[PIA_MAX_DIM];
    if ((frozen != NULL && frozen[i]) || !(diagonal[i] > 0)) return;
    multiply_row(p, i, x, sum);
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
    gram->scale = pia_take(gram->context, gram->count, sizeof *gram->scale);
    gram->factor = pia_take(gram->context, gram->count, (size_t)row * sizeof *gram->factor);
    pia_index border = is_bordered(gram) ? gram->count + gram->width : 0;
    gram->border = pia_take(gram->context, border, (size_t)row * sizeof *gram->border);
    if (gram->scale != NULL && gram->factor != NULL && gram->border != NULL) return PIA_OK;
    pia_give(gram->context, gram->factor);
    pia_give(gram->context, gram->scale);
    pia_give(gram->context, gram->border);
    gram->factor = gram->scale = gram->border = NULL;
    return pia_take_status(gram->context, gram->count, (size_t)row * sizeof *gram->factor);
}

/* Returns how many unknowns have no data. */
static pia_index find_scale(pia_gram *gram, const unsigned char *frozen)
{
    pia_index empty = 0;
    pia_gram_diagonal(gram, gram->scale);
    for (pia_index i = 0; i < gram->count; i++) {
        int still = frozen != NULL && frozen[i], held = gram->scale[i] > 0;
        gram->scale[i] = held && !still ? 1 / sqrt(gram->scale[i]) : 0;
        empty += !held && !still;
    }
    return empty;
}

/* Factors the scaled matrix plus `added` on its diagonal; unknowns of scale 0 get identity rows. Returns how many pivots were weak. */
static pia_index factor_scaled(pia_gram *gram, double added)
{
    int width = gram->factor_width, small = is_small(gram);
    memset(gram->factor, 0, (size_t)(gram->count * (width + 1)) * sizeof *gram->factor);
    for (pia_index i = 0; i < gram->count; i++) {
        for (int k = 0; k <= gram->width; k++) {
            pia_index j = partner(gram, i, k);
            if (j >= gram->count) break;
            double entry = gram->band[i * (gram->width + 1) + k] * gram->scale[i] * gram->scale[j];
            pia_index row = small && j < i ? j : i, apart = !small ? k : j < i ? i - j : j - i;
            gram->factor[row * (width + 1) + apart] += apart == 0 && k > 0 ? 2 * entry : entry;
        }
        gram->factor[i * (width + 1)] += gram->scale[i] > 0 ? added : 1;
    }
    if (is_bordered(gram)) return pia_band_cyclic_factor(gram->factor, gram->count, width, weak_pivot, gram->border);
    return pia_band_ldl_factor(gram->factor, gram->count, width, weak_pivot, NULL, 0);
}

pia_status pia_gram_factor(pia_gram *gram, const unsigned char *frozen)
{
    pia_status status = take_factor(gram);
    if (status != PIA_OK) return status;
    gram->weak = find_scale(gram, frozen);
    gram->refused = factor_scaled(gram, 0);
    if (gram->refused > 0) factor_scaled(gram, ridge);
    gram->weak += gram->refused;
    return PIA_OK;
}

static void scale_rows(const pia_gram *gram, pia_index after, double *b)
{
    for (pia_index i = 0; i < gram->count; i++)
        for (pia_index c = 0; c < after; c++) b[i * after + c] *= gram->scale[i];
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
    for (pia_index k = pia_chunk_begin(s->before, s->chunks, chunk); k < pia_chunk_begin(s->before, s->chunks, chunk + 1); k++) {
        double *b = s->b + k * g->count * s->after;
        scale_rows(g, s->after, b);
        if (is_bordered(g))
            pia_band_cyclic_solve(g->factor, g->border, g->count, g->factor_width, b, (int)s->after);
        else
            pia_band_ldl_solve(g->factor, g->count, g->factor_width, b, (int)s->after);
        scale_rows(g, s->after, b);
    }
}

void pia_gram_solve(const pia_gram *gram, double *b, pia_index before, pia_index after)
{
    solution s = {gram, before, after, 1, b};
    s.chunks = pia_chunk_count(before * gram->count * after, GRAIN);
    if (s.chunks > before) s.chunks = before > 0 ? before : 1;
    pia_for_each(gram->context, s.chunks, solve_chunk, &s);
}
