#include "refine_tiles.h"

#include "kernel.h"
#include "refine_relax.h"
#include "vector.h"

#include <math.h>
#include <string.h>

/* A component is fitted on its own as long as it takes at most so much of the tolerance. */
static const double QUIET = 0.25;

/* Rounds times rows in one refinement; more than on the operator, for a round is quicker here. */
static const double MOST = 6e8;

int pia_tiles_suit(const pia_fit *fit)
{
    if (fit->kind != PIA_GRID || fit->has_holes || fit->weights != NULL || !pia_fit_is_tolerance_alike(fit)) return 0;
    if (fit->constraint_count > 0 || fit->options.fairing > 0) return 0;
    return fit->map[0] == PIA_MAP_IDENTITY && fit->map[1] == PIA_MAP_IDENTITY;
}

static pia_index longer(const pia_fit *fit)
{
    return fit->count[0] > fit->count[1] ? fit->count[0] : fit->count[1];
}

/* ---- points in tiles ---- */

static pia_index tile_size(const pia_tiles *t)
{
    return t->dim * t->fit->count[0] * PIA_TILE;
}

/* Where component `c` of those relaxed of a row, and of a column, is in arrays of tiles. */
static pia_index place_of(const pia_tiles *t, int c, pia_index i, pia_index j)
{
    return (j / PIA_TILE) * tile_size(t) + (c * t->fit->count[0] + i) * PIA_TILE + j % PIA_TILE;
}

/* The points, less `relaxed` [rows x dim]. */
static void take_points(const pia_tiles *t, const double *relaxed, double *to)
{
    const pia_fit *fit = t->fit;
    for (int c = 0; c < t->dim; c++) {
        int d = t->component[c];
        for (pia_index i = 0; i < fit->count[0]; i++)
            for (pia_index j = 0; j < fit->count[1]; j++) {
                pia_index at = (i * fit->count[1] + j) * fit->dim + d;
                to[place_of(t, c, i, j)] = fit->points[at] - fit->origin[d] - (relaxed != NULL ? relaxed[at] : 0);
            }
    }
}

/* ---- components that vary along one direction alone ---- */

static int varies_along(const pia_fit *fit, int component, int direction)
{
    pia_index other = direction == 0 ? fit->dim : fit->count[1] * fit->dim, step = direction == 0 ? fit->count[1] * fit->dim : fit->dim;
    for (pia_index k = 0; k < fit->count[direction]; k++) {
        const double *line = fit->points + k * step + component;
        for (pia_index l = 1; l < fit->count[1 - direction]; l++)
            if (line[l * other] != line[0]) return 0;
    }
    return 1;
}

/* Least squares of the components of a direction, one in each lane. */
static void fit_singles(pia_tiles *t, int direction)
{
    const pia_fit *fit = t->fit;
    pia_index rows = fit->count[direction], step = direction == 0 ? fit->count[1] * fit->dim : fit->dim;
    double *values = t->room, *fitted = t->room + longer(fit) * PIA_TILE;
    int lane = 0;
    memset(values, 0, (size_t)(rows * PIA_TILE) * sizeof *values);
    for (int d = 0; d < fit->dim; d++) {
        if (t->direction[d] != direction) continue;
        for (pia_index k = 0; k < rows; k++) values[k * PIA_TILE + lane] = fit->points[k * step + d] - fit->origin[d];
        lane++;
    }
    pia_projection_line_fit(&t->line[direction], values, t->single[direction]);
    pia_projection_line_apply(&t->line[direction], t->single[direction], fitted);
    for (pia_index k = 0; k < rows; k++) {
        double square = 0;
        for (int l = 0; l < lane; l++) {
            double away = values[k * PIA_TILE + l] - fitted[k * PIA_TILE + l];
            square += away * away;
        }
        t->squares[direction][k] = square;
    }
}

static double largest(const double *x, pia_index count)
{
    double most = 0;
    for (pia_index i = 0; i < count; i++) most = fmax(most, x[i]);
    return most;
}

