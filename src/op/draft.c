#include "window.h"

#include <math.h>
#include <string.h>

static pia_index wrap(pia_index i, pia_index count, pia_index *periods)
{
    *periods = i >= 0 ? i / count : -((count - 1 - i) / count);
    return i - *periods * count;
}

double pia_draft_knot(const pia_draft *draft, pia_index i)
{
    pia_index periods = 0;
    if (draft->cyclic) i = wrap(i, draft->count, &periods);
    return draft->knots[i] + (double)periods;
}

const double *pia_draft_point(const pia_draft *draft, pia_index i)
{
    pia_index periods = 0;
    if (draft->cyclic) i = wrap(i, draft->count, &periods);
    return draft->control + i * draft->dim;
}

void pia_draft_inside(const pia_draft *draft, pia_index *first, pia_index *end)
{
    int p = draft->degree;
    *first = draft->cyclic ? 0 : draft->stays[0] == p ? 2 * p + 1 : p + 1;
    *end = draft->stays[1] == p ? draft->count - p : draft->count;
}

pia_index pia_draft_find(const pia_draft *draft, double knot)
{
    pia_index low, high, end;
    pia_draft_inside(draft, &low, &end);
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

/* ---- rows ---- */

double pia_draft_row(const pia_draft_data *data, pia_index row, pia_index *at)
{
    pia_index periods = 0;
    *at = data->periodic ? wrap(row, data->rows, &periods) : row;
    return data->parameters[*at] + (double)periods;
}

/* The ends of the curve's own chord are as far from those of the straight line as the rows may be. */
void pia_draft_let_swing(const pia_draft_data *data, pia_index at, double swing)
{
    pia_index next = at + 1 < data->rows ? at + 1 : 0;
    const double *inverse = data->inverse_tolerance;
    double width = data->parameters[next] - data->parameters[at] + (next == 0);
    double ends = 1 / (inverse != NULL ? fmin(inverse[at], inverse[next]) : data->inverse_one);
    data->swing[at] = swing;
    data->stand[at] = 8 * (swing - ends) / (width * width);
}

pia_index pia_draft_lower_row(const pia_draft_data *data, double t)
{
    pia_index low = 0, high = data->rows, shift = 0;
    if (data->periodic) {
        shift = (pia_index)floor(t - data->parameters[0]);
        t -= (double)shift;
    }
    while (low < high) {
        pia_index middle = low + (high - low) / 2;
        if (data->parameters[middle] < t)
            low = middle + 1;
        else
            high = middle;
    }
    return low + shift * data->rows;
}

/* ---- cutting a window out and putting it back ---- */

/* Control points base .. top of the old numbering, of which those within reach of the change move. */
static void cut_piece(const pia_draft *draft, pia_index first, int removed, const double *added, int inserted, int reach, pia_window *w)
{
    int p = draft->degree, dim = draft->dim, fewer = removed - inserted;
    pia_index low = first - p - reach, high = first + removed - 1 + reach; /* free, in the old numbering */
    pia_index least = draft->stays[0], most = draft->count - 1 - draft->stays[1];
    if (low < least) low = least;
    if (high > most) high = most;
    pia_index base = low > p ? low - p : 0, top = high + p < draft->count - 1 ? high + p : draft->count - 1;
    int before = (int)(first - base), after = (int)(top + p + 1 - (first + removed - 1));
    w->count = (int)(top - base) + 1 - fewer;
    memcpy(w->knots, draft->knots + base, (size_t)before * sizeof(double));
    for (int i = 0; i < inserted; i++) w->knots[before + i] = added[i];
    memcpy(w->knots + before + inserted, draft->knots + first + removed, (size_t)after * sizeof(double));
    w->base = base;
    w->first = (int)(low - base);
    w->free = (int)(high - low) + 1 - fewer;
    int same = before - (p + 1) / 2; /* control points before this one keep their number */
    for (int i = 0; i < w->count; i++) {
        int old = i < same ? i : i + fewer < same - 1 ? same - 1 : i + fewer;
        memcpy(w->point + i * dim, draft->control + (base + old) * dim, (size_t)dim * sizeof(double));
    }
}

/* A short closed curve is its own window: one period and the wrapped control points, which share their unknowns. */
static void cut_whole(const pia_draft *draft, pia_index first, int removed, const double *added, int inserted, pia_window *w)
{
    int p = draft->degree, n = (int)draft->count - removed + inserted;
    double before = pia_draft_knot(draft, first - 1);
    w->count = n + p;
    w->first = 0;
    w->free = n;
    for (int i = 0; i < w->count + p + 1; i++) {
        int period = i / n, k = i % n;
        w->knots[i] =
            period + (k < inserted ? added[k] - floor(added[k] - before) : pia_draft_knot(draft, first + removed - inserted + k));
    }
    for (int i = 0; i < w->count; i++)
        memcpy(w->point + i * draft->dim, pia_draft_point(draft, first + removed - inserted + i % n),
               (size_t)draft->dim * sizeof(double));
}

static void put_piece(pia_draft *draft, pia_index first, int removed, const double *added, int inserted, const pia_window *w)
{
    int p = draft->degree, fewer = removed - inserted, dim = draft->dim;
    pia_index knots = draft->count + p + 1, near = w->count;
    size_t tail = (size_t)(knots - first - removed);
    memmove(draft->knots + first + inserted, draft->knots + first + removed, tail * sizeof(double));
    memmove(draft->mark + first + inserted, draft->mark + first + removed, tail);
    for (int i = 0; i < inserted; i++) draft->knots[first + i] = added[i];
    for (int i = 0; i < inserted; i++) draft->mark[first + i] = 0;
    pia_index from = first > near ? first - near : 0, to = first + near < knots - fewer ? first + near : knots - fewer;
    for (pia_index j = from; j < to; j++) draft->mark[j] &= PIA_DRAFT_KEPT;
    pia_index gone = (first > p ? first - p : 0) + (fewer < 0 ? -fewer : 0);
    memmove(draft->control + gone * dim, draft->control + (gone + fewer) * dim,
            (size_t)((draft->count - gone - fewer) * dim) * sizeof(double));
    draft->count -= fewer;
    memcpy(draft->control + (w->base + w->first) * dim, w->point + w->first * dim, (size_t)(w->free * dim) * sizeof(double));
}

/* One period that starts in [0, 1). */
static void put_whole(pia_draft *draft, const pia_window *w)
{
    int n = w->free, start = 0;
    while (start < n && floor(w->knots[start]) < floor(w->knots[n - 1])) start++;
    if (start == n) start = 0;
    double base = floor(w->knots[start]);
    draft->count = n;
    for (int i = 0; i < n; i++) draft->knots[i] = w->knots[(start + i) % n] + (start + i) / n - base;
    for (int i = 0; i < n; i++)
        memcpy(draft->control + i * draft->dim, w->point + (start + i) % n * draft->dim, (size_t)draft->dim * sizeof(double));
    memset(draft->mark, 0, (size_t)n);
}

/* The rows that the moving control points see. */
static void find_rows(const pia_draft *draft, pia_window *w)
{
    int p = draft->degree;
    w->begin = w->knots[draft->cyclic ? p : w->first];
    w->end = draft->cyclic ? w->begin + 1 : w->knots[w->first + w->free + p];
    w->has_end = !draft->data->periodic && draft->stays[1] < p && w->end >= draft->knots[draft->count];
    w->row = pia_draft_lower_row(draft->data, w->begin);
    w->rows = (w->has_end ? draft->data->rows : pia_draft_lower_row(draft->data, w->end)) - w->row;
}

/* row, gaps: gaps all of whose places take part. */
static int replace(pia_draft *draft, pia_index row, int gaps, pia_index first, int removed, const double *added, int inserted,
                   int reach, int rounds)
{
    pia_window w;
    int p = draft->degree, more = inserted > removed ? inserted : removed;
    if (draft->count - removed + inserted < (!draft->cyclic ? p + 1 : p > 2 ? p : 3)) return 0;
    if (draft->cyclic ? draft->count > PIA_WINDOW_SHORT : more + 2 * reach + p > PIA_WINDOW_FREE) return 0;
    w.gap = row;
    w.gaps = gaps;
    if (draft->cyclic)
        cut_whole(draft, first, removed, added, inserted, &w);
    else
        cut_piece(draft, first, removed, added, inserted, reach, &w);
    find_rows(draft, &w);
    if ((w.rows < w.free && gaps == 0) || w.free < 1) return 0;
    if (!(pia_window_fit(draft, &w, rounds) <= 1)) return 0;
    if (draft->cyclic)
        put_whole(draft, &w);
    else
        put_piece(draft, first, removed, added, inserted, &w);
    return 1;
}

int pia_draft_replace(pia_draft *draft, pia_index first, int removed, const double *added, int inserted, int reach, int rounds)
{
    return replace(draft, 0, 0, first, removed, added, inserted, reach, rounds);
}

int pia_draft_fill(pia_draft *draft, pia_index row, int gaps, pia_index first, int removed, const double *added, int inserted,
                   int reach, int rounds)
{
    return replace(draft, row, gaps, first, removed, added, inserted, reach, rounds);
}
