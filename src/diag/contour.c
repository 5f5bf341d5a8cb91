#include "contour.h"

#include <math.h>
#include <string.h>

/* The cell whose lower corner is node (i, j), i from -1 to count[0] - 1; sides are numbered around it: 0 low v, 1 high u, 2 high v, 3
 * low u. A contour leaves a cell through the side through which it enters the next. */
typedef struct walk {
    const pia_raster *raster;
    const double *value;
    unsigned char *seen; /* [cells]: entered from below */
} walk;

typedef struct cell {
    pia_index i, j;
} cell;

static const int corner[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};

static double value_at(const walk *w, pia_index i, pia_index j)
{
    const pia_index *count = w->raster->count;
    return i >= 0 && i < count[0] && j >= 0 && j < count[1] ? w->value[i * count[1] + j] : -INFINITY;
}

static int is_inside(const walk *w, cell c, int k)
{
    return value_at(w, c.i + corner[k & 3][0], c.j + corner[k & 3][1]) > 0;
}

/* Where the contour crosses side k, between its corners k and k + 1: never at a node, so that contours do not touch; but at the node
 * inside where the other one is not of the raster. */
static void cross(const walk *w, cell c, int k, double at[2])
{
    const int *a = corner[k], *b = corner[(k + 1) & 3];
    double x = value_at(w, c.i + a[0], c.j + a[1]), y = value_at(w, c.i + b[0], c.j + b[1]), share;
    if (isinf(x) || isinf(y))
        share = isinf(x) ? 1 : 0;
    else
        share = fmin(fmax(x / (x - y), 0.02), 0.98);
    at[0] = ((double)(c.i + a[0]) + share * (b[0] - a[0])) * w->raster->step[0];
    at[1] = ((double)(c.j + a[1]) + share * (b[1] - a[1])) * w->raster->step[1];
}

/* Inside to the left: a contour enters where, around the cell, outside comes after inside, and leaves where inside comes after outside;
 * of two such sides by the one before, so that corners that are inside but not neighbours are apart. */
static int exit_of(const walk *w, cell c, int entry)
{
    for (int k = 3; k > 0; k--) {
        int side = (entry + k) & 3;
        if (!is_inside(w, c, side) && is_inside(w, c, side + 1)) return side;
    }
    return entry;
}

static pia_status add_vertex(pia_context *context, pia_loops *loops, const double at[2])
{
    pia_index first = loops->vertex_total - loops->vertex_count[loops->loop_count - 1];
    const double *last = loops->at != NULL ? loops->at + 2 * (loops->vertex_total - 1) : NULL;
    if (loops->vertex_total > first && last[0] == at[0] && last[1] == at[1]) return PIA_OK;
    void *block = loops->at;
    int grown = pia_memory_grow(pia_memory_of(context), &block, &loops->vertex_room, loops->vertex_total + 1, 2 * sizeof(double));
    loops->at = block;
    if (!grown) return pia_fail(context, PIA_E_MEMORY, "out of memory for an outline of %lld vertices", (long long)loops->vertex_total);
    memcpy(loops->at + 2 * loops->vertex_total++, at, 2 * sizeof *at);
    loops->vertex_count[loops->loop_count - 1]++;
    return PIA_OK;
}

static pia_status add_loop(pia_context *context, pia_loops *loops)
{
    void *block = loops->vertex_count;
    int grown = pia_memory_grow(pia_memory_of(context), &block, &loops->loop_room, loops->loop_count + 1, sizeof(pia_index));
    loops->vertex_count = block;
    if (!grown) return pia_fail(context, PIA_E_MEMORY, "out of memory for an outline of %lld loops", (long long)loops->loop_count);
    loops->vertex_count[loops->loop_count++] = 0;
    return PIA_OK;
}

/* From the side 0 of a cell, entered from below, around to it. */
static pia_status follow(pia_context *context, walk *w, cell begin, pia_loops *loops)
{
    static const int step[4][2] = {{0, -1}, {1, 0}, {0, 1}, {-1, 0}};
    cell c = begin;
    int side = 0;
    pia_status status = add_loop(context, loops);
    do {
        double at[2];
        if (side == 0) w->seen[(c.i + 1) * (w->raster->count[1] + 1) + c.j + 1] = 1;
        cross(w, c, side, at);
        if (status == PIA_OK) status = add_vertex(context, loops, at);
        int out = exit_of(w, c, side);
        c.i += step[out][0];
        c.j += step[out][1];
        side = (out + 2) & 3;
    } while (status == PIA_OK && (c.i != begin.i || c.j != begin.j || side != 0));
    if (status != PIA_OK) return status;
    pia_index *count = &loops->vertex_count[loops->loop_count - 1];
    const double *first = loops->at + 2 * (loops->vertex_total - *count), *last = loops->at + 2 * (loops->vertex_total - 1);
    if (*count > 1 && first[0] == last[0] && first[1] == last[1]) {
        (*count)--;
        loops->vertex_total--;
    }
    if (*count >= 3) return PIA_OK;
    loops->vertex_total -= *count; /* a single node of the border */
    loops->loop_count--;
    return PIA_OK;
}

