/* A = A_u (x) A_v. Blocks of lines are solved along v, then panels of columns along u. */
#include "square_grid.h"

#include "band.h"
#include "equations.h"
#include "kernel.h"
#include "rooms.h"
#include "square_grid_parts.h"

#include <math.h>
#include <string.h>

enum {
    UNIT = PIA_GRID_UNIT,
    MAX_CHUNKS = 64,
    PANEL = 128 /* numbers */,
    MOST = 16384 /* rows of a block */,
    LEAST_CLOSED = 16 /* rows of a closed direction, more than twice its degree in any case */,
    MARGIN = 12 /* rows a degree */
};

typedef struct work {
    const pia_grid_solver *solver;
    const pia_square_grid *grid;
    pia_index chunks;
    pia_rooms *rooms;
    pia_survey *survey;      /* [chunks] of the lines; NULL: unwanted */
    pia_step_errors *errors; /* [chunks] of the panels */
} work;

static pia_index units(pia_index count)
{
    return (count + UNIT - 1) / UNIT * UNIT;
}

/* ---- the two directions ---- */

static void close_side(pia_context *context, pia_grid_side *a)
{
    pia_give(context, a->entry);
    pia_give(context, a->narrow_entry);
    if (a->factor != NULL) pia_give(context, a->factor - a->margin * (a->lower + 1 + a->upper));
    if (a->narrow_factor != NULL) pia_give(context, a->narrow_factor - a->margin);
}

/* Whether what lies more than one place from the diagonal is zero. */
static unsigned char is_narrow(const double *row, int lower, int upper)
{
    unsigned char narrow = 1;
    for (int k = -lower; k <= upper; k++) narrow &= (k >= -1 && k <= 1) || row[lower + k] == 0;
    return narrow;
}

/* Where the first entry of an equation lies from its diagonal; that of a closed direction may wrap around. */
static pia_index first_place(const pia_equations *e, pia_index i, int closed)
{
    pia_index place = e->first[i] - i;
    if (!closed) return place;
    return place > e->n / 2 ? place - e->n : place < -e->n / 2 ? place + e->n : place;
}

static void fill_entries(const pia_equations *e, pia_grid_side *a)
{
    for (pia_index i = 0; i < e->n; i++) {
        double *row = a->entry + i * (a->lower + 1 + a->upper);
        for (int k = -a->lower; k <= a->upper; k++) {
            pia_index from = k - first_place(e, i, a->margin > 0);
            row[a->lower + k] = from >= 0 && from < e->width ? e->entry[i * e->width + from] : 0;
        }
        a->narrow_entry[i] = is_narrow(row, a->lower, a->upper);
    }
}

static void fill_factors(const pia_band_lu *lu, pia_grid_side *a)
{
    for (pia_index i = -a->margin; i < a->n + a->margin; i++) {
        double *row = a->factor + i * (a->lower + 1 + a->upper);
        const double *from = lu->entry + (i + a->margin) * (lu->lower + 1 + lu->upper) + lu->lower;
        for (int k = -a->lower; k <= a->upper; k++) row[a->lower + k] = k >= -lu->lower && k <= lu->upper ? from[k] : 0;
        row[a->lower] = 1 / row[a->lower];
        a->narrow_factor[i] = is_narrow(row, a->lower, a->upper);
    }
}

static pia_status take_side(pia_context *context, const pia_equations *e, const pia_band_lu *lu, pia_grid_side *a)
{
    a->n = e->n;
    a->lower = lu->lower > 1 ? lu->lower : 1;
    a->upper = lu->upper > 1 ? lu->upper : 1;
    pia_index rows = e->n + 2 * a->margin, width = a->lower + 1 + a->upper;
    a->entry = pia_take(context, e->n * width, sizeof *a->entry);
    a->narrow_entry = pia_take(context, e->n, 1);
    a->factor = pia_take(context, rows * width, sizeof *a->factor);
    if (a->factor != NULL) a->factor += a->margin * width;
    a->narrow_factor = pia_take(context, rows, 1);
    if (a->narrow_factor != NULL) a->narrow_factor += a->margin;
    if (a->entry == NULL || a->narrow_entry == NULL || a->factor == NULL || a->narrow_factor == NULL) return PIA_E_MEMORY;
    fill_entries(e, a);
    fill_factors(lu, a);
    return PIA_OK;
}

/* The equations of a closed direction cut open, with margins; what reaches past them is left out. */
static pia_status cut_open(pia_context *context, const pia_equations *e, pia_index margin, pia_equations *out)
{
    *out = (pia_equations){.n = e->n + 2 * margin, .width = e->width};
    out->first = pia_take(context, out->n, sizeof *out->first);
    out->entry = pia_take(context, out->n, (size_t)e->width * sizeof *out->entry);
    if (out->first == NULL || out->entry == NULL) return PIA_E_MEMORY;
    for (pia_index i = 0; i < out->n; i++) {
        pia_index row = (i - margin % e->n + e->n) % e->n, wanted = i + first_place(e, row, 1), most = out->n - e->width;
        out->first[i] = wanted < 0 ? 0 : wanted > most ? most : wanted;
        for (int k = 0; k < e->width; k++) {
            pia_index from = out->first[i] + k - wanted;
            out->entry[i * e->width + k] = from >= 0 && from < e->width ? e->entry[row * e->width + from] : 0;
        }
    }
    return PIA_OK;
}

