#include "io.h"

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
