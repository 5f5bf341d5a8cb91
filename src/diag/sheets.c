#include "sheets.h"

#include "kdtree.h"

#include <math.h>
#include <string.h>

/* Rows of a neighbourhood at most, and of a group at least; fewer are outliers. */
enum { MOST = 32, GROUP = 3 };

/* Share of a neighbourhood that its groups hold, and of the mixed pairs of neighbours that chance makes. */
static const double HELD = 0.75, MIXED = 0.5;

/* One neighbourhood. */
typedef struct patch {
    const double *uv, *points;
    int dim, count;
    double apart;
    pia_index row[MOST];
    double away[MOST][PIA_MAX_DIM]; /* from the linear trend */
    double along[MOST];             /* the line on which the groups stand */
    int sorted[MOST], group[MOST];  /* by `along`; -1: none */
} patch;

static double distance(const double *a, const double *b, int dim)
{
    double sum = 0;
    for (int d = 0; d < dim; d++) sum = hypot(sum, a[d] - b[d]);
    return sum;
}

static int nearest_to(const patch *p, int i)
{
    int nearest = -1;
    double least = INFINITY;
    for (int j = 0; j < p->count; j++) {
        double away = distance(p->points + p->row[i] * p->dim, p->points + p->row[j] * p->dim, p->dim);
        if (j == i || !(away < least)) continue;
        least = away;
        nearest = j;
    }
    return nearest;
}

/* What is left of the points beside the linear function of (u, v) that fits the ways from each to the nearest in space best: that is on
 * the same sheet, so that the slope is theirs, whatever is between sheets. */
static void take_trend_away(patch *p)
{
    double h[3] = {0, 0, 0}, g[2][PIA_MAX_DIM] = {{0}};
    for (int i = 0; i < p->count; i++) {
        int j = nearest_to(p, i);
        if (j < 0) continue;
        const double *t = p->uv + 2 * p->row[i], *s = p->uv + 2 * p->row[j];
        double u = t[0] - s[0], v = t[1] - s[1];
        h[0] += u * u;
        h[1] += u * v;
        h[2] += v * v;
        for (int d = 0; d < p->dim; d++) {
            double x = p->points[p->row[i] * p->dim + d] - p->points[p->row[j] * p->dim + d];
            g[0][d] += u * x;
            g[1][d] += v * x;
        }
    }
    double det = h[0] * h[2] - h[1] * h[1];
    int spreads = det > 1e-6 * h[0] * h[2];
    const double *from = p->uv + 2 * p->row[0];
    for (int d = 0; d < p->dim; d++) {
        double slope[2] = {spreads ? (h[2] * g[0][d] - h[1] * g[1][d]) / det : 0,
                           spreads ? (h[0] * g[1][d] - h[1] * g[0][d]) / det : 0};
        for (int i = 0; i < p->count; i++) {
            const double *t = p->uv + 2 * p->row[i];
            p->away[i][d] = p->points[p->row[i] * p->dim + d] - p->points[p->row[0] * p->dim + d] - slope[0] * (t[0] - from[0]) -
                            slope[1] * (t[1] - from[1]);
        }
    }
}

static int farthest_from(const patch *p, int from)
{
    int far = from;
    for (int i = 0; i < p->count; i++)
        if (distance(p->away[i], p->away[from], p->dim) > distance(p->away[far], p->away[from], p->dim)) far = i;
    return far;
}

/* Positions along the line through two points that are far apart, and their order. */
static void put_on_line(patch *p)
{
    int a = farthest_from(p, 0), b = farthest_from(p, a);
    double length = distance(p->away[a], p->away[b], p->dim);
    for (int i = 0; i < p->count; i++) {
        int k = i;
        p->along[i] = 0;
        for (int d = 0; d < p->dim && length > 0; d++)
            p->along[i] += (p->away[i][d] - p->away[a][d]) * ((p->away[b][d] - p->away[a][d]) / length);
        for (; k > 0 && p->along[p->sorted[k - 1]] > p->along[i]; k--) p->sorted[k] = p->sorted[k - 1];
        p->sorted[k] = i;
    }
}

static double gap_before(const patch *p, int k)
{
    return p->along[p->sorted[k]] - p->along[p->sorted[k - 1]];
}

/* Groups between gaps of at least half the widest one. Returns how many rows those hold that are thinner than that; 0 where there is
 * no second. */
