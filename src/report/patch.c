#include "patch.h"

#include "fill.h"
#include "style.h"

#include <math.h>

enum { MOST_KNOT_LINES = 42, MOST_STROKES = 12 };

/* Deviation in each cell of the sample lattice: the largest of the points that fall there, gaps filled from around. */
typedef struct deviation_map {
    double *value;
    unsigned char *known;
} deviation_map;

static pia_index cell_of(const pia_samples *samples, double t)
{
    pia_index low = 0, high = samples->count - 1;
    while (high - low > 1) {
        pia_index middle = low + (high - low) / 2;
        if (samples->parameter[middle] <= t)
            low = middle;
        else
            high = middle;
    }
    return low;
}

static pia_status map_deviation(const pia_scene *scene, pia_index index, deviation_map *map)
{
    const pia_samples *s = scene->figure[index].samples;
    pia_index rows = s[0].count - 1, columns = s[1].count - 1;
    map->value = pia_take_zero(scene->context, rows * columns, sizeof *map->value);
    map->known = pia_take_zero(scene->context, rows * columns, sizeof *map->known);
    if (map->value == NULL || map->known == NULL) return PIA_E_MEMORY;
    for (pia_index i = 0; i < scene->point_count; i++) {
        if (scene->owner[i] != index) continue;
        pia_index cell = cell_of(&s[0], scene->parameter[2 * i]) * columns + cell_of(&s[1], scene->parameter[2 * i + 1]);
        map->value[cell] = fmax(map->value[cell], scene->deviation[i]);
        map->known[cell] = 1;
    }
    return pia_fill_gaps(scene->context, map->value, map->known, rows, columns);
}

/* Light from the upper left behind the viewer on the side of a facet that faces the viewer: 0 turned away, 1 facing the light. It
 * never rises again where a shape turns further away, as plain Lambert shading of both sides would. */
static double light_on(const pia_view *view, const double *const at[4])
{
    double p[3], q[3], light[3], size = 0, lit = 0, seen = 0, length = 0, source = 0;
    for (int c = 0; c < 3; c++) {
        p[c] = view->stretch[c] * (at[2][c] - at[0][c]);
        q[c] = view->stretch[c] * (at[3][c] - at[1][c]);
        light[c] = view->toward[c] + 0.8 * view->up[c] - 0.7 * view->right[c];
        size = fmax(size, fmax(fabs(p[c]), fabs(q[c])));
    }
    if (!(size > 0)) return 1;
    for (int c = 0; c < 3; c++) {
        int a = (c + 1) % 3, b = (c + 2) % 3;
        double normal = p[a] / size * (q[b] / size) - p[b] / size * (q[a] / size);
        lit += normal * light[c];
        seen += normal * view->toward[c];
        length += normal * normal;
        source += light[c] * light[c];
    }
    if (!(length > 0)) return 1;
    return 0.5 + 0.5 * (seen < 0 ? -lit : lit) / sqrt(length * source);
}

typedef struct painter {
    const pia_scene *scene;
    pia_index index;
    pia_paint paint;
    deviation_map map;
} painter;

static pia_colour colour_of(const painter *p, pia_index cell, const double *const at[4])
{
    const pia_scene *scene = p->scene;
    if (p->paint == PIA_PAINT_DEVIATION)
        return pia_ramp_colour(PIA_RAMP_ERROR, scene->largest > 0 ? p->map.value[cell] / scene->largest : 0);
    if (p->paint == PIA_PAINT_HEIGHT) {
        double height = 0.25 * (at[0][2] + at[1][2] + at[2][2] + at[3][2]);
        return pia_ramp_colour(PIA_RAMP_HEIGHT, (height - scene->low[2]) / (scene->high[2] - scene->low[2]));
    }
    return pia_colour_lit(pia_colour_cycle(p->index), 1.45);
}

/* A cell that the edge of a trimmed surface crosses is drawn when less than half of its corners are cut away. */
static int is_cut_away(const pia_figure *figure, pia_index corner)
{
    pia_index columns = figure->samples[1].count;
    const unsigned char *o = figure->outside;
    return o != NULL && o[corner] + o[corner + 1] + o[corner + columns] + o[corner + columns + 1] > 1;
}

static void add_cells(pia_pieces *pieces, const painter *p)
{
    const pia_figure *figure = &p->scene->figure[p->index];
    pia_index rows = figure->samples[0].count, columns = figure->samples[1].count;
    for (pia_index i = 0; i + 1 < rows; i++) {
        for (pia_index j = 0; j + 1 < columns; j++) {
            if (is_cut_away(figure, i * columns + j)) continue;
            const double *a = figure->at + 3 * (i * columns + j);
            const double *const at[4] = {a, a + 3, a + 3 * columns + 3, a + 3 * columns};
            pia_colour colour = colour_of(p, i * (columns - 1) + j, at);
            pia_piece_add(pieces, at, 4, 0.4, 0, pia_colour_lit(colour, 0.38 + 0.68 * light_on(pieces->view, at)));
        }
    }
}

