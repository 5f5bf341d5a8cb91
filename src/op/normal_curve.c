/* The normal form of a curve: shares of knot spans, which control rows sum in their order, degree + 1 each, as soon as they are made,
 * so that they need not be kept: by pieces of control rows, one a thread, where there are many spans of few rows; else a batch of spans
 * at a time, whose rows all threads share. An edit sums again only the rows it touches. */
#include "clones.h"
#include "energy.h"
#include "kernel.h"
#include "normal.h"
#include "orthogonal.h"
#include "rooms.h"
#include "span_sums.h"

#include <string.h>

/* HIGH_DEGREE: from here on H has too few digits: its condition is 1e9 at degree 10, 2e11 at 25. GRAIN: control rows a thread should
 * get at least. BATCH: spans at a time, whose shares stay in the outermost cache. PIECE: control rows, whose shares stay in the second
 * one. FEW: rows a span at most where pieces sum those of their seams twice. */
enum { HIGH_DEGREE = 10, GRAIN = 1024, BATCH = 16384, PIECE = 512, FEW = 256 };

typedef struct curve {
    pia_gram gram;
    pia_band_qr orthogonal; /* R of the rows, once `correct` was called; empty before */
    int room;               /* doubles of a share */
    double *share;          /* of a batch [degree + BATCH or all spans x room]; NULL: by pieces */
    pia_rooms rooms;        /* for the shares of pieces */
    pia_survey *seen;       /* [pieces of all control rows] */
    double *alone;          /* band, right and column sums of the data [cols x (degree + 2 + dim)]; NULL where there is no more */
} curve;

static pia_index spans(const pia_collocation *line)
{
    return line->full - line->degree;
}

/* Sums over the functions of a span, which add up to 1, are sums over its rows: sum [width] of each function's products. */
PIA_INLINE void sum_functions(const double *share, int width, double *sum)
{
    for (int k = 0; k < width; k++) sum[k] = 0;
    for (int k = 0; k < width; k++) {
        sum[k] += *share++;
        for (int l = k + 1; l < width; l++, share++) {
            sum[k] += *share;
            sum[l] += *share;
        }
    }
}

/* Shares of spans first .. end - 1, and the control rows from .. to - 1 that they complete. */
typedef struct batch {
    pia_normal *normal;
    const double *share, *reference; /* what right-hand sides are relative to */
    pia_index first, end, from, to, chunks;
    int dim;
} batch;

/* What function k of a span has to say of its control row. */
typedef struct control_row {
    double product[PIA_MAX_DEGREE + 1], sum, right[PIA_MAX_DIM];
} control_row;

PIA_INLINE void add_function(const batch *b, pia_index s, int k, int width, int dim, control_row *out)
{
    const curve *c = b->normal->state;
    const double *share = b->share + (s - b->first) * c->room, *row = share, *right = share + width * (width + 1) / 2;
    const double *origin = right + width * dim;
    double sum = 0;
    for (int l = 0; l < k; row += width - l, l++) sum += row[k - l];
    for (int l = k; l < width; l++) sum += row[l - k];
    for (int l = k; l < width; l++) out->product[l - k] += row[l - k];
    for (int d = 0; d < dim; d++) out->right[d] += right[k * dim + d] + (origin[d] - b->reference[d]) * sum;
    out->sum += sum;
}

/* Control row i, which is no copy, from all of its spans. */
PIA_INLINE void make_row(const batch *b, pia_index i, int width, int dim)
{
    pia_normal *normal = b->normal;
    const curve *c = normal->state;
    control_row row = {{0}, 0, {0}};
    pia_index spans_of_line = spans(c->gram.line);
    if (i >= width - 1 && i < spans_of_line)
        for (int k = width - 1; k >= 0; k--) add_function(b, i - k, k, width, dim, &row);
    else
        for (int k = width - 1; k >= 0; k--)
            if (i >= k && i - k < spans_of_line) add_function(b, i - k, k, width, dim, &row);
    for (int l = 0; l < width; l++) c->gram.band[i * width + l] = row.product[l];
    for (int d = 0; d < dim; d++) normal->right[i * dim + d] = row.right[d];
    normal->diagonal[i] = row.product[0];
    normal->column_sum[i] = row.sum;
}

