/* Panels of columns go down through the elimination along u, and up through everything else: substitution, control points, and the
 * errors before and after, while what they need is in the first-level cache. Vectors run across the columns: block
 * [u and its margins x (width + 2 halo)], zeros around it. Included once for each width, after square_grid_vectors.h, with TARGETS
 * before functions that are made for certain processors. */
#include <math.h>

enum { AHEAD = 12 /* rows */ };

/* Squared lengths: their sum lane by lane of a unit, the longest and its number lane by lane of a vector. They come from the last to
 * the first, so that of equals the one to come counts. */
typedef struct tally {
    lanes sum[PARTS], most;
    masks at;
} tally;

PIA_INLINE void count(tally *t, lanes length, int part, masks number)
{
    masks more = length >= t->most;
    t->sum[part] += length;
    t->most = (lanes)choose(more, (masks)length, (masks)t->most);
    t->at = choose(more, number, t->at);
}

/* One panel at work. */
typedef struct strip {
    const pia_square_grid *g;
    pia_index begin;  /* its first number in a line */
    pia_index size;   /* width + 2 halo */
    pia_index line;   /* numbers of a line */
    int inside;       /* 1: lines have all of its numbers */
    double *block;    /* [u and its margins x size], at row 0 */
    double *copy;     /* [(lower + 2 + upper) of u x size] rows that are not inside */
    pia_index copied; /* rows of points from here on have been there */
    double *product;  /* [2 x 2 x size] of points and of control points with A_u, for even and odd rows */
    double *square;   /* [3 x (width + UNIT)] of errors before, after, of corrections, zeros at the ends */
    tally before, after;
    lanes moved; /* squared length of the longest correction */
} strip;

/* The numbers of a panel in a row of an array, those of the other end where it is closed and zeros elsewhere. */
static void copy_row(const strip *s, const double *row, double *to)
{
    pia_index first = s->begin - s->g->halo, end = first + s->size < s->line ? first + s->size : s->line, low = first > 0 ? first : 0;
    memset(to, 0, (size_t)s->size * sizeof *to);
    memcpy(to + low - first, row + low, (size_t)(end - low) * sizeof *to);
    if (s->g->v->margin > 0) {
        pia_index over = first + s->size - end < s->g->halo ? first + s->size - end : s->g->halo;
        memcpy(to, row + s->line + first, (size_t)(low - first) * sizeof *to);
        memcpy(to + end - first, row, (size_t)over * sizeof *to);
    }
}

PIA_INLINE const double *row_along(const strip *s, pia_index i)
{
    const double *row = s->g->along + pia_grid_turn(s->g->u, i) * s->g->stride;
    if (s->inside) return row + s->begin - s->g->halo;
    copy_row(s, row, s->copy);
    return s->copy;
}

PIA_INLINE double *place_of_copy(const strip *s, pia_index i)
{
    pia_index slots = s->g->u->lower + s->g->u->upper + 2;
    return s->copy + (i + slots) % slots * s->size;
}

/* Rows of points are copied once, from the last to the first; as many as are needed together are kept. */
PIA_INLINE void copy_points(strip *s, pia_index to)
{
    if (s->inside) return;
    for (; s->copied > to; s->copied--)
        copy_row(s, s->g->points + pia_grid_turn(s->g->u, s->copied - 1) * s->line, place_of_copy(s, s->copied - 1));
}

PIA_INLINE const double *row_of_points(const strip *s, pia_index i)
{
    if (!s->inside) return place_of_copy(s, i);
    return s->g->points + pia_grid_turn(s->g->u, i) * s->line + s->begin - s->g->halo;
}

/* Rows are pages apart, which no processor looks ahead of by itself. */
PIA_INLINE void fetch(const strip *s, const double *array, pia_index stride, pia_index row)
{
    const double *from = array + pia_grid_turn(s->g->u, row) * stride;
    pia_index first = s->begin > 0 ? s->begin - s->g->halo : 0, end = s->begin + s->g->width + s->g->halo;
    for (pia_index c = first; c < end && c < s->line; c += UNIT) __builtin_prefetch(from + c, 0, 2);
}

