/* What the page shows of the deviations: their sign, their distribution, and where on a surface they are large. */
#include "page.h"

#include "deviation.h"
#include "evaluate.h"

#include <math.h>
#include <string.h>

enum { BINS = 41, LEAST_NODES = 5, MOST_NODES = 128, SPREAD_ROUNDS = 3, MAP_BITS = 16 };

/* ---- Sides ---- */

/* Drawn position and first derivatives of a model at a parameter. */
static void frame_at(const pia_model *model, const pia_model_info *info, const double *parameter, pia_index hint[2], double out[3][3])
{
    double value[3 * PIA_MAX_DIM];
    pia_evaluate(model, parameter, 1, hint, value);
    pia_figure_place(info, parameter, value, out[0]);
    for (int d = 0; d < info->directions; d++) {
        const double step[2] = {d == 0, d == 1};
        pia_figure_place(info, step, value + (1 + d) * info->dim, out[1 + d]);
    }
}

/* Which side of the model a drawn point lies on: 1 or -1. */
static int side_of(const double frame[3][3], int directions, const double *point)
{
    const double *u = frame[1], *v = frame[2];
    double across[3] = {-u[1], u[0], 0}, along = 0;
    if (directions == 2) {
        across[0] = u[1] * v[2] - u[2] * v[1];
        across[1] = u[2] * v[0] - u[0] * v[2];
        across[2] = u[0] * v[1] - u[1] * v[0];
    }
    for (int c = 0; c < 3; c++) along += across[c] * (point[c] - frame[0][c]);
    return along < 0 ? -1 : 1;
}

int pia_page_sides(const pia_scene *scene, double *deviation)
{
    for (pia_index f = 0; f < scene->figure_count; f++)
        if (scene->space && scene->figure[f].info.directions == 1) return 0;
    pia_index hint[2] = {0, 0}, owner = 0;
    for (pia_index i = 0; i < scene->point_count; i++) {
        if (scene->owner[i] != owner) hint[0] = hint[1] = 0;
        owner = scene->owner[i];
        const pia_figure *figure = &scene->figure[owner];
        double frame[3][3];
        frame_at(figure->model, &figure->info, scene->parameter + 2 * i, hint, frame);
        deviation[i] *= side_of((const double(*)[3])frame, figure->info.directions, scene->point + 3 * i);
    }
    return 1;
}

/* ---- Distribution ---- */

static void put_histogram(pia_page *page, const double *deviation, int has_sides)
{
    double high = page->scene.largest, low = has_sides ? -high : 0;
    pia_index count[BINS] = {0};
    for (pia_index i = 0; i < page->scene.point_count; i++) {
        double share = high > low ? (deviation[i] - low) / (high - low) : 0.5;
        int bin = (int)floor(share * BINS);
        count[bin < 0 ? 0 : bin < BINS ? bin : BINS - 1]++;
    }
    pia_json_open(&page->json, "histogram", '{');
    pia_json_number(&page->json, "low", low);
    pia_json_number(&page->json, "high", high);
    pia_json_counts(&page->json, "counts", count, BINS);
    pia_json_close(&page->json, '}');
}

pia_status pia_page_statistics(pia_page *page, const double *deviation, int has_sides)
{
    const pia_scene *scene = &page->scene;
    pia_deviation summary = {.struct_size = sizeof summary};
    double *scratch = pia_take(page->context, scene->point_count, sizeof *scratch);
    if (scratch == NULL) return pia_take_status(page->context, scene->point_count, sizeof *scratch);
    memcpy(scratch, scene->deviation, (size_t)scene->point_count * sizeof *scratch);
    pia_status status = pia_deviation_summarize(page->context, scratch, scene->point_count, &summary);
    pia_give(page->context, scratch);
    if (status != PIA_OK) return status;
    pia_json_number(&page->json, "largest", scene->largest);
    pia_json_number(&page->json, "rms", scene->rms);
    pia_json_count(&page->json, "worst", scene->worst);
    pia_json_numbers(&page->json, "percentiles", summary.percentile, 3);
    pia_json_truth(&page->json, "parametric", scene->parametric);
    pia_json_truth(&page->json, "sides", has_sides);
    put_histogram(page, deviation, has_sides);
    return PIA_OK;
}