/* What is left to the others. Returns 0 where that is too little. */
static int spread_radius(pia_tiles *t)
{
    const pia_fit *fit = t->fit;
    double whole = fit->options.tolerance * fit->options.tolerance;
    double taken = largest(t->squares[0], fit->count[0]) + largest(t->squares[1], fit->count[1]);
    if (!(taken <= QUIET * QUIET * whole)) return 0;
    for (pia_index j = 0; j < t->projection.tiles * PIA_TILE; j++)
        for (pia_index i = 0; i < fit->count[0]; i++) {
            double left = j < fit->count[1] ? whole - t->squares[0][i] - t->squares[1][j] : whole;
            t->radius[(j / PIA_TILE * fit->count[0] + i) * PIA_TILE + j % PIA_TILE] = sqrt(left);
        }
    return 1;
}

/* ---- the search ---- */

static void show_moved(void *owner, pia_index tile, double *values)
{
    const pia_tiles *t = owner;
    size_t size = (size_t)tile_size(t) * sizeof(double);
    const double *from = (t->moves ? t->moved : t->points) + tile * tile_size(t);
    memcpy(values, from, size);
    memcpy(t->next + tile * tile_size(t), from, size);
}

/* The first round after least squares: x is the residual a. */
static void adopt(void *owner, pia_index tile, double *values)
{
    const pia_tiles *t = owner;
    memcpy(t->next + tile * tile_size(t), values, (size_t)tile_size(t) * sizeof(double));
}

/* What the deviations a = points - values of four neighbours have to do with the ball, and where that moves their points: x = points -
 * moved becomes x + b - a, b the nearest to 2 a - x within the ball. */
PIA_INLINE pia_lanes reflect(const double *points, const double *radius, int dim, pia_index stride, double *moved, double *values)
{
    pia_lanes a[PIA_MAX_DIM], q[PIA_MAX_DIM], square = {0}, reflected = {0}, r = pia_vector_load(radius), inside = PIA_INSIDE * r;
    for (int d = 0; d < dim; d++) {
        pia_lanes v = pia_vector_load(values + d * stride);
        a[d] = pia_vector_load(points + d * stride) - v;
        q[d] = a[d] + (pia_vector_load(moved + d * stride) - v);
        square += a[d] * a[d];
        reflected += q[d] * q[d];
    }
    pia_lanes factor = {1, 1, 1, 1}, limit = inside * inside;
    for (int l = 0; dim > 1 && l < PIA_LANES; l++) factor[l] = reflected[l] > limit[l] ? inside[l] / sqrt(reflected[l]) : 1;
    for (int d = 0; d < dim; d++) {
        pia_lanes b = dim > 1 ? factor * q[d] : pia_vector_upper(pia_vector_lower(q[d], inside), -inside);
        pia_lanes to = pia_vector_load(moved + d * stride) + (a[d] - b);
        memcpy(moved + d * stride, &to, sizeof to);
        memcpy(values + d * stride, &to, sizeof to);
    }
    return square - r * r;
}

PIA_INLINE double reflect_rows(const double *points, const double *radius, int dim, pia_index size, double *moved, double *values)
{
    pia_lanes worst = {-INFINITY, -INFINITY, -INFINITY, -INFINITY};
    for (pia_index k = 0; k < size; k += PIA_LANES)
        worst = pia_vector_upper(reflect(points + k, radius + k, dim, size, moved + k, values + k), worst);
    return fmax(fmax(worst[0], worst[1]), fmax(worst[2], worst[3]));
}

PIA_CLONES static double reflect_any(const double *points, const double *radius, int dim, pia_index size, double *moved, double *values)
{
    switch (dim) {
    case 1: return reflect_rows(points, radius, 1, size, moved, values);
    case 3: return reflect_rows(points, radius, 3, size, moved, values);
    default: return reflect_rows(points, radius, dim, size, moved, values);
    }
}

static void reflect_tile(void *owner, pia_index tile, double *values)
{
    const pia_tiles *t = owner;
    pia_index size = t->fit->count[0] * PIA_TILE, at = tile * tile_size(t);
    t->worst[tile] = reflect_any(t->points + at, t->radius + tile * size, t->dim, size, t->next + at, values);
}

