/* A = A_u (x) A_v. Lines along v are solved as many at a time as fill SIDES numbers a row, transposed so that vectors run across them;
 * then panels of as many columns are solved along u, where vectors run across them anyway. A line or a panel that is in the cache is
 * multiplied by the matrix of its direction there: the products meet in the errors. */
#include "square_grid.h"

#include "band.h"
#include "equations.h"
#include "kernel.h"
#include "lanes.h"
#include "rooms.h"

#include <math.h>
#include <string.h>

enum {
    SIDES = PIA_BAND_SIDES,
    MAX_CHUNKS = 64,
    MOST_DIM = SIDES / PIA_LANES,
    AHEAD = 12 /* rows */,
    MOST = 16384 /* rows of a block */
};

/* One direction: its factors, and its matrix over the columns i - lower .. i + upper of row i, zero outside. */
typedef struct side {
    pia_index n;
    int lower, upper;      /* at least 1 */
    double *entry;         /* [n x (lower + 1 + upper)] */
    unsigned char *narrow; /* [n] 1: one entry on either side of the diagonal is all, as in most rows of a cubic */
    pia_band_lu lu;
} side;

typedef struct work {
    const side *u, *v;
    int dim;
    pia_index chunks;
    const double *points;
    double shift[SIDES];  /* the first point, again and again, so that surfaces far from the origin lose nothing */
    double back[SIDES];   /* the same, less the origin of the targets */
    double *next, *along; /* [u x v x dim] solved along v, then control points; products with A_v, then with A_u */
    pia_rooms *rooms;
    pia_step_errors *errors; /* [chunks] */
} work;

/* Points side by side. */
PIA_INLINE pia_index together(int dim)
{
    return SIDES / dim / PIA_LANES * PIA_LANES;
}

/* ---- errors ---- */

/* Squares lane by lane, and where the largest is, once it is not 0. */
typedef struct tally {
    pia_lanes sum, most;
    pia_lane_masks at;
    pia_index count;
} tally;

/* Squares of as many points, numbers `now`; further lanes hold nothing. */
PIA_INLINE void count(tally *t, pia_lanes square, int points, pia_lane_masks now)
{
    for (int l = points; l < PIA_LANES; l++) square[l] = 0;
    pia_lane_masks more = square > t->most;
    t->at = (more & now) | (~more & t->at);
    t->most = pia_lanes_choose(more, square, t->most);
    t->sum += square;
    t->count += points;
}

/* first: the number of the first point of all. */
static pia_errors errors_of(const tally *t, pia_index first)
{
    pia_errors e = {.max_row = first, .count = t->count, .sum_squares = pia_vector_sum(t->sum)};
    double most = 0;
    for (int l = 0; l < PIA_LANES; l++) {
        if (t->most[l] < most || t->most[l] == 0 || (t->most[l] == most && t->at[l] > e.max_row)) continue;
        most = t->most[l];
        e.max_row = t->at[l];
    }
    e.weighted = e.sum_squares;
    e.max = sqrt(most);
    return e;
}

/* ---- along v: block [v x SIDES] holds component d of point s of line l at s * SIDES + d * together + l ---- */

/* PIA_LANES points from s on, the last ones again where fewer are left; `again` tells how many of them have been met before. */
PIA_INLINE pia_index next_points(const work *w, pia_index s, int *again)
{
    pia_index at = s + PIA_LANES <= w->v->n ? s : w->v->n - PIA_LANES;
    *again = (int)(s - at);
    return at;
}

/* Where PIA_LANES lines from `line` on have point s; lines past the last are the last. */
PIA_INLINE void places(const work *w, pia_index line, pia_index s, pia_index *at)
{
    for (int l = 0; l < PIA_LANES; l++) {
        pia_index row = line + l < w->u->n ? line + l : w->u->n - 1;
        at[l] = (row * w->v->n + s) * w->dim;
    }
}

/* The numbers of PIA_LANES points of PIA_LANES lines, a vector across the lines each. */
PIA_INLINE void load_points(const double *from, const pia_index *at, int dim, pia_lanes *number)
{
    for (int part = 0; part < dim; part++) {
        pia_lanes *four = number + part * PIA_LANES;
        for (int l = 0; l < PIA_LANES; l++) four[l] = pia_vector_load(from + at[l] + part * PIA_LANES);
        pia_lanes_transpose(four);
    }
}

