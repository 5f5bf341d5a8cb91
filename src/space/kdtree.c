#include "kdtree.h"

#include <math.h>

typedef struct stretch {
    pia_index begin, end;
} stretch;

static double at(const pia_kdtree *tree, pia_index place, int axis)
{
    return tree->points[tree->order[place] * tree->dim + axis];
}

static int longest_axis(const pia_kdtree *tree, stretch s)
{
    int axis = 0;
    double longest = -1;
    for (int d = 0; d < tree->dim; d++) {
        double low = INFINITY, high = -INFINITY;
        for (pia_index i = s.begin; i < s.end; i++) {
            low = fmin(low, at(tree, i, d));
            high = fmax(high, at(tree, i, d));
        }
        if (!(high - low > longest)) continue;
        longest = high - low;
        axis = d;
    }
    return axis;
}

static int comes_before(const pia_kdtree *tree, pia_index row, pia_index other, int axis)
{
    double a = tree->points[row * tree->dim + axis], b = tree->points[other * tree->dim + axis];
    return a < b || (a == b && row < other);
}

/* Hoare's selection: the row that belongs there comes to `middle`, smaller ones before it, larger ones behind. */
static void select_middle(pia_kdtree *tree, stretch s, pia_index middle, int axis)
{
    pia_index low = s.begin, high = s.end - 1, *order = tree->order;
    while (low < high) {
        pia_index pivot = order[low + (high - low) / 2], i = low, j = high;
        while (i <= j) {
            while (comes_before(tree, order[i], pivot, axis)) i++;
            while (comes_before(tree, pivot, order[j], axis)) j--;
            if (i > j) break;
            pia_index swap = order[i];
            order[i++] = order[j];
            order[j--] = swap;
        }
        if (middle <= j)
            high = j;
        else if (middle >= i)
            low = i;
        else
            return;
    }
}

static pia_index middle_of(stretch s)
{
    return s.begin + (s.end - s.begin) / 2;
}

/* As deep as the logarithm of the count. */
static void build(pia_kdtree *tree, stretch s)
{
    while (s.end - s.begin > 0) {
        pia_index middle = middle_of(s);
        int axis = longest_axis(tree, s);
        select_middle(tree, s, middle, axis);
        tree->axis[middle] = axis;
        build(tree, (stretch){s.begin, middle});
        s.begin = middle + 1;
    }
}

pia_status pia_kdtree_open(pia_context *context, const double *points, pia_index count, int dim, pia_kdtree *out)
{
    pia_kdtree tree = {points, count, dim, pia_take(context, count, sizeof *tree.order), pia_take(context, count, sizeof *tree.axis)};
    if (tree.order == NULL || tree.axis == NULL) {
        pia_kdtree_close(context, &tree);
        return pia_take_status(context, count, sizeof *tree.order);
    }
    for (pia_index i = 0; i < count; i++) tree.order[i] = i;
    build(&tree, (stretch){0, count});
    *out = tree;
    return PIA_OK;
}

void pia_kdtree_close(pia_context *context, pia_kdtree *tree)
{
    pia_give(context, tree->order);
    pia_give(context, tree->axis);
    *tree = (pia_kdtree){.count = 0};
}

typedef struct search {
    const pia_kdtree *tree;
    const double *point;
    const pia_kdtree_filter *filter;
    double square;
    pia_index row;
} search;

static int stretch_is_out(const pia_kdtree_filter *f, pia_index middle)
{
    if (f->group != NULL) return f->all_group[middle] == f->own;
    return f->gone != NULL && f->still_there[middle] == 0;
}

static int row_is_out(const pia_kdtree_filter *f, pia_index row)
{
    return f->group != NULL ? f->group[row] == f->own : f->gone != NULL && f->gone[row];
}

static void look_at(search *q, pia_index row)
{
    const pia_kdtree *tree = q->tree;
    double square = 0;
    for (int d = 0; d < tree->dim; d++) {
        double away = tree->points[row * tree->dim + d] - q->point[d];
        square += away * away;
    }
    if (square < q->square || (square == q->square && q->row >= 0 && row < q->row)) {
        q->square = square;
        q->row = row;
    }
}

static void look_below(search *q, stretch s)
{
    while (s.end > s.begin) {
        pia_index middle = middle_of(s), row = q->tree->order[middle];
        if (stretch_is_out(q->filter, middle)) return;
        if (!row_is_out(q->filter, row)) look_at(q, row);
        int axis = q->tree->axis[middle];
        double away = q->point[axis] - at(q->tree, middle, axis);
        stretch below = {s.begin, middle}, above = {middle + 1, s.end};
        look_below(q, away < 0 ? below : above);
        if (away * away > q->square) return;
        s = away < 0 ? above : below;
    }
}

pia_index pia_kdtree_nearest(const pia_kdtree *tree, const double *point, const pia_kdtree_filter *filter, double *square)
{
    static const pia_kdtree_filter all = {.own = -1};
    search q = {tree, point, filter != NULL ? filter : &all, *square, -1};
    look_below(&q, (stretch){0, tree->count});
    *square = q.square;
    return q.row;
}
