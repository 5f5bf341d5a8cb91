/* The solver of a group of windows, for vectors of LANES doubles: one lane a window, so that all arithmetic is of vectors and the
 * divisions of several eliminations overlap. What a window needs stays in the second-level cache, from its basis values to its errors.
 * Included once for each width, with JOIN(a, b) the vector of all quarters, TARGETS before functions that are made for certain
 * processors. */
#include "lanes.h"
#include "op_curve.h"
#include "vector_lanes.h"
#include "windows_group.h"

#include <float.h>
#include <math.h>
#include <string.h>

enum { QUARTERS = LANES / PIA_LANES /* vectors of four in one of these */, LINE = 64 /* bytes of a cache line */ };

/* Equations low .. low + size - 1 of LANES windows, lane by lane; size is a multiple of PIA_LANES. Arrays over rows have `degree` more
 * of zeros on both sides. */
typedef struct group {
    pia_index size;
    const pia_index *low, *own, *end, *column; /* [LANES] */
    const pia_window_group *all;
    int reach;                 /* bandwidth on the wider side of the diagonal */
    int stride;                /* entry [size x stride]: row i over columns i - reach .. i + reach, then nothing of interest */
    lanes *room, *entry;       /* [size x (2 degree + 1)], which entry lies in */
    lanes *upper;              /* [size x reach] */
    lanes *target, *point, *x; /* [size x dim], less the shift; x: residual, correction, then new control points */
    lanes *square;             /* [size] squared lengths */
    const double *next_points, *next_parameters, *next_knots; /* behind these windows */
    lanes shift[PIA_MAX_DIM]; /* the first target of each window, so that curves far from the origin lose nothing */
} group;

/* ---- vectors ---- */

PIA_INLINE lanes splat(double value)
{
    return (lanes){0} + value;
}

/* One number of each place. */
PIA_INLINE lanes load_each(const double *array, const pia_index *at)
{
    double value[LANES];
    lanes all;
    for (int l = 0; l < LANES; l++) value[l] = array[at[l]];
    memcpy(&all, value, sizeof all);
    return all;
}

PIA_INLINE pia_lanes quarter(const lanes *from, int k)
{
    pia_lanes four;
    memcpy(&four, (const double *)from + k * PIA_LANES, sizeof four);
    return four;
}

PIA_INLINE int all_set(masks mask)
{
    int64_t every = -1;
    for (int l = 0; l < LANES; l++) every &= mask[l];
    return every != 0;
}

/* history [count x width] of the rows before, nearest first: takes one more. */
PIA_INLINE void remember(lanes *history, int count, int width, const lanes *row)
{
    for (int r = count - 1; r >= 1; r--)
        for (int k = 0; k < width; k++) history[r * width + k] = history[(r - 1) * width + k];
    for (int k = 0; k < width; k++) history[k] = row[k];
}

/* ---- numbers to lanes and back ---- */

/* Of PIA_LANES rows from places at[lane] on, each a vector. */
PIA_INLINE void load_rows(const double *from, const pia_index *at, lanes *row)
{
    pia_lanes four[QUARTERS][PIA_LANES];
    for (int q = 0; q < QUARTERS; q++) {
        for (int l = 0; l < PIA_LANES; l++) four[q][l] = pia_vector_load(from + at[q * PIA_LANES + l]);
        pia_lanes_transpose(four[q]);
    }
    for (int k = 0; k < PIA_LANES; k++) row[k] = JOIN(four[0][k], four[QUARTERS - 1][k]);
}

/* array [size x dim] = numbers of the rows less the shift. */
PIA_INLINE void load(const group *g, const double *from, int dim, lanes *array)
{
    pia_index at[LANES];
    for (int l = 0; l < LANES; l++) at[l] = g->low[l] * dim;
    for (pia_index i = 0; i < g->size; i += PIA_LANES)
        for (int part = 0; part < dim; part++) {
            lanes number[PIA_LANES], *to = array + i * dim + part * PIA_LANES;
            load_rows(from + i * dim + part * PIA_LANES, at, number);
            for (int k = 0; k < PIA_LANES; k++) to[k] = number[k] - g->shift[(part * PIA_LANES + k) % dim];
        }
}

/* Rows that all windows of the group own, but `inside` at both ends. */
static void common_rows(const group *g, int inside, pia_index *from, pia_index *to)
{
    const pia_window_group *all = g->all;
    *from = 0;
    *to = g->size;
    for (int l = 0; l < PIA_WINDOW_GROUP; l++) {
        if (all->own[l] + inside > *from) *from = all->own[l] + inside;
        if (all->end[l] - inside < *to) *to = all->end[l] - inside;
    }
    if (*to < *from) *to = *from;
}

