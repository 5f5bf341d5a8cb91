#include "draft.h"

#include "basis.h"
#include "dense.h"

#include <math.h>
#include <string.h>

enum { MAX_ADDED = 4, MAX_FREE = 48, MAX_LOCAL = MAX_FREE + 2 * PIA_MAX_DEGREE, MAX_KNOTS = MAX_LOCAL + PIA_MAX_DEGREE + 1 };

/* A piece of the curve as a spline of its own. */
typedef struct window {
    int degree, dim, width;       /* width: degree + 1 */
    int count;                    /* control points, on knots 0 .. count + degree */
    int free;                     /* unknowns */
    int unknown[MAX_LOCAL];       /* of each control point; -1: it stays */
    pia_index control[MAX_LOCAL]; /* the curve's control point behind it, numbered as it will be afterwards */
    double knots[MAX_KNOTS];
    double point[MAX_LOCAL * PIA_MAX_DIM];
    pia_index row, rows; /* data rows that unknowns touch, unrolled */
    double *value;       /* [rows x width] basis values */
    double *first;       /* [rows] index of the first control point */
    double *target;      /* [rows x dim] */
    double *inverse;     /* [rows] inverse tolerance */
    double *lawson;      /* [rows] weight */
} window;

static pia_index wrap(pia_index i, pia_index count, pia_index *periods)
{
    *periods = i >= 0 ? i / count : -((count - 1 - i) / count);
    return i - *periods * count;
}

double pia_draft_knot(const pia_draft *draft, pia_index i)
{
    pia_index periods = 0;
    if (draft->closed) i = wrap(i, draft->count, &periods);
    return draft->knots[i] + (double)periods;
}

static double *control_at(const pia_draft *draft, pia_index i)
{
    pia_index periods = 0;
    if (draft->closed) i = wrap(i, draft->count, &periods);
    return draft->control + i * draft->dim;
}

void pia_draft_inside(const pia_draft *draft, pia_index *first, pia_index *end)
{
    *first = draft->closed ? 0 : draft->degree + 1;
    *end = draft->count;
}

pia_index pia_draft_find(const pia_draft *draft, double knot)
{
    pia_index low, high, end;
    pia_draft_inside(draft, &low, &end);
    if (draft->closed) knot -= floor(knot - draft->knots[0]);
    high = end;
    while (low < high) {
        pia_index middle = low + (high - low) / 2;
        if (draft->knots[middle] < knot)
            low = middle + 1;
        else
            high = middle;
    }
    return low < end && draft->knots[low] == knot ? low : -1;
}

void pia_draft_close(pia_draft *draft)
{
    pia_give(draft->context, draft->work);
    draft->work = NULL;
}

/* ---- rows ---- */

static double row_parameter(const pia_draft *draft, pia_index row, pia_index *at)
{
    pia_index periods = 0;
    *at = draft->closed ? wrap(row, draft->rows, &periods) : row;
    return draft->parameters[*at] + (double)periods;
}

/* First row whose parameter is at least t, unrolled. */
static pia_index lower_row(const pia_draft *draft, double t)
{
    pia_index low = 0, high = draft->rows, shift = 0;
    if (draft->closed) {
        shift = (pia_index)floor(t - draft->parameters[0]);
        t -= (double)shift;
    }
    while (low < high) {
        pia_index middle = low + (high - low) / 2;
        if (draft->parameters[middle] < t)
            low = middle + 1;
        else
            high = middle;
    }
    return low + shift * draft->rows;
}

static pia_status reserve_rows(pia_draft *draft, window *w)
{
    pia_index a_row = w->width + 1 + w->dim + 2, size;
    if (draft->work == NULL || draft->work_rows < w->rows) {
        pia_index room = w->rows + w->rows / 2 + 64;
        if (!pia_multiply(room, a_row, &size)) return PIA_E_SIZE;
        double *work = pia_take(draft->context, size, sizeof *work);
        if (work == NULL) return PIA_E_MEMORY;
        pia_give(draft->context, draft->work);
        draft->work = work;
        draft->work_rows = room;
    }
    w->value = draft->work;
    w->first = w->value + w->rows * w->width;
    w->target = w->first + w->rows;
    w->inverse = w->target + w->rows * w->dim;
    w->lawson = w->inverse + w->rows;
    return PIA_OK;
}

