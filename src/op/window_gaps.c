/* A window between rows that are far apart: where the curve is farther from the straight line between them than it may be, a row of the
 * line joins the fit. */
#include "window_rows.h"

#include "basis.h"

#include <math.h>

/* A gap: the rows at its ends, and what the curve may swing out there. */
typedef struct gap {
    double from, to;     /* parameters */
    const double *a, *b; /* [dim] */
    double swing;
} gap;

/* Returns 0 where nothing asks for the gap behind this unrolled row. */
static int find_gap(const pia_draft *draft, pia_index row, gap *out)
{
    const pia_draft_data *data = draft->data;
    pia_index at, next;
    if (!data->periodic && (row < 0 || row + 1 >= data->rows)) return 0;
    out->from = pia_draft_row(data, row, &at);
    out->swing = data->swing[at];
    if (!(out->swing < INFINITY)) return 0;
    out->to = pia_draft_row(data, row + 1, &next);
    out->a = data->points + at * draft->dim;
    out->b = data->points + next * draft->dim;
    return 1;
}

/* The curve at t, relative to nothing. */
static void value_at(const pia_draft *draft, const pia_window *w, const pia_piece *c, int span, double t, double *value)
{
    int p = draft->degree, dim = draft->dim;
    const double *origin = draft->data->origin;
    if (p > PIA_PIECE_DEGREE) {
        double basis[PIA_MAX_DEGREE + 1];
        pia_basis_values(w->knots, p, span, t, basis);
        for (int d = 0; d < dim; d++) {
            value[d] = origin[d];
            for (int i = 0; i <= p; i++) value[d] += basis[i] * w->point[(span - p + i) * dim + d];
        }
        return;
    }
    double x = (t - c->middle) * c->scale;
    for (int d = 0; d < dim; d++) {
        value[d] = c->coefficient[p * dim + d];
        for (int order = p - 1; order >= 0; order--) value[d] = value[d] * x + c->coefficient[order * dim + d];
        value[d] += origin[d];
    }
}

/* A row for the straight line of the gap at t. */
static void add_place(const pia_draft *draft, const pia_window *w, const gap *g, int span, double t, double weight, pia_rows *r)
{
    int p = draft->degree, dim = draft->dim;
    double share = (t - g->from) / (g->to - g->from);
    pia_index row = r->count++;
    pia_basis_values(w->knots, p, span, t, r->value + row * (p + 1));
    r->first[row] = span - p;
    r->inverse[row] = 1 / g->swing;
    r->weight[row] = weight;
    for (int d = 0; d < dim; d++) r->target[row * dim + d] = g->a[d] + share * (g->b[d] - g->a[d]) - draft->data->origin[d];
}

static double place_of(double low, double high, int k)
{
    return low + (high - low) * k / (PIA_DRAFT_PLACES + 1);
}

/* Places of a gap within a span, where the curve is too far. Returns the largest ratio. */
static double look_at(const pia_draft *draft, const pia_window *w, const pia_piece *c, const gap *g, int span, pia_rows *r)
{
    double low = fmax(g->from, w->knots[span]), high = fmin(g->to, w->knots[span + 1]), worst = 0, value[PIA_MAX_DIM];
    for (int k = 1; k <= PIA_DRAFT_PLACES && low < high; k++) {
        double t = place_of(low, high, k);
        value_at(draft, w, c, span, t, value);
        double ratio = pia_draft_distance(value, g->a, g->b, draft->dim) / g->swing;
        if (!(ratio <= worst)) worst = ratio;
        if (!(ratio <= 1) && r->count < r->room) add_place(draft, w, g, span, t, ratio, r);
    }
    return worst;
}

/* Between two rows a curve is no farther from its own chord than an eighth of its second derivative times the square of their distance.
 * The lengths of the control points [count - 2] of that derivative, which bound it; no number at a corner. */
static void second_derivatives(const pia_window *w, int p, int dim, double *out)
{
    double before[PIA_MAX_DIM], behind[PIA_MAX_DIM];
    for (int i = 0; i + 1 < w->count; i++) {
        double first = p / (w->knots[i + p + 1] - w->knots[i + 1]), square = 0;
        double second = i > 0 ? (p - 1) / (w->knots[i + p] - w->knots[i + 1]) : 0;
        for (int d = 0; d < dim; d++) {
            behind[d] = first * (w->point[(i + 1) * dim + d] - w->point[i * dim + d]);
            if (i > 0) square += (behind[d] - before[d]) * (behind[d] - before[d]);
            before[d] = behind[d];
        }
        if (i > 0) out[i - 1] = sqrt(square) * second;
    }
}

