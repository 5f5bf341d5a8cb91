#include "square.h"

#include "band.h"
#include "dense.h"
#include "equations.h"
#include "kernel.h"

#include <string.h>

/* Where few unknowns wrap around, the matrix is dense anyway. */
static pia_status solve_dense(pia_context *context, const pia_equations *e, double *r, int width)
{
    double *a = pia_take_zero(context, e->n * e->n, sizeof *a);
    pia_index *pivot = pia_take(context, e->n, sizeof *pivot);
    pia_status status = a != NULL && pivot != NULL ? PIA_OK : PIA_E_MEMORY;
    if (status == PIA_OK) {
        for (pia_index i = 0; i < e->n; i++)
            for (int k = 0; k < e->width; k++) a[i * e->n + (e->first[i] + k) % e->n] += e->entry[i * e->width + k];
        if (pia_dense_lu(a, e->n, pivot))
            pia_dense_lu_solve(a, e->n, pivot, r, width);
        else
            status = pia_fail(context, PIA_E_DATA, "the closed interpolation problem is singular; use other knots or an odd degree");
    }
    pia_give(context, a);
    pia_give(context, pivot);
    return status;
}

/* A cyclic band as a band with a border: the last `degree` unknowns are kept apart, the rest no longer wraps.
 *   [A11 A12] [x1]   [r1]        S = A22 - A21 A11^-1 A12
 *   [A21 A22] [x2] = [r2]        x2 = S^-1 (r2 - A21 A11^-1 r1),  x1 = A11^-1 r1 - (A11^-1 A12) x2 */
static pia_status solve_bordered(pia_context *context, const pia_equations *e, double *r, int width)
{
    int q = e->width - 1, band = 2 * q + 1;
    pia_index n = e->n, m = n - q;
    double *a11 = pia_take_zero(context, m, (size_t)band * sizeof *a11), *a12 = pia_take_zero(context, m, (size_t)q * sizeof *a12);
    double *a21 = pia_take_zero(context, m, (size_t)q * sizeof *a21), *s = pia_take_zero(context, q, (size_t)q * sizeof *s);
    pia_index *pivot = pia_take(context, q, sizeof *pivot);
    pia_band_plu plu = {0};
    pia_status status = a11 && a12 && a21 && s && pivot ? PIA_OK : PIA_E_MEMORY;
    for (pia_index i = 0; status == PIA_OK && i < n; i++)
        for (int k = 0; k < e->width; k++) {
            pia_index j = (e->first[i] + k) % n;
            double entry = e->entry[i * e->width + k];
            if (i < m && j < m && j - i >= -q && j - i <= q)
                a11[i * band + (j - i + q)] += entry;
            else if (i < m && j >= m)
                a12[i * q + (j - m)] += entry;
            else if (i >= m && j < m)
                a21[j * q + (i - m)] += entry;
            else if (i >= m)
                s[(i - m) * q + (j - m)] += entry;
            else
                status = pia_fail(context, PIA_E_DATA,
                                  "row %lld of the collocation matrix does not reach its control point: the knots do not suit the "
                                  "parameters (Schoenberg-Whitney); place knots by averaging",
                                  (long long)i);
        }
    if (status == PIA_OK) status = pia_band_plu_factor(context, a11, m, q, q, &plu);
    if (status == PIA_OK) {
        pia_band_plu_solve(&plu, a12, q);
        pia_band_plu_solve(&plu, r, width);
        double *r2 = r + m * width;
        for (pia_index j = 0; j < m; j++)
            for (int i = 0; i < q; i++) {
                double factor = a21[j * q + i];
                if (factor == 0) continue;
                for (int k = 0; k < q; k++) s[i * q + k] -= factor * a12[j * q + k];
                for (int k = 0; k < width; k++) r2[i * width + k] -= factor * r[j * width + k];
            }
        if (pia_dense_lu(s, q, pivot))
            pia_dense_lu_solve(s, q, pivot, r2, width);
        else
            status = pia_fail(context, PIA_E_DATA, "the closed interpolation problem is singular; use other knots or an odd degree");
        for (pia_index j = 0; status == PIA_OK && j < m; j++)
            for (int i = 0; i < q; i++)
                for (int k = 0; k < width; k++) r[j * width + k] -= a12[j * q + i] * r2[i * width + k];
    }
    pia_band_plu_clear(context, &plu);
    pia_give(context, a11);
    pia_give(context, a12);
    pia_give(context, a21);
    pia_give(context, s);
    pia_give(context, pivot);
    return status;
}

/* Rows of the collocation matrix as the streaming solver asks for them. */
typedef struct stream {
    const pia_collocation *c;
    const unsigned char *frozen;
} stream;

