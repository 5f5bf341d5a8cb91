/* Few rows decide a smallest largest deviation: as many as there are unknowns, and one more. So the reweighted fits see a few rows a
 * span, and a pass over all rows, at the speed of one polynomial a row, only says which ones were missing. */
#include "window_rows.h"

#include "band.h"
#include "basis.h"
#include "lanes.h"

#include <math.h>
#include <string.h>

/* SAMPLE: rows of a span to begin with, beside at most REMEMBERED critical ones. GROUPS: parts of a span of which each may send its
 * worst row. SPARSE: rows a span up to which all rows are taken at once. */
enum { SAMPLE = 5, REMEMBERED = 16, GROUPS = 4, EXCHANGES = 6, SPARSE = 16, BLOCK = 64 };

/* What counts as kept, a little below 1: control points are rounded when they are put back. */
static const double KEPT = 1 - 1e-9;

pia_index pia_draft_room(int degree, int dim, int reach)
{
    pia_index spans = 2 * reach + 2 * degree + 4 + PIA_WINDOW_SHORT;
    return spans * (SAMPLE + REMEMBERED + GROUPS * EXCHANGES) * (degree + 1 + 2 * dim + 3);
}

static pia_rows rows_in(const pia_draft *draft, pia_index room)
{
    pia_rows r = {.room = room, .value = draft->work};
    r.target = r.value + room * (draft->degree + 1);
    r.inverse = r.target + room * draft->dim;
    r.weight = r.inverse + room;
    r.difference = r.weight + room;
    r.first = (int *)(r.difference + room * draft->dim);
    return r;
}

static void add_row(const pia_draft *draft, const pia_window *w, int span, pia_index row, double weight, pia_rows *r)
{
    int p = draft->degree, dim = draft->dim;
    pia_index at, k = r->count++;
    const pia_draft_data *data = draft->data;
    double t = pia_draft_row(data, row, &at);
    pia_basis_values(w->knots, p, span, t, r->value + k * (p + 1));
    r->first[k] = span - p;
    r->inverse[k] = data->inverse_tolerance != NULL ? data->inverse_tolerance[at] : data->inverse_one;
    r->weight[k] = weight;
    for (int d = 0; d < dim; d++) r->target[k * dim + d] = data->points[at * dim + d] - data->origin[d];
}

/* begin[s - degree] .. begin[s - degree + 1]: rows of span s, cut to the rows of the window. */
static void find_spans(const pia_draft *draft, const pia_window *w, pia_index *begin)
{
    int p = draft->degree, spans = w->count - p;
    pia_index end = w->row + w->rows;
    begin[0] = w->row;
    for (int s = 1; s < spans; s++) {
        pia_index row = pia_draft_lower_row(draft->data, w->knots[p + s]);
        begin[s] = row < begin[s - 1] ? begin[s - 1] : row > end ? end : row;
    }
    begin[spans] = end;
    /* The end of the domain belongs to the last span that is not empty. */
    for (int s = spans - 1; s > 0 && !(w->knots[p + s] < w->knots[p + s + 1]); s--) begin[s] = end;
}

/* Critical rows among the unrolled rows from .. to - 1, every k-th where there are too many. */
static void add_critical(const pia_draft *draft, const pia_window *w, int span, pia_index from, pia_index to, pia_rows *r)
{
    pia_index found[8 * REMEMBERED], count = 0, at;
    for (pia_index row = from; row < to && count < 8 * REMEMBERED;) {
        pia_draft_row(draft->data, row, &at);
        pia_index left = to - row < draft->data->rows - at ? to - row : draft->data->rows - at;
        const unsigned char *hit = memchr(draft->critical + at, 1, (size_t)left);
        if (hit == NULL) {
            row += left;
            continue;
        }
        row += hit - (draft->critical + at);
        found[count++] = row++;
    }
    pia_index step = (count + REMEMBERED - 1) / REMEMBERED;
    for (pia_index k = 0; k < count; k += step) add_row(draft, w, span, found[k], 1, r);
}