/* Rows from .. to - 1 of a window, moved back by the shift. */
PIA_INLINE void store_rows(const group *g, int lane, pia_index from, pia_index to, int dim, double *out)
{
    for (pia_index i = from; i < to; i++)
        for (int d = 0; d < dim; d++) out[(g->low[lane] + i) * dim + d] = g->x[i * dim + d][lane] + g->shift[d][lane];
}

/* The own rows of each window are its share of the result. */
PIA_INLINE void store(const group *g, int dim, double *out)
{
    pia_index from, i, to;
    common_rows(g, 0, &from, &to);
    for (i = from; i + PIA_LANES <= to; i += PIA_LANES)
        for (int part = 0; part < dim; part++) {
            pia_index e = i * dim + part * PIA_LANES;
            for (int q = 0; q < QUARTERS; q++) {
                pia_lanes four[PIA_LANES];
                for (int k = 0; k < PIA_LANES; k++)
                    four[k] = quarter(g->x + e + k, q) + quarter(g->shift + (part * PIA_LANES + k) % dim, q);
                pia_lanes_transpose(four);
                for (int l = 0; l < PIA_LANES; l++) pia_lanes_write(four[l], out + g->low[q * PIA_LANES + l] * dim + e);
            }
        }
    for (int l = 0; l < LANES; l++) {
        store_rows(g, l, g->own[l], from, dim, out);
        store_rows(g, l, i, g->end[l], dim, out);
    }
}

/* No points: control points are the targets. Control points count from the origin of the targets. */
PIA_INLINE void load_group(const pia_windows *w, group *g, int dim)
{
    const pia_targets *q = w->targets;
    for (int d = 0; d < dim; d++) {
        pia_index first[LANES];
        for (int l = 0; l < LANES; l++) first[l] = g->low[l] * dim + d;
        g->shift[d] = load_each(q->points, first);
    }
    load(g, q->points, dim, g->target);
    for (int d = 0; d < dim; d++) g->shift[d] -= q->origin[d];
    if (w->points != NULL) load(g, w->points, dim, g->point);
}

/* ---- the equations ---- */

/* The denominators of the basis' quotients, inverted: [degree (degree + 1) / 2], those of degree 1 first. knot[k] is the knot at
 * span - degree + 1 + k, k < 2 degree. */
PIA_INLINE void invert(const lanes *knot, int degree, lanes *inverse)
{
    for (int d = 1; d <= degree; inverse += d++)
        for (int r = 0; r < d; r++) inverse[r] = 1 / (knot[degree + r] - knot[degree + r - d]);
}

/* The same for the next span, whose last knot is `next`: one division a degree. */
PIA_INLINE void advance(lanes *knot, int degree, lanes next, lanes *inverse)
{
    for (int k = 0; k + 1 < 2 * degree; k++) knot[k] = knot[k + 1];
    knot[2 * degree - 1] = next;
    for (int d = 1; d <= degree; inverse += d++) {
        for (int r = 0; r + 1 < d; r++) inverse[r] = inverse[r + 1];
        inverse[d - 1] = 1 / (knot[degree + d - 1] - knot[degree - 1]);
    }
}

/* Basis values from the inverses; exactly 0 where they should be at the left knot. */
PIA_INLINE void basis(const lanes *knot, const lanes *inverse, int degree, lanes t, lanes *value)
{
    value[0] = splat(1);
    for (int d = 1; d <= degree; inverse += d++) {
        lanes carried = {0};
        for (int r = 0; r < d; r++) {
            lanes part = value[r] * ((t - knot[degree + r - d]) * inverse[r]);
            value[r] = carried + (value[r] - part);
            carried = part;
        }
        value[d] = carried;
    }
}

/* Rows on spans one after the other: nothing has to be searched, and the quotients of the basis need one division a degree.
 * skip: reach - before. */
