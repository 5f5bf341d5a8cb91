/* Windows are taken as many at a time as a vector has lanes: one lane each, so that all arithmetic is of vectors and the divisions of
 * several eliminations overlap. What a window needs stays in the second-level cache, from its basis values to its errors. */
#include "windows.h"

#include "kernel.h"
#include "lanes.h"
#include "op_curve.h"

#include <float.h>
#include <math.h>
#include <string.h>

enum { LENGTH = 1024, LEAST_WINDOWS = 8, MAX_CHUNKS = 16, MARGIN = 12 /* rows a degree */ };

/* Equations low .. low + size - 1 of a group of windows, lane by lane. Arrays over rows have `degree` more of zeros on both sides. */
typedef struct system {
    pia_index size, low[PIA_LANES], own[PIA_LANES], end[PIA_LANES]; /* the window's own rows, from low */
    int reach;                                                      /* bandwidth on the wider side of the diagonal */
    pia_lanes *entry;                                               /* [size x (2 degree + 1)] row i over columns i - degree .. */
    pia_lanes *upper;                                               /* [size x degree] */
    pia_lanes *target, *point, *x;                                  /* [size x dim]; x: residual, correction, new control points */
    pia_lanes *square;                                              /* [size] squared lengths */
    pia_lanes *block;
} system;

