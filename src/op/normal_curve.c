/* The normal form of a curve: the shares of the knot spans are kept, so that an edit sums again only the spans it touches, and are put
 * together in order of the spans, which costs as much as one iteration. */
#include "energy.h"
#include "normal.h"
#include "orthogonal.h"
#include "span_sums.h"

#include <string.h>

enum { HIGH_DEGREE = 10 }; /* from here on H has too few digits: its condition is 1e9 at degree 10, 2e11 at 25 */

typedef struct curve {
    pia_gram gram;
    pia_band_qr orthogonal; /* R of the rows, once `correct` was called; empty before */
    double *share;          /* [spans x room] */
    int room;
} curve;

static pia_index spans(const pia_collocation *line)
{
    return line->full - line->degree;
}

/* right [width x dim] += the span's sums with the data, moved from its first point to the origin. */
static void add_right(const double *share, int width, const double *shift, int dim, double **right)
{
    double sum[PIA_MAX_DEGREE + 1] = {0};
    for (int k = 0; k < width; k++) {
        sum[k] += *share++;
        for (int l = k + 1; l < width; l++, share++) {
            sum[k] += *share;
            sum[l] += *share;
        }
    }
    for (int k = 0; k < width; k++)
        for (int d = 0; d < dim; d++) right[k][d] += *share++ + shift[d] * sum[k];
}

static void assemble(pia_normal *normal, const pia_targets *targets)
{
    curve *c = normal->state;
    const pia_collocation *line = c->gram.line;
    pia_span_data data = {normal->op->context, line, normal->op->weights, targets};
    int width = line->degree + 1, dim = targets->dim;
    double *right[PIA_MAX_DEGREE + 1], shift[PIA_MAX_DIM];
    pia_gram_clear(&c->gram);
    memset(normal->right, 0, (size_t)(line->unknowns * dim) * sizeof *normal->right);
    for (pia_index s = 0; s < spans(line); s++) {
        const double *share = c->share + s * c->room;
        pia_gram_add(&c->gram, s, share);
        for (int k = 0; k < width; k++) right[k] = normal->right + pia_collocation_unknown(line, s + k) * dim;
        pia_span_shift(&data, s, shift);
        add_right(share, width, shift, dim, right);
    }
    pia_op_mask(normal->op, normal->right, dim);
}

/* The basis functions sum to 1, so the rows of H sum to the column sums. */
static void derive(pia_normal *normal)
{
    curve *c = normal->state;
    for (pia_index i = 0; i < c->gram.count; i++) normal->diagonal[i] = 1;
    pia_gram_multiply(&c->gram, normal->diagonal, 1, 1, normal->column_sum);
    pia_gram_diagonal(&c->gram, normal->diagonal);
}

/* How strong the energy is depends on the sums of the data, which are complete now. */
static void add_more(pia_normal *normal, int dim)
{
    curve *c = normal->state;
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

static void sweep(const pia_normal *normal, double *x, int dim)
{
    const curve *c = normal->state;
    pia_gram_sweep(&c->gram, normal->op->frozen, normal->diagonal, normal->right, dim, x);
}

static void refresh(pia_normal *normal, const pia_targets *targets, pia_index first_row, pia_index last_row)
{
    curve *c = normal->state;
    const pia_collocation *line = c->gram.line;
    pia_index first = pia_collocation_span(line, first_row) - line->degree, last = pia_collocation_span(line, last_row) - line->degree;
    pia_span_data data = {normal->op->context, line, normal->op->weights, targets};
    pia_span_sums(&data, first, last, c->share + first * c->room, NULL);
    assemble(normal, targets);
    derive(normal);
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
                                        .correct = correct,
                                        .sweep = sweep,
                                        .refresh = refresh,
                                        .close = close};

pia_status pia_normal_curve_open(pia_normal *normal, const pia_targets *targets, const pia_addition *addition)
{
    pia_context *context = normal->op->context;
    const pia_collocation *line = normal->op->line[0];
    int room = pia_span_room(line->degree, targets->dim);
    curve *c = pia_take_zero(context, 1, sizeof *c);
    if (c == NULL) return pia_take_status(context, 1, sizeof *c);
    normal->state = c;
    normal->class = &banded;
    c->room = room;
    c->gram.context = context;
    c->share = pia_take(context, spans(line), (size_t)room * sizeof *c->share);
    if (c->share == NULL) return pia_take_status(context, spans(line), (size_t)room * sizeof *c->share);
    pia_status status = pia_gram_open(context, line, &c->gram);
    if (status != PIA_OK) return status;
    pia_span_data data = {context, line, normal->op->weights, targets};
    pia_survey survey;
    pia_span_sums(&data, 0, spans(line) - 1, c->share, addition->look != NULL ? &survey : NULL);
    if (addition->look != NULL) status = addition->look(addition->owner, &survey);
    if (status != PIA_OK) return status;
    assemble(normal, targets);
    derive(normal);
    add_more(normal, targets->dim);
    return PIA_OK;
}
