#include "collocation.h"

#include "basis.h"
#include "kernel.h"
#include "knots.h"

#include <string.h>

enum { GRAIN = 16384 }; /* rows, or spans, a thread should get at least */

static pia_index spans(const pia_collocation *c)
{
    return c->full - c->degree;
}

/* The first row from `row` on whose parameter is not below `right`; steps double until they pass it. */
static pia_index first_from(const pia_collocation *c, pia_index row, double right)
{
    pia_index low = row, high = row, step = 1;
    while (high < c->rows && c->parameters[high] < right) {
        low = high + 1;
        high += step;
        step *= 2;
    }
    if (high > c->rows) high = c->rows;
    while (low < high) {
        pia_index middle = low + (high - low) / 2;
        if (c->parameters[middle] < right)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

static void find_last(pia_collocation *c)
{
    c->last = c->full - 1;
    while (c->last > c->degree && !(c->knots[c->last] < c->knots[c->last + 1])) c->last--;
}

typedef struct search {
    pia_collocation *line;
    pia_index chunks;
} search;

/* Of the first spans that have rows, up to `last`. */
static void find_chunk(void *work, pia_index chunk)
{
    const search *b = work;
    pia_collocation *c = b->line;
    pia_index count = c->last - c->degree + 1;
    pia_index from = pia_chunk_begin(count, b->chunks, chunk), to = pia_chunk_begin(count, b->chunks, chunk + 1);
    pia_index row = from > 0 ? first_from(c, 0, c->knots[c->degree + from]) : 0;
    for (pia_index s = from; s < to; s++) {
        c->begin[s] = row;
        if (s + 1 < to) row = first_from(c, row, c->knots[c->degree + s + 1]);
    }
}

/* Parameters out of order are found out later; until then begins at least never fall. */
static void find_begins(pia_context *context, pia_collocation *c)
{
    pia_index last = c->last - c->degree;
    search b = {c, pia_chunk_count(last + 1, GRAIN)};
    pia_for_each(context, b.chunks, find_chunk, &b);
    c->most = 0;
    for (pia_index s = 1; s <= last; s++) {
        if (c->begin[s] < c->begin[s - 1]) c->begin[s] = c->begin[s - 1];
        pia_index rows = c->begin[s] - c->begin[s - 1];
        if (rows > c->most) c->most = rows;
    }
    if (c->rows - c->begin[last] > c->most) c->most = c->rows - c->begin[last];
    for (pia_index s = last + 1; s <= spans(c); s++) c->begin[s] = c->rows;
}

static void fill_values(void *work, pia_index chunk)
{
    pia_collocation *c = work;
    pia_index chunks = pia_chunk_count(c->rows, GRAIN);
    pia_index from = pia_chunk_begin(c->rows, chunks, chunk), to = pia_chunk_begin(c->rows, chunks, chunk + 1);
    pia_index span = pia_collocation_span(c, from);
    for (pia_index row = from; row < to; row++) {
        span = pia_collocation_advance(c, row, span);
        pia_basis_values(c->knots, c->degree, span, c->parameters[row], c->values + row * (c->degree + 1));
    }
}

void pia_collocation_rebucket(pia_collocation *c)
{
    find_last(c);
    if (c->begin != NULL) find_begins(NULL, c);
    if (c->values != NULL) {
        pia_index chunks = pia_chunk_count(c->rows, GRAIN);
        for (pia_index chunk = 0; chunk < chunks; chunk++) fill_values(c, chunk);
    }
}

pia_status pia_collocation_open(pia_context *context, int degree, pia_map map, pia_index offset, const double *knots, pia_index full,
                                const double *parameters, pia_index rows, int keep, pia_collocation *out)
{
    pia_collocation c = {
        .degree = degree, .map = map, .full = full, .rows = rows, .knots = knots, .parameters = parameters, .offset = offset};
    c.unknowns = map == PIA_MAP_IDENTITY ? full : map == PIA_MAP_CYCLIC ? full - degree : full - 2;
    if (c.unknowns < 1 || full <= degree)
        return pia_fail(context, PIA_E_SHAPE, "%lld control points are too few for degree %d", (long long)full, degree);
    pia_index begins = keep & PIA_WITHOUT_BEGINS ? 0 : full - degree + 1, values = keep & PIA_STORE_VALUES ? rows : 0;
    find_last(&c);
    if (begins > 0) {
        c.begin = pia_take(context, begins, sizeof *c.begin);
        if (c.begin == NULL) return pia_take_status(context, begins, sizeof *c.begin);
        find_begins(context, &c);
    }
    if (values > 0) {
        c.values = pia_take(context, values, (size_t)(degree + 1) * sizeof *c.values);
        if (c.values == NULL) {
            pia_collocation_close(context, &c);
            return pia_take_status(context, values, (size_t)(degree + 1) * sizeof *c.values);
        }
        pia_for_each(context, pia_chunk_count(rows, GRAIN), fill_values, &c);
    }
    *out = c;
    return PIA_OK;
}

void pia_collocation_close(pia_context *context, pia_collocation *c)
{
    pia_give(context, c->begin);
    pia_give(context, c->values);
    *c = (pia_collocation){0};
}

pia_index pia_collocation_span(const pia_collocation *c, pia_index row)
{
    double share = (double)row / (double)c->rows; /* rows and spans are mostly spread alike */
    pia_index hint = c->degree + (pia_index)(share * (double)spans(c));
    return pia_knots_span_near(c->knots, c->degree, c->full, c->parameters[row], hint);
}

pia_index pia_collocation_own_span(const pia_collocation *c, pia_index row)
{
    double t = c->parameters[row];
    pia_index span = row > c->degree ? row : c->degree;
    if (span > c->last) span = c->last;
    if (t < c->knots[span]) return -1;
    while (span < c->last && span < row + c->degree && t >= c->knots[span + 1]) span++;
    return span == c->last || t < c->knots[span + 1] ? span : -1;
}

pia_index pia_collocation_begin(const pia_collocation *c, pia_index span)
{
    return span <= c->degree ? 0 : span > c->last ? c->rows : first_from(c, 0, c->knots[span]);
}

const double *pia_collocation_compute_row(const pia_collocation *c, pia_index row, pia_index span, double *scratch)
{
    pia_basis_values(c->knots, c->degree, span, c->parameters[row], scratch);
    return scratch;
}

pia_index pia_collocation_unknown(const pia_collocation *c, pia_index column)
{
    if (c->map == PIA_MAP_IDENTITY) return column;
    if (c->map == PIA_MAP_CYCLIC) return (column + c->offset) % c->unknowns;
    return column == 0 ? 0 : column > c->unknowns ? c->unknowns - 1 : column - 1;
}

void pia_collocation_expand(const pia_collocation *c, const double *unknowns, pia_index before, pia_index after, double *full)
{
    size_t line = (size_t)after * sizeof *full;
    for (pia_index b = 0; b < before; b++)
        for (pia_index i = 0; i < c->full; i++)
            memcpy(full + (b * c->full + i) * after, unknowns + (b * c->unknowns + pia_collocation_unknown(c, i)) * after, line);
}

void pia_collocation_reduce(const pia_collocation *c, const double *full, pia_index before, pia_index after, double *unknowns)
{
    memset(unknowns, 0, (size_t)(before * c->unknowns * after) * sizeof *unknowns);
    for (pia_index b = 0; b < before; b++)
        for (pia_index i = 0; i < c->full; i++) {
            double *to = unknowns + (b * c->unknowns + pia_collocation_unknown(c, i)) * after;
            const double *from = full + (b * c->full + i) * after;
            for (pia_index k = 0; k < after; k++) to[k] += from[k];
        }
}

void pia_collocation_column_sums(const pia_collocation *c, const double *weights, double *sums)
{
    double scratch[PIA_MAX_DEGREE + 1];
    memset(sums, 0, (size_t)c->unknowns * sizeof *sums);
    pia_index span = c->degree;
    for (pia_index row = 0; row < c->rows; row++) {
        span = pia_collocation_advance(c, row, span);
        const double *value = pia_collocation_row(c, row, span, scratch);
        double w = weights != NULL ? weights[row] : 1;
        for (int k = 0; k <= c->degree; k++) sums[pia_collocation_unknown(c, span - c->degree + k)] += w * value[k];
    }
}

int pia_collocation_entries(const pia_collocation *c, pia_index row, pia_index span, pia_index *first, double *entries)
{
    double scratch[PIA_MAX_DEGREE + 1];
    const double *value = pia_collocation_row(c, row, span, scratch);
    pia_index column = span - c->degree;
    int width = c->degree + 1;
    for (int k = 0; k < width; k++) entries[k] = 0;
    if (c->map != PIA_MAP_DOUBLED) {
        *first = pia_collocation_unknown(c, column);
        for (int k = 0; k < width; k++) entries[k] = value[k];
        return *first + width <= c->unknowns;
    }
    pia_index start = pia_collocation_unknown(c, column);
    if (start + width > c->unknowns) start = c->unknowns > width ? c->unknowns - width : 0;
    *first = start;
    for (int k = 0; k < width; k++) entries[pia_collocation_unknown(c, column + k) - start] += value[k];
    return 1;
}
