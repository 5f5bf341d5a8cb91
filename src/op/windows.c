/* Windows are taken as many at a time as a vector has lanes: one lane each, so that all arithmetic is of vectors and the divisions of
 * several eliminations overlap. What a window needs stays in the second-level cache, from its basis values to its errors. */
#include "windows.h"

#include "kernel.h"
#include "lanes.h"
#include "op_curve.h"

#include <float.h>
#include <math.h>
#include <string.h>

enum { LENGTH = 512, LEAST_WINDOWS = 8, MAX_CHUNKS = 16, MARGIN = 12 /* rows a degree */ };

/* Equations low .. low + size - 1 of a group of windows, lane by lane. Arrays over rows have `degree` more of zeros on both sides. */
typedef struct group {
    pia_index size, low[PIA_LANES], own[PIA_LANES], end[PIA_LANES]; /* the window's own rows, from low */
    int reach;                                                      /* bandwidth on the wider side of the diagonal */
    int stride;                    /* entry [size x stride]: row i over columns i - reach .. i + reach, then nothing of interest */
    pia_lanes *room, *entry;       /* [size x (2 degree + 1)], which entry lies in */
    pia_lanes *upper;              /* [size x reach] */
    pia_lanes *target, *point, *x; /* [size x dim], less the shift; x: residual, correction, then new control points */
    pia_lanes *square;             /* [size] squared lengths */
    pia_lanes shift[PIA_MAX_DIM];  /* the first target of each window, so that curves far from the origin lose nothing */
} group;

typedef struct work {
    const pia_op *op;
    const pia_collocation *line;
    const pia_targets *targets;
    const double *points;
    double *next;
    int degree, dim;
    pia_index windows, size, chunks;
    group *group;            /* [chunks] */
    pia_step_errors *errors; /* [chunks] */
    int *failed;             /* [chunks] */
} work;

static pia_index window_count(pia_index rows)
{
    return rows / LENGTH / PIA_LANES * PIA_LANES;
}

int pia_windows_suit(const pia_op *op)
{
    return op->directions == 1 && op->identity && op->frozen == NULL && op->rows == op->cols &&
           op->line[0]->degree * MARGIN <= LENGTH && window_count(op->rows) >= LEAST_WINDOWS;
}

static void place_windows(const work *w, pia_index first, group *g)
{
    pia_index rows = w->line->rows, margin = (pia_index)w->degree * MARGIN;
    g->size = w->size;
    for (int l = 0; l < PIA_LANES; l++) {
        pia_index begin = pia_chunk_begin(rows, w->windows, first + l), low = begin > margin ? begin - margin : 0;
        g->low[l] = low < rows - g->size ? low : rows - g->size;
        g->own[l] = begin - g->low[l];
        g->end[l] = pia_chunk_begin(rows, w->windows, first + l + 1) - g->low[l];
    }
}

/* ---- numbers to lanes and back ---- */

/* array [size x dim] = numbers of the rows less the shift. */
PIA_INLINE void load(const group *g, const double *from, const pia_lanes *shift, int dim, pia_lanes *array)
{
    pia_index i = 0;
    const double *at[PIA_LANES];
    for (int l = 0; l < PIA_LANES; l++) at[l] = from + g->low[l] * dim;
    for (; i + PIA_LANES <= g->size; i += PIA_LANES)
        for (int part = 0; part < dim; part++) {
            pia_index e = i * dim + part * PIA_LANES;
            pia_lanes four[PIA_LANES];
            for (int l = 0; l < PIA_LANES; l++) four[l] = pia_vector_load(at[l] + e);
            pia_lanes_transpose(four);
            for (int k = 0; k < PIA_LANES; k++) array[e + k] = four[k] - shift[(part * PIA_LANES + k) % dim];
        }
    for (pia_index e = i * dim; e < g->size * dim; e++) array[e] = (pia_lanes){at[0][e], at[1][e], at[2][e], at[3][e]} - shift[e % dim];
}

