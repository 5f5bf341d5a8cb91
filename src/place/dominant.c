#include "dominant.h"

#include <math.h>
#include <stdlib.h>

static const double EQUAL = 1e-9; /* curvatures this near, relative to the largest, make a plateau */

static pia_index count_marks(const unsigned char *mark, pia_index count)
{
    pia_index marked = 0;
    for (pia_index i = 0; i < count; i++) marked += mark[i];
    return marked;
}

pia_index pia_dominant_mark(const double *curvature, pia_index count, double share, unsigned char *mark)
{
    double largest = 0;
    for (pia_index i = 0; i < count; i++) largest = fmax(largest, curvature[i]);
    for (pia_index first = 1, end; first + 1 < count; first = end) {
        double here = curvature[first], equal = EQUAL * largest;
        for (end = first + 1; end < count && fabs(curvature[end] - here) <= equal;) end++;
        int rises = curvature[first - 1] < here - equal, falls = end < count && curvature[end] < here - equal;
        if (rises && falls && here > share * largest) mark[first + (end - 1 - first) / 2] = 1;
    }
    mark[0] = mark[count - 1] = 1;
    return count_marks(mark, count);
}

typedef struct candidate {
    double curvature;
    pia_index line;
} candidate;

static int compare(const void *a, const void *b)
{
    const candidate *p = a, *q = b;
    if (p->curvature != q->curvature) return p->curvature < q->curvature ? -1 : 1;
    return (p->line > q->line) - (p->line < q->line);
}

pia_status pia_dominant_thin(pia_context *context, const double *curvature, pia_index count, pia_index wanted,
                             const unsigned char *pinned, unsigned char *mark)
{
    pia_index marked = count_marks(mark, count), found = 0;
    if (marked <= wanted) return PIA_OK;
    candidate *order = pia_take(context, marked, sizeof *order);
    if (order == NULL) return pia_take_status(context, marked, sizeof *order);
    for (pia_index i = 1; i + 1 < count; i++)
        if (mark[i] && !(pinned != NULL && pinned[i])) order[found++] = (candidate){curvature[i], i};
    qsort(order, (size_t)found, sizeof *order, compare);
    for (pia_index k = 0; k < found && marked > wanted; k++, marked--) mark[order[k].line] = 0;
    pia_give(context, order);
    return PIA_OK;
}

/* The unmarked line nearest to the middle of the gap between marked lines. */
static pia_index middle_line(const double *parameters, pia_index from, pia_index to)
{
    double middle = parameters[from] + (parameters[to] - parameters[from]) / 2;
    pia_index best = from + 1;
    for (pia_index i = from + 2; i < to; i++)
        if (fabs(parameters[i] - middle) < fabs(parameters[best] - middle)) best = i;
    return best;
}

pia_index pia_dominant_fill(const double *parameters, pia_index count, pia_index wanted, unsigned char *mark)
{
    pia_index marked = count_marks(mark, count);
    for (; marked < wanted; marked++) {
        pia_index last = 0, from = -1, to = -1;
        for (pia_index i = 1; i < count; i++) {
            if (!mark[i]) continue;
            if (i > last + 1 && (from < 0 || parameters[i] - parameters[last] > parameters[to] - parameters[from])) {
                from = last;
                to = i;
            }
            last = i;
        }
        if (from < 0) break;
        mark[middle_line(parameters, from, to)] = 1;
    }
    return marked;
}