pia_index pia_patch_knot_stride(const pia_figure *surface, int direction)
{
    return 1 + (pia_samples_knots(&surface->samples[direction]) - 2) / MOST_KNOT_LINES;
}

/* Lines of constant parameter in `direction`, at its knots; the border always. */
static void add_knot_lines(pia_pieces *pieces, const painter *p, int direction, double lift)
{
    const pia_figure *figure = &p->scene->figure[p->index];
    const pia_samples *held = &figure->samples[direction], *run = &figure->samples[1 - direction];
    pia_index step = direction == 0 ? 1 : figure->samples[1].count, jump = direction == 0 ? figure->samples[1].count : 1;
    pia_index stride = pia_patch_knot_stride(figure, direction), knot = 0;
    for (pia_index i = 0; i < held->count; i++) {
        if (!held->at_knot[i]) continue;
        int border = i == 0 || i == held->count - 1;
        if (knot++ % stride != 0 && !border) continue;
        if (!border && !p->scene->options.knots) continue;
        for (pia_index j = 0; j + 1 < run->count; j++) {
            pia_index from = i * jump + j * step;
            if (figure->outside != NULL && (figure->outside[from] || figure->outside[from + step])) continue;
            const double *const at[2] = {figure->at + 3 * from, figure->at + 3 * (from + step)};
            pia_piece_add(pieces, at, 2, border ? 0.8 : 0.4, lift, pia_colour_faded(pia_colour_grey(0.1), border ? 0.9 : 0.5));
        }
    }
}

static void add_trim_edges(pia_pieces *pieces, const pia_figure *figure, double lift)
{
    const double *stroke = figure->edge;
    for (pia_index i = 0; i < figure->edge_count; i++, stroke += 6)
        pia_piece_add(pieces, (const double *const[]){stroke, stroke + 3}, 2, 0.8, lift, pia_colour_faded(pia_colour_grey(0.1), 0.9));
}

/* Lines on a surface are nearer than the facets around them by about the size of a facet. */
static double facet_size(const pia_view *view, const pia_figure *figure)
{
    double sum = 0;
    for (int c = 0; c < 3; c++) sum += pow(view->stretch[c] * (view->high[c] - view->low[c]), 2);
    pia_index most = figure->samples[0].count > figure->samples[1].count ? figure->samples[0].count : figure->samples[1].count;
    return sqrt(sum) / (double)most;
}

/* In strokes of about the size of a facet, so that each is hidden or seen as the surface around it asks. */
static void add_edge(pia_pieces *pieces, const double *a, const double *b, double facet)
{
    double length = 0;
    for (int c = 0; c < 3; c++) length += pow(pieces->view->stretch[c] * (b[c] - a[c]), 2);
    int strokes = (int)fmin(MOST_STROKES, 1 + sqrt(length) / facet);
    for (int k = 0; k < strokes; k++) {
        double from[3], to[3];
        for (int c = 0; c < 3; c++) {
            from[c] = a[c] + (b[c] - a[c]) * k / strokes;
            to[c] = a[c] + (b[c] - a[c]) * (k + 1) / strokes;
        }
        pia_piece_add(pieces, (const double *const[]){from, to}, 2, 0.5, 1.5 * facet, pia_style_control.colour);
    }
}

static void add_net(pia_pieces *pieces, const pia_figure *figure, double facet)
{
    pia_index rows = figure->info.control[0], columns = figure->info.control[1];
    for (pia_index i = 0; i < rows; i++) {
        for (pia_index j = 0; j < columns; j++) {
            const double *a = figure->control + 3 * (i * columns + j);
            if (j + 1 < columns) add_edge(pieces, a, a + 3, facet);
            if (i + 1 < rows) add_edge(pieces, a, a + 3 * columns, facet);
        }
    }
}

pia_status pia_patch_add(pia_pieces *pieces, const pia_scene *scene, pia_index index, pia_paint paint, int net)
{
    painter p = {.scene = scene, .index = index, .paint = paint};
    const pia_figure *figure = &scene->figure[index];
    pia_status status = paint == PIA_PAINT_DEVIATION ? map_deviation(scene, index, &p.map) : PIA_OK;
    if (status == PIA_OK) {
        double lift = facet_size(pieces->view, figure);
        add_cells(pieces, &p);
        for (int d = 0; d < 2; d++) add_knot_lines(pieces, &p, d, lift);
        add_trim_edges(pieces, figure, lift);
        if (net) add_net(pieces, figure, lift);
    }
    pia_give(scene->context, p.map.value);
    pia_give(scene->context, p.map.known);
    return status;
}
