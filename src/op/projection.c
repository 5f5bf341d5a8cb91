#include "projection.h"

#include "band.h"
#include "kernel.h"
#include "lanes.h"

#include <string.h>

/* Values that a thread should get at least; pieces of work at most. */
enum { GRAIN = 65536, MOST_CHUNKS = 16, HALVES = PIA_TILE / PIA_LANES };

/* Pivots that small beside the diagonal: the data do not tell the control point apart, and it becomes 0. */
static const double WEAK = 1e-13;

/* ---- one direction, a tile of columns ---- */

/* Values of splines: rows of the basis times the coefficients of their spans. */
PIA_INLINE void apply(const pia_projection_line *line, int p, const double *coefficients, double *values)
{
    const pia_collocation *c = &line->basis;
    for (pia_index s = 0; s < line->count - p; s++)
        for (int half = 0; half < HALVES; half++) {
            const double *from = coefficients + s * PIA_TILE + half * PIA_LANES;
            pia_lanes z[PIA_MAX_DEGREE + 1];
            for (int k = 0; k <= p; k++) z[k] = pia_vector_load(from + k * PIA_TILE);
            for (pia_index row = c->begin[s]; row < c->begin[s + 1]; row++) {
                const double *n = c->values + row * (p + 1);
                pia_lanes sum = n[0] * z[0];
                for (int k = 1; k <= p; k++) sum += n[k] * z[k];
                pia_lanes_write(sum, values + row * PIA_TILE + half * PIA_LANES);
            }
        }
}

/* N' values, and forward substitution as soon as no later span adds to a coefficient. */
PIA_INLINE void gather(const pia_projection_line *line, int p, const double *values, double *coefficients)
{
    const pia_collocation *c = &line->basis;
    pia_index spans = line->count - p;
    for (int half = 0; half < HALVES; half++) {
        pia_lanes y[PIA_MAX_DEGREE + 2] = {{0}}, before[PIA_MAX_DEGREE + 1] = {{0}};
        double *to = coefficients + half * PIA_LANES;
        for (pia_index s = 0; s < line->count; s++) {
            for (pia_index row = s < spans ? c->begin[s] : 0; s < spans && row < c->begin[s + 1]; row++) {
                const double *n = c->values + row * (p + 1);
                pia_lanes value = pia_vector_load(values + row * PIA_TILE + half * PIA_LANES);
                for (int k = 0; k <= p; k++) y[k] += n[k] * value;
            }
            pia_lanes x = y[0];
            for (int r = s < p ? (int)s : p; r >= 1; r--) x -= line->factor[(s - r) * (p + 1) + r] * before[r - 1];
            for (int r = p - 1; r >= 1; r--) before[r] = before[r - 1];
            before[0] = x;
            for (int k = 0; k < p; k++) y[k] = y[k + 1];
            y[p] = (pia_lanes){0};
            pia_lanes_write(x, to + s * PIA_TILE);
        }
    }
}

PIA_INLINE void substitute_back(const pia_projection_line *line, int p, double *coefficients)
{
    for (int half = 0; half < HALVES; half++) {
        pia_lanes behind[PIA_MAX_DEGREE + 1] = {{0}};
        for (pia_index s = line->count - 1; s >= 0; s--) {
            double *at = coefficients + s * PIA_TILE + half * PIA_LANES;
            const double *row = line->factor + s * (p + 1);
            pia_lanes x = pia_vector_load(at) * row[0];
            for (int r = p; r >= 1; r--) x -= row[r] * behind[r - 1];
            for (int r = p - 1; r >= 1; r--) behind[r] = behind[r - 1];
            behind[0] = x;
            pia_lanes_write(x, at);
        }
    }
}

PIA_INLINE void fit(const pia_projection_line *line, int p, const double *values, double *coefficients)
{
    gather(line, p, values, coefficients);
    substitute_back(line, p, coefficients);
}

PIA_CLONES static void fit_tile(const pia_projection_line *line, const double *values, double *coefficients)
{
    switch (line->basis.degree) {
    case 1: fit(line, 1, values, coefficients); break;
    case 2: fit(line, 2, values, coefficients); break;
    case 3: fit(line, 3, values, coefficients); break;
    default: fit(line, line->basis.degree, values, coefficients); break;
    }
}