static pia_status open_side(pia_context *context, const pia_collocation *c, pia_grid_side *out)
{
    pia_equations e, cut = {0};
    pia_band_lu lu;
    pia_status status = pia_equations_open(context, c, NULL, &e);
    if (status != PIA_OK) return status;
    if (c->map == PIA_MAP_CYCLIC) {
        out->margin = units(MARGIN * (pia_index)c->degree);
        status = cut_open(context, &e, out->margin, &cut);
    }
    const pia_equations *open = c->map == PIA_MAP_CYCLIC ? &cut : &e;
    if (status == PIA_OK) status = pia_band_lu_factor(context, open->entry, open->first, open->n, open->width, &lu);
    if (status == PIA_OK) {
        status = take_side(context, &e, &lu, out);
        pia_band_lu_clear(context, &lu);
    }
    pia_equations_clear(context, &cut);
    pia_equations_clear(context, &e);
    return status;
}

/* ---- what panels look up ---- */

static void fill_across(const pia_square_grid *g, double *across)
{
    const pia_grid_side *v = g->v;
    pia_index length = g->panels * g->width;
    int bands = v->lower + 1 + v->upper;
    for (int k = 0; k < bands; k++)
        for (pia_index c = 0; c < length; c++) across[k * length + c] = c < v->n * g->dim ? v->entry[c / g->dim * bands + k] : 0;
}

static void fill_shifts(const pia_square_grid *g, const pia_targets *targets, double *shift, double *back)
{
    for (pia_index c = 0; c < g->width + 2 * g->halo; c++) shift[c] = g->points[(c + g->halo * (g->dim - 1)) % g->dim];
    for (pia_index c = 0; c < g->width; c++) back[c] = g->points[c % g->dim] - targets->origin[c % g->dim];
}

/* *out: what the tables lie in. */
static pia_status take_tables(pia_context *context, pia_square_grid *g, const pia_targets *targets, double **out)
{
    pia_index length = g->panels * g->width, bands = g->v->lower + 1 + g->v->upper, size = g->width + 2 * g->halo;
    pia_index count = (bands + 1) * length + size + g->width;
    double *table = pia_take(context, count, sizeof *table);
    if (table == NULL) return pia_take_status(context, count, sizeof *table);
    double *counts = table + bands * length, *shift = counts + length, *back = shift + size;
    fill_across(g, table);
    for (pia_index c = 0; c < length; c++) counts[c] = c % g->dim == 0 && c < g->v->n * g->dim;
    fill_shifts(g, targets, shift, back);
    g->across = table;
    g->counts = counts;
    g->shift = shift;
    g->back = back;
    *out = table;
    return PIA_OK;
}

static void set_shape(const pia_grid_side *u, const pia_grid_side *v, const pia_targets *targets, double *next, pia_square_grid *out)
{
    int dim = targets->dim, reach = v->lower > v->upper ? v->lower : v->upper;
    pia_index most = PANEL / (UNIT * dim) * UNIT, points = most > 0 ? most : UNIT; /* of a panel */
    *out = (pia_square_grid){.u = u, .v = v, .dim = dim, .points = targets->points, .next = next};
    out->halo = units(reach * dim);
    out->panels = (v->n + points - 1) / points;
    out->width = units((v->n + out->panels - 1) / out->panels) * dim; /* alike, so that none is wider than it needs to be */
    out->stride = units(v->n) * dim;
}

/* ---- passes ---- */

static void solve_lines(void *argument, pia_index chunk)
{
    const work *w = argument;
    const pia_square_grid *g = w->grid;
    pia_index each = pia_grid_lines(g->dim), count = (g->u->n + each - 1) / each, end = pia_chunk_begin(count, w->chunks, chunk + 1);
    double *room = pia_rooms_take(w->rooms);
    pia_box box;
    pia_box_open(g->dim, &box);
    for (pia_index b = pia_chunk_begin(count, w->chunks, chunk); b < end; b++) {
        pia_index line = b * each, lines = g->u->n - line < each ? g->u->n - line : each;
        if (w->survey != NULL) pia_box_add(&box, g->points + line * g->v->n * g->dim, lines * g->v->n);
        w->solver->lines(g, line, room);
    }
    if (w->survey != NULL) w->survey[chunk] = pia_survey_of(&box);
    pia_rooms_leave(w->rooms, room);
}