static void load_rows(const pia_draft *draft, window *w)
{
    int p = w->degree, span = p;
    for (pia_index r = 0; r < w->rows; r++) {
        pia_index at;
        double t = row_parameter(draft, w->row + r, &at);
        while (span < w->count - 1 && t >= w->knots[span + 1]) span++;
        while (span > p && !(w->knots[span] < w->knots[span + 1])) span--;
        pia_basis_values(w->knots, p, span, t, w->value + r * w->width);
        w->first[r] = span - p;
        for (int d = 0; d < w->dim; d++) w->target[r * w->dim + d] = draft->points[at * w->dim + d] - draft->origin[d];
        w->inverse[r] = draft->inverse_tolerance != NULL ? draft->inverse_tolerance[at] : draft->inverse_one;
        w->lawson[r] = 1;
    }
}

/* ---- the fit of a window ---- */

static void difference_of(const window *w, pia_index r, double *difference)
{
    const double *value = w->value + r * w->width, *point = w->point + (int)w->first[r] * w->dim;
    for (int d = 0; d < w->dim; d++) {
        double sum = 0;
        for (int k = 0; k < w->width; k++) sum += value[k] * point[k * w->dim + d];
        difference[d] = w->target[r * w->dim + d] - sum;
    }
}

/* Weighted least squares for the corrections of the unknowns. Few unknowns: a dense Gram matrix, which also serves whole closed curves.
 */
static void correct(window *w)
{
    double h[MAX_FREE * MAX_FREE], b[MAX_FREE * PIA_MAX_DIM], scratch[MAX_FREE * PIA_MAX_DIM];
    pia_index order[MAX_FREE];
    int n = w->free;
    memset(h, 0, (size_t)(n * n) * sizeof *h);
    memset(b, 0, (size_t)(n * w->dim) * sizeof *b);
    for (pia_index r = 0; r < w->rows; r++) {
        const double *value = w->value + r * w->width;
        const int *unknown = w->unknown + (int)w->first[r];
        double difference[PIA_MAX_DIM], weight = w->lawson[r] * w->inverse[r] * w->inverse[r];
        difference_of(w, r, difference);
        for (int k = 0; k < w->width; k++) {
            int i = unknown[k];
            if (i < 0) continue;
            double factor = weight * value[k];
            for (int l = 0; l < w->width; l++)
                if (unknown[l] >= 0) h[i * n + unknown[l]] += factor * value[l];
            for (int d = 0; d < w->dim; d++) b[i * w->dim + d] += factor * difference[d];
        }
    }
    pia_index rank = pia_dense_cholesky(h, n, 1e-14, order);
    pia_dense_cholesky_solve(h, n, rank, order, b, w->dim, scratch);
    for (int i = 0; i < w->count; i++)
        for (int d = 0; d < w->dim && w->unknown[i] >= 0; d++) w->point[i * w->dim + d] += b[w->unknown[i] * w->dim + d];
}

/* The largest ratio; *bound is the weighted root mean square, which no choice of the unknowns can undercut at its largest ratio once
 * `correct` has minimised it. Then the weights move towards the rows that deviate most. */
static double judge(window *w, double *bound)
{
    double worst = 0, weighted = 0, total = 0, moved = 0;
    for (pia_index r = 0; r < w->rows; r++) {
        double difference[PIA_MAX_DIM], square = 0;
        difference_of(w, r, difference);
        for (int d = 0; d < w->dim; d++) square += difference[d] * difference[d];
        double ratio = sqrt(square) * w->inverse[r];
        weighted += w->lawson[r] * ratio * ratio;
        total += w->lawson[r];
        if (!(ratio <= worst)) worst = ratio;
        w->lawson[r] *= ratio + 1e-3;
        moved += w->lawson[r];
    }
    *bound = total > 0 ? sqrt(weighted / total) : 0;
    if (moved > 0)
        for (pia_index r = 0; r < w->rows; r++) w->lawson[r] *= (double)w->rows / moved;
    return worst;
}

