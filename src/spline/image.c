/* Along a segment a piece of a surface is a polynomial of degree p + q. With B_ij the Bezier net of the surface over the rectangle
 * whose diagonal the segment is, control point k is the sum over i + j = k of C(p,i) C(q,j) / C(p+q,k) B_ij: multiply out the Bernstein
 * polynomials of t in u and in v. The net comes from blossoms: B_ij has i arguments at the segment's end and p - i at its start, and so
 * in v. Inside a knot cell all this is convex combinations, hence accurate for any degree. */
#include "image.h"

#include <string.h>

#include "basis.h"
#include "knots.h"

enum { ROW = PIA_MAX_DEGREE + 1 };

/* A segment in the parameter plane and the surface above it. */
typedef struct segment {
    const pia_model *surface;
    const double *from, *to;
} segment;

static double parameter_at(const segment *s, int d, double t)
{
    return t == 0 ? s->from[d] : t == 1 ? s->to[d] : s->from[d] + t * (s->to[d] - s->from[d]);
}

/* The t in (0, 1) where the segment crosses inside knots of direction d, increasing. out NULL: only counts. */
static pia_index crossings(const segment *s, int d, double *out)
{
    const double *knots = s->surface->knots[d];
    pia_index first = s->surface->degree[d] + 1, last = s->surface->control[d] - 1, count = 0;
    int forth = s->to[d] > s->from[d];
    for (pia_index i = 0; i <= last - first && s->from[d] != s->to[d]; i++) {
        double knot = knots[forth ? first + i : last - i], t = (knot - s->from[d]) / (s->to[d] - s->from[d]);
        if (!(t > 0 && t < 1) || (i > 0 && knot == knots[forth ? first + i - 1 : last - i + 1])) continue;
        if (out != NULL) out[count] = t;
        count++;
    }
    return count;
}

/* Both increasing lists in one, what is equal up to rounding once; returns how many. */
static pia_index merge(const double *a, pia_index a_count, const double *b, pia_index b_count, double *out)
{
    static const double near = 1e-12;
    pia_index count = 0;
    for (pia_index i = 0, j = 0; i < a_count || j < b_count;) {
        double t = j == b_count || (i < a_count && a[i] <= b[j]) ? a[i++] : b[j++];
        if (t > near && t < 1 - near && (count == 0 || t > out[count - 1] + near)) out[count++] = t;
    }
    return count;
}

/* Places where pieces end, 0 and 1 among them; [*count + 1] for *count pieces. */
static pia_status find_breaks(pia_context *context, const segment *s, double **out, pia_index *count)
{
    pia_index u = crossings(s, 0, NULL), v = crossings(s, 1, NULL);
    double *breaks = pia_take(context, 2 * (u + v) + 2, sizeof *breaks); /* no more than the knots, which are in memory */
    if (breaks == NULL) return pia_take_status(context, 2 * (u + v) + 2, sizeof *breaks);
    double *each = breaks + u + v + 2;
    crossings(s, 0, each);
    crossings(s, 1, each + u);
    *count = merge(each, u, each + u, v, breaks + 1) + 1;
    breaks[0] = 0;
    breaks[*count] = 1;
    *out = breaks;
    return PIA_OK;
}

/* Coefficients of the blossoms with i arguments at `b` and the rest at `a`, i = 0 ... degree; returns the span they speak of. */
static pia_index blossoms(const segment *s, int d, double a, double b, double rows[ROW][ROW])
{
    int degree = s->surface->degree[d];
    double arguments[ROW];
    pia_index span = pia_knots_span(s->surface->knots[d], degree, s->surface->control[d], a + (b - a) / 2);
    for (int i = 0; i <= degree; i++) {
        for (int k = 0; k < degree; k++) arguments[k] = k < degree - i ? a : b;
        pia_basis_blossom(s->surface->knots[d], degree, span, arguments, rows[i]);
    }
    return span - degree;
}

static double binomial(int n, int k)
{
    double value = 1;
    for (int i = 1; i <= k; i++) value = value * (n - k + i) / i;
    return value;
}

/* The control points of the piece over [ta, tb]: out [p + q + 1 x width]. */
static void fill_piece(const segment *s, double ta, double tb, double *out)
{
    double rows[2][ROW][ROW];
    pia_index first[2];
    const pia_model *model = s->surface;
    int p = model->degree[0], q = model->degree[1], width = pia_model_width(model);
    for (int d = 0; d < 2; d++) first[d] = blossoms(s, d, parameter_at(s, d, ta), parameter_at(s, d, tb), rows[d]);
    memset(out, 0, (size_t)((p + q + 1) * width) * sizeof *out);
    for (int i = 0; i <= p; i++)
        for (int j = 0; j <= q; j++) {
            double share = binomial(p, i) * binomial(q, j) / binomial(p + q, i + j), *to = out + (i + j) * width;
            for (int k = 0; k <= p; k++)
                for (int l = 0; l <= q; l++) {
                    double factor = share * rows[0][i][k] * rows[1][j][l];
                    const double *point = model->points + ((first[0] + k) * model->control[1] + first[1] + l) * width;
                    for (int c = 0; c < width; c++) to[c] += factor * point[c];
                }
        }
}

static void fill(const segment *s, const double *breaks, pia_index pieces, pia_model *curve)
{
    int degree = curve->degree[0], width = pia_model_width(curve);
    double *knot = curve->knots[0];
    for (pia_index b = 0; b <= pieces; b++)
        for (int k = 0; k < degree + (b == 0 || b == pieces); k++) *knot++ = breaks[b];
    for (pia_index b = 0; b < pieces; b++) fill_piece(s, breaks[b], breaks[b + 1], curve->points + b * degree * width);
}

pia_status pia_model_image(pia_context *context, const pia_model *surface, const double from[2], const double to[2], pia_model **out)
{
    segment s = {surface, from, to};
    int degree = surface->degree[0] + surface->degree[1];
    double *breaks = NULL;
    pia_index pieces = 0, control, most = surface->control[0] + surface->control[1];
    if (degree > PIA_MAX_DEGREE)
        return pia_fail(context, PIA_E_ARGUMENT, "the edges of a trimmed surface of degrees %d and %d have degree %d; %d is the most",
                        surface->degree[0], surface->degree[1], degree, PIA_MAX_DEGREE);
    if (!pia_multiply(most, degree, &control))
        return pia_fail(context, PIA_E_SIZE, "an edge across %lld knots does not fit in 64 bits", (long long)most);
    pia_status status = find_breaks(context, &s, &breaks, &pieces);
    if (status != PIA_OK) return status;
    pia_model *curve = NULL;
    control = pieces * degree + 1;
    status = pia_model_new(context, 1, &degree, &control, surface->dim, surface->rational, &curve);
    if (status == PIA_OK) {
        fill(&s, breaks, pieces, curve);
        *out = curve;
    }
    pia_give(context, breaks);
    return status;
}