typedef struct work {
    const pia_op *op;
    const pia_collocation *line;
    const pia_targets *targets;
    const double *points;
    double *next;
    int degree, dim;
    pia_index windows, size, chunks;
    system *system;          /* [chunks] */
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

/* ---- the equations of a group of windows ---- */

static void place_windows(const work *w, pia_index first, system *s)
{
    pia_index rows = w->line->rows, margin = (pia_index)w->degree * MARGIN;
    s->size = w->size;
    for (int l = 0; l < PIA_LANES; l++) {
        pia_index begin = pia_chunk_begin(rows, w->windows, first + l), low = begin > margin ? begin - margin : 0;
        s->low[l] = low < rows - s->size ? low : rows - s->size;
        s->own[l] = begin - s->low[l];
        s->end[l] = pia_chunk_begin(rows, w->windows, first + l + 1) - s->low[l];
    }
}

/* Returns 0 where a row does not reach its diagonal. */
PIA_INLINE int fill_entries(const work *w, system *s, int degree)
{
    const pia_collocation *c = w->line;
    pia_index row[PIA_LANES], span[PIA_LANES], column[PIA_LANES];
    pia_lanes value[PIA_MAX_DEGREE + 1];
    int width = 2 * degree + 1, reach = 1;
    for (int l = 0; l < PIA_LANES; l++) span[l] = pia_collocation_span(c, s->low[l]);
    for (pia_index i = 0; i < s->size; i++) {
        pia_lanes *entry = s->entry + i * width;
        for (int l = 0; l < PIA_LANES; l++) {
            row[l] = s->low[l] + i;
            span[l] = pia_collocation_advance(c, row[l], span[l]);
            column[l] = span[l] - degree;
        }
        pia_lanes_row(c, row, column, degree, value);
        for (int k = 0; k < width; k++) entry[k] = (pia_lanes){0};
        for (int l = 0; l < PIA_LANES; l++) {
            pia_index before = row[l] - column[l];
            if (before < 0 || before > degree) return 0;
            int after = degree - (int)before - (value[degree][l] == 0); /* a parameter at a knot has one function less */
            reach = before > reach ? (int)before : reach;
            reach = after > reach ? after : reach;
            for (int k = 0; k <= degree; k++) entry[degree - before + k][l] = value[k][l];
        }
    }
    s->reach = reach;
    return 1;
}

/* array [size x dim] = numbers of the rows minus origin; NULL origin: 0. */
PIA_INLINE void load(const system *s, const double *from, const double *origin, int dim, pia_lanes *array)
{
    for (pia_index i = 0; i < s->size; i++) {
        pia_index at[PIA_LANES];
        for (int l = 0; l < PIA_LANES; l++) at[l] = (s->low[l] + i) * dim;
        for (int d = 0; d < dim; d++) array[i * dim + d] = pia_lanes_load(from + d, at) - (origin != NULL ? origin[d] : 0);
    }
}

/* difference = target - A point, and its squared lengths; difference NULL: only these. */
PIA_INLINE void subtract_product(const system *s, const pia_lanes *point, int degree, int reach, int dim, pia_lanes *difference)
{
    for (pia_index i = 0; i < s->size; i++) {
        const pia_lanes *entry = s->entry + i * (2 * degree + 1) + degree - reach;
        pia_lanes square = {0};
        for (int d = 0; d < dim; d++) {
            const pia_lanes *p = point + (i - reach) * dim + d;
            pia_lanes sum = entry[0] * p[0];
            for (int k = 1; k <= 2 * reach; k++) sum += entry[k] * p[k * dim];
            sum = s->target[i * dim + d] - sum;
            square += sum * sum;
            if (difference != NULL) difference[i * dim + d] = sum;
        }
        s->square[i] = square;
    }
}

/* Crout's elimination as in band_lu.c; rows before the first and after the last are zero. Returns 0 where a pivot vanishes. */
PIA_INLINE int eliminate(system *s, int degree, int reach, int dim)
{
    pia_lane_masks good = ~(pia_lane_masks){0};
    double tolerance = 4 * DBL_EPSILON * (degree + 1);
    for (pia_index i = 0; i < s->size; i++) {
        const pia_lanes *entry = s->entry + i * (2 * degree + 1) + degree - reach;
        pia_lanes row[2 * PIA_MAX_DEGREE + 1], *u = s->upper + i * degree, *x = s->x + i * dim;
        for (int k = 0; k <= 2 * reach; k++) row[k] = entry[k];
        pia_lanes least = row[reach] * tolerance + DBL_MIN;
        for (int r = reach; r >= 1; r--) {
            pia_lanes factor = row[reach - r];
            for (int k = 0; k < reach; k++) row[reach - r + 1 + k] -= factor * u[k - r * degree];
            for (int d = 0; d < dim; d++) x[d] -= factor * x[d - r * dim];
        }
        good &= row[reach] > least;
        pia_lanes inverse = 1 / row[reach];
        for (int k = 0; k < reach; k++) u[k] = row[reach + 1 + k] * inverse;
        for (int d = 0; d < dim; d++) x[d] *= inverse;
    }
    for (pia_index i = s->size - 1; i >= 0; i--) {
        const pia_lanes *u = s->upper + i * degree;
        for (int r = reach; r >= 1; r--)
            for (int d = 0; d < dim; d++) s->x[i * dim + d] -= u[r - 1] * s->x[(i + r) * dim + d];
    }
    int all = 1;
    for (int l = 0; l < PIA_LANES; l++) all &= good[l] != 0;
    return all;
}

/* ---- what comes out ---- */

/* Of squared lengths of rows from .. to - 1 of a lane. */
static pia_errors lane_errors(const system *s, int lane, pia_index from, pia_index to)
{
    pia_errors e = {.count = to - from, .max_row = -1};
    double worst = -1;
    for (pia_index i = from; i < to; i++) {
        double square = s->square[i][lane];
        e.sum_squares += square;
        if (square > worst) {
            worst = square;
            e.max_row = s->low[lane] + i;
        }
    }
    e.weighted = e.sum_squares;
    e.max = worst > 0 ? sqrt(worst) : 0;
    return e;
}

/* x := point + x; its own rows are the window's share of the result. */
PIA_INLINE void add_correction(const work *w, system *s, int dim)
{
    for (pia_index i = 0; i < s->size; i++) {
        pia_lanes square = {0};
        for (int d = 0; d < dim; d++) {
            pia_lanes *x = &s->x[i * dim + d];
            square += *x * *x;
            *x += s->point[i * dim + d];
        }
        s->square[i] = square;
    }
    for (int l = 0; l < PIA_LANES; l++)
        for (pia_index i = s->own[l] * dim; i < s->end[l] * dim; i++) w->next[s->low[l] * dim + i] = s->x[i][l];
}

PIA_INLINE int solve_group_of(const work *w, system *s, pia_step_errors *errors, int degree, int reach, int dim)
{
    subtract_product(s, s->point, degree, reach, dim, s->x);
    for (int l = 0; l < PIA_LANES; l++) errors->before = pia_errors_join(errors->before, lane_errors(s, l, s->own[l], s->end[l]));
    if (!eliminate(s, degree, reach, dim)) return 0;
    add_correction(w, s, dim);
    for (int l = 0; l < PIA_LANES; l++) errors->moved = fmax(errors->moved, lane_errors(s, l, s->own[l], s->end[l]).max);
    subtract_product(s, s->x, degree, reach, dim, NULL);
    for (int l = 0; l < PIA_LANES; l++) /* rows that see control points of the next window come later */
        errors->after = pia_errors_join(errors->after, lane_errors(s, l, s->own[l] + degree, s->end[l] - degree));
    return 1;
}

PIA_INLINE int solve_group_of_dim(const work *w, system *s, pia_step_errors *errors, int degree, int reach)
{
    switch (w->dim) {
    case 1: return solve_group_of(w, s, errors, degree, reach, 1);
    case 2: return solve_group_of(w, s, errors, degree, reach, 2);
    case 3: return solve_group_of(w, s, errors, degree, reach, 3);
    default: return solve_group_of(w, s, errors, degree, reach, w->dim);
    }
}

PIA_CLONES static int solve_group(const work *w, system *s, pia_step_errors *errors)
{
    int degree = w->degree;
    if (degree == 3) {
        if (!fill_entries(w, s, 3)) return 0;
    } else if (!fill_entries(w, s, degree)) {
        return 0;
    }
    if (w->dim == 3)
        load(s, w->targets->points, w->targets->origin, 3, s->target);
    else
        load(s, w->targets->points, w->targets->origin, w->dim, s->target);
    if (w->points != NULL) load(s, w->points, NULL, w->dim, s->point);
    if (degree == 3 && s->reach == 1) return solve_group_of_dim(w, s, errors, 3, 1);
    if (degree == 3 && s->reach == 2) return solve_group_of_dim(w, s, errors, 3, 2);
    return solve_group_of_dim(w, s, errors, degree, s->reach);
}

static void solve_chunk(void *argument, pia_index chunk)
{
    work *w = argument;
    pia_index groups = w->windows / PIA_LANES;
    pia_step_errors errors = {.before.max_row = -1, .after.max_row = -1};
    int good = 1;
    for (pia_index i = pia_chunk_begin(groups, w->chunks, chunk); good && i < pia_chunk_begin(groups, w->chunks, chunk + 1); i++) {
        place_windows(w, i * PIA_LANES, &w->system[chunk]);
        good = solve_group(w, &w->system[chunk], &errors);
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

static pia_status open_system(const work *w, system *s)
{
    pia_index degree = w->degree, dim = w->dim, size = w->size;
    pia_index room = size * (2 * degree + 2) + (size + 2 * degree) * (degree + 3 * dim);
    pia_lanes *block = pia_take(w->op->context, room, sizeof(pia_lanes));
    s->block = block;
    if (block == NULL) return PIA_E_MEMORY;
    s->entry = padded(&block, size, 2 * degree + 1, 0);
    s->upper = padded(&block, size, degree, degree);
    s->target = padded(&block, size, dim, degree);
    s->point = w->points != NULL ? padded(&block, size, dim, degree) : s->target;
    s->x = padded(&block, size, dim, degree);
    s->square = padded(&block, size, 1, 0);
    return PIA_OK;
}

static void close_work(work *w)
{
    pia_context *context = w->op->context;
    for (pia_index c = 0; w->system != NULL && c < w->chunks; c++) pia_give(context, w->system[c].block);
    pia_give(context, w->system);
    pia_give(context, w->errors);
    pia_give(context, w->failed);
}

static pia_status open_work(work *w)
{
    pia_context *context = w->op->context;
    w->system = pia_take_zero(context, w->chunks, sizeof *w->system);
    w->errors = pia_take(context, w->chunks, sizeof *w->errors);
    w->failed = pia_take(context, w->chunks, sizeof *w->failed);
    pia_status status = w->system != NULL && w->errors != NULL && w->failed != NULL ? PIA_OK : PIA_E_MEMORY;
    for (pia_index c = 0; c < w->chunks && status == PIA_OK; c++) status = open_system(w, &w->system[c]);
    return status;
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
    const pia_collocation *line = op->line[0];
    pia_index windows = window_count(op->rows), groups = windows / PIA_LANES;
    work w = {.op = op, .line = line, .targets = targets, .points = x, .next = next, .degree = line->degree, .dim = targets->dim};
    w.windows = windows;
    w.size = op->rows / windows + 1 + 2 * (pia_index)line->degree * MARGIN;
    w.chunks = groups < MAX_CHUNKS ? groups : MAX_CHUNKS;
    pia_status status = open_work(&w);
    *done = 0;
    if (status == PIA_OK) {
        pia_for_each(op->context, w.chunks, solve_chunk, &w);
        *done = 1;
        for (pia_index c = 0; c < w.chunks; c++) *done &= !w.failed[c];
        if (*done) join_chunks(&w, out);
    }
    close_work(&w);
    return status;
}