static int find_groups(patch *p)
{
    double widest = 0;
    int groups = 0, held = 0;
    for (int k = 1; k < p->count; k++) widest = fmax(widest, gap_before(p, k));
    for (int i = 0; i < p->count; i++) p->group[i] = -1;
    if (!(widest > p->apart)) return 0;
    double cut = fmax(p->apart, widest / 2);
    for (int begin = 0, end; begin < p->count; begin = end) {
        for (end = begin + 1; end < p->count && !(gap_before(p, end) > cut);) end++;
        if (end - begin < GROUP || !(p->along[p->sorted[end - 1]] - p->along[p->sorted[begin]] < widest)) continue;
        for (int k = begin; k < end; k++) p->group[p->sorted[k]] = groups;
        held += end - begin;
        groups++;
    }
    return groups > 1 ? held : 0;
}

static double between(const patch *p, int i, int j)
{
    return hypot(p->uv[2 * p->row[i]] - p->uv[2 * p->row[j]], p->uv[2 * p->row[i] + 1] - p->uv[2 * p->row[j] + 1]);
}

/* Whether neighbours in the parameter plane belong to different groups about as often as they would by chance; the nearest such. */
static int is_mixed(const patch *p, int held, int pair[2])
{
    double alike = 0, nearest = INFINITY;
    int mixed = 0;
    for (int i = 0; i < p->count; i++) {
        int next = -1, same = 0;
        for (int j = 0; j < p->count && p->group[i] >= 0; j++) {
            if (p->group[j] < 0) continue;
            same += p->group[j] == p->group[i];
            if (j != i && (next < 0 || between(p, i, j) < between(p, i, next))) next = j;
        }
        if (next < 0) continue;
        alike += (double)same / held;
        if (p->group[next] == p->group[i]) continue;
        mixed++;
        if (!(between(p, i, next) < nearest)) continue;
        nearest = between(p, i, next);
        pair[0] = i;
        pair[1] = next;
    }
    return mixed > 0 && mixed >= MIXED * (held - alike);
}

/* Whether it falls apart, and then its nearest pair. */
static int falls_apart(patch *p, int pair[2])
{
    take_trend_away(p);
    put_on_line(p);
    int held = find_groups(p);
    return held >= HELD * p->count && is_mixed(p, held, pair);
}

/* Down the tree, as deep as the logarithm of the count. */
typedef struct search {
    const pia_kdtree *tree;
    patch patch;
    pia_index patches, apart;
    double nearest;
    pia_sheets *out;
} search;

static void look_at_patch(search *s, pia_index begin, pia_index end)
{
    patch *p = &s->patch;
    int pair[2] = {0, 0};
    p->count = (int)(end - begin);
    memcpy(p->row, s->tree->order + begin, (size_t)(end - begin) * sizeof *p->row);
    s->patches++;
    if (!falls_apart(p, pair)) return;
    s->apart++;
    if (!(between(p, pair[0], pair[1]) < s->nearest)) return;
    s->nearest = between(p, pair[0], pair[1]);
    for (int k = 0; k < 2; k++) s->out->row[k] = p->row[pair[k]];
}

static void look(search *s, pia_index begin, pia_index end)
{
    if (end - begin <= MOST) {
        if (end > begin) look_at_patch(s, begin, end);
        return;
    }
    pia_index middle = begin + (end - begin) / 2;
    look(s, begin, middle);
    look(s, middle, end);
}

pia_status pia_sheets_find(pia_context *context, const double *uv, const double *points, pia_index count, int dim, double apart,
                           pia_sheets *out)
{
    pia_kdtree tree;
    *out = (pia_sheets){.share = 0};
    pia_status status = pia_kdtree_open(context, uv, count, 2, &tree);
    if (status != PIA_OK) return status;
    search s = {.tree = &tree, .patch = {.uv = uv, .points = points, .dim = dim, .apart = apart}, .nearest = INFINITY, .out = out};
    look(&s, 0, count);
    out->share = (double)s.apart / (double)s.patches;
    if (s.apart > 0) {
        pia_index a = out->row[0], b = out->row[1];
        out->row[0] = a < b ? a : b;
        out->row[1] = a < b ? b : a;
        out->distance = distance(points + a * dim, points + b * dim, dim);
    }
    pia_kdtree_close(context, &tree);
    return PIA_OK;
}