static void sample_rows(const pia_draft *draft, const pia_window *w, const pia_index *begin, int all, pia_rows *r)
{
    int p = draft->degree;
    for (int s = 0; s < w->count - p; s++) {
        pia_index count = begin[s + 1] - begin[s], taken = all || count < SAMPLE ? count : SAMPLE;
        for (pia_index k = 0; k < taken; k++)
            add_row(draft, w, p + s, begin[s] + (taken == count ? k : k * (count - 1) / (taken - 1)), 1, r);
        if (taken < count) add_critical(draft, w, p + s, begin[s], begin[s + 1], r);
    }
}

/* ---- the reweighted fit ---- */

/* One row of a cubic, with its products side by side. Those beyond its last basis function are zeros, added to what stands there. */
PIA_INLINE void add_cubic(const double *value, double weight, const double *difference, int dim, double *h, double *b)
{
    static const double none[PIA_LANES] = {0};
    pia_lanes v = pia_vector_load(value), factor = weight * v, zero = pia_vector_load(none);
    pia_lanes shifted[] = {v, __builtin_shufflevector(v, zero, 1, 2, 3, 4), __builtin_shufflevector(v, zero, 2, 3, 4, 4),
                           __builtin_shufflevector(v, zero, 3, 4, 4, 4)};
    for (int i = 0; i < 4; i++) pia_lanes_write(pia_vector_load(h + 4 * i) + factor[i] * shifted[i], h + 4 * i);
    for (int part = 0; part < dim; part++) {
        double *to = b + PIA_LANES * part;
        pia_lanes each = {0};
        for (int l = 0; l < PIA_LANES; l++) each[l] = difference[(PIA_LANES * part + l) % dim];
        pia_lanes_write(pia_vector_load(to) + pia_lanes_spread(factor, dim, part) * each, to);
    }
}

/* Normal equations of a piece: sums over all control points of the window, moving or not, in bands; those that stay are cut off. */
PIA_INLINE void sum_band(const pia_rows *r, int p, int dim, double *h, double *b)
{
    for (pia_index k = 0; k < r->count; k++) {
        const double *value = r->value + k * (p + 1), *difference = r->difference + k * dim;
        double weight = r->weight[k] * r->inverse[k] * r->inverse[k];
        double *h_row = h + (pia_index)r->first[k] * (p + 1), *b_row = b + (pia_index)r->first[k] * dim;
        if (p == 3 && dim <= 3) {
            add_cubic(value, weight, difference, dim, h_row, b_row);
            continue;
        }
        for (int i = 0; i <= p; i++) {
            double factor = weight * value[i];
            for (int j = i; j <= p; j++) h_row[i * (p + 1) + j - i] += factor * value[j];
            for (int d = 0; d < dim; d++) b_row[i * dim + d] += factor * difference[d];
        }
    }
}

/* Lawson's weights add up to the number of rows. */
static inline void share_out(pia_rows *r, double total)
{
    double factor = total > 0 ? (double)r->count / total : 1;
    for (pia_index k = 0; k < r->count; k++) r->weight[k] *= factor;
}

/* The largest ratio of all rows, the bound from below, and what Lawson makes of the weights. */
PIA_INLINE double judge(pia_rows *r, int p, int dim, const pia_window *w, double *bound)
{
    double worst = 0, weighted = 0, total = 0, moved = 0;
    for (pia_index k = 0; k < r->count; k++) {
        double *difference = r->difference + k * dim, square = 0;
        pia_row_difference(r, k, w->point, p, dim, difference);
        for (int d = 0; d < dim; d++) square += difference[d] * difference[d];
        double ratio = sqrt(square) * r->inverse[k];
        weighted += r->weight[k] * ratio * ratio;
        total += r->weight[k];
        if (!(ratio <= worst)) worst = ratio;
        r->weight[k] *= ratio + 1e-3;
        moved += r->weight[k];
    }
    *bound = total > 0 ? sqrt(weighted / total) : 0;
    share_out(r, moved);
    return worst;
}