/* The largest of a span's; INFINITY where that is not known. */
static double bend_of(const double *second, int s, int p)
{
    double worst = p < 2 ? INFINITY : 0;
    for (int i = s; i < s + p - 1; i++)
        if (!(second[i] <= worst)) worst = isnan(second[i]) ? INFINITY : second[i];
    return worst;
}

/* The first row from `row` on whose gap does not stand a second derivative of `bend`. */
static pia_index next_row(const pia_draft_data *data, pia_index row, pia_index end, double bend)
{
    pia_index at, k = 0;
    for (; row < end; row += k, k = 0) {
        if (!data->periodic && row < 0) return row;
        pia_draft_row(data, row, &at);
        pia_index left = end - row < data->rows - at ? end - row : data->rows - at;
        while (k < left && bend <= data->stand[at + k]) k++;
        if (k < left) return row + k;
    }
    return end;
}

/* A look at the gaps in one span. */
typedef struct look {
    const pia_draft *draft;
    const pia_window *window;
    pia_rows *rows;
    int span, known; /* known: the piece of the span is */
    pia_piece piece;
} look;

/* At those behind the rows from .. end - 1 where the curve bends by no more than `bend`. */
static double look_along(look *l, pia_index from, pia_index end, double bend)
{
    const pia_window *w = l->window;
    int p = l->draft->degree;
    double worst = 0, narrow = (w->knots[l->span + 1] - w->knots[l->span]) / PIA_DRAFT_PARTS;
    gap g;
    for (pia_index row = from; (row = next_row(l->draft->data, row, end, bend)) < end; row++) {
        if (!find_gap(l->draft, row, &g) || !(g.to - g.from > narrow)) continue;
        if (!l->known && p <= PIA_PIECE_DEGREE) l->piece = pia_window_piece(w, l->span, p, l->draft->dim);
        l->known = 1;
        worst = fmax(worst, look_at(l->draft, w, &l->piece, &g, l->span, l->rows));
    }
    return worst;
}

double pia_window_look_between(const pia_draft *draft, const pia_window *w, const pia_index *begin, pia_rows *r)
{
    double second[PIA_WINDOW_CONTROL], bend[PIA_WINDOW_CONTROL], worst = 0;
    int p = draft->degree, spans = w->count - p;
    second_derivatives(w, p, draft->dim, second);
    for (int s = 0; s < spans; s++) bend[s] = bend_of(second, s, p);
    for (int s = 0; s < spans; s++) {
        look l = {.draft = draft, .window = w, .rows = r, .span = p + s};
        int begun = s > 0 && begin[s] > begin[s - 1], ended = s + 1 < spans && begin[s + 2] > begin[s + 1];
        worst = fmax(worst, look_along(&l, begin[s] - 1, begin[s], begun ? fmax(bend[s - 1], bend[s]) : INFINITY));
        if (begin[s] == begin[s + 1]) continue;
        worst = fmax(worst, look_along(&l, begin[s], begin[s + 1] - 1, bend[s]));
        worst = fmax(worst, look_along(&l, begin[s + 1] - 1, begin[s + 1], ended ? fmax(bend[s], bend[s + 1]) : INFINITY));
    }
    return worst;
}

/* All places of the gap behind a row. */
static void fill_gap(const pia_draft *draft, const pia_window *w, pia_index row, pia_rows *r)
{
    int p = draft->degree;
    gap g;
    for (int s = p; s < w->count && find_gap(draft, row, &g); s++) {
        double low = fmax(g.from, w->knots[s]), high = fmin(g.to, w->knots[s + 1]);
        for (int k = 1; k <= PIA_DRAFT_PLACES && low < high && r->count < r->room; k++)
            add_place(draft, w, &g, s, place_of(low, high, k), 1, r);
    }
}

/* In a cyclic window every control point moves, and with it the curve in every gap. */
void pia_window_fill_gaps(const pia_draft *draft, const pia_window *w, pia_rows *r)
{
    int all = draft->cyclic && w->gaps > 0;
    pia_index from = all ? w->row - 1 : w->gap, count = all ? w->rows + 1 : w->gaps;
    for (pia_index k = 0; k < count; k++) fill_gap(draft, w, from + k, r);
}