PIA_INLINE void store_points(double *to, const pia_index *at, int lines, int dim, pia_lanes *number)
{
    for (int part = 0; part < dim; part++) {
        pia_lanes *four = number + part * PIA_LANES;
        pia_lanes_transpose(four);
        for (int l = 0; l < lines; l++) pia_lanes_write(four[l], to + at[l] + part * PIA_LANES);
    }
}

PIA_INLINE pia_index lines_from(const work *w, pia_index line)
{
    return w->u->n - line < PIA_LANES ? w->u->n - line : PIA_LANES;
}

PIA_INLINE void load_lines(const work *w, const double *from, int shifted, int dim, pia_index line, double *block)
{
    for (pia_index s = 0; s < w->v->n; s += PIA_LANES)
        for (pia_index q = 0; q < together(dim); q += PIA_LANES) {
            int again;
            pia_index at[PIA_LANES], first = next_points(w, s, &again);
            pia_lanes number[PIA_LANES * MOST_DIM];
            places(w, line + q, first, at);
            load_points(from, at, dim, number);
            for (int k = 0; k < PIA_LANES; k++)
                for (int d = 0; d < dim; d++)
                    pia_lanes_write(number[k * dim + d] - (shifted ? w->shift[d] : 0),
                                    block + (first + k) * SIDES + d * together(dim) + q);
        }
}

/* PIA_LANES numbers at column c of row i of A block. */
PIA_INLINE pia_lanes product(const side *a, const double *block, pia_index i, pia_index c)
{
    const double *value = a->entry + i * (a->lower + 1 + a->upper) + a->lower, *from = block + i * SIDES + c;
    pia_lanes sum =
        value[-1] * pia_vector_load(from - SIDES) + value[0] * pia_vector_load(from) + value[1] * pia_vector_load(from + SIDES);
    for (int k = 2; k <= a->lower && !a->narrow[i]; k++) sum += value[-k] * pia_vector_load(from - k * SIDES);
    for (int k = 2; k <= a->upper && !a->narrow[i]; k++) sum += value[k] * pia_vector_load(from + k * SIDES);
    return sum;
}

/* to = the block, or its product with A_v. */
PIA_INLINE void store_lines(const work *w, const double *block, int multiplied, int dim, pia_index line, double *to)
{
    for (pia_index s = 0; s < w->v->n; s += PIA_LANES)
        for (pia_index q = 0; q < together(dim) && line + q < w->u->n; q += PIA_LANES) {
            int again;
            pia_index at[PIA_LANES], first = next_points(w, s, &again);
            pia_lanes number[PIA_LANES * MOST_DIM];
            for (int k = 0; k < PIA_LANES; k++)
                for (int d = 0; d < dim; d++) {
                    pia_index c = d * together(dim) + q;
                    number[k * dim + d] =
                        multiplied ? product(w->v, block, first + k, c) : pia_vector_load(block + (first + k) * SIDES + c);
                }
            places(w, line + q, first, at);
            store_points(to, at, (int)lines_from(w, line + q), dim, number);
        }
}

/* Points less the product of the block with A_v. */
PIA_INLINE void compare_lines(const work *w, const double *block, int dim, pia_index line, tally *t)
{
    for (pia_index q = 0; q < together(dim) && line + q < w->u->n; q += PIA_LANES)
        for (pia_index s = 0; s < w->v->n; s += PIA_LANES) {
            int again;
            pia_index at[PIA_LANES], first = next_points(w, s, &again);
            pia_lanes number[PIA_LANES * MOST_DIM];
            pia_lane_masks now = (line + q + (pia_lane_masks){0, 1, 2, 3}) * w->v->n + first;
            places(w, line + q, first, at);
            load_points(w->points, at, dim, number);
            for (int k = again; k < PIA_LANES; k++) {
                pia_lanes square = {0};
                for (int d = 0; d < dim; d++) {
                    pia_lanes left = number[k * dim + d] - w->shift[d] - product(w->v, block, first + k, d * together(dim) + q);
                    square += left * left;
                }
                count(t, square, (int)lines_from(w, line + q), now + k);
            }
        }
}