/* The same with limits for components. One weight a row serves all components, so that each of them has a bound of its own. */
static double judge_axes(const pia_window *w, pia_rows *r, const double *inverse_axis, int p, int dim, double *bound)
{
    double worst = 0, weighted[PIA_MAX_DIM + 1] = {0}, total = 0, moved = 0;
    for (pia_index k = 0; k < r->count; k++) {
        double *difference = r->difference + k * dim, square = 0;
        pia_row_difference(r, k, w->point, p, dim, difference);
        for (int d = 0; d < dim; d++) {
            square += difference[d] * difference[d];
            weighted[d] += r->weight[k] * pow(difference[d] * inverse_axis[d], 2);
        }
        weighted[dim] += r->weight[k] * square * r->inverse[k] * r->inverse[k];
        double ratio = fmax(sqrt(square) * r->inverse[k], pia_axis_ratio(difference, inverse_axis, dim));
        total += r->weight[k];
        if (!(ratio <= worst)) worst = ratio;
        r->weight[k] *= ratio + 1e-3;
        moved += r->weight[k];
    }
    *bound = 0;
    for (int d = 0; d <= dim && total > 0; d++) *bound = fmax(*bound, sqrt(weighted[d] / total));
    share_out(r, moved);
    return worst;
}

/* The cubic in up to three dimensions, by counts that the compiler knows. */
#define PIA_UNROLL(result, call, p, dim, ...)                                                                                          \
    do {                                                                                                                               \
        if ((p) == 3 && (dim) == 3)                                                                                                    \
            result call(r, 3, 3, __VA_ARGS__);                                                                                         \
        else if ((p) == 3 && (dim) == 2)                                                                                               \
            result call(r, 3, 2, __VA_ARGS__);                                                                                         \
        else if ((p) == 3 && (dim) == 1)                                                                                               \
            result call(r, 3, 1, __VA_ARGS__);                                                                                         \
        else                                                                                                                           \
            result call(r, p, dim, __VA_ARGS__);                                                                                       \
    } while (0)

PIA_CLONES static void correct_piece(pia_window *w, const pia_rows *r, int p, int dim)
{
    double h[PIA_WINDOW_CONTROL * (PIA_MAX_DEGREE + 1)], b[PIA_WINDOW_CONTROL * PIA_MAX_DIM];
    memset(h, 0, (size_t)(w->count * (p + 1)) * sizeof *h);
    memset(b, 0, (size_t)(w->count * dim) * sizeof *b);
    PIA_UNROLL(, sum_band, p, dim, h, b);
    double *cut = h + w->first * (p + 1), *right = b + w->first * dim;
    pia_band_ldl_factor(cut, w->free, p, 1e-13, NULL, 0);
    pia_band_ldl_solve(cut, w->free, p, right, dim);
    for (int i = 0; i < w->free * dim; i++) w->point[w->first * dim + i] += right[i];
}

/* Rounds until the rows keep their tolerance, or the weighted root mean square proves that they cannot: no choice of the unknowns has
 * a smaller largest ratio. */
static double fit_rows(const pia_draft *draft, pia_window *w, pia_rows *r, const pia_held *held, int rounds)
{
    const double *inverse_axis = draft->data->inverse_axis;
    int p = draft->degree, dim = draft->dim, cyclic = draft->cyclic;
    double ratio = INFINITY;
    for (pia_index k = 0; k < r->count; k++) pia_row_difference(r, k, w->point, p, dim, r->difference + k * dim);
    for (int round = 0; round <= rounds; round++) {
        double bound;
        if (held->count > 0) {
            if (!pia_window_correct_held(w, r, held, p, dim, cyclic)) return INFINITY;
        } else if (cyclic)
            pia_window_correct_cyclic(w, r, p, dim);
        else
            correct_piece(w, r, p, dim);
        if (inverse_axis != NULL)
            ratio = judge_axes(w, r, inverse_axis, p, dim, &bound);
        else
            PIA_UNROLL(ratio =, judge, p, dim, w, &bound);
        if (ratio <= KEPT || bound > 1 || !isfinite(ratio)) break;
    }
    return ratio;
}

