#include <float.h>
#include <math.h>

#include "minimum.h"

enum { STEPS = 60 };

/* Whether the value can still fall along direction d. */
static int is_free(const pia_minimum *m, const pia_cell *cell, const pia_look *now, int d)
{
    return d < m->directions && (now->slope[d] > 0 ? now->at[d] > cell->low[d] : now->at[d] < cell->high[d]);
}

static double free_slope(const pia_minimum *m, const pia_cell *cell, const pia_look *now)
{
    double sum = 0;
    for (int d = 0; d < 2; d++)
        if (is_free(m, cell, now, d)) sum += now->slope[d] * now->slope[d];
    return sum;
}

/* Newton's step where the Hessian is positive; returns 0 where it is not, or not both directions are free. */
static int newton_step(const pia_minimum *m, const pia_cell *cell, const pia_look *now, double step[2])
{
    const double *h = now->hessian;
    double determinant = h[0] * h[2] - h[1] * h[1];
    if (!is_free(m, cell, now, 0) || !is_free(m, cell, now, 1) || !(h[0] > 0) || !(determinant > 1e-14 * h[0] * h[2])) return 0;
    step[0] = (h[1] * now->slope[1] - h[2] * now->slope[0]) / determinant;
    step[1] = (h[1] * now->slope[0] - h[0] * now->slope[1]) / determinant;
    return 1;
}

/* A step down each free direction by itself, which no edge of the cell can turn upwards; to the edge where nothing bends. */
static void separate_step(const pia_minimum *m, const pia_cell *cell, const pia_look *now, double step[2])
{
    for (int d = 0; d < 2; d++) {
        double slope = now->slope[d], bend = now->hessian[2 * d] > 0 ? now->hessian[2 * d] : now->safe[d];
        double far = slope > 0 ? cell->low[d] - now->at[d] : cell->high[d] - now->at[d];
        step[d] = !is_free(m, cell, now, d) || slope == 0 ? 0 : bend > 0 ? -slope / bend : far;
    }
}

/* Near the minimum the value is flat to rounding while the slope still tells: then a smaller slope is progress too. */
static int is_better(const pia_minimum *m, const pia_cell *cell, const pia_look *next, const pia_look *now)
{
    if (next->value < now->value) return 1;
    int as_low = next->value <= now->value + 8 * DBL_EPSILON * fabs(now->value);
    return as_low && free_slope(m, cell, next) < 0.25 * free_slope(m, cell, now);
}

/* Halves the step until it gains something; returns 0 when it never does, or moves so little that rounding decides. */
static int go(const pia_minimum *m, const pia_cell *cell, const double step[2], pia_look *now)
{
    double part = 1, moved;
    do {
        double place[2];
        for (int d = 0; d < 2; d++) place[d] = fmin(fmax(now->at[d] + part * step[d], cell->low[d]), cell->high[d]);
        moved = fabs(place[0] - now->at[0]) + fabs(place[1] - now->at[1]);
        if (moved == 0) return 0;
        pia_look next;
        m->look(m, place, &next);
        if (is_better(m, cell, &next, now)) {
            *now = next;
            return 1;
        }
        part /= 2;
    } while (moved > 1e-9);
    return 0;
}

void pia_minimum_descend(const pia_minimum *m, const pia_cell *cell, pia_look *now)
{
    double step[2], start[2] = {now->at[0], now->at[1]};
    m->look(m, start, now);
    for (int k = 0; k < STEPS; k++) {
        if (newton_step(m, cell, now, step) && go(m, cell, step, now)) continue;
        separate_step(m, cell, now, step);
        if (!go(m, cell, step, now)) return;
    }
}
