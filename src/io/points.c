#include "io.h"

#include <math.h>
#include <string.h>

void pia_points_clear(pia_points *points)
{
    const pia_memory memory = points->memory;
    for (int i = 0; points->names != NULL && i < points->dim; i++) pia_memory_give(&memory, points->names[i]);
    pia_memory_give(&memory, points->names);
    pia_memory_give(&memory, points->points);
    pia_memory_give(&memory, points->part);
    pia_memory_give(&memory, points->row);
    *points = (pia_points){.memory = memory};
}

pia_status pia_points_from_heights(pia_context *context, const double *values, pia_index rows, pia_index columns, const double first[2],
                                   const double step[2], pia_points *out)
{
    pia_index count;
    if (!pia_multiply(rows, columns, &count) || count > INT64_MAX / 3)
        return pia_fail(context, PIA_E_SIZE, "a grid of %lld x %lld points does not fit in 64 bits", (long long)rows,
                        (long long)columns);
    double *point = pia_take(context, 3 * count, sizeof *point);
    if (point == NULL) return pia_take_status(context, 3 * count, sizeof *point);
    out->kind = PIA_GRID;
    out->points = point;
    out->count[0] = rows;
    out->count[1] = columns;
    out->dim = 3;
    for (pia_index i = 0; i < rows; i++) {
        for (pia_index j = 0; j < columns; j++, point += 3) {
            point[0] = first[0] + (double)j * step[0];
            point[1] = first[1] + (double)i * step[1];
            point[2] = values[i * columns + j];
        }
    }
    return PIA_OK;
}

/* The first component that must not be there; -1 when the row is good. */
static int find_invalid(const double *row, int dim, int allow_nan)
{
    for (int c = 0; c < dim; c++)
        if (!isfinite(row[c]) && !(allow_nan && isnan(row[c]))) return c;
    return -1;
}

static pia_status refuse_point(pia_context *context, const pia_input *input, const pia_points *points, pia_index i, int component)
{
    double value = points->points[i * points->dim + component];
    const char *text = isnan(value) ? "nan" : "infinite";
    if (points->kind == PIA_GRID)
        return pia_input_fail(context, input, NULL, "row %lld, column %lld of the grid is %s; fill the hole, or allow holes",
                              (long long)(i / points->count[1]), (long long)(i % points->count[1]), text);
    return pia_input_fail(context, input, NULL, "component %d of row %lld is %s; correct it, or skip invalid rows", component,
                          (long long)i, text);
}

/* Keeps the good rows and their numbers in the file. */
static pia_status drop_invalid(pia_context *context, const pia_input *input, int allow_nan, pia_points *points)
{
    points->row = pia_take(context, points->count[0], sizeof *points->row);
    if (points->row == NULL) return pia_take_status(context, points->count[0], sizeof *points->row);
    pia_index kept = 0;
    for (pia_index i = 0; i < points->count[0]; i++) {
        const double *row = points->points + i * points->dim;
        if (find_invalid(row, points->dim, allow_nan) >= 0) continue;
        memmove(points->points + kept * points->dim, row, (size_t)points->dim * sizeof *row);
        points->row[kept++] = i;
    }
    points->skipped = points->count[0] - kept;
    points->count[0] = kept;
    if (kept == 0) return pia_input_fail(context, input, NULL, "all %lld rows are invalid; correct them", (long long)points->skipped);
    return PIA_OK;
}

pia_status pia_points_screen(pia_context *context, const pia_input *input, const pia_points_options *options, pia_points *points)
{
    pia_index count = points->count[0] * points->count[1];
    int allow_nan = options->allow_nan == PIA_AUTO ? points->kind == PIA_GRID : options->allow_nan;
    for (pia_index i = 0; i < count; i++) {
        int component = find_invalid(points->points + i * points->dim, points->dim, allow_nan);
        if (component < 0) continue;
        if (points->kind != PIA_GRID && options->skip_invalid) return drop_invalid(context, input, allow_nan, points);
        return refuse_point(context, input, points, i, component);
    }
    return PIA_OK;
}