/* Rows that all windows own, but `inside` at both ends. */
static void common_rows(const group *g, int inside, pia_index *from, pia_index *to)
{
    *from = 0;
    *to = g->size;
    for (int l = 0; l < PIA_LANES; l++) {
        if (g->own[l] + inside > *from) *from = g->own[l] + inside;
        if (g->end[l] - inside < *to) *to = g->end[l] - inside;
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
            pia_lanes four[PIA_LANES];
            for (int k = 0; k < PIA_LANES; k++) four[k] = g->x[e + k] + g->shift[(part * PIA_LANES + k) % dim];
            pia_lanes_transpose(four);
            for (int l = 0; l < PIA_LANES; l++) pia_lanes_write(four[l], out + g->low[l] * dim + e);
        }
    for (int l = 0; l < PIA_LANES; l++) {
        store_rows(g, l, g->own[l], from, dim, out);
        store_rows(g, l, i, g->end[l], dim, out);
    }
}

/* x NULL: control points are the targets. Control points count from the origin of the targets. */
PIA_INLINE void load_group(const work *w, group *g, int dim)
{
    const pia_targets *q = w->targets;
    for (int d = 0; d < dim; d++)
        for (int l = 0; l < PIA_LANES; l++) g->shift[d][l] = q->points[g->low[l] * dim + d];
    load(g, q->points, g->shift, dim, g->target);
    for (int d = 0; d < dim; d++) g->shift[d] -= q->origin[d];
    if (w->points != NULL) load(g, w->points, g->shift, dim, g->point);
}

/* ---- the equations ---- */

/* Rows one after the other on spans one after the other, as knots near the parameters have them: nothing has to be searched, and the
 * quotients of the basis need one division a degree. */
typedef struct walk {
    pia_index column[PIA_LANES]; /* of the first row */
    int before, reach;           /* columns of a row before its diagonal, in all lanes; on the wider side */
} walk;

/* Whether the first rows of the lanes are alike. */
static int can_walk(const work *w, const group *g, walk *k)
{
    const pia_collocation *c = w->line;
    int degree = w->degree, at_knots = 1;
    if (c->values != NULL) return 0; /* nothing is to be computed */
    for (int l = 0; l < PIA_LANES; l++) {
        pia_index span = pia_collocation_own_span(c, g->low[l]);
        if (span < 0) return 0;
        k->column[l] = span - degree;
        if (l > 0 && g->low[l] - k->column[l] != k->before) return 0;
        k->before = (int)(g->low[l] - k->column[l]);
        if (k->column[l] + g->size - 1 + 2 * degree > c->full + degree) return 0; /* the last rows share a span */
        at_knots &= c->parameters[g->low[l]] == c->knots[span];                   /* a row at a knot has one function less */
    }
    int after = degree - k->before - at_knots;
    k->reach = k->before > after ? k->before : after;
    if (k->reach < 1) k->reach = 1;
    return 1;
}

/* Returns 0 where a row is not as expected. skip: reach - before. */
PIA_INLINE int fill_walking(const work *w, const group *g, const walk *k, int degree, int skip, int reach)
{
    const double *parameters = w->line->parameters, *knots = w->line->knots + 2 * degree; /* nothing that is written overlaps these */
    pia_lanes knot[2 * PIA_MAX_DEGREE], inverse[PIA_MAX_DEGREE * (PIA_MAX_DEGREE + 1) / 2], value[PIA_MAX_DEGREE + 1];
    pia_lane_masks good = ~(pia_lane_masks){0};
    pia_lanes *entry = g->entry;
    for (int i = 0; i < 2 * degree; i++) knot[i] = pia_lanes_load(w->line->knots + i, k->column);
    pia_lanes_inverses(knot, degree, inverse);
    for (pia_index i = 0; i < g->size; i++, entry += 2 * reach + 1) {
        pia_lanes t = pia_lanes_load(parameters + i, g->low);
        pia_lanes_advance(knot, degree, pia_lanes_load(knots + i, k->column), inverse);
        pia_lanes_quick_basis(knot, inverse, degree, t, value);
        good &= (knot[degree - 1] <= t) & (t < knot[degree]);
        for (int j = 0; j < skip; j++) entry[j] = (pia_lanes){0};
        for (int j = 0; j < degree; j++) entry[skip + j] = value[j];
        for (int j = skip + degree; j < 2 * reach + 1; j++) entry[j] = (pia_lanes){0};
        if (skip + degree <= 2 * reach)
            entry[skip + degree] = value[degree];
        else
            good &= value[degree] == 0;
    }
    return pia_lanes_all(good);
}

