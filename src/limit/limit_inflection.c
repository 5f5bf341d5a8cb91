/* No inflection of the control polygon is added. Every turn is given a sign to keep, once, from the start; the control points move one
 * after the other, each as far as the turns it touches allow: the orientation of a turn is affine in the step of one vertex, so where
 * it vanishes is known. [2023] section 4.4 made robust: printed are two mirror cases that are none, and unguarded ends. */
#include "limit.h"
#include "polygon.h"

enum { ALPHA, DELTA, MAX_HALVINGS = 40 };

typedef struct inflection {
    double alpha, delta;
    double *sign;  /* [cols] of each turn to keep; 0: free */
    double *scale; /* [cols] */
} inflection;

static pia_status begin(pia_iterate *iterate, const pia_values *values, void *state)
{
    inflection *s = state;
    pia_index n = iterate->op->cols;
    s->alpha = values->number[ALPHA];
    s->delta = values->is_word[DELTA] ? 1e-9 * iterate->extent : values->number[DELTA];
    s->sign = pia_take(iterate->context, n, sizeof *s->sign);
    s->scale = pia_take(iterate->context, n, sizeof *s->scale);
    if (s->sign == NULL || s->scale == NULL) return pia_take_status(iterate->context, n, sizeof *s->sign);
    pia_status status = pia_polygon_check(iterate, "inflection");
    if (status == PIA_OK) pia_polygon_targets(iterate, NULL, s->sign);
    return status;
}

static int has_target(const pia_iterate *iterate, const inflection *s)
{
    for (pia_index i = 0; i < iterate->op->cols; i++)
        if (s->sign[i] != 0) return 1;
    return 0;
}

/* A straight start says nothing: its first step decides, by the first turn it makes, to which side all of it bends. */
static void choose_side(const pia_iterate *iterate, inflection *s)
{
    pia_index first, end;
    double side = 0;
    for (pia_index i = 0; i < iterate->op->cols; i++) s->scale[i] = 1;
    pia_polygon_turns(iterate, &first, &end);
    for (pia_index i = first; i < end && side == 0; i++) side = pia_polygon_sign(iterate, s->scale, i);
    for (pia_index i = first; i < end; i++) s->sign[i] = side;
}

/* The factor at which turn j, seen from vertex i, becomes straight; 1 when the whole step of vertex i keeps its sign. */
static double crossing(const pia_iterate *iterate, inflection *s, pia_index i, pia_index j)
{
    double sign = s->sign[pia_polygon_vertex(iterate, j)];
    s->scale[i] = 1;
    if (sign * pia_polygon_sign(iterate, s->scale, j) >= 0) return 1;
    double there = sign * pia_polygon_orientation(iterate, s->scale, j);
    s->scale[i] = 0;
    double here = sign * pia_polygon_orientation(iterate, s->scale, j);
    return here > 0 ? here / (here - there) : 0;
}

static int keeps_turns(const pia_iterate *iterate, const inflection *s, pia_index from, pia_index to)
{
    for (pia_index j = from; j <= to; j++)
        if (s->sign[pia_polygon_vertex(iterate, j)] * pia_polygon_sign(iterate, s->scale, j) < 0) return 0;
    return 1;
}

static void move_vertex(const pia_iterate *iterate, inflection *s, pia_index i)
{
    pia_index first, end, from = i - 1, to = i + 1;
    double step = 1;
    pia_polygon_turns(iterate, &first, &end);
    if (!pia_polygon_closed(iterate)) {
        from = from < first ? first : from;
        to = to >= end ? end - 1 : to;
    }
    for (pia_index j = from; j <= to; j++) {
        double factor = crossing(iterate, s, i, j);
        step = factor < step ? factor : step;
    }
    s->scale[i] = step < 1 ? s->alpha * step : 1;
    for (int k = 0; k < MAX_HALVINGS && s->scale[i] > 0 && !keeps_turns(iterate, s, from, to); k++) s->scale[i] /= 2;
    if (!keeps_turns(iterate, s, from, to)) s->scale[i] = 0;
}

static pia_status limit(pia_iterate *iterate, void *state)
{
    inflection *s = state;
    if (!has_target(iterate, s)) choose_side(iterate, s);
    for (pia_index i = 0; i < iterate->op->cols; i++) s->scale[i] = 0;
    for (pia_index i = 0; i < iterate->op->cols; i++) move_vertex(iterate, s, i);
    pia_polygon_shorten(iterate, s->scale, s->delta);
    return PIA_OK;
}

static void end(pia_iterate *iterate, void *state)
{
    inflection *s = state;
    pia_give(iterate->context, s->sign);
    pia_give(iterate->context, s->scale);
}

static void history(pia_iterate *iterate, void *state, void (*visit)(void *, const char *, double *, pia_index), void *user)
{
    visit(user, "turns", ((inflection *)state)->sign, iterate->op->cols);
}

static const pia_parameter parameters[] = {
    {"alpha", NULL, "0.8", 1e-6, 1, "share of the way to where a turn becomes straight that a step may go"},
    {"delta", "auto|number", "auto", 0, 1e300, "steps below this count as none, units of the points; auto is 1e-9 of the extent"},
    {0}};

const pia_limiter pia_limit_inflection = {
    .name = "inflection",
    .title = "each control point shortens its own step, so that the control polygon gains no inflection",
    .reference = "chang2023",
    .detail = "planar curves, with and without constraints; inflections may vanish, none is added",
    .parameters = parameters,
    .state_size = sizeof(inflection),
    .begin = begin,
    .limit = limit,
    .end = end,
    .history = history,
};