PIA_INLINE void fill_walking(const pia_windows *w, const group *g, int degree, int skip, int reach)
{
    const double *parameters = w->line->parameters, *knots = w->line->knots + 2 * degree; /* nothing that is written overlaps these */
    lanes knot[2 * PIA_MAX_DEGREE], inverse[PIA_MAX_DEGREE * (PIA_MAX_DEGREE + 1) / 2], value[PIA_MAX_DEGREE + 1], *entry = g->entry;
    int known = skip + degree <= 2 * reach ? degree : degree - 1; /* a last value outside is 0 */
    for (int i = 0; i < 2 * degree; i++) knot[i] = load_each(w->line->knots + i, g->column);
    invert(knot, degree, inverse);
    for (pia_index i = 0; i < g->size; i += PIA_LANES) {
        lanes t[PIA_LANES], next[PIA_LANES];
        load_rows(parameters + i, g->low, t);
        load_rows(knots + i, g->column, next);
        for (int row = 0; row < PIA_LANES; row++, entry += 2 * reach + 1) {
            advance(knot, degree, next[row], inverse);
            basis(knot, inverse, degree, t[row], value);
            for (int j = 0; j < skip; j++) entry[j] = (lanes){0};
            for (int j = 0; j <= known; j++) entry[skip + j] = value[j];
            for (int j = skip + known + 1; j < 2 * reach + 1; j++) entry[j] = (lanes){0};
        }
    }
}

/* Rows on any spans, over columns i - degree .. i + degree. Returns the bandwidth, 0 where a row does not reach its diagonal or its
 * parameter is not above that of the row before. */
PIA_INLINE int fill_searching(const pia_windows *w, const group *g, int degree)
{
    const pia_collocation *c = w->line;
    pia_index row[LANES], span[LANES], column[LANES];
    pia_lanes value[QUARTERS][PIA_MAX_DEGREE + 1];
    int width = 2 * degree + 1, reach = 1;
    for (int l = 0; l < LANES; l++) {
        span[l] = pia_collocation_own_span(c, g->low[l]);
        if (span[l] < 0) return 0;
    }
    for (pia_index i = 0; i < g->size; i++) {
        lanes *entry = g->entry + i * width;
        for (int l = 0; l < LANES; l++) {
            row[l] = g->low[l] + i;
            if (i > 0 && !(c->parameters[row[l]] > c->parameters[row[l] - 1])) return 0;
            span[l] = pia_collocation_advance(c, row[l], span[l]);
            column[l] = span[l] - degree;
        }
        for (int q = 0; q < QUARTERS; q++) pia_lanes_row(c, row + q * PIA_LANES, column + q * PIA_LANES, degree, value[q]);
        for (int k = 0; k < width; k++) entry[k] = (lanes){0};
        for (int l = 0; l < LANES; l++) {
            const pia_lanes *own = value[l / PIA_LANES];
            pia_index before = row[l] - column[l];
            if (before < 0 || before > degree) return 0;
            int after = degree - (int)before - (own[degree][l % PIA_LANES] == 0);
            reach = before > reach ? (int)before : reach;
            reach = after > reach ? after : reach;
            for (int k = 0; k <= degree; k++) entry[degree - before + k][l] = own[k][l % PIA_LANES];
        }
    }
    return reach;
}

TARGETS static void fill_alike(const pia_windows *w, const group *g)
{
    int reach = g->reach, skip = reach - g->all->before;
    if (w->degree == 3 && skip == 0 && reach == 1)
        fill_walking(w, g, 3, 0, 1);
    else if (w->degree == 3 && skip == 0 && reach == 2)
        fill_walking(w, g, 3, 0, 2);
    else if (w->degree == 3 && skip == 1 && reach == 2)
        fill_walking(w, g, 3, 1, 2);
    else
        fill_walking(w, g, w->degree, skip, reach);
}

TARGETS static int fill_any(const pia_windows *w, const group *g)
{
    return w->degree == 3 ? fill_searching(w, g, 3) : fill_searching(w, g, w->degree);
}

/* Returns 0 where a row does not reach its diagonal. */
static int fill(const pia_windows *w, group *g)
{
    g->entry = g->room;
    if (g->all->walks) {
        g->reach = g->all->reach;
        g->stride = 2 * g->reach + 1;
        fill_alike(w, g);
        return 1;
    }
    g->reach = fill_any(w, g);
    g->stride = 2 * w->degree + 1;
    g->entry += w->degree - g->reach;
    return g->reach > 0;
}

/* ---- the solve ---- */

/* difference = target - A point of row i. Returns its square. */
PIA_INLINE lanes subtract_product(const group *g, const lanes *row, const lanes *point, pia_index i, int reach, int dim,
                                  lanes *difference)
{
    lanes square = {0};
    for (int d = 0; d < dim; d++) {
        const lanes *p = point + (i - reach) * dim + d;
        lanes sum = row[0] * p[0];
        for (int k = 1; k <= 2 * reach; k++) sum += row[k] * p[k * dim];
        difference[d] = g->target[i * dim + d] - sum;
        square += difference[d] * difference[d];
    }
    return square;
}