/* Rows on any spans, over columns i - degree .. i + degree. Returns the bandwidth, 0 where a row does not reach its diagonal. */
PIA_INLINE int fill_searching(const work *w, const group *g, int degree)
{
    const pia_collocation *c = w->line;
    pia_index row[PIA_LANES], span[PIA_LANES], column[PIA_LANES];
    pia_lanes value[PIA_MAX_DEGREE + 1];
    int width = 2 * degree + 1, reach = 1;
    for (int l = 0; l < PIA_LANES; l++) {
        span[l] = pia_collocation_own_span(c, g->low[l]);
        if (span[l] < 0) return 0;
    }
    for (pia_index i = 0; i < g->size; i++) {
        pia_lanes *entry = g->entry + i * width;
        for (int l = 0; l < PIA_LANES; l++) {
            row[l] = g->low[l] + i;
            span[l] = pia_collocation_advance(c, row[l], span[l]);
            column[l] = span[l] - degree;
        }
        pia_lanes_row(c, row, column, degree, value);
        for (int k = 0; k < width; k++) entry[k] = (pia_lanes){0};
        for (int l = 0; l < PIA_LANES; l++) {
            pia_index before = row[l] - column[l];
            if (before < 0 || before > degree) return 0;
            int after = degree - (int)before - (value[degree][l] == 0);
            reach = before > reach ? (int)before : reach;
            reach = after > reach ? after : reach;
            for (int k = 0; k <= degree; k++) entry[degree - before + k][l] = value[k][l];
        }
    }
    return reach;
}

PIA_CLONES static int fill_alike(const work *w, const group *g, const walk *k)
{
    int skip = k->reach - k->before;
    if (w->degree == 3 && skip == 0 && k->reach == 1) return fill_walking(w, g, k, 3, 0, 1);
    if (w->degree == 3 && skip == 0 && k->reach == 2) return fill_walking(w, g, k, 3, 0, 2);
    if (w->degree == 3 && skip == 1 && k->reach == 2) return fill_walking(w, g, k, 3, 1, 2);
    return fill_walking(w, g, k, w->degree, skip, k->reach);
}

PIA_CLONES static int fill_any(const work *w, const group *g)
{
    return w->degree == 3 ? fill_searching(w, g, 3) : fill_searching(w, g, w->degree);
}

/* Returns 0 where a row does not reach its diagonal. */
static int fill(const work *w, group *g)
{
    walk k;
    g->entry = g->room;
    if (can_walk(w, g, &k) && fill_alike(w, g, &k)) {
        g->reach = k.reach;
        g->stride = 2 * k.reach + 1;
        return 1;
    }
    g->reach = fill_any(w, g);
    g->stride = 2 * w->degree + 1;
    g->entry += w->degree - g->reach;
    return g->reach > 0;
}

/* ---- the solve ---- */

/* difference = target - A point of row i. Returns its square. */
PIA_INLINE pia_lanes subtract_product(const group *g, const pia_lanes *row, const pia_lanes *point, pia_index i, int reach, int dim,
                                      pia_lanes *difference)
{
    pia_lanes square = {0};
    for (int d = 0; d < dim; d++) {
        const pia_lanes *p = point + (i - reach) * dim + d;
        pia_lanes sum = row[0] * p[0];
        for (int k = 1; k <= 2 * reach; k++) sum += row[k] * p[k * dim];
        difference[d] = g->target[i * dim + d] - sum;
        square += difference[d] * difference[d];
    }
    return square;
}

/* x = residual and its squares; Crout's elimination as in band_lu.c. Returns 0 where a pivot vanishes. The group is copied, because
 * what is written could overlap it as far as the compiler knows. */