/* ---- the pass over all rows ---- */

pia_piece pia_window_piece(const pia_window *w, int span, int p, int dim)
{
    double half = (w->knots[span + 1] - w->knots[span]) / 2, factor = 1;
    pia_piece c = {.middle = w->knots[span] + half, .scale = 1 / half};
    double basis[(PIA_PIECE_DEGREE + 1) * (PIA_PIECE_DEGREE + 1)];
    pia_basis_derivatives(w->knots, p, span, c.middle, p, basis);
    for (int order = 0; order <= p; order++) {
        for (int d = 0; d < dim; d++) {
            double sum = 0;
            for (int k = 0; k <= p; k++) sum += basis[order * (p + 1) + k] * w->point[(span - p + k) * dim + d];
            c.coefficient[order * dim + d] = sum * factor;
        }
        factor *= half / (order + 1);
    }
    return c;
}

PIA_INLINE pia_lanes spread(double x)
{
    return (pia_lanes){x, x, x, x};
}

/* Squared distances of rows to the piece; returns the largest. */
PIA_INLINE double squares_of(const pia_piece *c, const double *t, double shift, const double *q, const double *origin, int count, int p,
                             int dim, double *square)
{
    double middle = c->middle - shift, last[PIA_MAX_DIM], worst = 0;
    pia_lanes largest = {0};
    int k = 0;
    for (int d = 0; d < dim; d++) last[d] = c->coefficient[d] + origin[d];
    for (; k + PIA_LANES <= count; k += PIA_LANES) {
        pia_lanes x = (pia_vector_load(t + k) - middle) * c->scale, sum = {0};
        for (int d = 0; d < dim; d++) {
            pia_lanes value = spread(c->coefficient[p * dim + d]);
            for (int order = p - 1; order > 0; order--) value = value * x + c->coefficient[order * dim + d];
            value = value * x + last[d] - pia_vector_component(q + k * dim, dim, d);
            sum += value * value;
        }
        memcpy(square + k, &sum, sizeof sum);
        largest = pia_vector_upper(sum, largest);
    }
    for (; k < count; k++) {
        double x = (t[k] - middle) * c->scale, sum = 0;
        for (int d = 0; d < dim; d++) {
            double value = c->coefficient[p * dim + d];
            for (int order = p - 1; order > 0; order--) value = value * x + c->coefficient[order * dim + d];
            value = value * x + last[d] - q[k * dim + d];
            sum += value * value;
        }
        square[k] = sum;
        if (sum > worst) worst = sum;
    }
    for (int l = 0; l < PIA_LANES; l++) worst = fmax(worst, largest[l]);
    return worst;
}

PIA_CLONES static double squares_of_piece(const pia_piece *c, const double *t, double shift, const double *q, const double *origin,
                                          int count, int p, int dim, double *square)
{
    if (p == 3 && dim == 3) return squares_of(c, t, shift, q, origin, count, 3, 3, square);
    if (p == 3 && dim == 2) return squares_of(c, t, shift, q, origin, count, 3, 2, square);
    return squares_of(c, t, shift, q, origin, count, p, dim, square);
}

/* The same for degrees whose powers lose digits, and for limits of components, as the distance that would be as bad. */
static void squares_plain(const pia_window *w, const pia_draft_data *data, pia_index at, double shift, int span, int count, int p,
                          int dim, double *square)
{
    double basis[PIA_MAX_DEGREE + 1], difference[PIA_MAX_DIM];
    for (int k = 0; k < count; k++) {
        const double *q = data->points + (at + k) * dim;
        pia_basis_values(w->knots, p, span, data->parameters[at + k] + shift, basis);
        square[k] = 0;
        for (int d = 0; d < dim; d++) {
            difference[d] = q[d] - data->origin[d];
            for (int i = 0; i <= p; i++) difference[d] -= basis[i] * w->point[(span - p + i) * dim + d];
            square[k] += difference[d] * difference[d];
        }
        if (data->inverse_axis == NULL) continue;
        double inverse = data->inverse_tolerance != NULL ? data->inverse_tolerance[at + k] : data->inverse_one;
        square[k] = fmax(square[k], pow(pia_axis_ratio(difference, data->inverse_axis, dim) / inverse, 2));
    }
}