/* The cubic in space is what nearly everybody fits. */
PIA_CLONES static void make_rows(const batch *b, pia_index from, pia_index to)
{
    int width = b->normal->op->line[0]->degree + 1;
    for (pia_index i = from; i < to; i++)
        if (width == 4 && b->dim == 3)
            make_row(b, i, 4, 3);
        else
            make_row(b, i, width, b->dim);
}

/* What span s has to say of its control rows, where some are copies. */
static void add_span(const batch *b, pia_index s)
{
    pia_normal *normal = b->normal;
    curve *c = normal->state;
    int width = c->gram.width + 1, dim = b->dim;
    const double *row = b->share + (s - b->first) * c->room, *right = row + width * (width + 1) / 2, *origin = right + width * dim;
    double sum[PIA_MAX_DEGREE + 1];
    sum_functions(row, width, sum);
    for (int k = 0; k < width; row += width - k, k++) {
        pia_index unknown = pia_collocation_unknown(c->gram.line, s + k);
        if (s + k < b->from || s + k >= b->to) continue;
        pia_gram_add_row(&c->gram, s, k, row);
        normal->column_sum[unknown] += sum[k];
        for (int d = 0; d < dim; d++) normal->right[unknown * dim + d] += right[k * dim + d] + (origin[d] - b->reference[d]) * sum[k];
    }
}

static void add_spans(const batch *b)
{
    pia_index first = b->from - b->normal->op->line[0]->degree;
    for (pia_index s = first > b->first ? first : b->first; s < b->end && s < b->to; s++) add_span(b, s);
}

/* Control rows from .. to - 1, and with them their copies. */
static void clear(pia_normal *normal, pia_index from, pia_index to, int dim)
{
    curve *c = normal->state;
    pia_index width = c->gram.width + 1;
    for (pia_index row = from; row < to; row++) {
        pia_index i = pia_collocation_unknown(c->gram.line, row);
        for (pia_index l = 0; l < width; l++) c->gram.band[i * width + l] = 0;
        for (int d = 0; d < dim; d++) normal->right[i * dim + d] = 0;
        normal->column_sum[i] = 0;
    }
}

static int has_copies(const pia_collocation *line)
{
    return line->map != PIA_MAP_IDENTITY;
}

/* Control rows that are no copies are independent. */
static void make_chunk(void *work, pia_index chunk)
{
    const batch *b = work;
    pia_index count = b->to - b->from;
    make_rows(b, b->from + pia_chunk_begin(count, b->chunks, chunk), b->from + pia_chunk_begin(count, b->chunks, chunk + 1));
}

static void sum_batches(pia_normal *normal, const pia_targets *targets, pia_index from, pia_index to, pia_survey *survey)
{
    curve *c = normal->state;
    const pia_collocation *line = c->gram.line;
    pia_span_data data = {normal->op->context, line, normal->op->weights, targets};
    pia_index first = from > line->degree ? from - line->degree : 0, stop = to < spans(line) ? to : spans(line), kept = 0;
    batch b = {.normal = normal, .share = c->share, .reference = targets->points, .from = from, .dim = targets->dim};
    for (pia_index next = first, end; next < stop; next = end) {
        pia_survey seen;
        end = stop - next > BATCH ? next + BATCH : stop;
        pia_span_sums(&data, next, end - 1, c->share + kept * c->room, survey != NULL ? &seen : NULL);
        if (survey != NULL) *survey = next == first ? seen : pia_survey_join(survey, &seen, targets->dim);
        b.first = next - kept;
        b.end = end;
        b.to = end < stop ? end : to;
        b.chunks = pia_chunk_count(b.to - b.from, GRAIN);
        if (has_copies(line))
            add_spans(&b);
        else
            pia_for_each(normal->op->context, b.chunks, make_chunk, &b);
        b.from = b.to;
        kept = line->degree;
        if (end < stop) memmove(c->share, c->share + (end - kept - b.first) * c->room, (size_t)(kept * c->room) * sizeof *c->share);
    }
}