PIA_INLINE int go_down(const group *all, int degree, int reach, int dim)
{
    const group here = *all, *g = &here;
    pia_lanes upper[PIA_MAX_DEGREE * PIA_MAX_DEGREE] = {{0}}, above[PIA_MAX_DEGREE * PIA_MAX_DIM] = {{0}};
    pia_lane_masks good = ~(pia_lane_masks){0};
    double tolerance = 4 * DBL_EPSILON * (degree + 1);
    for (pia_index i = 0; i < g->size; i++) {
        pia_lanes row[2 * PIA_MAX_DEGREE + 1], x[PIA_MAX_DIM], u[PIA_MAX_DEGREE];
        for (int j = 0; j <= 2 * reach; j++) row[j] = g->entry[i * g->stride + j];
        g->square[i] = subtract_product(g, row, g->point, i, reach, dim, x);
        pia_lanes least = row[reach] * tolerance + DBL_MIN;
        for (int r = reach; r >= 1; r--) {
            pia_lanes factor = row[reach - r];
            for (int j = 0; j < reach; j++) row[reach - r + 1 + j] -= factor * upper[(r - 1) * reach + j];
            for (int d = 0; d < dim; d++) x[d] -= factor * above[(r - 1) * dim + d];
        }
        good &= row[reach] > least;
        pia_lanes inverse = 1 / row[reach];
        for (int j = 0; j < reach; j++) g->upper[i * reach + j] = u[j] = row[reach + 1 + j] * inverse;
        for (int d = 0; d < dim; d++) g->x[i * dim + d] = x[d] *= inverse;
        pia_lanes_remember(upper, reach, reach, u);
        pia_lanes_remember(above, reach, dim, x);
    }
    return pia_lanes_all(good);
}

