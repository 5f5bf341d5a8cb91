#include "order.h"

#include "options.h"
#include "spanning_tree.h"

#include <math.h>
#include <string.h>

static double distance(const double *points, int dim, pia_index i, pia_index j)
{
    double sum = 0;
    for (int d = 0; d < dim; d++) sum = hypot(sum, points[i * dim + d] - points[j * dim + d]);
    return sum;
}

/* The ends are neighbours when they are not much farther apart than neighbours are at most. */
static void measure(const double *points, pia_index count, int dim, const pia_index *order, pia_order_report *report)
{
    double longest = 0;
    for (pia_index i = 1; i < count; i++) {
        double step = distance(points, dim, order[i - 1], order[i]);
        report->length += step;
        longest = fmax(longest, step);
    }
    report->closed = count > 3 && distance(points, dim, order[0], order[count - 1]) <= 1.5 * longest && longest < report->length / 6;
}

static pia_status measure_tree(pia_context *context, const double *points, pia_index count, int dim, double *length)
{
    pia_tree_edge *edge;
    pia_status status = pia_spanning_tree(context, points, count, dim, &edge);
    if (status != PIA_OK) return status;
    *length = 0;
    for (pia_index e = 0; e < count - 1; e++) *length += edge[e].length;
    pia_give(context, edge);
    return PIA_OK;
}

pia_status pia_points_order(pia_context *context, const double *points, pia_index count, int dim, const char *how, pia_index *order,
                            pia_order_report *report)
{
    pia_order_report full = {.struct_size = sizeof full, .break_row = -1};
    if (points == NULL || order == NULL || count < 1 || dim < 1 || dim > PIA_MAX_DIM)
        return pia_fail(context, PIA_E_ARGUMENT, "ordering needs points of 1 to %d components, and room for their order", PIA_MAX_DIM);
    for (pia_index i = 0; i < count * dim; i++)
        if (!isfinite(points[i]))
            return pia_fail(context, PIA_E_DATA, "component %lld of row %lld is %g; points are finite", (long long)(i % dim),
                            (long long)(i / dim), points[i]);
    pia_status status = PIA_OK;
    if (how == NULL || strcmp(how, "given") == 0)
        for (pia_index i = 0; i < count; i++) order[i] = i;
    else if (strcmp(how, "nearest") == 0)
        status = pia_order_nearest(context, points, count, dim, order, &full);
    else if (strcmp(how, "tree") == 0)
        status = pia_order_tree(context, points, count, dim, order, &full);
    else
        return pia_fail(context, PIA_E_ARGUMENT, "there is no order '%.40s'; there are given, nearest, tree", how);
    if (status == PIA_OK && report != NULL) {
        measure(points, count, dim, order, &full);
        status = measure_tree(context, points, count, dim, &full.tree_length);
        if (status == PIA_OK) pia_options_write(report, &full, sizeof full);
    }
    return status;
}