/* What rows look up is read before the first number is written, which could be anywhere as far as the compiler knows. */
PIA_INLINE void eliminate_row(const strip *s, const double *from, pia_index i, int reach)
{
    const pia_grid_side *u = s->g->u;
    const pia_index size = s->size;
    const double *row = u->factor + i * (u->lower + 1 + u->upper) + u->lower;
    double factor[PIA_MAX_DEGREE + 1], *to = s->block + i * size;
    for (int r = 0; r <= reach; r++) factor[r] = row[-r];
    for (pia_index c = 0; c < size; c += LANES) {
        lanes y = lanes_load(from + c);
        for (int r = reach; r >= 1; r--) y -= factor[r] * lanes_load(to - r * size + c);
        lanes_store(y * factor[0], to + c);
    }
}

PIA_INLINE void substitute_row(const strip *s, pia_index i, int reach)
{
    const pia_grid_side *u = s->g->u;
    const pia_index size = s->size;
    const double *row = u->factor + i * (u->lower + 1 + u->upper) + u->lower;
    double factor[PIA_MAX_DEGREE + 1], *to = s->block + i * size;
    for (int r = 1; r <= reach; r++) factor[r] = row[r];
    for (pia_index c = 0; c < size; c += LANES) {
        lanes x = lanes_load(to + c);
        for (int r = reach; r >= 1; r--) x -= factor[r] * lanes_load(to + r * size + c);
        lanes_store(x, to + c);
    }
}

/* to = row i of A_u times points less their shift, and times control points: as many rows of these as entries. */
PIA_INLINE void multiply_row(const strip *s, pia_index i, const double *const *points, int lower, int upper)
{
    const pia_grid_side *u = s->g->u;
    const double *row = u->entry + i * (u->lower + 1 + u->upper) + u->lower, *x = s->block + i * s->size, *shift = s->g->shift;
    const pia_index size = s->size;
    double entries[2 * PIA_MAX_DEGREE + 1], *entry = entries + lower;
    double *to_before = s->product + (i & 1) * 2 * size, *to_after = to_before + size;
    for (int r = -lower; r <= upper; r++) entry[r] = row[r];
    for (pia_index c = 0; c < size; c += LANES) {
        lanes before = {0}, after = {0};
        for (int r = -lower; r <= upper; r++) {
            before += entry[r] * (lanes_load(points[r] + c) - lanes_load(shift + c));
            after += entry[r] * lanes_load(x + r * size + c);
        }
        lanes_store(before, to_before + c);
        lanes_store(after, to_after + c);
    }
}

/* What row i, which is known, leaves at numbers c ..: of the points, of the control points, and what these were moved by. */
typedef struct leftover {
    lanes before, after, moved;
} leftover;

/* Row i as finish_row needs it, from the first number of the panel on. */
typedef struct known {
    const double *points, *shift, *x, *before, *after; /* before, after: products with A_u */
    const double *across;                              /* the diagonal; others are `length` apart */
    pia_index length;
} known;

PIA_INLINE leftover leave(const known *row, pia_index c, int lower, int upper, int dim)
{
    lanes point = lanes_load(row->points + c) - lanes_load(row->shift + c);
    leftover left = {point, point, lanes_load(row->x + c) - point};
    for (int r = -lower; r <= upper; r++) {
        lanes entry = lanes_load(row->across + r * row->length + c);
        left.before -= entry * lanes_load(row->before + c + r * dim);
        left.after -= entry * lanes_load(row->after + c + r * dim);
    }
    left.before *= left.before;
    left.after *= left.after;
    left.moved *= left.moved;
    return left;
}

/* The squared length of the point that begins at number c. */
PIA_INLINE lanes length_at(const double *square, pia_index c, int dim)
{
    lanes sum = lanes_load(square + c);
    for (int d = 1; d < dim; d++) sum += lanes_load(square + c + d);
    return sum;
}

PIA_INLINE void leave_squares(const strip *s, const known *row, int lower, int upper, int dim)
{
    const pia_index width = s->g->width, next = width + UNIT;
    double *square = s->square;
    for (pia_index c = 0; c < width; c += LANES) {
        leftover left = leave(row, c, lower, upper, dim);
        lanes_store(left.before, square + c);
        lanes_store(left.after, square + next + c);
        lanes_store(left.moved, square + 2 * next + c);
    }
}