pia_status pia_contour(pia_context *context, const pia_raster *raster, const double *value, pia_loops *out)
{
    const pia_index *count = raster->count;
    pia_loops loops = {0};
    pia_index cells = (count[0] + 1) * (count[1] + 1);
    walk w = {raster, value, pia_take_zero(context, cells, 1)};
    pia_status status = w.seen != NULL ? PIA_OK : pia_take_status(context, cells, 1);
    for (pia_index i = -1; i < count[0] && status == PIA_OK; i++)
        for (pia_index j = -1; j < count[1] && status == PIA_OK; j++) {
            cell c = {i, j};
            int enters = is_inside(&w, c, 0) && !is_inside(&w, c, 1);
            if (enters && !w.seen[(i + 1) * (count[1] + 1) + j + 1]) status = follow(context, &w, c, &loops);
        }
    pia_give(context, w.seen);
    if (status == PIA_OK)
        *out = loops;
    else
        pia_loops_clear(context, &loops);
    return status;
}

void pia_loops_clear(pia_context *context, pia_loops *loops)
{
    pia_give(context, loops->vertex_count);
    pia_give(context, loops->at);
    *loops = (pia_loops){0};
}

double pia_loop_area(const double *at, pia_index count)
{
    double twice = 0;
    for (pia_index i = 0; i < count; i++) {
        const double *p = at + 2 * i, *q = at + 2 * (i + 1 < count ? i + 1 : 0);
        twice += (p[0] - at[0]) * (q[1] - at[1]) - (p[1] - at[1]) * (q[0] - at[0]);
    }
    return twice / 2;
}

static double distance_to_chord(const double *p, const double *a, const double *b)
{
    double x = b[0] - a[0], y = b[1] - a[1], length = x * x + y * y;
    double share = length > 0 ? fmin(fmax(((p[0] - a[0]) * x + (p[1] - a[1]) * y) / length, 0), 1) : 0;
    return hypot(p[0] - a[0] - share * x, p[1] - a[1] - share * y);
}

/* Marks what stays strictly between two vertices; `end` may be `count`, which is vertex 0. */
static void keep_between(const double *at, pia_index count, pia_index begin, pia_index end, double tolerance, unsigned char *keep)
{
    while (end - begin > 1) {
        pia_index far = begin;
        double worst = tolerance;
        for (pia_index i = begin + 1; i < end; i++) {
            double away = distance_to_chord(at + 2 * i, at + 2 * begin, at + 2 * (end % count));
            if (!(away > worst)) continue;
            worst = away;
            far = i;
        }
        if (far == begin) return;
        keep[far] = 1;
        /* the smaller half on the stack, so that it stays flat */
        if (far - begin < end - far) {
            keep_between(at, count, begin, far, tolerance, keep);
            begin = far;
        } else {
            keep_between(at, count, far, end, tolerance, keep);
            end = far;
        }
    }
}

pia_index pia_loop_simplify(double *at, pia_index count, double tolerance, unsigned char *keep)
{
    pia_index far = 0, kept = 0;
    double longest = 0;
    if (count < 4) return count;
    memset(keep, 0, (size_t)count);
    for (pia_index i = 1; i < count; i++) {
        double away = hypot(at[2 * i] - at[0], at[2 * i + 1] - at[1]);
        if (!(away > longest)) continue;
        longest = away;
        far = i;
    }
    keep[0] = keep[far] = 1;
    keep_between(at, count, 0, far, tolerance, keep);
    keep_between(at, count, far, count, tolerance, keep);
    for (pia_index i = 0; i < count; i++) kept += keep[i];
    if (kept < 3) return count;
    kept = 0;
    for (pia_index i = 0; i < count; i++)
        if (keep[i]) memmove(at + 2 * kept++, at + 2 * i, 2 * sizeof *at);
    return kept;
}
