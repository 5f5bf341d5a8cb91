#include "shape.h"

#include <math.h>

#include "evaluate.h"
#include "knots.h"

static const double pi = 3.14159265358979323846;

static double cross(const double a[2], const double b[2])
{
    return a[0] * b[1] - a[1] * b[0];
}

int pia_turn_sign(const double a[2], const double b[2])
{
    double product = cross(a, b);
    if (!(fabs(product) > 1e-12 * hypot(a[0], a[1]) * hypot(b[0], b[1]))) return 0;
    return product > 0 ? 1 : -1;
}

/* A sequence of signs, of which zeroes do not count. */
typedef struct signs {
    int first, last; /* 0: none yet */
    pia_index changes;
} signs;

static void add_sign(signs *s, int sign)
{
    if (sign == 0) return;
    if (s->first == 0) s->first = sign;
    s->changes += s->last != 0 && s->last != sign;
    s->last = sign;
}

/* Edge from point i to the next one (of a closed polygon: round the end); returns 0 when it has no length. */
static int edge(const double *points, pia_index count, pia_index i, double out[2])
{
    const double *a = points + i % count * 2, *b = points + (i + 1) % count * 2;
    out[0] = b[0] - a[0];
    out[1] = b[1] - a[1];
    return out[0] != 0 || out[1] != 0;
}

pia_index pia_polygon_inflections(const double *points, pia_index count, int closed)
{
    signs s = {0, 0, 0};
    double before[2] = {0, 0}, after[2];
    pia_index edges = closed ? 2 * count : count - 1; /* twice round, so that the first turn has an edge before it */
    for (pia_index i = 0; i < edges; i++) {
        if (!edge(points, count, i, after)) continue;
        if (!closed || i >= count) add_sign(&s, pia_turn_sign(before, after));
        before[0] = after[0];
        before[1] = after[1];
    }
    return s.changes + (closed && s.first != s.last);
}

/* Angles between a leg and the last one before it that has a length, summed over the group. */
static double group_turn(const double *points, pia_index count, pia_index first, int degree)
{
    double before[2] = {0, 0}, after[2], sum = 0;
    for (pia_index i = first; i < first + degree && i + 1 < count; i++) {
        if (!edge(points, count, i, after)) continue;
        sum += atan2(fabs(cross(before, after)), before[0] * after[0] + before[1] * after[1]);
        before[0] = after[0];
        before[1] = after[1];
    }
    return sum;
}

pia_index pia_polygon_first_wide_turn(const double *points, pia_index count, int degree)
{
    for (pia_index i = 0; i + 1 < count; i++)
        if (!(group_turn(points, count, i, degree) < pi)) return i;
    return -1;
}

/* C' x C'' at t and its sign. */
typedef struct bend {
    double t, value;
    int sign;
} bend;

static bend bend_at(const pia_model *model, double t, pia_index *hint)
{
    double c[3][2];
    pia_evaluate(model, &t, 2, hint, c[0]);
    return (bend){t, cross(c[1], c[2]), pia_turn_sign(c[1], c[2])};
}

/* Looks between a and c, around b, for a place where the bend has the other sign: golden sections towards its smallest magnitude. */
static int changes_twice(const pia_model *model, bend a, bend b, bend c, pia_index *hint)
{
    const double golden = 0.3819660112501051;
    int sign = b.sign;
    for (int k = 0; k < 60; k++) {
        int right = c.t - b.t > b.t - a.t;
        bend d = bend_at(model, right ? b.t + golden * (c.t - b.t) : b.t - golden * (b.t - a.t), hint);
        if (d.sign == -sign) return 1;
        int better = sign * d.value < sign * b.value;
        if (better && right) a = b;
        if (better && !right) c = b;
        if (!better && right) c = d;
        if (!better && !right) a = d;
        if (better) b = d;
    }
    return 0;
}

/* A corner stands at the control point that a degree-fold knot leaves alone; its turn is that of the control polygon. */
static int corner_sign(const pia_model *model, pia_index control)
{
    int width = pia_model_width(model);
    double leg[2][2];
    for (int k = 0; k < 2; k++)
        for (int c = 0; c < 2; c++) {
            const double *p = model->points + (control - 1 + k) * width, *q = p + width;
            leg[k][c] = model->rational ? q[c] / q[2] - p[c] / p[2] : q[c] - p[c];
        }
    return pia_turn_sign(leg[0], leg[1]);
}

/* The signs of one span, sampled more densely towards its ends. The bend of a polynomial of degree p has at most 2 p - 3 zeroes there,
 * that of a rational one 3 p - 3: fewer than there are samples. */
static void add_span(const pia_model *model, pia_index span, signs *s)
{
    const double *knots = model->knots[0];
    int samples = 3 * model->degree[0] + 2;
    double begin = knots[span], length = knots[span + 1] - knots[span];
    bend before = {0, 0, 0}, here = {0, 0, 0};
    for (int k = 0; k <= samples; k++) {
        bend next = {0, 0, 0};
        if (k < samples) next = bend_at(model, begin + length * (0.5 - 0.5 * cos(pi * (k + 0.5) / samples)), &span);
        int dips = k > 1 && before.sign == here.sign && next.sign == here.sign && here.sign != 0 &&
                   fabs(here.value) <= fabs(before.value) && fabs(here.value) <= fabs(next.value);
        if (dips && changes_twice(model, before, here, next, &span)) add_sign(s, -here.sign);
        add_sign(s, next.sign);
        before = here;
        here = next;
    }
}

pia_status pia_curve_inflections(pia_context *context, const pia_model *model, pia_index *count)
{
    if (model->directions != 1 || model->dim != 2)
        return pia_fail(context, PIA_E_SHAPE, "inflections are those of a planar curve; this model has %d directions, dimension %d",
                        model->directions, model->dim);
    signs s = {0, 0, 0};
    int degree = model->degree[0];
    const double *knots = model->knots[0];
    for (pia_index span = degree; span < model->control[0]; span++) {
        if (!(knots[span + 1] > knots[span])) continue;
        add_span(model, span, &s);
        if (span + degree < model->control[0] && knots[span + 1] == knots[span + degree]) add_sign(&s, corner_sign(model, span));
    }
    *count = s.changes;
    return PIA_OK;
}