/* Errors before and after, and corrections. */
PIA_INLINE void measure_row(strip *s, const known *row, pia_index first, int lower, int upper, int dim)
{
    const pia_index width = s->g->width, next = width + UNIT;
    const double *counts = s->g->counts + s->begin, *square = s->square;
    tally before = s->before, after = s->after;
    lanes moved = s->moved;
    masks number = first + width + LANE_NUMBERS;
    if (dim > 1) leave_squares(s, row, lower, upper, dim);
    for (pia_index c = width - UNIT; c >= 0; c -= UNIT)
        for (int part = PARTS - 1; part >= 0; part--) {
            const pia_index at = c + part * LANES;
            const lanes count_of = lanes_load(counts + at);
            leftover left;
            if (dim == 1)
                left = leave(row, at, lower, upper, 1);
            else
                left = (leftover){length_at(square, at, dim), length_at(square + next, at, dim), length_at(square + 2 * next, at, dim)};
            number -= LANES;
            count(&before, count_of * left.before, part, number);
            count(&after, count_of * left.after, part, number);
            moved = lanes_upper(count_of * left.moved, moved);
        }
    s->before = before;
    s->after = after;
    s->moved = moved;
}

PIA_INLINE void store_row(const strip *s, const known *row, double *to)
{
    const double *x = row->x, *back = s->g->back;
    pia_index wanted = s->line - s->begin < s->g->width ? s->line - s->begin : s->g->width, c = 0;
    for (; c + LANES <= wanted; c += LANES) lanes_store(lanes_load(x + c) + lanes_load(back + c), to + c);
    for (; c < wanted; c++) to[c] = x[c] + back[c];
}

PIA_INLINE void go_down_rows(const strip *s)
{
    const pia_square_grid *g = s->g;
    const pia_grid_side *u = g->u;
    for (pia_index i = -u->margin; i < u->n + u->margin; i++) {
        fetch(s, g->along, g->stride, i + AHEAD);
        const double *from = row_along(s, i);
        if (u->narrow_factor[i])
            eliminate_row(s, from, i, 1);
        else
            eliminate_row(s, from, i, u->lower);
    }
}

/* Rows of points around row i, for multiply_row: row[lower] is row i; those past an open end meet entries that are 0. */
PIA_INLINE void point_rows(strip *s, pia_index i, int lower, int upper, const double **row)
{
    copy_points(s, i - lower);
    for (int r = -lower; r <= upper; r++) row[lower + r] = row_of_points(s, i + r);
}

PIA_INLINE void multiply(strip *s, pia_index i, int lower, int upper)
{
    const double *row[2 * PIA_MAX_DEGREE + 1];
    point_rows(s, i, lower, upper, row);
    multiply_row(s, i, row + lower, lower, upper);
}

PIA_INLINE void finish(strip *s, pia_index i, int narrow, int dim)
{
    const pia_square_grid *g = s->g;
    const double *product = s->product + (i & 1) * 2 * s->size + g->halo;
    const known row = {.points = row_of_points(s, i) + g->halo,
                       .shift = g->shift + g->halo,
                       .x = s->block + i * s->size + g->halo,
                       .before = product,
                       .after = product + s->size,
                       .across = g->across + g->v->lower * g->panels * g->width + s->begin,
                       .length = g->panels * g->width};
    pia_index first = i * s->line + s->begin;
    if (narrow)
        measure_row(s, &row, first, 1, 1, dim);
    else
        measure_row(s, &row, first, g->v->lower, g->v->upper, dim);
    store_row(s, &row, g->next + first);
}

PIA_INLINE void substitute(const strip *s, pia_index i)
{
    const pia_grid_side *u = s->g->u;
    if (u->narrow_factor[i])
        substitute_row(s, i, 1);
    else
        substitute_row(s, i, u->upper);
}