/* x: the correction and its squares. */
PIA_INLINE void go_up(const group *all, int reach, int dim)
{
    const group here = *all, *g = &here;
    pia_lanes below[PIA_MAX_DEGREE * PIA_MAX_DIM] = {{0}};
    for (pia_index i = g->size - 1; i >= 0; i--) {
        pia_lanes x[PIA_MAX_DIM], square = {0};
        for (int d = 0; d < dim; d++) x[d] = g->x[i * dim + d];
        for (int r = reach; r >= 1; r--)
            for (int d = 0; d < dim; d++) x[d] -= g->upper[i * reach + r - 1] * below[(r - 1) * dim + d];
        pia_lanes_remember(below, reach, dim, x);
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
    pia_lanes difference[PIA_MAX_DIM];
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

static pia_index first_row(const group *g, int lane, pia_index from, double square)
{
    while (g->square[from][lane] != square) from++;
    return from;
}

/* Joins the squares of each window's own rows, but `inside` at both ends. */
PIA_INLINE void count_squares(const group *g, int inside, pia_errors *errors)
{
    pia_index from, to;
    pia_lanes sums = {0}, most = {0};
    common_rows(g, inside, &from, &to);
    for (pia_index i = from; i < to; i++) {
        sums += g->square[i];
        most = pia_lanes_choose(g->square[i] > most, g->square[i], most);
    }
    for (int l = 0; l < PIA_LANES; l++) {
        pia_index own = g->own[l] + inside, end = g->end[l] - inside;
        pia_errors lane = {.sum_squares = sums[l], .count = end - own, .max_row = -1};
        double worst = most[l];
        count_rows(g, l, own, from, &lane.sum_squares, &worst);
        count_rows(g, l, to, end, &lane.sum_squares, &worst);
        lane.weighted = lane.sum_squares;
        lane.max = sqrt(worst);
        if (lane.max > errors->max || errors->max_row < 0) lane.max_row = g->low[l] + first_row(g, l, own, worst);
        *errors = pia_errors_join(*errors, lane);
    }
}

PIA_INLINE int solve_rows(const work *w, group *g, pia_step_errors *errors, int reach, int dim)
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

PIA_INLINE int solve_dim(const work *w, group *g, pia_step_errors *errors, int reach)
{
    switch (w->dim) {
    case 1: return solve_rows(w, g, errors, reach, 1);
    case 2: return solve_rows(w, g, errors, reach, 2);
    case 3: return solve_rows(w, g, errors, reach, 3);
    default: return solve_rows(w, g, errors, reach, w->dim);
    }
}

/* The cubic is what nearly everybody fits: one or two neighbours on either side. */
PIA_CLONES static int solve_any(const work *w, group *g, pia_step_errors *errors)
{
    if (g->reach == 1) return solve_dim(w, g, errors, 1);
    if (g->reach == 2) return solve_dim(w, g, errors, 2);
    return solve_rows(w, g, errors, g->reach, w->dim);
}

PIA_CLONES static void load_any(const work *w, group *g)
{
    if (w->dim == 3)
        load_group(w, g, 3);
    else
        load_group(w, g, w->dim);
}

static int solve_group(const work *w, group *g, pia_step_errors *errors)
{
    load_any(w, g);
    return fill(w, g) && solve_any(w, g, errors);
}

static void solve_chunk(void *argument, pia_index chunk)
{
    work *w = argument;
    pia_index groups = w->windows / PIA_LANES;
    pia_step_errors errors = {.before.max_row = -1, .after.max_row = -1};
    int good = 1;
    for (pia_index i = pia_chunk_begin(groups, w->chunks, chunk); good && i < pia_chunk_begin(groups, w->chunks, chunk + 1); i++) {
        place_windows(w, i * PIA_LANES, &w->group[chunk]);
        good = solve_group(w, &w->group[chunk], &errors);
    }
    w->errors[chunk] = errors;
    w->failed[chunk] = !good;
}

/* Rows at the seams between windows, and at both ends. */
static pia_errors seam_errors(const work *w)
{
    pia_errors all = {.max_row = -1};
    for (pia_index k = 0; k <= w->windows; k++) {
        pia_index seam = pia_chunk_begin(w->line->rows, w->windows, k);
        pia_index from = k > 0 ? seam - w->degree : 0, to = k < w->windows ? seam + w->degree : seam;
        all = pia_errors_join(all, pia_op_curve_errors(w->op, w->next, w->targets, from, to));
    }
    return all;
}

/* ---- memory ---- */

/* The next `rows` rows of `width` numbers of a block, `degree` rows of zeros around them. */
static pia_lanes *padded(pia_lanes **block, pia_index rows, pia_index width, pia_index degree)
{
    pia_lanes *first = *block + degree * width;
    memset(*block, 0, (size_t)(degree * width) * sizeof(pia_lanes));
    memset(first + rows * width, 0, (size_t)(degree * width) * sizeof(pia_lanes));
    *block = first + (rows + degree) * width;
    return first;
}

static pia_index group_room(const work *w)
{
    pia_index degree = w->degree, dim = w->dim;
    return w->size * (2 * degree + 2) + (w->size + 2 * degree) * (degree + 3 * dim);
}

static void open_group(const work *w, pia_lanes *block, group *g)
{
    pia_index degree = w->degree, dim = w->dim;
    g->square = padded(&block, w->size, 1, 0);
    g->room = padded(&block, w->size, 2 * degree + 1, 0);
    g->upper = padded(&block, w->size, degree, degree);
    g->target = padded(&block, w->size, dim, degree);
    g->point = w->points != NULL ? padded(&block, w->size, dim, degree) : g->target;
    g->x = padded(&block, w->size, dim, degree);
}

static void join_chunks(const work *w, pia_step_errors *out)
{
    *out = w->errors[0];
    for (pia_index c = 1; c < w->chunks; c++) {
        out->before = pia_errors_join(out->before, w->errors[c].before);
        out->after = pia_errors_join(out->after, w->errors[c].after);
        out->moved = fmax(out->moved, w->errors[c].moved);
    }
    out->after = pia_errors_join(out->after, seam_errors(w));
}

pia_status pia_windows_step(const pia_op *op, const double *x, const pia_targets *targets, double *next, pia_step_errors *out,
                            int *done)
{
    pia_context *context = op->context;
    const pia_collocation *line = op->line[0];
    pia_index windows = window_count(op->rows), groups = windows / PIA_LANES;
    pia_step_errors errors[MAX_CHUNKS];
    group of_chunk[MAX_CHUNKS];
    int failed[MAX_CHUNKS];
    work w = {op, line, targets, x, next, line->degree, targets->dim, windows, 0, 0, of_chunk, errors, failed};
    w.size = op->rows / windows + 1 + 2 * (pia_index)line->degree * MARGIN;
    w.chunks = groups < MAX_CHUNKS ? groups : MAX_CHUNKS;
    pia_index room = group_room(&w);
    pia_lanes *block = pia_take(context, w.chunks * room, sizeof *block);
    *done = 0;
    if (block == NULL) return pia_take_status(context, w.chunks * room, sizeof *block);
    for (pia_index c = 0; c < w.chunks; c++) open_group(&w, block + c * room, &of_chunk[c]);
    pia_for_each(context, w.chunks, solve_chunk, &w);
    *done = 1;
    for (pia_index c = 0; c < w.chunks; c++) *done &= !failed[c];
    if (*done) join_chunks(&w, out);
    pia_give(context, block);
    return PIA_OK;
}
