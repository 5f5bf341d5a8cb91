#include "hull.h"

#include <stdlib.h>
#include <string.h>

typedef struct point {
    double x, y;
} point;

static int by_place(const void *a, const void *b)
{
    const point *p = a, *q = b;
    if (p->x != q->x) return p->x < q->x ? -1 : 1;
    return (p->y > q->y) - (p->y < q->y);
}

static int turns_left(const point *a, const point *b, const point *c)
{
    return (b->x - a->x) * (c->y - a->y) - (b->y - a->y) * (c->x - a->x) > 0;
}

/* The chain grows on top of `chain`, not below the first `floor` points; returns its size. */
static pia_index add(point *chain, pia_index size, pia_index floor, const point *next)
{
    while (size > floor && !turns_left(&chain[size - 2], &chain[size - 1], next)) size--;
    chain[size] = *next;
    return size + 1;
}

pia_status pia_hull(pia_context *context, double *at, pia_index count, pia_index *corners)
{
    pia_index size = 0, below;
    point *sorted = pia_take(context, count, sizeof *sorted), *chain = pia_take(context, 2 * count + 1, sizeof *chain);
    pia_status status = sorted != NULL && chain != NULL ? PIA_OK : pia_take_status(context, 2 * count + 1, sizeof *chain);
    if (status == PIA_OK) {
        memcpy(sorted, at, (size_t)count * sizeof *sorted);
        qsort(sorted, (size_t)count, sizeof *sorted, by_place);
        for (pia_index i = 0; i < count; i++) size = add(chain, size, 1, &sorted[i]);
        below = size;
        for (pia_index i = count - 1; i-- > 0;) size = add(chain, size, below, &sorted[i]);
        size--; /* the first one again */
        if (size < 3)
            status = pia_fail(context, PIA_E_DATA, "all points lie on one line of the parameter plane, which has no hull");
        else
            memcpy(at, chain, (size_t)size * sizeof *chain);
        *corners = size;
    }
    pia_give(context, sorted);
    pia_give(context, chain);
    return status;
}
