#include "holes.h"

#include <math.h>
#include <string.h>

static int is_hole(const double *point, int dim)
{
    for (int d = 0; d < dim; d++)
        if (isnan(point[d])) return 1;
    return 0;
}

struct solid points_without_holes(struct session *session, const pia_points_info *points, const double *parameters)
{
    pia_index all = points->count[0] * points->count[1];
    size_t dim = (size_t)points->dim;
    struct solid whole = {.points = points->points, .parameters = parameters, .count = all}, solid = {.count = 0};
    if (points->kind != PIA_GRID) return whole;
    double *point = session_keep(session, (size_t)all, dim * sizeof *point);
    double *parameter = parameters ? session_keep(session, (size_t)all, 2 * sizeof *parameter) : NULL;
    pia_index *row = session_keep(session, (size_t)all, sizeof *row);
    for (pia_index i = 0; i < all; i++) {
        const double *from = points->points + i * points->dim;
        if (is_hole(from, points->dim)) continue;
        memcpy(point + (size_t)solid.count * dim, from, dim * sizeof *point);
        if (parameter) memcpy(parameter + 2 * solid.count, parameters + 2 * i, 2 * sizeof *parameter);
        row[solid.count++] = i;
    }
    if (solid.count == all) return whole;
    solid.points = point;
    solid.parameters = parameter;
    solid.row = row;
    return solid;
}
