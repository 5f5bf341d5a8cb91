#include "order.h"

#include "kdtree.h"
#include "select.h"

#include <math.h>

/* A tree from which rows are taken. */
typedef struct walk {
    pia_kdtree tree;
    pia_index *place, *still_there;
    unsigned char *gone;
    double *step;
} walk;

static pia_index count_rows(pia_index *still_there, pia_index begin, pia_index end)
{
    if (begin == end) return 0;
    pia_index middle = begin + (end - begin) / 2;
    count_rows(still_there, begin, middle);
    count_rows(still_there, middle + 1, end);
    return still_there[middle] = end - begin;
}

static void take(walk *w, pia_index row)
{
    pia_index begin = 0, end = w->tree.count, place = w->place[row];
    w->gone[row] = 1;
    for (;;) {
        pia_index middle = begin + (end - begin) / 2;
        w->still_there[middle]--;
        if (middle == place) return;
        if (place < middle)
            end = middle;
        else
            begin = middle + 1;
    }
}

/* The row farthest from the first one is at an end of most curves. */
static pia_index far_row(const pia_kdtree *tree)
{
    pia_index far = 0;
    double longest = 0;
    for (pia_index row = 1; row < tree->count; row++) {
        double square = 0;
        for (int d = 0; d < tree->dim; d++) square += pow(tree->points[row * tree->dim + d] - tree->points[d], 2);
        if (!(square > longest)) continue;
        longest = square;
        far = row;
    }
    return far;
}

static void go(walk *w, pia_index *order)
{
    pia_index count = w->tree.count;
    const pia_kdtree_filter filter = {.gone = w->gone, .still_there = w->still_there};
    for (pia_index i = 0; i < count; i++) w->place[w->tree.order[i]] = i;
    count_rows(w->still_there, 0, count);
    order[0] = far_row(&w->tree);
    take(w, order[0]);
    for (pia_index i = 1; i < count; i++) {
        double square = INFINITY;
        pia_index next = pia_kdtree_nearest(&w->tree, w->tree.points + order[i - 1] * w->tree.dim, &filter, &square);
        for (pia_index row = 0; next < 0; row++) /* all distances overflow: any that is left */
            if (!w->gone[row]) next = row;
        order[i] = next;
        w->step[i - 1] = sqrt(square);
        take(w, next);
    }
}

static void find_breaks(const walk *w, const pia_index *order, pia_order_report *report)
{
    pia_index steps = w->tree.count - 1;
    double median = pia_select(w->step, steps, steps / 2);
    for (pia_index i = 0; i < steps; i++) {
        double square = 0;
        for (int d = 0; d < w->tree.dim; d++)
            square += pow(w->tree.points[order[i] * w->tree.dim + d] - w->tree.points[order[i + 1] * w->tree.dim + d], 2);
        if (!(sqrt(square) > 10 * median)) continue;
        report->break_count++;
        if (!(sqrt(square) > report->break_length)) continue;
        report->break_length = sqrt(square);
        report->break_row = order[i];
    }
}

pia_status pia_order_nearest(pia_context *context, const double *points, pia_index count, int dim, pia_index *order,
                             pia_order_report *report)
{
    walk w = {.gone = NULL};
    pia_status status = pia_kdtree_open(context, points, count, dim, &w.tree);
    if (status != PIA_OK) return status;
    w.place = pia_take(context, count, sizeof *w.place);
    w.still_there = pia_take(context, count, sizeof *w.still_there);
    w.gone = pia_take_zero(context, count, 1);
    w.step = pia_take(context, count, sizeof *w.step);
    if (w.place != NULL && w.still_there != NULL && w.gone != NULL && w.step != NULL) {
        go(&w, order);
        if (count > 1) find_breaks(&w, order, report);
    } else {
        status = pia_take_status(context, count, sizeof *w.step);
    }
    pia_give(context, w.step);
    pia_give(context, w.gone);
    pia_give(context, w.still_there);
    pia_give(context, w.place);
    pia_kdtree_close(context, &w.tree);
    return status;
}