PIA_INLINE void solve_lines_of(const work *w, int dim, pia_index line, double *block)
{
    load_lines(w, w->points, 1, dim, line, block);
    store_lines(w, block, 1, dim, line, w->along);
    pia_band_lu_solve(&w->v->lu, block, SIDES);
    store_lines(w, block, 0, dim, line, w->next);
}

PIA_INLINE void measure_lines_of(const work *w, int dim, pia_index line, double *block, tally *t)
{
    load_lines(w, w->along, 0, dim, line, block);
    compare_lines(w, block, dim, line, t);
}

PIA_CLONES static void solve_lines(const work *w, pia_index line, double *block)
{
    if (w->dim == 1)
        solve_lines_of(w, 1, line, block);
    else if (w->dim == 3)
        solve_lines_of(w, 3, line, block);
    else
        solve_lines_of(w, w->dim, line, block);
}

PIA_CLONES static void measure_lines(const work *w, pia_index line, double *block, tally *t)
{
    if (w->dim == 1)
        measure_lines_of(w, 1, line, block, t);
    else if (w->dim == 3)
        measure_lines_of(w, 3, line, block, t);
    else
        measure_lines_of(w, w->dim, line, block, t);
}

/* ---- along u: block [u x SIDES] holds `width` columns of numbers ---- */

PIA_INLINE pia_lanes load_some(const double *from, pia_index wanted)
{
    if (wanted >= PIA_LANES) return pia_vector_load(from);
    double value[PIA_LANES] = {0};
    for (pia_index k = 0; k < wanted; k++) value[k] = from[k];
    return pia_vector_load(value);
}

PIA_INLINE void store_some(pia_lanes value, double *to, pia_index wanted)
{
    if (wanted >= PIA_LANES)
        pia_lanes_write(value, to);
    else
        for (pia_index k = 0; k < wanted; k++) to[k] = value[k];
}

/* Rows are pages apart, which no processor looks ahead of by itself. */
PIA_INLINE void fetch(const double *row, pia_index stride, pia_index width)
{
    for (pia_index c = 0; c < width; c += 8) __builtin_prefetch(row + AHEAD * stride + c);
}

static void load_panel(const work *w, const double *from, pia_index column, pia_index width, double *block)
{
    pia_index stride = w->v->n * w->dim;
    for (pia_index i = 0; i < w->u->n; i++) {
        fetch(from + i * stride + column, stride, width);
        memcpy(block + i * SIDES, from + i * stride + column, (size_t)width * sizeof *block);
        for (pia_index c = width; c < SIDES; c++) block[i * SIDES + c] = 0;
    }
}

/* Squares of differences in the columns of a row whose first point has number `first`. */
PIA_INLINE void count_row(const double *difference, int dim, pia_index width, pia_index first, tally *t)
{
    for (pia_index c = 0; c < width; c += PIA_LANES * dim) {
        pia_lanes square = {0};
        for (int d = 0; d < dim; d++) {
            pia_lanes part = pia_vector_component(difference + c, dim, d);
            square += part * part;
        }
        pia_index points = (width - c) / dim;
        count(t, square, points < PIA_LANES ? (int)points : PIA_LANES, first + c / dim + (pia_lane_masks){0, 1, 2, 3});
    }
}

/* Row i of the points, less the shift, less the product of the block with A_u or the block itself. */
PIA_INLINE void compare_row(const work *w, const double *block, int multiplied, pia_index i, int dim, pia_index column, pia_index width,
                            tally *t)
{
    double difference[SIDES];
    pia_index at = i * w->v->n * dim + column;
    fetch(w->points + at, w->v->n * dim, width);
    for (pia_index c = 0; c < width; c += PIA_LANES) {
        pia_lanes other = multiplied ? product(w->u, block, i, c) : pia_vector_load(block + i * SIDES + c);
        pia_lanes_write(load_some(w->points + at + c, width - c) - pia_vector_load(w->shift + c) - other, difference + c);
    }
    count_row(difference, dim, width, at / dim, t);
}

