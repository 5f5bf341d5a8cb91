/* The normal form of a curve: shares of knot spans, made a batch at a time and put together at once, so that they need not be kept. A
 * control row sums the shares of its degree + 1 spans in their order; an edit sums again only the rows it touches. */
#include "clones.h"
#include "energy.h"
#include "kernel.h"
#include "normal.h"
#include "orthogonal.h"
#include "span_sums.h"

#include <string.h>

/* HIGH_DEGREE: from here on H has too few digits: its condition is 1e9 at degree 10, 2e11 at 25. GRAIN: control rows a thread should
 * get at least. BATCH: spans at a time, whose shares stay in the outermost cache. */
enum { HIGH_DEGREE = 10, GRAIN = 1024, BATCH = 16384 };

typedef struct curve {
    pia_gram gram;
    pia_band_qr orthogonal; /* R of the rows, once `correct` was called; empty before */
    double *share;          /* [degree + BATCH or all spans x room] */
    int room;
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

/* What span s has to say of the control rows from .. to - 1. */
PIA_INLINE void add_span(const batch *b, pia_index s, pia_index from, pia_index to, int width, int dim)
{
    pia_normal *normal = b->normal;
    curve *c = normal->state;
    const double *row = b->share + (s - b->first) * c->room, *right = row + width * (width + 1) / 2, *origin = right + width * dim;
    double sum[PIA_MAX_DEGREE + 1];
    sum_functions(row, width, sum);
    for (int k = 0; k < width; row += width - k, k++) {
        if (s + k < from || s + k >= to) continue;
        pia_index unknown = pia_collocation_unknown(c->gram.line, s + k);
        pia_gram_add_row(&c->gram, s, k, row);
        normal->column_sum[unknown] += sum[k];
        for (int d = 0; d < dim; d++) normal->right[unknown * dim + d] += right[k * dim + d] + (origin[d] - b->reference[d]) * sum[k];
    }
}

/* Of unknowns, where no two control rows are copies of one; of all unknowns where some are. */
static void clear_rows(pia_normal *normal, pia_index from, pia_index to, int dim)
{
    curve *c = normal->state;
    size_t count = (size_t)(to - from);
    memset(c->gram.band + from * (c->gram.width + 1), 0, count * (size_t)(c->gram.width + 1) * sizeof *c->gram.band);
    memset(normal->right + from * dim, 0, count * (size_t)dim * sizeof *normal->right);
    memset(normal->column_sum + from, 0, count * sizeof *normal->column_sum);
}

static int has_copies(const pia_collocation *line)
{
    return line->map != PIA_MAP_IDENTITY;
}

/* Control rows are independent where none is a copy. */
static void assemble_chunk(void *work, pia_index chunk)
{
    const batch *b = work;
    const pia_collocation *line = b->normal->op->line[0];
    pia_index from = b->from + pia_chunk_begin(b->to - b->from, b->chunks, chunk);
    pia_index to = b->from + pia_chunk_begin(b->to - b->from, b->chunks, chunk + 1);
    pia_index first = from - line->degree > b->first ? from - line->degree : b->first, end = to < b->end ? to : b->end;
    if (!has_copies(line)) clear_rows(b->normal, from, to, b->dim);
    for (pia_index s = first; s < end; s++)
        if (line->degree == 3 && b->dim == 3)
            add_span(b, s, from, to, 4, 3);
        else
            add_span(b, s, from, to, line->degree + 1, b->dim);
}

/* Control rows from .. to - 1 from the data, with right-hand sides relative to the first row of data. survey NULL: unwanted. */
static void sum_rows(pia_normal *normal, const pia_targets *targets, pia_index from, pia_index to, pia_survey *survey)
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
        b.chunks = has_copies(line) ? 1 : pia_chunk_count(b.to - b.from, GRAIN);
        pia_for_each(normal->op->context, b.chunks, assemble_chunk, &b);
        b.from = b.to;
        kept = line->degree;
        if (end < stop) memmove(c->share, c->share + (end - kept - b.first) * c->room, (size_t)(kept * c->room) * sizeof *c->share);
    }
}

/* All that the data say, anew. */
static pia_status sum_all(pia_normal *normal, const pia_targets *targets, const pia_addition *addition)
{
    const pia_collocation *line = normal->op->line[0];
    pia_survey survey;
    if (has_copies(line)) clear_rows(normal, 0, line->unknowns, targets->dim);
    sum_rows(normal, targets, 0, line->full, addition->look != NULL ? &survey : NULL);
    pia_status status = addition->look != NULL ? addition->look(addition->owner, &survey) : PIA_OK;
    if (status == PIA_OK) pia_normal_move(normal, targets, 0, line->unknowns);
    return status;
}

/* How strong the energy is depends on the sums of the data, which are complete now. */
static void add_more(pia_normal *normal, int dim)
{
    curve *c = normal->state;
    pia_gram_diagonal(&c->gram, normal->diagonal);
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

/* Row 0 is what all sums refer to, and energy and pull are in all of them. */
static void refresh(pia_normal *normal, const pia_targets *targets, pia_index first_row, pia_index last_row)
{
    const pia_collocation *line = normal->op->line[0];
    if (has_copies(line) || normal->energy != NULL || normal->pull > 0 || first_row == 0) {
        const pia_addition nothing = {0};
        sum_all(normal, targets, &nothing);
    } else {
        pia_index from = pia_collocation_span(line, first_row) - line->degree, to = pia_collocation_span(line, last_row) + 1;
        sum_rows(normal, targets, from, to, NULL);
        pia_normal_move(normal, targets, from, to);
    }
    add_more(normal, targets->dim);
}

static void close(pia_normal *normal)
{
    curve *c = normal->state;
    pia_context *context = normal->op->context;
    pia_give(context, c->share);
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

pia_status pia_normal_curve_open(pia_normal *normal, const pia_targets *targets, const pia_addition *addition)
{
    pia_context *context = normal->op->context;
    const pia_collocation *line = normal->op->line[0];
    curve *c = pia_take_zero(context, 1, sizeof *c);
    if (c == NULL) return pia_take_status(context, 1, sizeof *c);
    normal->state = c;
    normal->class = &banded;
    c->room = pia_span_room(line->degree, targets->dim);
    c->gram.context = context;
    pia_index kept = spans(line) > BATCH ? BATCH + line->degree : spans(line);
    c->share = pia_take(context, kept, (size_t)c->room * sizeof *c->share);
    if (c->share == NULL) return pia_take_status(context, kept, (size_t)c->room * sizeof *c->share);
    pia_status status = pia_gram_open(context, line, &c->gram);
    if (status == PIA_OK) status = sum_all(normal, targets, addition);
    if (status == PIA_OK) add_more(normal, targets->dim);
    return status;
}