typedef struct pieces {
    pia_normal *normal;
    const pia_targets *targets;
    pia_index from, to, count;
    int survey; /* 1: wanted */
} pieces;

static void sum_piece(void *work, pia_index piece)
{
    const pieces *p = work;
    curve *c = p->normal->state;
    const pia_collocation *line = c->gram.line;
    pia_span_data data = {NULL, line, p->normal->op->weights, p->targets}; /* this thread alone */
    pia_index from = p->from + pia_chunk_begin(p->to - p->from, p->count, piece);
    pia_index to = p->from + pia_chunk_begin(p->to - p->from, p->count, piece + 1);
    pia_index first = from > line->degree ? from - line->degree : 0, end = to < spans(line) ? to : spans(line);
    double *share = pia_rooms_take(&c->rooms);
    batch b = {
        .normal = p->normal, .share = share, .reference = p->targets->points, .first = first, .end = end, .dim = p->targets->dim};
    pia_span_sums(&data, first, end - 1, share, p->survey ? &c->seen[piece] : NULL);
    make_rows(&b, from, to);
    pia_rooms_leave(&c->rooms, share);
}

static void sum_pieces(pia_normal *normal, const pia_targets *targets, pia_index from, pia_index to, pia_survey *survey)
{
    curve *c = normal->state;
    pieces p = {normal, targets, from, to, pia_chunk_count(to - from, PIECE), survey != NULL};
    pia_for_each(normal->op->context, p.count, sum_piece, &p);
    if (survey != NULL) *survey = c->seen[0];
    for (pia_index k = 1; k < p.count && survey != NULL; k++) *survey = pia_survey_join(survey, &c->seen[k], targets->dim);
}

/* Control rows from .. to - 1 from the data, with right-hand sides relative to the first row of data. survey NULL: unwanted. */
static void sum_rows(pia_normal *normal, const pia_targets *targets, pia_index from, pia_index to, pia_survey *survey)
{
    const curve *c = normal->state;
    if (c->share == NULL)
        sum_pieces(normal, targets, from, to, survey);
    else
        sum_batches(normal, targets, from, to, survey);
}

/* All that the data say, anew. */
static pia_status sum_all(pia_normal *normal, const pia_targets *targets, const pia_addition *addition)
{
    const pia_collocation *line = normal->op->line[0];
    pia_survey survey;
    if (has_copies(line)) clear(normal, 0, line->full, targets->dim);
    sum_rows(normal, targets, 0, line->full, addition->look != NULL ? &survey : NULL);
    pia_status status = addition->look != NULL ? addition->look(addition->owner, &survey) : PIA_OK;
    if (status == PIA_OK) pia_normal_move(normal, targets, 0, line->unknowns);
    return status;
}

/* What an edit touches: control rows from .. to - 1. Where some of them have copies, all that have are taken, the first ones before the
 * last ones, as their spans come. */
static void sum_touched(pia_normal *normal, const pia_targets *targets, pia_index from, pia_index to)
{
    const pia_collocation *line = normal->op->line[0];
    const pia_addition nothing = {0};
    pia_index count = line->unknowns, copies = line->full - count;
    int first = (from < copies), last = (to > count), dim = targets->dim;
    pia_index low = first && to > copies ? to : copies, high = last && from < count ? from : count;
    if (line->map == PIA_MAP_DOUBLED || line->offset != 0 || ((first || last) && low >= high)) {
        sum_all(normal, targets, &nothing);
    } else if (first || last) {
        clear(normal, 0, low, dim);
        clear(normal, high, count, dim);
        sum_rows(normal, targets, 0, low, NULL);
        sum_rows(normal, targets, high, line->full, NULL);
        pia_normal_move(normal, targets, 0, low);
        pia_normal_move(normal, targets, high, count);
    } else {
        if (has_copies(line)) clear(normal, from, to, dim);
        sum_rows(normal, targets, from, to, NULL);
        pia_normal_move(normal, targets, from, to);
    }
}