PIA_CLONES static void apply_tile(const pia_projection_line *line, const double *coefficients, double *values)
{
    switch (line->basis.degree) {
    case 1: apply(line, 1, coefficients, values); break;
    case 2: apply(line, 2, coefficients, values); break;
    case 3: apply(line, 3, coefficients, values); break;
    default: apply(line, line->basis.degree, coefficients, values); break;
    }
}

void pia_projection_line_fit(const pia_projection_line *line, const double *values, double *coefficients)
{
    fit_tile(line, values, coefficients);
}

void pia_projection_line_apply(const pia_projection_line *line, const double *coefficients, double *values)
{
    apply_tile(line, coefficients, values);
}

static void sum_gram(const pia_collocation *c, pia_index count, double *gram)
{
    int p = c->degree;
    memset(gram, 0, (size_t)(count * (p + 1)) * sizeof *gram);
    for (pia_index s = 0; s < count - p; s++)
        for (pia_index row = c->begin[s]; row < c->begin[s + 1]; row++) {
            const double *n = c->values + row * (p + 1);
            for (int i = 0; i <= p; i++)
                for (int k = 0; k <= p - i; k++) gram[(s + i) * (p + 1) + k] += n[i] * n[i + k];
        }
}

pia_status pia_projection_line_open(pia_context *context, int degree, double *knots, pia_index count, const double *parameters,
                                    pia_index rows, pia_projection_line *out)
{
    pia_projection_line line = {.knots = knots, .count = count};
    pia_status status =
        pia_collocation_open(context, degree, PIA_MAP_IDENTITY, 0, knots, count, parameters, rows, PIA_STORE_VALUES, &line.basis);
    line.factor = status == PIA_OK ? pia_take(context, count, (size_t)(degree + 1) * sizeof(double)) : NULL;
    if (status == PIA_OK && line.factor == NULL) status = pia_take_status(context, count, (size_t)(degree + 1) * sizeof(double));
    if (status != PIA_OK) {
        pia_projection_line_close(context, &line);
        return status;
    }
    sum_gram(&line.basis, count, line.factor);
    pia_band_ldl_factor(line.factor, count, degree, WEAK, NULL, 0);
    for (pia_index i = 0; i < count; i++) {
        double *pivot = line.factor + i * (degree + 1);
        *pivot = *pivot > 0 ? 1 / *pivot : 0;
    }
    *out = line;
    return PIA_OK;
}

void pia_projection_line_close(pia_context *context, pia_projection_line *line)
{
    pia_collocation_close(context, &line->basis);
    pia_give(context, line->knots);
    pia_give(context, line->factor);
    *line = (pia_projection_line){.knots = NULL};
}

/* ---- both directions ---- */

static pia_index tiles_of(pia_index columns)
{
    return (columns + PIA_TILE - 1) / PIA_TILE;
}

/* A square of tiles to its transpose. */
PIA_CLONES static void transpose(const double *from, double *to)
{
    for (int i = 0; i < HALVES; i++)
        for (int j = 0; j < HALVES; j++) {
            pia_lanes square[PIA_LANES];
            for (int k = 0; k < PIA_LANES; k++) square[k] = pia_vector_load(from + (i * PIA_LANES + k) * PIA_TILE + j * PIA_LANES);
            pia_lanes_transpose(square);
            for (int k = 0; k < PIA_LANES; k++) pia_lanes_write(square[k], to + (j * PIA_LANES + k) * PIA_TILE + i * PIA_LANES);
        }
}

typedef struct pass {
    pia_projection *p;
    pia_exchange *exchange;
    void *owner;
    pia_index unknown_tiles, tiles, chunks;
    pia_index down, along; /* numbers in a tile of each array, one component */
} pass;

/* Values of a tile, or of a tile of unknowns, and coefficients of one, of which there are at most as many as rows. */
static pia_index room_of(const pia_index rows[2], int dim)
{
    pia_index along = tiles_of(rows[1]) * PIA_TILE, values = dim * rows[0] > along ? dim * rows[0] : along;
    return (values + tiles_of(rows[0]) * PIA_TILE) * PIA_TILE;
}

static double *room_for(const pass *w, pia_index chunk)
{
    const pia_index rows[2] = {w->p->line[0]->basis.rows, w->p->line[1]->basis.rows};
    return w->p->room + chunk * room_of(rows, w->p->dim);
}