/* The worst of the rows from .. to - 1 of one span; returns its squared ratio. */
static double worst_of(const pia_draft *draft, const pia_window *w, const pia_piece *c, int span, pia_index from, pia_index to,
                       pia_index *row)
{
    const pia_draft_data *data = draft->data;
    int p = draft->degree, dim = draft->dim;
    double square[BLOCK], worst = -1;
    for (pia_index k = from; k < to;) {
        pia_index at;
        double shift = pia_draft_row(data, k, &at);
        shift -= data->parameters[at];
        pia_index left = to - k < data->rows - at ? to - k : data->rows - at;
        int count = left < BLOCK ? (int)left : BLOCK;
        const double *t = data->parameters + at, *q = data->points + at * dim;
        double most = INFINITY, one = data->inverse_one;
        if (p > PIA_PIECE_DEGREE || data->inverse_axis != NULL)
            squares_plain(w, data, at, shift, span, count, p, dim, square);
        else
            most = squares_of_piece(c, t, shift, q, data->origin, count, p, dim, square);
        int passed = data->inverse_tolerance == NULL && most * one * one <= worst; /* nothing worse in this block */
        for (int i = 0; i < count && !passed; i++) {
            double inverse = data->inverse_tolerance != NULL ? data->inverse_tolerance[at + i] : one;
            double ratio = square[i] * inverse * inverse;
            if (ratio <= worst) continue;
            worst = ratio;
            *row = k + i;
        }
        k += count;
    }
    return worst;
}

/* Adds the worst rows of all spans that deviate too much. Returns the largest ratio. */
static double exchange(const pia_draft *draft, const pia_window *w, const pia_index *begin, pia_rows *r)
{
    int p = draft->degree;
    double worst = 0;
    for (int s = 0; s < w->count - p; s++) {
        pia_index count = begin[s + 1] - begin[s];
        if (count <= SAMPLE) continue;
        pia_piece c = {0};
        if (p <= PIA_PIECE_DEGREE) c = pia_window_piece(w, p + s, p, draft->dim);
        for (int group = 0; group < GROUPS; group++) {
            pia_index row = 0;
            double square =
                worst_of(draft, w, &c, p + s, begin[s] + count * group / GROUPS, begin[s] + count * (group + 1) / GROUPS, &row);
            double ratio = sqrt(fmax(square, 0));
            if (!(ratio <= worst)) worst = ratio;
            if (!(ratio > KEPT) || r->count >= r->room) continue;
            add_row(draft, w, p + s, row, ratio, r);
            pia_index at;
            pia_draft_row(draft->data, row, &at);
            draft->critical[at] = 1;
        }
    }
    return worst;
}

double pia_window_fit(pia_draft *draft, pia_window *w, int rounds)
{
    int p = draft->degree, spans = w->count - p, all = w->rows <= (pia_index)spans * SPARSE;
    pia_index begin[PIA_WINDOW_CONTROL + 1];
    pia_rows r = rows_in(draft, (pia_index)spans * (SAMPLE + REMEMBERED + GROUPS * EXCHANGES));
    pia_held held;
    if (!pia_window_hold(draft, w, &held)) return INFINITY;
    find_spans(draft, w, begin);
    sample_rows(draft, w, begin, all, &r);
    pia_window_fill_gaps(draft, w, &r);
    for (int k = 0; k < EXCHANGES; k++) {
        double ratio = fit_rows(draft, w, &r, &held, rounds);
        if (!(ratio <= 1) || !pia_window_holds(w, &held, p, draft->dim)) return INFINITY;
        if (!all) ratio = exchange(draft, w, begin, &r);
        if (ratio <= (all ? 1 : KEPT) && draft->data->swing != NULL) ratio = fmax(ratio, pia_window_look_between(draft, w, begin, &r));
        if (ratio <= (all ? 1 : KEPT)) return ratio;
    }
    return INFINITY;
}