/* The sums of the data alone, before there is more in them, and back. */
static void keep(const pia_normal *normal, int dim)
{
    const curve *c = normal->state;
    size_t count = (size_t)c->gram.count, width = (size_t)c->gram.width + 1;
    if (c->alone == NULL) return;
    memcpy(c->alone, c->gram.band, count * width * sizeof *c->alone);
    memcpy(c->alone + count * width, normal->right, count * (size_t)dim * sizeof *c->alone);
    memcpy(c->alone + count * (width + (size_t)dim), normal->column_sum, count * sizeof *c->alone);
}

static void restore(pia_normal *normal, int dim)
{
    const curve *c = normal->state;
    size_t count = (size_t)c->gram.count, width = (size_t)c->gram.width + 1;
    if (c->alone == NULL) return;
    memcpy(c->gram.band, c->alone, count * width * sizeof *c->alone);
    memcpy(normal->right, c->alone + count * width, count * (size_t)dim * sizeof *c->alone);
    memcpy(normal->column_sum, c->alone + count * (width + (size_t)dim), count * sizeof *c->alone);
    pia_gram_diagonal(&c->gram, normal->diagonal);
}

/* How strong the energy is depends on the sums of the data, which are complete now. */
static void add_more(pia_normal *normal, int dim)
{
    curve *c = normal->state;
    keep(normal, dim);
    if (has_copies(c->gram.line)) pia_gram_diagonal(&c->gram, normal->diagonal);
    if (normal->energy != NULL) {
        double factor = pia_energy_factor(normal->energy, normal->diagonal);
        pia_energy_add_gram(normal->energy, factor, &c->gram);
        pia_energy_add_sums(normal->energy, factor, normal->column_sum);
        pia_gram_diagonal(&c->gram, normal->diagonal);
    }
    if (normal->pull == 0) return;
    for (pia_index i = 0; i < c->gram.count; i++) c->gram.band[i * (c->gram.width + 1)] += normal->pull;
    pia_normal_add_pull(normal, dim);
}

static void multiply(const pia_normal *normal, const double *x, int dim, double *y)
{
    const curve *c = normal->state;
    pia_gram_multiply(&c->gram, x, 1, dim, y);
    pia_op_mask(normal->op, y, dim);
}

static pia_status factor(pia_normal *normal)
{
    curve *c = normal->state;
    pia_band_qr_close(c->gram.context, &c->orthogonal);
    pia_status status = pia_gram_factor(&c->gram, normal->op->frozen);
    normal->weak = c->gram.weak;
    normal->delicate = (c->gram.refused > 0 || c->gram.width >= HIGH_DEGREE) && pia_orthogonal_suits(normal);
    return status;
}

static pia_status correct(pia_normal *normal, const pia_targets *targets, const double *x, double *d)
{
    curve *c = normal->state;
    pia_band_qr_close(c->gram.context, &c->orthogonal);
    return pia_orthogonal_correct(normal, targets, x, d, &c->orthogonal, &normal->weak);
}

static void solve(const pia_normal *normal, double *b, int dim)
{
    const curve *c = normal->state;
    if (c->orthogonal.r != NULL)
        pia_orthogonal_solve(&c->orthogonal, b, dim);
    else
        pia_gram_solve(&c->gram, b, 1, dim);
}

static pia_status leap(const pia_normal *normal, int dim, double *x, int *done)
{
    const curve *c = normal->state;
    *done = 0;
    if (normal->op->frozen != NULL || c->gram.width >= HIGH_DEGREE) return PIA_OK;
    return pia_gram_leap(&c->gram, normal->right, dim, x, done);
}

