#include "order.h"

#include "spanning_tree.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* The tree as lists of neighbours, and a walk over it. */
typedef struct network {
    pia_index count;
    const pia_tree_edge *edge; /* [count - 1] shortest first */
    pia_index *begin;          /* [count + 1] where the neighbours of a row begin */
    pia_index *incident;       /* [2 (count - 1)] edges */
    pia_index *from;           /* [count] the row from which the walk came; -1: it began there; -2: not reached */
    double *away;              /* [count] length of the way */
    pia_index *queue;          /* [count] rows in the order of the walk */
} network;

static void list_neighbours(network *n)
{
    pia_index edges = n->count - 1;
    memset(n->begin, 0, (size_t)(n->count + 1) * sizeof *n->begin);
    for (pia_index e = 0; e < 2 * edges; e++) n->begin[n->edge[e / 2].row[e % 2] + 1]++;
    for (pia_index row = 0; row < n->count; row++) n->begin[row + 1] += n->begin[row];
    for (pia_index e = 0; e < 2 * edges; e++) n->incident[n->begin[n->edge[e / 2].row[e % 2]]++] = e / 2;
    memmove(n->begin + 1, n->begin, (size_t)n->count * sizeof *n->begin);
    n->begin[0] = 0;
}

/* On from the `queued` rows of the queue, whose `from` and `away` are known, to all that are not reached. */
static void walk_on(network *n, pia_index queued)
{
    for (pia_index i = 0; i < queued; i++) {
        pia_index row = n->queue[i];
        for (pia_index k = n->begin[row]; k < n->begin[row + 1]; k++) {
            const pia_tree_edge *edge = &n->edge[n->incident[k]];
            pia_index next = edge->row[edge->row[0] == row];
            if (n->from[next] != -2) continue;
            n->from[next] = row;
            n->away[next] = n->away[row] + edge->length;
            n->queue[queued++] = next;
        }
    }
}

/* A walk from one row; the row farthest away, of equal ones the smallest. */
static pia_index walk_from(network *n, pia_index row)
{
    pia_index far = row;
    for (pia_index i = 0; i < n->count; i++) n->from[i] = -2;
    n->from[row] = -1;
    n->away[row] = 0;
    n->queue[0] = row;
    walk_on(n, 1);
    for (pia_index i = 0; i < n->count; i++)
        if (n->away[i] > n->away[far] || (n->away[i] == n->away[far] && i < far)) far = i;
    return far;
}

/* The longest path into `path`; returns its rows. It begins at the end with the smaller row. */
static pia_index find_path(network *n, pia_index *path)
{
    pia_index end = walk_from(n, 0), other = walk_from(n, end), length = 0;
    if (other > end) {
        pia_index swap = end;
        end = other;
        other = walk_from(n, swap) == end ? swap : other;
        walk_from(n, end);
    }
    for (pia_index row = other; row != -1; row = n->from[row]) path[length++] = row;
    return length;
}

typedef struct stop {
    pia_index at, row; /* index of the row of the path where its twig leaves */
    double away;
} stop;

static int by_stop(const void *a, const void *b)
{
    const stop *p = a, *q = b;
    if (p->at != q->at) return p->at < q->at ? -1 : 1;
    if (p->away != q->away) return p->away < q->away ? -1 : 1;
    return (p->row > q->row) - (p->row < q->row);
}

/* All rows by where their twig leaves the path, then by the way along it; and how many twigs are long. */
static void line_up(network *n, const pia_index *path, pia_index length, stop *stops, pia_order_report *report)
{
    double median = n->count > 1 ? n->edge[(n->count - 1) / 2].length : 0;
    for (pia_index i = 0; i < n->count; i++) n->from[i] = -2;
    for (pia_index i = 0; i < length; i++) {
        n->from[path[i]] = -1;
        n->away[path[i]] = 0;
        stops[path[i]] = (stop){i, path[i], 0};
        n->queue[i] = path[i];
    }
    walk_on(n, length);
    for (pia_index i = length; i < n->count; i++) {
        pia_index row = n->queue[i];
        stops[row] = (stop){stops[n->from[row]].at, row, n->away[row]};
    }
    qsort(stops, (size_t)n->count, sizeof *stops, by_stop);
    for (pia_index i = 0; i < n->count; i++) {
        int last = i + 1 == n->count || stops[i + 1].at != stops[i].at;
        if (!last || !(stops[i].away > 10 * median)) continue;
        report->break_count++;
        if (!(stops[i].away > report->break_length)) continue;
        report->break_length = stops[i].away;
        report->break_row = path[stops[i].at];
    }
}

static pia_status line_up_network(pia_context *context, network *n, pia_index *order, pia_order_report *report)
{
    pia_index count = n->count;
    stop *stops = pia_take(context, count, sizeof *stops);
    n->begin = pia_take(context, count + 1, sizeof *n->begin);
    n->incident = pia_take(context, 2 * count, sizeof *n->incident);
    n->from = pia_take(context, count, sizeof *n->from);
    n->away = pia_take(context, count, sizeof *n->away);
    n->queue = pia_take(context, count, sizeof *n->queue);
    pia_status status = PIA_OK;
    if (stops != NULL && n->begin != NULL && n->incident != NULL && n->from != NULL && n->away != NULL && n->queue != NULL) {
        list_neighbours(n);
        pia_index length = find_path(n, order);
        line_up(n, order, length, stops, report);
        for (pia_index i = 0; i < count; i++) order[i] = stops[i].row;
    } else {
        status = pia_take_status(context, 2 * count, sizeof *stops);
    }
    pia_give(context, n->queue);
    pia_give(context, n->away);
    pia_give(context, n->from);
    pia_give(context, n->incident);
    pia_give(context, n->begin);
    pia_give(context, stops);
    return status;
}

pia_status pia_order_tree(pia_context *context, const double *points, pia_index count, int dim, pia_index *order,
                          pia_order_report *report)
{
    pia_tree_edge *edge;
    pia_status status = pia_spanning_tree(context, points, count, dim, &edge);
    if (status != PIA_OK) return status;
    network n = {.count = count, .edge = edge};
    status = line_up_network(context, &n, order, report);
    pia_give(context, edge);
    return status;
}