/* The rows next to the ends of a closed direction become those of the other end, so that errors are those of what is kept. */
PIA_INLINE void close_rows(const strip *s)
{
    const pia_grid_side *u = s->g->u;
    pia_index n = u->n, size = s->size;
    for (pia_index i = n + u->margin - 1; i >= -u->margin; i--) substitute(s, i);
    memcpy(s->block - u->lower * size, s->block + (n - u->lower) * size, (size_t)(u->lower * size) * sizeof *s->block);
    memcpy(s->block + n * size, s->block, (size_t)(u->upper * size) * sizeof *s->block);
}

/* A row is multiplied as soon as all rows are known that its equation has, and finished after the next one, when what it reads in two
 * pieces has left the processor's queue of stores. */
PIA_INLINE void go_up_rows(strip *s, int narrow, int dim)
{
    const pia_grid_side *u = s->g->u;
    if (u->margin > 0) close_rows(s);
    for (pia_index i = u->n - 1; i >= -u->lower - 1; i--) {
        fetch(s, s->g->points, s->line, i - AHEAD);
        if (i >= 0 && u->margin == 0) substitute(s, i);
        pia_index ready = i + u->lower;
        if (ready >= 0 && ready < u->n && u->narrow_entry[ready])
            multiply(s, ready, 1, 1);
        else if (ready >= 0 && ready < u->n)
            multiply(s, ready, u->lower, u->upper);
        if (ready + 1 < u->n) finish(s, ready + 1, narrow, dim);
    }
}

static strip open_strip(const pia_square_grid *g, pia_index panel, double *room)
{
    strip s = {.g = g, .begin = panel * g->width, .size = g->width + 2 * g->halo, .line = g->v->n * g->dim};
    const pia_grid_side *u = g->u;
    s.inside = s.begin >= g->halo && s.begin + g->width + g->halo <= s.line;
    s.block = room + (u->lower + u->margin) * s.size;
    double *behind = s.block + (u->n + u->margin) * s.size;
    memset(room, 0, (size_t)(u->lower * s.size) * sizeof *room);
    memset(behind, 0, (size_t)(u->upper * s.size) * sizeof *room);
    s.product = behind + u->upper * s.size;
    s.square = s.product + 4 * s.size;
    s.copy = s.square + 3 * (g->width + UNIT);
    s.copied = u->n + u->upper;
    memset(s.square, 0, (size_t)(3 * (g->width + UNIT)) * sizeof *room);
    return s;
}

static pia_errors errors_of(const strip *s, const tally *t)
{
    const pia_square_grid *g = s->g;
    double sum[UNIT];
    pia_index left = (s->line - s->begin) / g->dim, points = g->width / g->dim;
    pia_errors e = {.max_row = INT64_MAX, .count = g->u->n * (left < points ? left : points)};
    memcpy(sum, t->sum, sizeof sum);
    for (int l = 0; l < UNIT / 2; l++) sum[l] += sum[l + UNIT / 2];
    e.sum_squares = e.weighted = (sum[0] + sum[1]) + (sum[2] + sum[3]);
    for (int l = 0; l < LANES; l++) {
        if (t->most[l] < e.max || (t->most[l] == e.max && t->at[l] > e.max_row)) continue;
        e.max = t->most[l];
        e.max_row = t->at[l];
    }
    e.max_row /= g->dim;
    e.max = sqrt(e.max);
    return e;
}

static void close_strip(const strip *s, pia_step_errors *errors)
{
    errors->before = pia_errors_join(errors->before, errors_of(s, &s->before));
    errors->after = pia_errors_join(errors->after, errors_of(s, &s->after));
    for (int l = 0; l < LANES; l++) errors->moved = fmax(errors->moved, sqrt(s->moved[l]));
}

TARGETS static void solve_panel(strip *s, int narrow)
{
    go_down_rows(s);
    if (narrow && s->g->dim == 1)
        go_up_rows(s, 1, 1);
    else if (narrow && s->g->dim == 3)
        go_up_rows(s, 1, 3);
    else
        go_up_rows(s, narrow, s->g->dim);
}

static void panel(const pia_square_grid *g, pia_index number, double *room, pia_step_errors *errors)
{
    strip s = open_strip(g, number, room);
    pia_index first = s.begin / g->dim, end = first + g->width / g->dim;
    solve_panel(&s, all_narrow(g->v->narrow_entry, first, end < g->v->n ? end : g->v->n));
    close_strip(&s, errors);
}
