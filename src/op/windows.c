/* Windows go eight at a time through all of their work, so that the points are read from memory once and the result is written once. */
#include "windows.h"

#include "clones.h"
#include "kernel.h"
#include "op_curve.h"
#include "rooms.h"
#include "vector.h"
#include "windows_group.h"

#include <math.h>

enum { LENGTH = 512, MAX_CHUNKS = 64, MARGIN = 12 /* rows a degree */, UNIT = PIA_WINDOW_GROUP * sizeof(double) };

typedef struct work {
    pia_windows windows;
    const pia_op *op;
    pia_windows_solver *solve;
    pia_index chunks;
    pia_step_errors *errors; /* [chunks] */
    pia_survey *survey;      /* [chunks]; NULL: unwanted */
    int *failed;             /* [chunks] */
    pia_rooms *rooms;
} work;

static pia_index window_count(pia_index rows)
{
    return rows / LENGTH / PIA_WINDOW_GROUP * PIA_WINDOW_GROUP;
}

int pia_windows_suit_rows(pia_index rows, int degree)
{
    return degree * MARGIN <= LENGTH && window_count(rows) > 0;
}

int pia_windows_suit(const pia_op *op)
{
    return op->directions == 1 && op->identity && op->frozen == NULL && op->rows == op->cols &&
           pia_windows_suit_rows(op->rows, op->line[0]->degree);
}

pia_index pia_windows_room(const pia_windows *w)
{
    pia_index degree = w->degree, dim = w->dim;
    return (w->size * (2 * degree + 2) + (w->size + 2 * degree) * (degree + 3 * dim)) * UNIT;
}

/* Up to whole vectors. */
static pia_index whole(pia_index rows)
{
    return (rows + PIA_LANES - 1) / PIA_LANES * PIA_LANES;
}

static pia_window_group place(const pia_windows *w, pia_index first)
{
    pia_window_group g;
    pia_index rows = w->line->rows, margin = (pia_index)w->degree * MARGIN;
    for (int l = 0; l < PIA_WINDOW_GROUP; l++) {
        pia_index begin = pia_chunk_begin(rows, w->count, first + l), low = begin > margin ? begin - margin : 0;
        g.low[l] = low < rows - w->size ? low : rows - w->size;
        g.own[l] = begin - g.low[l];
        g.end[l] = pia_chunk_begin(rows, w->count, first + l + 1) - g.low[l];
    }
    return g;
}

/* ---- rows on spans one after the other, as knots near the parameters have them ---- */

/* Each parameter on a span of its own, and not below the one before; *at_knots: at its left end. */
PIA_CLONES static int one_a_span(const double *t, const double *knot, pia_index rows, int *at_knots)
{
    int all = 1, at = 1;
    for (pia_index i = 0; i < rows; i++) {
        all &= (knot[i] <= t[i]) & (t[i] < knot[i + 1]);
        at &= knot[i] == t[i];
    }
    *at_knots &= at;
    return all;
}

static int walks(const pia_windows *w, pia_window_group *g)
{
    const pia_collocation *c = w->line;
    int degree = w->degree, at_knots = 1; /* a row at a knot has one function less */
    if (c->values != NULL) return 0;      /* nothing is to be computed */
    for (int l = 0; l < PIA_WINDOW_GROUP; l++) {
        pia_index span = pia_collocation_own_span(c, g->low[l]);
        if (span < 0) return 0;
        g->column[l] = span - degree;
        if (l > 0 && g->low[l] - g->column[l] != g->before) return 0;
        g->before = (int)(g->low[l] - g->column[l]);
        if (g->column[l] + w->size - 1 + 2 * degree > c->full + degree) return 0; /* the last rows share a span */
        if (!one_a_span(c->parameters + g->low[l], c->knots + span, w->size, &at_knots)) return 0;
    }
    int after = degree - g->before - at_knots;
    g->reach = g->before > after ? g->before : after;
    if (g->reach < 1) g->reach = 1;
    return 1;
}

/* ---- rows that see control points of two windows ---- */

/* Rows at the seam before a window; number 0 and the one after the last window are the ends. */
static pia_errors seam_errors(const work *w, pia_index window)
{
    const pia_windows *all = &w->windows;
    pia_index seam = pia_chunk_begin(all->line->rows, all->count, window);
    pia_index from = window > 0 ? seam - all->degree : 0, to = window < all->count ? seam + all->degree : seam;
    return pia_op_curve_errors(w->op, all->next, all->targets, from, to);
}

static pia_index first_window(const work *w, pia_index chunk)
{
    return pia_chunk_begin(w->windows.count / PIA_WINDOW_GROUP, w->chunks, chunk) * PIA_WINDOW_GROUP;
}