/* ---- Map ---- */

static pia_index node_of(double parameter, const double domain[2], pia_index nodes)
{
    double share = (parameter - domain[0]) / (domain[1] - domain[0]);
    return (pia_index)rint(fmin(fmax(share, 0), 1) * (double)(nodes - 1));
}

/* Mean of the neighbours that are known, NaN when none is. */
static double mean_about(const double *map, const pia_index nodes[2], pia_index i, pia_index j)
{
    double sum = 0;
    int known = 0;
    for (pia_index a = i > 0 ? i - 1 : 0; a <= i + 1 && a < nodes[0]; a++)
        for (pia_index b = j > 0 ? j - 1 : 0; b <= j + 1 && b < nodes[1]; b++) {
            double value = map[a * nodes[1] + b];
            if (isnan(value)) continue;
            sum += value;
            known++;
        }
    return known > 0 ? sum / known : NAN;
}

/* Nodes without points take the mean of their neighbours, round by round; far from all points they stay NaN. */
static void spread(double *map, double *next, const pia_index nodes[2])
{
    size_t bytes = (size_t)(nodes[0] * nodes[1]) * sizeof *map;
    for (int round = 0; round < SPREAD_ROUNDS; round++) {
        memcpy(next, map, bytes);
        for (pia_index k = 0; k < nodes[0] * nodes[1]; k++)
            if (isnan(map[k])) next[k] = mean_about(map, nodes, k / nodes[1], k % nodes[1]);
        memcpy(map, next, bytes);
    }
}

/* About as many nodes as points, shared by the directions as the control points are. */
static void count_nodes(const pia_model_info *info, pia_index points, pia_index nodes[2])
{
    double ratio = (double)info->control[0] / (double)info->control[1];
    const double wanted[2] = {sqrt((double)points * ratio), sqrt((double)points / ratio)};
    for (int d = 0; d < 2; d++) nodes[d] = (pia_index)rint(fmin(fmax(wanted[d], LEAST_NODES), MOST_NODES));
}

static void collect(const pia_scene *scene, pia_index model, const double *deviation, const pia_index nodes[2], double *map)
{
    const pia_model_info *info = &scene->figure[model].info;
    for (pia_index k = 0; k < nodes[0] * nodes[1]; k++) map[k] = NAN;
    for (pia_index i = 0; i < scene->point_count; i++) {
        if (scene->owner[i] != model) continue;
        const double *at = scene->parameter + 2 * i;
        double *node = &map[node_of(at[0], info->domain[0], nodes[0]) * nodes[1] + node_of(at[1], info->domain[1], nodes[1])];
        if (!(fabs(*node) >= fabs(deviation[i]))) *node = deviation[i];
    }
}

pia_status pia_page_map(pia_page *page, pia_index model, const double *deviation)
{
    const pia_scene *scene = &page->scene;
    pia_index nodes[2], owned = 0;
    for (pia_index i = 0; i < scene->point_count; i++) owned += scene->owner[i] == model;
    if (owned == 0) return PIA_OK;
    count_nodes(&scene->figure[model].info, owned, nodes);
    pia_index count = nodes[0] * nodes[1];
    double *map = pia_take(page->context, count, sizeof *map), *next = pia_take(page->context, count, sizeof *next);
    pia_status status = map != NULL && next != NULL ? PIA_OK : pia_take_status(page->context, count, sizeof *map);
    if (status == PIA_OK) {
        const double low = -scene->largest, high = scene->largest;
        pia_series series = pia_series_between(1, MAP_BITS, &low, &high);
        collect(scene, model, deviation, nodes, map);
        spread(map, next, nodes);
        status = pia_page_lattice(page, "map", &series, map, 1, nodes[0], nodes[1]);
        pia_series_close(page->context, &series);
    }
    pia_give(page->context, map);
    pia_give(page->context, next);
    return status;
}