/* The largest ratio of the spline at hand; and what is to be projected next is ready. */
static double look(pia_tiles *t)
{
    double whole = t->fit->options.tolerance * t->fit->options.tolerance, worst = -whole;
    pia_projection_exchange(&t->projection, reflect_tile, t);
    for (pia_index tile = 0; tile < t->projection.tiles; tile++) worst = fmax(worst, t->worst[tile]);
    return sqrt(1 + worst / whole);
}

static void begin(pia_tiles *t)
{
    pia_projection_exchange(&t->projection, show_moved, t);
    pia_projection_find(&t->projection);
    if (t->moves) return;
    pia_projection_exchange(&t->projection, adopt, t);
    pia_projection_find(&t->projection);
}

pia_status pia_tiles_search(pia_tiles *t, int *found)
{
    *found = 0;
    if (!spread_radius(t)) return PIA_OK;
    begin(t);
    double ratio = look(t), best = ratio;
    pia_index k = 0;
    while (ratio > 1 && !pia_relax_is_vain(k, best) && t->fit->relaxation + (double)k * (double)t->fit->rows <= MOST) {
        pia_projection_find(&t->projection);
        ratio = look(t);
        best = fmin(best, ratio);
        k++;
    }
    t->fit->relaxation += (double)k * (double)t->fit->rows;
    *found = ratio <= 1;
    return PIA_OK;
}

void pia_tiles_keep(pia_tiles *t)
{
    double *kept = t->next;
    t->next = t->moved;
    t->moved = kept;
    t->moves = 1;
}

/* ---- knots and control points ---- */

static pia_status open_line(const pia_fit *fit, int d, double *knots, pia_index count, pia_projection_line *line)
{
    if (knots == NULL) return PIA_E_MEMORY;
    return pia_projection_line_open(fit->context, fit->degree[d], knots, count, fit->parameter[d], fit->count[d], line);
}

pia_status pia_tiles_place(pia_tiles *t, int d, const double *inside, pia_index count, pia_projection_line *before)
{
    pia_projection_line line;
    pia_status status = open_line(t->fit, d, pia_refine_knots(t->fit, d, inside, count), count + t->fit->degree[d] + 1, &line);
    if (status != PIA_OK) return status;
    *before = t->line[d];
    t->line[d] = line;
    fit_singles(t, d);
    return PIA_OK;
}

void pia_tiles_put_back(pia_tiles *t, int d, pia_projection_line *before)
{
    pia_projection_line_close(t->fit->context, &t->line[d]);
    t->line[d] = *before;
    fit_singles(t, d);
}

void pia_tiles_control(const pia_tiles *t, double *control)
{
    const pia_fit *fit = t->fit;
    pia_index count[2] = {t->line[0].count, t->line[1].count};
    int lane[2] = {0, 0}, c = 0;
    for (int d = 0; d < fit->dim; d++) {
        int single = t->direction[d], l = single >= 0 ? lane[single]++ : 0;
        for (pia_index i = 0; i < count[0]; i++)
            for (pia_index j = 0; j < count[1]; j++) {
                double *to = &control[(i * count[1] + j) * fit->dim + d];
                *to = single >= 0 ? t->single[single][(single == 0 ? i : j) * PIA_TILE + l]
                                  : pia_projection_control(&t->projection, c, i, j);
            }
        c += single < 0;
    }
}

/* ---- open and close ---- */

static void give(pia_tiles *t)
{
    pia_context *context = t->fit->context;
    for (int d = 0; d < 2; d++) {
        pia_projection_line_close(context, &t->line[d]);
        pia_give(context, t->single[d]);
        pia_give(context, t->squares[d]);
    }
    if (t->projection.context != NULL) pia_projection_close(&t->projection);
    double *array[] = {t->points, t->moved, t->next, t->radius, t->worst, t->room};
    for (size_t k = 0; k < sizeof array / sizeof *array; k++) pia_give(context, array[k]);
}

/* A component that takes too little of the tolerance to be relaxed. */
static int is_quiet(const pia_fit *fit, int d)
{
    double most = 0;
    for (pia_index row = 0; row < fit->rows; row++) most = fmax(most, fabs(fit->iterate.residual[row * fit->dim + d]));
    return most < QUIET / 2 * fit->options.tolerance;
}

