/* A band solved once, in windows that know nothing of each other: four side by side in the lanes of vectors, so that the divisions of
 * their eliminations overlap. What a window needs stays in the second-level cache. */
#include <stdatomic.h>

#include "band.h"
#include "kernel.h"
#include "rooms.h"
#include "vector.h"

/* LENGTH: rows of a window without its margins. MARGIN: rows, for each of width + 1: over so many the Gram matrices of B-splines at
 * evenly spread data forget 16 digits. */
enum { LENGTH = 1024, MARGIN = 16, MAX_WIDTH = 9, UNIT = sizeof(pia_lanes) };

typedef struct windows {
    const pia_band_system *system;
    double *x;
    pia_index count, size, margin; /* windows; rows of each with its margins */
    pia_rooms *rooms;
    atomic_int weak; /* 1: some pivot was */
} windows;

/* PIA_LANES neighbouring windows. */
typedef struct team {
    pia_index size, low[PIA_LANES];           /* rows of each; the first one */
    pia_index own[PIA_LANES], end[PIA_LANES]; /* the rows that are its share of the solution, from low */
    pia_lanes *row;                           /* [size x (width + 1)] reduced rows, their pivots inverted */
    pia_lanes *right;                         /* [size x dim] reduced right-hand sides, then the solution */
} team;

int pia_band_windows_suit(pia_index n, int width)
{
    return width >= 1 && width <= MAX_WIDTH && n >= LENGTH * PIA_LANES;
}

static team place(const windows *w, pia_index first)
{
    pia_index n = w->system->n;
    team t = {.size = w->size};
    for (int l = 0; l < PIA_LANES; l++) {
        pia_index begin = pia_chunk_begin(n, w->count, first + l), low = begin - w->margin;
        if (!w->system->wraps && low < 0) low = 0;
        if (!w->system->wraps && low > n - w->size) low = n - w->size;
        t.low[l] = low < 0 ? low + n : low;
        t.own[l] = begin - low;
        t.end[l] = pia_chunk_begin(n, w->count, first + l + 1) - low;
    }
    return t;
}

PIA_INLINE void find_rows(const team *t, pia_index n, pia_index i, pia_index *at)
{
    for (int l = 0; l < PIA_LANES; l++) {
        at[l] = t->low[l] + i;
        if (at[l] >= n) at[l] -= n;
    }
}

/* Number k of rows at[] of `count` each. */
PIA_INLINE pia_lanes gather(const double *array, const pia_index *at, int count, int k)
{
    return (pia_lanes){array[at[0] * count + k], array[at[1] * count + k], array[at[2] * count + k], array[at[3] * count + k]};
}

/* Row i less what the `reach` rows before it say of it, farthest first, its right-hand side as well. Lanes of `good` stay set where the
 * pivot is strong. */
PIA_INLINE void reduce(const pia_band_system *s, const team *t, pia_index i, int reach, int width, int dim, pia_lane_masks *good)
{
    pia_index at[PIA_LANES];
    pia_lanes row[MAX_WIDTH + 1], right[PIA_MAX_DIM], *to = t->row + i * (width + 1), *right_to = t->right + i * dim;
    find_rows(t, s->n, i, at);
    for (int k = 0; k <= width; k++) row[k] = gather(s->h, at, width + 1, k);
    for (int d = 0; d < dim; d++) right[d] = gather(s->b, at, dim, d);
    pia_lanes least = row[0] * s->threshold;
    for (int r = reach; r >= 1; r--) {
        const pia_lanes *above = to - r * (width + 1);
        pia_lanes factor = above[r] * above[0];
        for (int k = 0; k <= width - r; k++) row[k] -= factor * above[r + k];
        for (int d = 0; d < dim; d++) right[d] -= factor * right_to[d - r * dim];
    }
    *good &= row[0] > least;
    to[0] = 1 / row[0];
    for (int k = 1; k <= width; k++) to[k] = row[k];
    for (int d = 0; d < dim; d++) right_to[d] = right[d];
}

PIA_INLINE void substitute(const pia_band_system *s, const team *t, pia_index i, int reach, int width, int dim, double *x)
{
    pia_index at[PIA_LANES];
    pia_lanes solution[PIA_MAX_DIM], *row = t->row + i * (width + 1), *to = t->right + i * dim;
    for (int d = 0; d < dim; d++) solution[d] = to[d];
    for (int r = reach; r >= 1; r--)
        for (int d = 0; d < dim; d++) solution[d] -= row[r] * to[d + r * dim];
    for (int d = 0; d < dim; d++) to[d] = solution[d] *= row[0];
    find_rows(t, s->n, i, at);
    for (int l = 0; l < PIA_LANES; l++)
        for (int d = 0; d < dim && i >= t->own[l] && i < t->end[l]; d++) x[at[l] * dim + d] = solution[d][l];
}

/* System and team are copied, because what is written could overlap them as far as the compiler knows. */
PIA_INLINE int solve(const pia_band_system *system, const team *together, int width, int dim, double *x)
{
    const pia_band_system s = *system;
    const team t = *together;
    pia_lane_masks good = ~(pia_lane_masks){0};
    pia_index least = t.own[0], inside = t.size - width;
    for (int l = 1; l < PIA_LANES; l++) least = t.own[l] < least ? t.own[l] : least;
    for (pia_index i = 0; i < width; i++) reduce(&s, &t, i, (int)i, width, dim, &good);
    for (pia_index i = width; i < t.size; i++) reduce(&s, &t, i, width, width, dim, &good);
    for (pia_index i = t.size - 1; i >= inside; i--) substitute(&s, &t, i, (int)(t.size - 1 - i), width, dim, x);
    for (pia_index i = inside - 1; i >= least; i--) substitute(&s, &t, i, width, width, dim, x);
    return (good[0] & good[1] & good[2] & good[3]) != 0;
}

/* The cubic in up to three dimensions is what nearly everybody fits. */
PIA_CLONES static int solve_any(const pia_band_system *s, const team *t, double *x)
{
    if (s->width == 3 && s->dim == 3) return solve(s, t, 3, 3, x);
    if (s->width == 3 && s->dim == 2) return solve(s, t, 3, 2, x);
    if (s->width == 3 && s->dim == 1) return solve(s, t, 3, 1, x);
    return solve(s, t, s->width, s->dim, x);
}

static void solve_team(void *work, pia_index number)
{
    windows *w = work;
    team t = place(w, number * PIA_LANES);
    t.row = pia_rooms_take(w->rooms);
    t.right = t.row + w->size * (w->system->width + 1);
    if (!solve_any(w->system, &t, w->x)) atomic_store_explicit(&w->weak, 1, memory_order_relaxed);
    pia_rooms_leave(w->rooms, t.row);
}

pia_status pia_band_windows_solve(pia_context *context, const pia_band_system *system, double *x, int *done)
{
    pia_rooms rooms;
    windows w = {.system = system, .x = x, .rooms = &rooms};
    pia_index teams = pia_chunk_count(system->n, LENGTH * PIA_LANES);
    w.count = teams * PIA_LANES;
    w.margin = MARGIN * (system->width + 1);
    w.size = (system->n + w.count - 1) / w.count + 2 * w.margin;
    *done = 0;
    pia_status status = pia_rooms_open(context, teams, w.size * (system->width + 1 + system->dim) * UNIT, &rooms);
    if (status != PIA_OK) return status;
    pia_for_each(context, teams, solve_team, &w);
    pia_rooms_close(context, &rooms);
    *done = atomic_load(&w.weak) == 0;
    return PIA_OK;
}