static void exchange_chunk(void *work, pia_index chunk)
{
    const pass *w = work;
    pia_projection *p = w->p;
    const pia_projection_line *line = p->line[0];
    pia_index rows = line->basis.rows, end = pia_chunk_begin(w->tiles, w->chunks, chunk + 1);
    double *values = room_for(w, chunk), *found = values + p->dim * rows * PIA_TILE;
    memset(found, 0, (size_t)w->down * sizeof *found);
    for (pia_index tile = pia_chunk_begin(w->tiles, w->chunks, chunk); tile < end; tile++) {
        for (int d = 0; d < p->dim; d++) apply_tile(line, p->down + (tile * p->dim + d) * w->down, values + d * rows * PIA_TILE);
        w->exchange(w->owner, tile, values);
        for (int d = 0; d < p->dim; d++) {
            fit_tile(line, values + d * rows * PIA_TILE, found);
            for (pia_index t = 0; t < w->unknown_tiles; t++)
                transpose(found + t * PIA_TILE * PIA_TILE,
                          p->along + (d * w->unknown_tiles + t) * w->along + tile * PIA_TILE * PIA_TILE);
        }
    }
}

static void find_chunk(void *work, pia_index chunk)
{
    const pass *w = work;
    pia_projection *p = w->p;
    const pia_projection_line *line = p->line[1];
    pia_index end = pia_chunk_begin(w->unknown_tiles, w->chunks, chunk + 1);
    double *values = room_for(w, chunk);
    memset(values, 0, (size_t)w->along * sizeof *values);
    for (pia_index t = pia_chunk_begin(w->unknown_tiles, w->chunks, chunk); t < end; t++)
        for (int d = 0; d < p->dim; d++) {
            pia_index at = d * w->unknown_tiles + t;
            double *control = p->control + at * line->count * PIA_TILE;
            fit_tile(line, p->along + at * w->along, control);
            apply_tile(line, control, values);
            for (pia_index tile = 0; tile < w->tiles; tile++)
                transpose(values + tile * PIA_TILE * PIA_TILE, p->down + (tile * p->dim + d) * w->down + t * PIA_TILE * PIA_TILE);
        }
}

static pass pass_of(pia_projection *p)
{
    pass w = {.p = p, .unknown_tiles = tiles_of(p->line[0]->count), .tiles = p->tiles};
    w.down = w.unknown_tiles * PIA_TILE * PIA_TILE;
    w.along = w.tiles * PIA_TILE * PIA_TILE;
    return w;
}

void pia_projection_exchange(pia_projection *p, pia_exchange *exchange, void *owner)
{
    pass w = pass_of(p);
    w.exchange = exchange;
    w.owner = owner;
    w.chunks = p->chunks < w.tiles ? p->chunks : w.tiles;
    pia_for_each(p->context, w.chunks, exchange_chunk, &w);
}

void pia_projection_find(pia_projection *p)
{
    pass w = pass_of(p);
    w.chunks = p->chunks < w.unknown_tiles ? p->chunks : w.unknown_tiles;
    pia_for_each(p->context, w.chunks, find_chunk, &w);
}

pia_status pia_projection_open(pia_context *context, const pia_index rows[2], const pia_index most[2], int dim, pia_projection *out)
{
    pia_projection p = {
        .context = context, .dim = dim, .tiles = tiles_of(rows[1]), .chunks = pia_chunk_count(rows[0] * rows[1] * dim, GRAIN)};
    const size_t tile = (size_t)(dim * PIA_TILE) * sizeof(double);
    if (p.chunks > MOST_CHUNKS) p.chunks = MOST_CHUNKS;
    pia_index across = tiles_of(most[0]), down = p.tiles * across * PIA_TILE, control = across * most[1];
    p.down = pia_take_zero(context, down, tile);
    p.along = pia_take(context, down, tile);
    p.control = pia_take(context, control, tile);
    p.room = pia_take(context, p.chunks * room_of(rows, dim), sizeof *p.room);
    if (p.down == NULL || p.along == NULL || p.control == NULL || p.room == NULL) {
        pia_projection_close(&p);
        return PIA_E_MEMORY;
    }
    *out = p;
    return PIA_OK;
}

void pia_projection_close(pia_projection *p)
{
    pia_give(p->context, p->down);
    pia_give(p->context, p->along);
    pia_give(p->context, p->control);
    pia_give(p->context, p->room);
    *p = (pia_projection){.context = NULL};
}