/* Fetches a share of what the next windows begin with, so that it is here by then. */
PIA_INLINE void fetch_ahead(const group *g, pia_index i, int dim)
{
    const char *points = (const char *)g->next_points + i * LANES * dim * (pia_index)sizeof(double);
    for (int k = 0; k < LANES * dim * (int)sizeof(double); k += LINE) __builtin_prefetch(points + k, 0, 2);
    __builtin_prefetch(g->next_parameters + i * LANES, 0, 2);
    __builtin_prefetch(g->next_knots + i * LANES, 0, 2);
}

/* x = residual and its squares; Crout's elimination as in band_lu.c. Returns 0 where a pivot vanishes. The group is copied, because
 * what is written could overlap it as far as the compiler knows. */
PIA_INLINE int go_down(const group *all, int degree, int reach, int dim)
{
    const group here = *all, *g = &here;
    lanes upper[PIA_MAX_DEGREE * PIA_MAX_DEGREE] = {{0}}, above[PIA_MAX_DEGREE * PIA_MAX_DIM] = {{0}};
    masks good = ~(masks){0};
    double tolerance = 4 * DBL_EPSILON * (degree + 1);
    for (pia_index i = 0; i < g->size; i++) {
        lanes row[2 * PIA_MAX_DEGREE + 1], x[PIA_MAX_DIM], u[PIA_MAX_DEGREE];
        for (int j = 0; j <= 2 * reach; j++) row[j] = g->entry[i * g->stride + j];
        g->square[i] = subtract_product(g, row, g->point, i, reach, dim, x);
        lanes least = row[reach] * tolerance + DBL_MIN;
        for (int r = reach; r >= 1; r--) {
            lanes factor = row[reach - r];
            for (int j = 0; j < reach; j++) row[reach - r + 1 + j] -= factor * upper[(r - 1) * reach + j];
            for (int d = 0; d < dim; d++) x[d] -= factor * above[(r - 1) * dim + d];
        }
        good &= row[reach] > least;
        lanes inverse = 1 / row[reach];
        for (int j = 0; j < reach; j++) g->upper[i * reach + j] = u[j] = row[reach + 1 + j] * inverse;
        for (int d = 0; d < dim; d++) g->x[i * dim + d] = x[d] *= inverse;
        remember(upper, reach, reach, u);
        remember(above, reach, dim, x);
        fetch_ahead(g, i, dim);
    }
    return all_set(good);
}

/* x: the correction and its squares. */
PIA_INLINE void go_up(const group *all, int reach, int dim)
{
    const group here = *all, *g = &here;
    lanes below[PIA_MAX_DEGREE * PIA_MAX_DIM] = {{0}};
    for (pia_index i = g->size - 1; i >= 0; i--) {
        lanes x[PIA_MAX_DIM], square = {0};
        for (int d = 0; d < dim; d++) x[d] = g->x[i * dim + d];
        for (int r = reach; r >= 1; r--)
            for (int d = 0; d < dim; d++) x[d] -= g->upper[i * reach + r - 1] * below[(r - 1) * dim + d];
        remember(below, reach, dim, x);
        for (int d = 0; d < dim; d++) {
            square += x[d] * x[d];
            g->x[i * dim + d] = g->point[i * dim + d] + x[d];
        }
        g->square[i] = square;
    }
}

/* Squares of what the control points in x leave. */
PIA_INLINE void measure(const group *all, int reach, int dim)
{
    const group here = *all, *g = &here;
    lanes difference[PIA_MAX_DIM];
    for (pia_index i = 0; i < g->size; i++)
        g->square[i] = subtract_product(g, g->entry + i * g->stride, g->x, i, reach, dim, difference);
}

/* Squares of rows from .. to - 1 of a window. */
PIA_INLINE void count_rows(const group *g, int lane, pia_index from, pia_index to, double *sum, double *worst)
{
    for (pia_index i = from; i < to; i++) {
        *sum += g->square[i][lane];
        *worst = fmax(*worst, g->square[i][lane]);
    }
}

/* The last one where there is none, as with squares that are no numbers. */
static pia_index first_row(const group *g, int lane, pia_index from, pia_index to, double square)
{
    while (from + 1 < to && g->square[from][lane] != square) from++;
    return from;
}

