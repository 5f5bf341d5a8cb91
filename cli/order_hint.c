#include "order_hint.h"

#include <math.h>

enum { FEWEST = 10, MOST = 200000 };

/* Mean step over the extent; 0 when a point is not finite. */
static double relative_step(const double *points, pia_index count, int dim)
{
    double low[PIA_MAX_DIM], high[PIA_MAX_DIM], length = 0, extent = 0;
    for (int d = 0; d < dim; d++) low[d] = high[d] = points[d];
    for (pia_index i = 1; i < count; i++) {
        double square = 0;
        for (int d = 0; d < dim; d++) {
            double value = points[i * dim + d], step = value - points[(i - 1) * dim + d];
            square += step * step;
            low[d] = fmin(low[d], value);
            high[d] = fmax(high[d], value);
        }
        length += sqrt(square);
    }
    for (int d = 0; d < dim; d++) extent = hypot(extent, high[d] - low[d]);
    return isfinite(length) && extent > 0 ? length / extent / (double)(count - 1) : 0;
}

double order_ratio(struct session *session, const double *points, pia_index count, int dim)
{
    pia_order_report report = {.struct_size = sizeof report};
    if (count < FEWEST || count > MOST || relative_step(points, count, dim) < 0.05) return 0;
    pia_index *order = session_keep(session, (size_t)count, sizeof *order);
    if (pia_points_order(session->context, points, count, dim, NULL, order, &report) != PIA_OK) return 0;
    return report.tree_length > 0 ? report.length / report.tree_length : 0;
}