static void choose_components(pia_tiles *t)
{
    int singles[2] = {0, 0};
    for (int d = 0; d < t->fit->dim; d++) {
        t->direction[d] = -1;
        for (int along = 0; along < 2 && t->direction[d] < 0; along++)
            if (singles[along] < PIA_TILE && varies_along(t->fit, d, along) && is_quiet(t->fit, d)) {
                t->direction[d] = along;
                singles[along]++;
            }
        if (t->direction[d] < 0) t->component[t->dim++] = d;
    }
    if (t->dim > 0) return;
    t->direction[0] = -1; /* one at least is relaxed */
    t->component[t->dim++] = 0;
}

static pia_status take_arrays(pia_tiles *t)
{
    const pia_fit *fit = t->fit;
    pia_context *context = fit->context;
    pia_index tiles = (fit->count[1] + PIA_TILE - 1) / PIA_TILE, rows = tiles * PIA_TILE * fit->count[0];
    const size_t point = (size_t)t->dim * sizeof(double);
    t->points = pia_take_zero(context, rows, point);
    t->moved = pia_take_zero(context, rows, point);
    t->next = pia_take_zero(context, rows, point);
    t->radius = pia_take(context, rows, sizeof(double));
    t->worst = pia_take(context, tiles, sizeof(double));
    t->room = pia_take(context, longer(fit), 2 * PIA_TILE * sizeof(double));
    int all = t->points != NULL && t->moved != NULL && t->next != NULL && t->radius != NULL && t->worst != NULL && t->room != NULL;
    for (int d = 0; d < 2; d++) {
        t->single[d] = pia_take(context, fit->full[d], PIA_TILE * sizeof(double));
        t->squares[d] = pia_take(context, fit->count[d], sizeof(double));
        all = all && t->single[d] != NULL && t->squares[d] != NULL;
    }
    return all ? PIA_OK : PIA_E_MEMORY;
}

pia_status pia_tiles_open(pia_fit *fit, pia_tiles *out)
{
    pia_tiles *t = out;
    *t = (pia_tiles){.fit = fit};
    choose_components(t);
    pia_status status = take_arrays(t);
    if (status == PIA_OK) status = pia_projection_open(fit->context, fit->count, fit->full, t->dim, &t->projection);
    for (int d = 0; d < 2 && status == PIA_OK; d++) {
        double *knots = pia_refine_knots(fit, d, pia_refine_inside(fit, d), pia_refine_inside_count(fit, d));
        status = open_line(fit, d, knots, fit->full[d], &t->line[d]);
    }
    if (status != PIA_OK) {
        give(t);
        return status;
    }
    for (int d = 0; d < 2; d++) {
        t->projection.line[d] = &t->line[d];
        fit_singles(t, d);
    }
    take_points(t, NULL, t->points);
    t->moves = fit->relaxed != NULL;
    if (t->moves) take_points(t, fit->relaxed, t->moved);
    return PIA_OK;
}

/* fit->relaxed from the points moved. */
static pia_status leave(const pia_tiles *t)
{
    pia_fit *fit = t->fit;
    if (!t->moves) return PIA_OK;
    if (fit->relaxed == NULL) fit->relaxed = pia_take(fit->context, fit->rows, (size_t)fit->dim * sizeof(double));
    if (fit->relaxed == NULL) return PIA_E_MEMORY;
    memset(fit->relaxed, 0, (size_t)(fit->rows * fit->dim) * sizeof(double));
    for (int c = 0; c < t->dim; c++)
        for (pia_index i = 0; i < fit->count[0]; i++)
            for (pia_index j = 0; j < fit->count[1]; j++)
                fit->relaxed[(i * fit->count[1] + j) * fit->dim + t->component[c]] =
                    t->points[place_of(t, c, i, j)] - t->moved[place_of(t, c, i, j)];
    return PIA_OK;
}

pia_status pia_tiles_close(pia_tiles *t)
{
    pia_status status = leave(t);
    give(t);
    return status;
}
