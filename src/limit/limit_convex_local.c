/* The per-vertex form of [2004] Eq. (11): only the three vertices of a turn that would change its sign shorten their step, by halves,
 * until no turn does. Ends closer to the data than one step length for all. */
#include "limit.h"
#include "polygon.h"

enum { DELTA, MAX_ROUNDS = 200 };

typedef struct local {
    double delta;
    double *sign;  /* [cols] of each turn to keep; 0: free */
    double *scale; /* [cols] */
} local;

static pia_status begin(pia_iterate *iterate, const pia_values *values, void *state)
{
    local *l = state;
    l->delta = values->is_word[DELTA] ? 1e-9 * iterate->extent : values->number[DELTA];
    l->sign = pia_take(iterate->context, iterate->op->cols, sizeof *l->sign);
    l->scale = pia_take(iterate->context, iterate->op->cols, sizeof *l->scale);
    if (l->sign == NULL || l->scale == NULL) return pia_take_status(iterate->context, iterate->op->cols, sizeof *l->scale);
    pia_status status = pia_polygon_check(iterate, "convex-local");
    if (status == PIA_OK) pia_polygon_targets(iterate, NULL, l->sign);
    return status;
}

/* One round over all turns; the number of those that would change. */
static pia_index shorten(pia_iterate *iterate, local *l)
{
    pia_index first, end, changed = 0;
    pia_polygon_turns(iterate, &first, &end);
    for (pia_index i = first; i < end; i++) {
        if (l->sign[i] * pia_polygon_sign(iterate, l->scale, i) >= 0) continue;
        for (pia_index v = i - 1; v <= i + 1; v++) {
            double *scale = &l->scale[pia_polygon_vertex(iterate, v)];
            *scale = *scale > 1e-18 ? *scale / 2 : 0;
        }
        changed++;
    }
    return changed;
}

static pia_status limit(pia_iterate *iterate, void *state)
{
    local *l = state;
    pia_index n = iterate->op->cols, left = 1;
    for (pia_index i = 0; i < n; i++) l->scale[i] = 1;
    for (int round = 0; round < MAX_ROUNDS && left > 0; round++) left = shorten(iterate, l);
    for (pia_index i = 0; i < n && left > 0; i++) l->scale[i] = 0;
    pia_polygon_shorten(iterate, l->scale, l->delta);
    return PIA_OK;
}

static void end(pia_iterate *iterate, void *state)
{
    local *l = state;
    pia_give(iterate->context, l->sign);
    pia_give(iterate->context, l->scale);
}

static void history(pia_iterate *iterate, void *state, void (*visit)(void *, const char *, double *, pia_index), void *user)
{
    visit(user, "turns", ((local *)state)->sign, iterate->op->cols);
}

static const pia_parameter parameters[] = {
    {"delta", "auto|number", "auto", 0, 1e300, "steps below this count as none, units of the points; auto is 1e-9 of the extent"}, {0}};

const pia_limiter pia_limit_convex_local = {
    .name = "convex-local",
    .title = "each control point shortens its own step, so that no turn of the control polygon changes its sign",
    .reference = "lin2004",
    .detail = "planar curves; closer to the data than convex",
    .parameters = parameters,
    .state_size = sizeof(local),
    .begin = begin,
    .limit = limit,
    .end = end,
    .history = history,
};