static void make_rows(void *work, pia_index begin, pia_index end, pia_index *first, double *a)
{
    const stream *s = work;
    const pia_collocation *c = s->c;
    int width = c->degree + 1;
    pia_index span = pia_collocation_span(c, begin);
    for (pia_index row = begin; row < end; row++) {
        span = pia_collocation_advance(c, row, span);
        double *entry = a + (row - begin) * width;
        pia_collocation_entries(c, row, span, &first[row - begin], entry);
        if (s->frozen != NULL && s->frozen[row])
            for (int k = 0; k < width; k++) entry[k] = first[row - begin] + k == row;
    }
}

/* Lines of a grid along one direction, r [before x n x after]: before x after right-hand sides. As many at a time as the cache holds
 * are put side by side, so that each row of the factors meets all of them in vectors. */
enum { TOGETHER = PIA_BAND_SIDES, MAX_CHUNKS = 16 };

typedef struct lines {
    const pia_band_lu *lu;
    double *r;
    pia_index before, after, chunks;
    double *block; /* [chunks x n x TOGETHER] */
} lines;

/* Where right-hand side number `side` begins. */
static double *side_of(const lines *s, pia_index side)
{
    return s->r + side / s->after * s->lu->n * s->after + side % s->after;
}

static void solve_together(const lines *s, pia_index first, pia_index count, double *block)
{
    double *side[TOGETHER];
    pia_index n = s->lu->n;
    for (pia_index k = 0; k < TOGETHER; k++) side[k] = side_of(s, first + (k < count ? k : 0));
    for (pia_index i = 0; i < n; i++)
        for (pia_index k = 0; k < TOGETHER; k++) block[i * TOGETHER + k] = side[k][i * s->after];
    pia_band_lu_solve(s->lu, block, TOGETHER);
    for (pia_index i = 0; i < n; i++)
        for (pia_index k = 0; k < count; k++) side[k][i * s->after] = block[i * TOGETHER + k];
}

static void solve_chunk(void *work, pia_index chunk)
{
    const lines *s = work;
    pia_index sides = s->before * s->after, blocks = (sides + TOGETHER - 1) / TOGETHER;
    for (pia_index b = pia_chunk_begin(blocks, s->chunks, chunk); b < pia_chunk_begin(blocks, s->chunks, chunk + 1); b++) {
        pia_index first = b * TOGETHER, count = sides - first < TOGETHER ? sides - first : TOGETHER;
        solve_together(s, first, count, s->block + chunk * s->lu->n * TOGETHER);
    }
}

/* One factorisation for all of them. */
static pia_status solve_banded(pia_context *context, const pia_equations *e, double *r, pia_index before, pia_index after)
{
    pia_band_lu lu;
    pia_status status = pia_band_lu_factor(context, e->entry, e->first, e->n, e->width, &lu);
    if (status != PIA_OK) return status;
    pia_index blocks = (before * after + TOGETHER - 1) / TOGETHER;
    lines s = {&lu, r, before, after, blocks < MAX_CHUNKS ? blocks : MAX_CHUNKS, NULL};
    s.block = pia_take(context, s.chunks * e->n, TOGETHER * sizeof *s.block);
    if (s.block != NULL)
        pia_for_each(context, s.chunks, solve_chunk, &s);
    else
        status = pia_take_status(context, s.chunks * e->n, TOGETHER * sizeof *s.block);
    pia_give(context, s.block);
    pia_band_lu_clear(context, &lu);
    return status;
}

static pia_status solve_wrapping(pia_context *context, const pia_equations *e, double *r, pia_index before, pia_index after)
{
    pia_status status = PIA_OK;
    int dense = e->n <= 2 * (pia_index)e->width;
    for (pia_index i = 0; status == PIA_OK && i < before; i++)
        status = dense ? solve_dense(context, e, r + i * e->n * after, (int)after)
                       : solve_bordered(context, e, r + i * e->n * after, (int)after);
    return status;
}

/* Along one direction of r [before x unknowns x after]. */
static pia_status solve_direction(pia_context *context, const pia_collocation *c, const unsigned char *frozen, double *r,
                                  pia_index before, pia_index after)
{
    stream rows = {c, frozen};
    if (before == 1 && after <= PIA_MAX_DIM && c->map != PIA_MAP_CYCLIC)
        return pia_band_lu_stream(context, make_rows, &rows, c->unknowns, c->degree + 1, r, (int)after);
    pia_equations e;
    pia_status status = pia_equations_open(context, c, frozen, &e);
    if (status != PIA_OK) return status;
    status = e.wraps ? solve_wrapping(context, &e, r, before, after) : solve_banded(context, &e, r, before, after);
    pia_equations_clear(context, &e);
    return status;
}

pia_status pia_square_solve(const pia_op *op, double *r, int dim)
{
    if (op->directions == 1) return solve_direction(op->context, op->line[0], op->frozen, r, 1, dim);
    pia_status status = solve_direction(op->context, op->line[0], NULL, r, 1, op->count[1] * dim);
    if (status == PIA_OK) status = solve_direction(op->context, op->line[1], NULL, r, op->count[0], dim);
    return status;
}