/* ---- chunks ---- */

static void look_at(const pia_windows *w, const pia_window_group *g, pia_box *box)
{
    const int last = PIA_WINDOW_GROUP - 1;
    pia_index begin = g->low[0] + g->own[0], end = g->low[last] + g->end[last];
    pia_box_add(box, w->targets->points + begin * w->dim, end - begin);
}

/* Parameters that did not rise have ended the solve. */
static pia_survey seen_in(const pia_box *box)
{
    pia_survey survey = {.ordered = 1};
    survey.finite = pia_box_close(box, survey.low, survey.high);
    return survey;
}

/* Windows first .. end - 1. */
static int solve_windows(const work *w, pia_index first, pia_index end, pia_box *box, void *room, pia_step_errors *errors)
{
    for (pia_index at = first; at < end; at += PIA_WINDOW_GROUP) {
        pia_window_group g = place(&w->windows, at);
        if (w->survey != NULL) look_at(&w->windows, &g, box);
        g.walks = walks(&w->windows, &g);
        if (!w->solve(&w->windows, &g, room, errors)) return 0;
        for (pia_index k = at > first ? at : at + 1; k < at + PIA_WINDOW_GROUP; k++)
            errors->after = pia_errors_join(errors->after, seam_errors(w, k));
    }
    return 1;
}

static void solve_chunk(void *argument, pia_index chunk)
{
    const work *w = argument;
    pia_index first = first_window(w, chunk), end = first_window(w, chunk + 1);
    void *room = pia_rooms_take(w->rooms);
    pia_step_errors errors = {.before.max_row = -1, .after.max_row = -1};
    pia_box box;
    pia_box_open(w->windows.dim, &box);
    w->failed[chunk] = !solve_windows(w, first, end, &box, room, &errors);
    w->errors[chunk] = errors;
    if (w->survey != NULL) w->survey[chunk] = seen_in(&box);
    pia_rooms_leave(w->rooms, room);
}

static void join_errors(const work *w, pia_step_errors *out)
{
    *out = w->errors[0];
    for (pia_index c = 1; c < w->chunks; c++) {
        out->before = pia_errors_join(out->before, w->errors[c].before);
        out->after = pia_errors_join(out->after, w->errors[c].after);
        out->moved = fmax(out->moved, w->errors[c].moved);
    }
    for (pia_index c = 0; c <= w->chunks; c++) out->after = pia_errors_join(out->after, seam_errors(w, first_window(w, c)));
}

static void join_surveys(const work *w, pia_survey *out)
{
    *out = w->survey[0];
    for (pia_index c = 1; c < w->chunks; c++) *out = pia_survey_join(out, &w->survey[c], w->windows.dim);
}

pia_status pia_windows_step_with(pia_windows_solver *solve, const pia_op *op, const double *x, const pia_targets *targets, double *next,
                                 pia_survey *survey, pia_step_errors *out, int *done)
{
    const pia_collocation *line = op->line[0];
    pia_index count = window_count(op->rows), groups = count / PIA_WINDOW_GROUP;
    pia_step_errors errors[MAX_CHUNKS];
    pia_survey seen[MAX_CHUNKS];
    pia_rooms rooms;
    int failed[MAX_CHUNKS];
    work w = {{line, targets, x, next, line->degree, targets->dim, count, 0}, op, solve, 0, errors, NULL, failed, &rooms};
    w.windows.size = whole(op->rows / count + 1 + 2 * (pia_index)line->degree * MARGIN);
    w.chunks = groups < MAX_CHUNKS ? groups : MAX_CHUNKS;
    if (survey != NULL) w.survey = seen;
    *done = 0;
    pia_status status = pia_rooms_open(op->context, w.chunks, pia_windows_room(&w.windows), &rooms);
    if (status != PIA_OK) return status;
    pia_for_each(op->context, w.chunks, solve_chunk, &w);
    *done = 1;
    for (pia_index c = 0; c < w.chunks; c++) *done &= !failed[c];
    if (*done) join_errors(&w, out);
    if (*done && survey != NULL) join_surveys(&w, survey);
    pia_rooms_close(op->context, &rooms);
    return PIA_OK;
}

pia_status pia_windows_step(const pia_op *op, const double *x, const pia_targets *targets, double *next, pia_survey *survey,
                            pia_step_errors *out, int *done)
{
    pia_windows_solver *best = pia_has_wide() ? pia_windows_solve_by_eight : pia_windows_solve_by_four;
    return pia_windows_step_with(best, op, x, targets, next, survey, out, done);
}