static void solve_panels(void *argument, pia_index chunk)
{
    const work *w = argument;
    pia_index end = pia_chunk_begin(w->grid->panels, w->chunks, chunk + 1);
    double *room = pia_rooms_take(w->rooms);
    pia_step_errors errors = {.before.max_row = -1, .after.max_row = -1};
    for (pia_index b = pia_chunk_begin(w->grid->panels, w->chunks, chunk); b < end; b++) w->solver->panel(w->grid, b, room, &errors);
    w->errors[chunk] = errors;
    pia_rooms_leave(w->rooms, room);
}

static void run(pia_context *context, work *w, pia_index count, pia_task *task)
{
    w->chunks = count < MAX_CHUNKS ? count : MAX_CHUNKS;
    pia_for_each(context, w->chunks, task, w);
}

static void join_surveys(const work *w, pia_survey *out)
{
    *out = w->survey[0];
    for (pia_index c = 1; c < w->chunks; c++) *out = pia_survey_join(out, &w->survey[c], w->grid->dim);
}

static void join_errors(const work *w, pia_step_errors *out)
{
    *out = w->errors[0];
    for (pia_index c = 1; c < w->chunks; c++) {
        out->before = pia_errors_join(out->before, w->errors[c].before);
        out->after = pia_errors_join(out->after, w->errors[c].after);
        out->moved = fmax(out->moved, w->errors[c].moved);
    }
}

pia_index pia_grid_room(const pia_square_grid *g)
{
    pia_index size = g->width + 2 * g->halo, bands = g->u->lower + 1 + g->u->upper;
    pia_index lines = (g->v->lower + g->v->n + 2 * g->v->margin + g->v->upper) * g->dim * pia_grid_lines(g->dim);
    pia_index panel = (g->u->n + 2 * g->u->margin + 2 * bands + 5) * size + 3 * (g->width + UNIT);
    return lines > panel ? lines : panel;
}

static pia_status pass_twice(pia_context *context, const pia_grid_solver *solver, const pia_square_grid *g, pia_survey *survey,
                             pia_step_errors *out)
{
    pia_rooms rooms;
    pia_survey seen[MAX_CHUNKS];
    pia_step_errors errors[MAX_CHUNKS];
    work w = {solver, g, 0, &rooms, survey != NULL ? seen : NULL, errors};
    pia_index each = pia_grid_lines(g->dim);
    pia_status status = pia_rooms_open(context, MAX_CHUNKS, pia_grid_room(g) * (pia_index)sizeof(double), &rooms);
    if (status != PIA_OK) return status;
    run(context, &w, (g->u->n + each - 1) / each, solve_lines);
    if (survey != NULL) join_surveys(&w, survey);
    run(context, &w, g->panels, solve_panels);
    join_errors(&w, out);
    pia_rooms_close(context, &rooms);
    return PIA_OK;
}

static pia_status step(pia_context *context, const pia_grid_solver *solver, pia_square_grid *g, const pia_targets *targets,
                       pia_survey *survey, pia_step_errors *out)
{
    double *tables = NULL;
    pia_index count = g->u->n * g->stride;
    g->along = pia_take(context, count, sizeof *g->along);
    pia_status status =
        g->along != NULL ? take_tables(context, g, targets, &tables) : pia_take_status(context, count, sizeof *g->along);
    if (status == PIA_OK) status = pass_twice(context, solver, g, survey, out);
    pia_give(context, tables);
    pia_give(context, g->along);
    return status;
}

int pia_square_grid_suits_counts(const pia_index *count, int dim)
{
    return dim <= PIA_GRID_MOST_DIM && count[0] <= MOST && count[1] <= MOST;
}

/* A closed direction is longer than what its rows reach on both sides. */
static int suits_line(const pia_collocation *c)
{
    if (c->map == PIA_MAP_CYCLIC) return c->unknowns >= LEAST_CLOSED && c->unknowns > 2 * (pia_index)c->degree + 2;
    return c->map == PIA_MAP_IDENTITY;
}

int pia_square_grid_suits(const pia_op *op, int dim)
{
    return op->directions == 2 && op->frozen == NULL && op->rows == op->cols && op->line[0] != NULL && suits_line(op->line[0]) &&
           suits_line(op->line[1]) && pia_square_grid_suits_counts(op->count, dim);
}

pia_status pia_square_grid_step_with(const pia_grid_solver *solver, const pia_op *op, const pia_targets *targets, double *next,
                                     pia_survey *survey, pia_step_errors *out)
{
    pia_grid_side u = {0}, v = {0};
    pia_square_grid g;
    pia_status status = open_side(op->context, op->line[0], &u);
    if (status == PIA_OK) status = open_side(op->context, op->line[1], &v);
    if (status == PIA_OK) {
        set_shape(&u, &v, targets, next, &g);
        status = step(op->context, solver, &g, targets, survey, out);
    }
    close_side(op->context, &u);
    close_side(op->context, &v);
    return status;
}

pia_status pia_square_grid_step(const pia_op *op, const pia_targets *targets, double *next, pia_survey *survey, pia_step_errors *out)
{
    const pia_grid_solver *best = pia_has_wide() ? &pia_grid_by_eight : &pia_grid_by_four;
    return pia_square_grid_step_with(best, op, targets, next, survey, out);
}