/* Joins the squares of each window's own rows, but `inside` at both ends. */
PIA_INLINE void count_squares(const group *g, int inside, pia_errors *errors)
{
    pia_index from, to;
    lanes sums = {0}, most = {0};
    common_rows(g, inside, &from, &to);
    for (pia_index i = from; i < to; i++) {
        sums += g->square[i];
        most = lanes_upper(g->square[i], most);
    }
    for (int l = 0; l < LANES; l++) {
        pia_index own = g->own[l] + inside, end = g->end[l] - inside;
        pia_errors lane = {.sum_squares = sums[l], .count = end - own, .max_row = -1};
        double worst = most[l];
        count_rows(g, l, own, from, &lane.sum_squares, &worst);
        count_rows(g, l, to, end, &lane.sum_squares, &worst);
        lane.weighted = lane.sum_squares;
        lane.max = sqrt(worst);
        if (lane.max > errors->max || errors->max_row < 0) lane.max_row = g->low[l] + first_row(g, l, own, end, worst);
        *errors = pia_errors_join(*errors, lane);
    }
}

PIA_INLINE int solve_rows(const pia_windows *w, group *g, pia_step_errors *errors, int reach, int dim)
{
    pia_errors moved = {.max_row = -1};
    if (!go_down(g, w->degree, reach, dim)) return 0;
    count_squares(g, 0, &errors->before);
    go_up(g, reach, dim);
    count_squares(g, 0, &moved);
    errors->moved = fmax(errors->moved, moved.max);
    measure(g, reach, dim);
    count_squares(g, w->degree, &errors->after); /* rows that see control points of the next window come later */
    store(g, dim, w->next);
    return 1;
}

PIA_INLINE int solve_dim(const pia_windows *w, group *g, pia_step_errors *errors, int reach)
{
    switch (w->dim) {
    case 1: return solve_rows(w, g, errors, reach, 1);
    case 2: return solve_rows(w, g, errors, reach, 2);
    case 3: return solve_rows(w, g, errors, reach, 3);
    default: return solve_rows(w, g, errors, reach, w->dim);
    }
}

/* The cubic is what nearly everybody fits: one or two neighbours on either side. */
TARGETS static int solve_any(const pia_windows *w, group *g, pia_step_errors *errors)
{
    if (g->reach == 1) return solve_dim(w, g, errors, 1);
    if (g->reach == 2) return solve_dim(w, g, errors, 2);
    return solve_rows(w, g, errors, g->reach, w->dim);
}

TARGETS static void load_any(const pia_windows *w, group *g)
{
    if (w->dim == 3)
        load_group(w, g, 3);
    else
        load_group(w, g, w->dim);
}

/* ---- room ---- */

/* The next `rows` rows of `width` numbers of a block, `degree` rows of zeros around them. */
static lanes *padded(lanes **block, pia_index rows, pia_index width, pia_index degree)
{
    lanes *first = *block + degree * width;
    memset(*block, 0, (size_t)(degree * width) * sizeof(lanes));
    memset(first + rows * width, 0, (size_t)(degree * width) * sizeof(lanes));
    *block = first + (rows + degree) * width;
    return first;
}

static group open_group(const pia_windows *w, const pia_window_group *all, int first, void *room)
{
    lanes *block = room;
    pia_index degree = w->degree, dim = w->dim;
    group g = {.size = w->size,
               .low = all->low + first,
               .own = all->own + first,
               .end = all->end + first,
               .column = all->column + first,
               .all = all};
    pia_index behind = g.low[LANES - 1] + g.size;
    g.next_points = w->targets->points + behind * dim;
    g.next_parameters = w->line->parameters + behind;
    g.next_knots = w->line->knots + behind;
    g.square = padded(&block, w->size, 1, 0);
    g.room = padded(&block, w->size, 2 * degree + 1, 0);
    g.upper = padded(&block, w->size, degree, degree);
    g.target = padded(&block, w->size, dim, degree);
    g.point = w->points != NULL ? padded(&block, w->size, dim, degree) : g.target;
    g.x = padded(&block, w->size, dim, degree);
    return g;
}

static int solve_group(const pia_windows *w, const pia_window_group *all, void *room, pia_step_errors *errors)
{
    for (int first = 0; first < PIA_WINDOW_GROUP; first += LANES) {
        group g = open_group(w, all, first, room);
        load_any(w, &g);
        if (!fill(w, &g) || !solve_any(w, &g, errors)) return 0;
    }
    return 1;
}