/* Control points, and their product with A_u. */
PIA_INLINE void store_row(const work *w, const double *block, pia_index i, int dim, pia_index column, pia_index width)
{
    pia_index at = i * w->v->n * dim + column;
    for (pia_index c = 0; c < width; c += PIA_LANES) {
        store_some(pia_vector_load(block + i * SIDES + c) + pia_vector_load(w->back + c), w->next + at + c, width - c);
        store_some(product(w->u, block, i, c), w->along + at + c, width - c);
    }
}

PIA_INLINE void solve_panel_of(const work *w, int dim, pia_index column, pia_index width, double *block, tally *before, tally *moved)
{
    load_panel(w, w->along, column, width, block);
    for (pia_index i = 0; i < w->u->n; i++) compare_row(w, block, 1, i, dim, column, width, before);
    load_panel(w, w->next, column, width, block);
    pia_band_lu_solve(&w->u->lu, block, SIDES);
    for (pia_index i = 0; i < w->u->n; i++) {
        compare_row(w, block, 0, i, dim, column, width, moved);
        store_row(w, block, i, dim, column, width);
    }
}

PIA_CLONES static void solve_panel(const work *w, pia_index column, pia_index width, double *block, tally *before, tally *moved)
{
    int full = width == together(w->dim) * w->dim;
    if (full && w->dim == 1)
        solve_panel_of(w, 1, column, together(1), block, before, moved);
    else if (full && w->dim == 3)
        solve_panel_of(w, 3, column, 3 * together(3), block, before, moved);
    else
        solve_panel_of(w, w->dim, column, width, block, before, moved);
}

/* ---- tasks ---- */

static pia_index blocks(pia_index count, pia_index together)
{
    return (count + together - 1) / together;
}

/* A room holds the rows of a block, and as many zeros around them as a row of a matrix may ask for. Columns that hold no points are
 * zeros as well, and stay so. */
static double *take_block(const work *w, const side *a)
{
    double *room = pia_rooms_take(w->rooms), *block = room + a->lower * SIDES;
    if (together(w->dim) * w->dim < SIDES) memset(block, 0, (size_t)(a->n * SIDES) * sizeof *block);
    memset(room, 0, (size_t)(a->lower * SIDES) * sizeof *room);
    memset(block + a->n * SIDES, 0, (size_t)(a->upper * SIDES) * sizeof *room);
    return block;
}

static void leave_block(const work *w, const side *a, double *block)
{
    pia_rooms_leave(w->rooms, block - a->lower * SIDES);
}

static void solve_v_chunk(void *argument, pia_index chunk)
{
    const work *w = argument;
    pia_index each = together(w->dim), count = blocks(w->u->n, each), end = pia_chunk_begin(count, w->chunks, chunk + 1);
    double *block = take_block(w, w->v);
    for (pia_index b = pia_chunk_begin(count, w->chunks, chunk); b < end; b++) solve_lines(w, b * each, block);
    leave_block(w, w->v, block);
}

static void solve_u_chunk(void *argument, pia_index chunk)
{
    const work *w = argument;
    pia_index each = together(w->dim), count = blocks(w->v->n, each), end = pia_chunk_begin(count, w->chunks, chunk + 1);
    pia_index begin = pia_chunk_begin(count, w->chunks, chunk);
    double *block = take_block(w, w->u);
    tally before = {0}, moved = {0};
    for (pia_index b = begin; b < end; b++) {
        pia_index first = b * each, points = w->v->n - first < each ? w->v->n - first : each;
        solve_panel(w, first * w->dim, points * w->dim, block, &before, &moved);
    }
    w->errors[chunk].before = errors_of(&before, begin * each);
    w->errors[chunk].moved = errors_of(&moved, 0).max;
    leave_block(w, w->u, block);
}

static void measure_chunk(void *argument, pia_index chunk)
{
    const work *w = argument;
    pia_index each = together(w->dim), count = blocks(w->u->n, each), end = pia_chunk_begin(count, w->chunks, chunk + 1);
    pia_index begin = pia_chunk_begin(count, w->chunks, chunk);
    double *block = take_block(w, w->v);
    tally after = {0};
    for (pia_index b = begin; b < end; b++) measure_lines(w, b * each, block, &after);
    w->errors[chunk].after = errors_of(&after, begin * each * w->v->n);
    leave_block(w, w->v, block);
}

