#include "distance_map.h"

#include <math.h>

/* Work of one line: its values, the parabolas of the envelope and where each begins. */
typedef struct line {
    double *value, *begin;
    pia_index *top;
} line;

static void transform(const line *w, double *at, pia_index stride, pia_index count, double step)
{
    pia_index last = -1;
    for (pia_index i = 0; i < count; i++) {
        double height = w->value[i] = at[i * stride], x = (double)i * step, begin = -INFINITY;
        if (isinf(height)) continue;
        for (; last >= 0; last--) {
            double other = (double)w->top[last] * step;
            begin = (height + x * x - w->value[w->top[last]] - other * other) / (2 * (x - other));
            if (begin > w->begin[last]) break;
            begin = -INFINITY;
        }
        w->top[++last] = i;
        w->begin[last] = begin;
    }
    for (pia_index i = 0, k = 0; i < count && last >= 0; i++) {
        double x = (double)i * step;
        while (k < last && w->begin[k + 1] < x) k++;
        double away = x - (double)w->top[k] * step;
        at[i * stride] = away * away + w->value[w->top[k]];
    }
}

pia_status pia_distance_map(pia_context *context, const pia_raster *raster, double *square)
{
    pia_index longest = raster->count[0] > raster->count[1] ? raster->count[0] : raster->count[1];
    line w = {pia_take(context, longest, sizeof *w.value), pia_take(context, longest, sizeof *w.begin),
              pia_take(context, longest, sizeof *w.top)};
    pia_status status = w.value != NULL && w.begin != NULL && w.top != NULL ? PIA_OK : pia_take_status(context, longest, sizeof *w.top);
    for (pia_index i = 0; i < raster->count[0] && status == PIA_OK; i++)
        transform(&w, square + i * raster->count[1], 1, raster->count[1], raster->step[1]);
    for (pia_index j = 0; j < raster->count[1] && status == PIA_OK; j++)
        transform(&w, square + j, raster->count[1], raster->count[0], raster->step[0]);
    pia_give(context, w.value);
    pia_give(context, w.begin);
    pia_give(context, w.top);
    return status;
}
