#include "spanning_tree.h"

#include "kdtree.h"

#include <math.h>
#include <stdlib.h>

/* A forest that grows together. In every round each of its trees takes the shortest edge to another one. Ties are broken by rows, the
 * same way everywhere, so that no circle closes. */
typedef struct forest {
    pia_kdtree tree;
    pia_index *group;     /* [count] smallest row of the tree a row is in, after `settle` */
    pia_index *all_group; /* [count] see kdtree.h */
    pia_tree_edge *best;  /* [count] by group: its shortest edge outwards; row[1] -1: none yet */
    pia_tree_edge *edge;  /* [count - 1] taken */
    pia_index taken;
} forest;

static pia_index root_of(pia_index *group, pia_index row)
{
    while (group[row] != row) row = group[row] = group[group[row]];
    return row;
}

/* all_group of the stretch; -2 for an empty one. */
static pia_index mark(forest *f, pia_index begin, pia_index end)
{
    if (begin == end) return -2;
    pia_index middle = begin + (end - begin) / 2, own = f->group[f->tree.order[middle]];
    pia_index below = mark(f, begin, middle), above = mark(f, middle + 1, end);
    int same = (below == -2 || below == own) && (above == -2 || above == own);
    return f->all_group[middle] = same ? own : -1;
}

static int is_shorter(const pia_tree_edge *a, const pia_tree_edge *b)
{
    if (a->length != b->length) return a->length < b->length;
    if (a->row[0] != b->row[0]) return a->row[0] < b->row[0];
    return a->row[1] < b->row[1];
}

static int by_length(const void *a, const void *b)
{
    return is_shorter(a, b) ? -1 : is_shorter(b, a);
}

/* The shortest edge out of each tree; lengths are squares here. */
static void find_best(forest *f)
{
    pia_index count = f->tree.count;
    for (pia_index row = 0; row < count; row++) f->best[row] = (pia_tree_edge){{-1, -1}, INFINITY};
    for (pia_index row = 0; row < count; row++) {
        pia_tree_edge *best = &f->best[f->group[row]];
        pia_kdtree_filter filter = {.group = f->group, .all_group = f->all_group, .own = f->group[row]};
        double square = nextafter(best->length, INFINITY);
        pia_index other = pia_kdtree_nearest(&f->tree, f->tree.points + row * f->tree.dim, &filter, &square);
        if (other < 0) continue;
        pia_tree_edge edge = {{row < other ? row : other, row < other ? other : row}, square};
        if (best->row[1] < 0 || is_shorter(&edge, best)) *best = edge;
    }
}

static void join(forest *f)
{
    pia_index count = f->tree.count;
    for (pia_index g = 0; g < count; g++) {
        const pia_tree_edge *edge = &f->best[g];
        if (edge->row[1] < 0) continue;
        pia_index a = root_of(f->group, edge->row[0]), b = root_of(f->group, edge->row[1]);
        if (a == b) continue; /* the other tree took the same edge */
        f->group[a < b ? b : a] = a < b ? a : b;
        f->edge[f->taken++] = *edge;
    }
    for (pia_index row = 0; row < count; row++) f->group[row] = root_of(f->group, row);
}

/* Trees that stay apart are farther from each other than a double can tell: 1e154. */
static pia_status grow(pia_context *context, forest *f)
{
    pia_index count = f->tree.count, before = -1;
    for (pia_index row = 0; row < count; row++) f->group[row] = row;
    while (f->taken < count - 1 && f->taken > before) {
        before = f->taken;
        mark(f, 0, count);
        find_best(f);
        join(f);
    }
    for (pia_index e = 0; e < f->taken; e++) f->edge[e].length = sqrt(f->edge[e].length);
    qsort(f->edge, (size_t)f->taken, sizeof *f->edge, by_length);
    if (f->taken == count - 1) return PIA_OK;
    return pia_fail(context, PIA_E_DATA, "the points lie too far apart to measure their distances; rescale them");
}

pia_status pia_spanning_tree(pia_context *context, const double *points, pia_index count, int dim, pia_tree_edge **edges)
{
    forest f = {.taken = 0};
    pia_status status = pia_kdtree_open(context, points, count, dim, &f.tree);
    if (status != PIA_OK) return status;
    f.group = pia_take(context, count, sizeof *f.group);
    f.all_group = pia_take(context, count, sizeof *f.all_group);
    f.best = pia_take(context, count, sizeof *f.best);
    f.edge = pia_take(context, count, sizeof *f.edge);
    if (f.group != NULL && f.all_group != NULL && f.best != NULL && f.edge != NULL) {
        status = grow(context, &f);
    } else {
        status = pia_take_status(context, count, sizeof *f.best);
    }
    if (status == PIA_OK)
        *edges = f.edge;
    else
        pia_give(context, f.edge);
    pia_give(context, f.best);
    pia_give(context, f.all_group);
    pia_give(context, f.group);
    pia_kdtree_close(context, &f.tree);
    return status;
}