static double fit_window(window *w, int rounds)
{
    double best = INFINITY;
    for (int round = 0; round <= rounds && best > 1; round++) {
        double bound;
        correct(w);
        double ratio = judge(w, &bound);
        if (ratio < best) best = ratio;
        if (bound > 1 || !isfinite(ratio)) break;
    }
    return best;
}

/* ---- cutting a window out and putting it back ---- */

/* Renumbers a closed draft so that knot `middle` comes to lie in the middle of the period. Returns its new number. */
static pia_index rotate(pia_draft *draft, pia_index middle, double *spare)
{
    pia_index n = draft->count, periods, by = wrap(middle - n / 2, n, &periods);
    size_t point = (size_t)draft->dim * sizeof(double);
    for (pia_index i = 0; i < n; i++) spare[i] = pia_draft_knot(draft, by + i);
    memcpy(draft->knots, spare, (size_t)n * sizeof *spare);
    memcpy(spare, draft->control, (size_t)n * point);
    for (pia_index i = 0; i < n; i++) memcpy(draft->control + i * draft->dim, spare + (by + i) % n * draft->dim, point);
    unsigned char *marks = (unsigned char *)spare;
    for (pia_index i = 0; i < n; i++) marks[i] = draft->tried[(by + i) % n];
    for (pia_index i = 0; i < n; i++) draft->tried[i] = marks[i];
    return n / 2;
}

static pia_status turn_to(pia_draft *draft, pia_index *first)
{
    double *spare = pia_take(draft->context, draft->count, (size_t)draft->dim * sizeof *spare);
    if (spare == NULL) return PIA_E_MEMORY;
    *first = rotate(draft, *first, spare);
    pia_give(draft->context, spare);
    return PIA_OK;
}

/* The window of an open curve, or of a closed one that is long enough: control points base .. top of the old numbering. */
static void cut_piece(const pia_draft *draft, pia_index first, int removed, const double *added, int inserted, int reach, window *w)
{
    int p = w->degree, fewer = removed - inserted;
    pia_index low = first - p - reach, high = first + removed - 1 + reach; /* free, in the old numbering */
    if (low < 0) low = 0;
    if (high > draft->count - 1) high = draft->count - 1;
    pia_index base = low > p ? low - p : 0, top = high + p < draft->count - 1 ? high + p : draft->count - 1;
    int before = (int)(first - base), after = (int)(top + p + 1 - (first + removed - 1));
    w->count = (int)(top - base) + 1 - fewer;
    for (int i = 0; i < before; i++) w->knots[i] = pia_draft_knot(draft, base + i);
    for (int i = 0; i < inserted; i++) w->knots[before + i] = added[i];
    for (int i = 0; i < after; i++) w->knots[before + inserted + i] = pia_draft_knot(draft, first + removed + i);
    w->free = 0;
    int same = before - (p + 1) / 2 - 1; /* control points before this one keep their number */
    for (int i = 0; i < w->count; i++) {
        pia_index old = i <= same ? base + i : base + i + fewer;
        int moves = base + i >= low && base + i + fewer <= high;
        w->control[i] = base + i;
        w->unknown[i] = moves ? w->free++ : -1;
        memcpy(w->point + i * w->dim, control_at(draft, old), (size_t)w->dim * sizeof(double));
    }
}

/* A short closed curve is its own window: one period and the wrapped control points, which share their unknowns. */
static void cut_whole(const pia_draft *draft, pia_index first, int removed, const double *added, int inserted, window *w)
{
    int p = w->degree, n = (int)draft->count - removed + inserted;
    w->count = n + p;
    w->free = n;
    for (int i = 0; i < w->count + p + 1; i++) {
        int period = i / n, k = i % n;
        w->knots[i] = period + (k < inserted ? added[k] : pia_draft_knot(draft, first + removed + (k - inserted)));
    }
    for (int i = 0; i < w->count; i++) {
        w->control[i] = i % n;
        w->unknown[i] = i % n;
        memcpy(w->point + i * w->dim, control_at(draft, first + removed - inserted + i), (size_t)w->dim * sizeof(double));
    }
}

