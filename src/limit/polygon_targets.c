#include "polygon.h"

#include <math.h>
#include <string.h>

/* Edge from vertex i to the next; returns 0 when it has no length. */
static int edge(const pia_iterate *iterate, const double *scale, pia_index i, double out[2])
{
    double a[2], b[2];
    pia_polygon_point(iterate, scale, i, a);
    pia_polygon_point(iterate, scale, i + 1, b);
    for (int d = 0; d < 2; d++) out[d] = b[d] - a[d];
    return out[0] != 0 || out[1] != 0;
}

static double turn(const double a[2], const double b[2])
{
    double cross = a[0] * b[1] - a[1] * b[0];
    return fabs(cross) <= 1e-12 * hypot(a[0], a[1]) * hypot(b[0], b[1]) ? 0 : cross > 0 ? 1 : -1;
}

/* Turns between edges that have a length, given to every vertex where these edges meet. */
static void find_turns(const pia_iterate *iterate, const double *scale, double *sign)
{
    pia_index n = iterate->op->cols, met = 0; /* the first of the vertices that coincide with vertex i */
    pia_index edges = pia_polygon_closed(iterate) ? 2 * n : n - 1;
    double before[2] = {0, 0}, after[2];
    memset(sign, 0, (size_t)n * sizeof *sign);
    for (pia_index i = 0; i < edges; i++) {
        if (!edge(iterate, scale, i, after)) continue;
        for (; met <= i; met++) sign[pia_polygon_vertex(iterate, met)] = turn(before, after);
        memcpy(before, after, sizeof before);
    }
}

/* Straight vertices between from and to, whose turns are known. */
static void split(double *sign, pia_index count, pia_index from, pia_index to)
{
    pia_index half = (to - from) / 2;
    int same = sign[from % count] == sign[to % count];
    for (pia_index k = 1; k < to - from; k++)
        sign[(from + k) % count] = same || k < to - from - half ? sign[from % count] : sign[to % count];
    if (!same && (to - from) % 2 == 0) sign[(from + half) % count] = 0;
}

static int fill_straight(double *sign, pia_index count, int closed)
{
    pia_index start = 0, last;
    while (start < count && sign[start] == 0) start++;
    if (start >= count) return 0;
    for (pia_index k = 0; k < start && !closed; k++) sign[k] = sign[start];
    last = start;
    for (pia_index k = start + 1; k < (closed ? start + count + 1 : count); k++) {
        if (sign[k % count] == 0) continue;
        split(sign, count, last, k);
        last = k;
    }
    for (pia_index k = last + 1; k < count && !closed; k++) sign[k] = sign[last];
    return 1;
}

int pia_polygon_targets(const pia_iterate *iterate, const double *scale, double *sign)
{
    pia_index first, end;
    find_turns(iterate, scale, sign);
    pia_polygon_turns(iterate, &first, &end);
    return fill_straight(sign + first, end - first, pia_polygon_closed(iterate));
}