static void run(pia_context *context, work *w, pia_index count, pia_task *task)
{
    pia_index all = blocks(count, together(w->dim));
    w->chunks = all < MAX_CHUNKS ? all : MAX_CHUNKS;
    pia_for_each(context, w->chunks, task, w);
}

static pia_status step(pia_context *context, work *w, pia_step_errors *out)
{
    pia_rooms rooms;
    pia_step_errors errors[MAX_CHUNKS];
    pia_index rows = (w->u->n > w->v->n ? w->u->n : w->v->n) + 2 * (PIA_MAX_DEGREE + 1);
    pia_status status = pia_rooms_open(context, MAX_CHUNKS, rows * SIDES * (pia_index)sizeof(double), &rooms);
    if (status != PIA_OK) return status;
    w->rooms = &rooms;
    w->errors = errors;
    *out = (pia_step_errors){.before.max_row = -1, .after.max_row = -1};
    run(context, w, w->u->n, solve_v_chunk);
    run(context, w, w->v->n, solve_u_chunk);
    for (pia_index c = 0; c < w->chunks; c++) {
        out->before = pia_errors_join(out->before, errors[c].before);
        out->moved = fmax(out->moved, errors[c].moved);
    }
    run(context, w, w->u->n, measure_chunk);
    for (pia_index c = 0; c < w->chunks; c++) out->after = pia_errors_join(out->after, errors[c].after);
    pia_rooms_close(context, &rooms);
    return PIA_OK;
}

/* ---- the two directions ---- */

static void close_side(pia_context *context, side *a)
{
    pia_band_lu_clear(context, &a->lu);
    pia_give(context, a->entry);
    pia_give(context, a->narrow);
}

/* The rows of the equations as wide as the band of the factors. */
static void fill_entries(const pia_equations *e, side *a)
{
    int width = a->lower + 1 + a->upper;
    for (pia_index i = 0; i < a->n; i++) {
        a->narrow[i] = 1;
        for (int k = -a->lower; k <= a->upper; k++) {
            pia_index from = i + k - e->first[i];
            double value = from >= 0 && from < e->width ? e->entry[i * e->width + from] : 0;
            a->entry[i * width + a->lower + k] = value;
            if (k < -1 || k > 1) a->narrow[i] &= value == 0;
        }
    }
}

static pia_status open_side(pia_context *context, const pia_collocation *c, side *out)
{
    pia_equations e;
    *out = (side){.n = c->unknowns};
    pia_status status = pia_equations_open(context, c, NULL, &e);
    if (status != PIA_OK) return status;
    status = pia_band_lu_factor(context, e.entry, e.first, e.n, e.width, &out->lu);
    if (status == PIA_OK) {
        out->lower = out->lu.lower > 1 ? out->lu.lower : 1;
        out->upper = out->lu.upper > 1 ? out->lu.upper : 1;
        out->entry = pia_take(context, e.n * (out->lower + 1 + out->upper), sizeof *out->entry);
        out->narrow = pia_take(context, e.n, 1);
        if (out->entry == NULL || out->narrow == NULL)
            status = PIA_E_MEMORY;
        else
            fill_entries(&e, out);
    }
    pia_equations_clear(context, &e);
    return status;
}

int pia_square_grid_suits(const pia_op *op, int dim)
{
    return op->directions == 2 && op->identity && op->frozen == NULL && op->rows == op->cols && dim <= MOST_DIM &&
           op->count[1] >= PIA_LANES && op->count[0] <= MOST && op->count[1] <= MOST;
}

pia_status pia_square_grid_step(const pia_op *op, const pia_targets *targets, double *next, pia_step_errors *out)
{
    side u, v = {0};
    int dim = targets->dim;
    work w = {.u = &u, .v = &v, .dim = dim, .points = targets->points, .next = next, .along = op->along};
    for (int c = 0; c < SIDES; c++) {
        w.shift[c] = targets->points[c % dim];
        w.back[c] = w.shift[c] - targets->origin[c % dim];
    }
    pia_status status = open_side(op->context, op->line[0], &u);
    if (status == PIA_OK) status = open_side(op->context, op->line[1], &v);
    if (status == PIA_OK) status = step(op->context, &w, out);
    close_side(op->context, &u);
    close_side(op->context, &v);
    return status;
}