static void put_piece(pia_draft *draft, pia_index first, int removed, const double *added, int inserted, const window *w)
{
    int fewer = removed - inserted;
    pia_index knots = draft->count + (draft->closed ? 0 : draft->degree + 1);
    for (int i = 0; i < inserted; i++) draft->knots[first + i] = added[i];
    memmove(draft->knots + first + inserted, draft->knots + first + removed, (size_t)(knots - first - removed) * sizeof(double));
    memmove(draft->tried + first + inserted, draft->tried + first + removed, (size_t)(knots - first - removed));
    pia_index near = w->count + draft->degree, from = first > near ? first - near : 0;
    pia_index to = first + near < knots - fewer ? first + near : knots - fewer;
    memset(draft->tried + from, 0, (size_t)(to - from));
    pia_index gone = first - draft->degree > 0 ? first - draft->degree : 0;
    memmove(draft->control + gone * draft->dim, draft->control + (gone + fewer) * draft->dim,
            (size_t)((draft->count - gone - fewer) * draft->dim) * sizeof(double));
    draft->count -= fewer;
    for (int i = 0; i < w->count; i++)
        if (w->unknown[i] >= 0)
            memcpy(draft->control + w->control[i] * draft->dim, w->point + i * w->dim, (size_t)w->dim * sizeof(double));
}

static void put_whole(pia_draft *draft, const window *w)
{
    draft->count = w->free;
    memcpy(draft->knots, w->knots, (size_t)w->free * sizeof(double));
    memcpy(draft->control, w->point, (size_t)(w->free * w->dim) * sizeof(double));
    memset(draft->tried, 0, (size_t)w->free);
}

pia_status pia_draft_replace(pia_draft *draft, pia_index first, int removed, const double *added, int inserted, int reach, int rounds,
                             pia_trial *trial)
{
    window w = {.degree = draft->degree, .dim = draft->dim, .width = draft->degree + 1};
    int p = draft->degree, size = removed + 2 * reach + 3 * p + 1;
    int whole = draft->closed && draft->count < size + 2;
    *trial = (pia_trial){INFINITY, 0};
    if (draft->count - removed + inserted < (draft->closed ? (p > 2 ? p : 3) : p + 1)) return PIA_OK;
    if (removed + 2 * reach + p > MAX_FREE || (whole && draft->count > MAX_FREE)) return PIA_OK;
    double moved[MAX_ADDED];
    if (inserted > MAX_ADDED) return PIA_OK;
    for (int i = 0; i < inserted; i++) moved[i] = added[i];
    if (!whole && draft->closed && (first - p - reach - p < 0 || first + removed + reach + 2 * p >= draft->count)) {
        double before = pia_draft_knot(draft, first);
        pia_status status = turn_to(draft, &first);
        if (status != PIA_OK) return status;
        for (int i = 0; i < inserted; i++) moved[i] += round(pia_draft_knot(draft, first) - before);
    }
    if (whole)
        cut_whole(draft, first, removed, moved, inserted, &w);
    else
        cut_piece(draft, first, removed, moved, inserted, reach, &w);
    int low = 0, high = w.count - 1; /* the first and the last control point that moves */
    while (w.unknown[low] < 0) low++;
    while (w.unknown[high] < 0) high--;
    double begin = whole ? w.knots[p] : w.knots[low], end = whole ? w.knots[p] + 1 : w.knots[high + p + 1];
    w.row = lower_row(draft, begin);
    w.rows = !draft->closed && end >= draft->knots[draft->count] ? draft->rows - w.row : lower_row(draft, end) - w.row;
    if (w.rows < w.free) return PIA_OK;
    pia_status status = reserve_rows(draft, &w);
    if (status != PIA_OK) return status;
    load_rows(draft, &w);
    trial->ratio = fit_window(&w, rounds);
    if (!(trial->ratio <= 1)) return PIA_OK;
    trial->taken = 1;
    if (whole)
        put_whole(draft, &w);
    else
        put_piece(draft, first, removed, moved, inserted, &w);
    return PIA_OK;
}