static double residual(const pia_normal *normal, const double *x, int dim, double *r)
{
    const curve *c = normal->state;
    return pia_gram_residual(&c->gram, x, normal->right, dim, r);
}

static void sweep(const pia_normal *normal, double *x, int dim)
{
    const curve *c = normal->state;
    pia_gram_sweep(&c->gram, normal->op->frozen, normal->diagonal, normal->right, dim, x);
}

/* Row 0 is what all sums refer to. */
static void refresh(pia_normal *normal, const pia_targets *targets, pia_index first_row, pia_index last_row)
{
    const pia_collocation *line = normal->op->line[0];
    const pia_addition nothing = {0};
    if (first_row == 0) {
        sum_all(normal, targets, &nothing);
    } else {
        restore(normal, targets->dim);
        sum_touched(normal, targets, pia_collocation_span(line, first_row) - line->degree, pia_collocation_span(line, last_row) + 1);
    }
    add_more(normal, targets->dim);
}

static void close(pia_normal *normal)
{
    curve *c = normal->state;
    pia_context *context = normal->op->context;
    pia_give(context, c->share);
    pia_give(context, c->seen);
    pia_give(context, c->alone);
    pia_rooms_close(context, &c->rooms);
    pia_band_qr_close(context, &c->orthogonal);
    pia_gram_close(&c->gram);
    pia_give(context, c);
}

static const pia_normal_class banded = {.name = "banded",
                                        .multiply = multiply,
                                        .factor = factor,
                                        .solve = solve,
                                        .sides = PIA_LDL_SIDES,
                                        .correct = correct,
                                        .sweep = sweep,
                                        .leap = leap,
                                        .residual = residual,
                                        .refresh = refresh,
                                        .close = close};

/* Work space: for what the data say alone, where there is more; for pieces, or for a batch. */
static pia_status take_room(pia_normal *normal, int dim)
{
    curve *c = normal->state;
    pia_context *context = normal->op->context;
    const pia_collocation *line = normal->op->line[0];
    if (normal->energy != NULL || normal->pull > 0) {
        size_t each = (size_t)(line->degree + 2 + dim) * sizeof *c->alone;
        c->alone = pia_take(context, line->unknowns, each);
        if (c->alone == NULL) return pia_take_status(context, line->unknowns, each);
    }
    pia_index count = pia_chunk_count(line->full, PIECE), kept = spans(line) > BATCH ? BATCH + line->degree : spans(line);
    if (spans(line) > BATCH && line->most <= FEW && !has_copies(line)) {
        pia_index longest = line->full / count + 1 > 2 * PIECE ? line->full / count + 1 : 2 * PIECE;
        c->seen = pia_take(context, count, sizeof *c->seen);
        if (c->seen == NULL) return pia_take_status(context, count, sizeof *c->seen);
        return pia_rooms_open(context, count, (longest + line->degree) * c->room * (pia_index)sizeof *c->share, &c->rooms);
    }
    c->share = pia_take(context, kept, (size_t)c->room * sizeof *c->share);
    return c->share != NULL ? PIA_OK : pia_take_status(context, kept, (size_t)c->room * sizeof *c->share);
}

pia_status pia_normal_curve_open(pia_normal *normal, const pia_targets *targets, const pia_addition *addition)
{
    pia_context *context = normal->op->context;
    const pia_collocation *line = normal->op->line[0];
    curve *c = pia_take_zero(context, 1, sizeof *c);
    if (c == NULL) return pia_take_status(context, 1, sizeof *c);
    normal->state = c;
    normal->class = &banded;
    c->room = pia_span_room(line->degree, targets->dim);
    pia_status status = pia_gram_open(context, line, &c->gram);
    if (status == PIA_OK) status = take_room(normal, targets->dim);
    if (status == PIA_OK) status = sum_all(normal, targets, addition);
    if (status == PIA_OK) add_more(normal, targets->dim);
    return status;
}
