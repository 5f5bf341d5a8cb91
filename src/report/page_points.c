/* The points that the page shows. Where they are too many, one of each group of neighbours in the file stays: the farthest. */
#include "page.h"

#include <math.h>

enum { MOST_SHOWN = 16000, PLANE_BITS = 32, SPACE_BITS = 16, DEVIATION_BITS = 24, WHOLE_BITS = 32 };

typedef struct shown {
    pia_index *index; /* [count] of the scene's points, increasing */
    pia_index count;
    double *value; /* [count x 3] scratch */
} shown;

static void choose(const pia_scene *scene, shown *out)
{
    for (pia_index k = 0; k < out->count; k++) {
        pia_index begin = k * scene->point_count / out->count, end = (k + 1) * scene->point_count / out->count;
        out->index[k] = begin;
        for (pia_index i = begin + 1; i < end && scene->deviation != NULL; i++)
            if (scene->deviation[i] > scene->deviation[out->index[k]]) out->index[k] = i;
    }
}

/* Columns of numbers gathered from the points shown, in scratch, packed between their bounds. */
static pia_status put_gathered(pia_page *page, const char *key, const shown *s, int components, int bits)
{
    double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};
    for (pia_index k = 0; k < s->count * components; k++) {
        int c = (int)(k % components);
        low[c] = fmin(low[c], s->value[k]);
        high[c] = fmax(high[c], s->value[k]);
    }
    pia_series series = pia_series_between(components, bits, low, high);
    pia_status status = pia_page_lattice(page, key, &series, s->value, components, s->count, 1);
    pia_series_close(page->context, &series);
    return status;
}

static pia_status put_positions(pia_page *page, const shown *s)
{
    for (pia_index k = 0; k < s->count; k++)
        for (int c = 0; c < page->components; c++) s->value[k * page->components + c] = page->scene.point[3 * s->index[k] + c];
    return put_gathered(page, "position", s, page->components, page->scene.surface ? SPACE_BITS : PLANE_BITS);
}

static pia_status put_deviations(pia_page *page, const shown *s, const double *deviation)
{
    for (pia_index k = 0; k < s->count; k++) s->value[k] = deviation[s->index[k]];
    return put_gathered(page, "deviation", s, 1, DEVIATION_BITS);
}

static pia_status put_parameters(pia_page *page, const shown *s)
{
    int directions = page->scene.surface ? 2 : 1;
    for (pia_index k = 0; k < s->count; k++)
        for (int d = 0; d < directions; d++) s->value[k * directions + d] = page->scene.parameter[2 * s->index[k] + d];
    return put_gathered(page, "parameter", s, directions, page->scene.surface ? SPACE_BITS : PLANE_BITS);
}

/* Whole numbers below 2^32 - 2, packed as they are. */
static pia_status put_whole(pia_page *page, const char *key, const shown *s, const pia_index *number)
{
    const double low = 0, high = ldexp(1, WHOLE_BITS) - 2;
    for (pia_index k = 0; k < s->count; k++) s->value[k] = (double)(number != NULL ? number[s->index[k]] : s->index[k]);
    pia_series series = pia_series_between(1, WHOLE_BITS, &low, &high);
    pia_status status = pia_page_lattice(page, key, &series, s->value, 1, s->count, 1);
    pia_series_close(page->context, &series);
    return status;
}

static pia_status put_shown(pia_page *page, const shown *s, const double *deviation)
{
    pia_status status = put_positions(page, s);
    if (status == PIA_OK) status = put_whole(page, "row", s, page->rows);
    if (status == PIA_OK) status = put_deviations(page, s, deviation);
    if (status == PIA_OK) status = put_parameters(page, s);
    if (status == PIA_OK && page->scene.figure_count > 1) status = put_whole(page, "owner", s, page->scene.owner);
    return status;
}

static pia_status put_maps(pia_page *page, const double *deviation)
{
    pia_status status = PIA_OK;
    pia_json_open(&page->json, "maps", '[');
    for (pia_index f = 0; f < page->scene.figure_count && status == PIA_OK; f++) {
        pia_json_open(&page->json, NULL, '{');
        if (page->scene.figure[f].info.directions == 2) status = pia_page_map(page, f, deviation);
        pia_json_close(&page->json, '}');
    }
    pia_json_close(&page->json, ']');
    return status;
}

pia_status pia_page_points(pia_page *page)
{
    pia_index all = page->scene.point_count;
    shown s = {.count = all < MOST_SHOWN ? all : MOST_SHOWN};
    s.index = pia_take(page->context, s.count, sizeof *s.index);
    s.value = pia_take(page->context, s.count, 3 * sizeof *s.value);
    double *deviation = pia_take(page->context, all, sizeof *deviation);
    pia_status status = PIA_E_MEMORY;
    if (s.index != NULL && s.value != NULL && deviation != NULL) {
        choose(&page->scene, &s);
        for (pia_index i = 0; i < all; i++) deviation[i] = page->scene.deviation[i];
        int sides = pia_page_sides(&page->scene, deviation);
        pia_json_open(&page->json, "data", '{');
        pia_json_count(&page->json, "count", all);
        status = pia_page_statistics(page, deviation, sides);
        if (status == PIA_OK) status = put_shown(page, &s, deviation);
        if (status == PIA_OK) status = put_maps(page, deviation);
        pia_json_close(&page->json, '}');
    }
    pia_give(page->context, s.index);
    pia_give(page->context, s.value);
    pia_give(page->context, deviation);
    return status;
}
