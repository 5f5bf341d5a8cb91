/* There are registers enough to see the rows in passing: who looked at a block first would wait for memory with nothing to do. */
#define LANES 8
#include "vector_lanes.h"

#include <math.h>

enum { AHEAD = 96 };

typedef struct sight {
    lanes low[3], high[3]; /* by places: three vectors hold the components in turn */
    lanes last;            /* parameters before */
    masks fallen;
} sight;

/* Rows to columns, two shuffles a column at most. */
PIA_INLINE void split(const double *q, int dim, lanes *component)
{
    lanes a = lanes_load(q), b = dim > 1 ? lanes_load(q + LANES) : a, c = dim > 2 ? lanes_load(q + 2 * LANES) : a;
    if (dim == 1) {
        component[0] = a;
    } else if (dim == 2) {
        component[0] = __builtin_shufflevector(a, b, 0, 2, 4, 6, 8, 10, 12, 14);
        component[1] = __builtin_shufflevector(a, b, 1, 3, 5, 7, 9, 11, 13, 15);
    } else {
        lanes first = __builtin_shufflevector(a, b, 0, 3, 6, 9, 12, 15, 0, 0);
        lanes second = __builtin_shufflevector(a, b, 1, 4, 7, 10, 13, 0, 0, 0);
        lanes third = __builtin_shufflevector(a, b, 2, 5, 8, 11, 14, 0, 0, 0);
        component[0] = __builtin_shufflevector(first, c, 0, 1, 2, 3, 4, 5, 10, 13);
        component[1] = __builtin_shufflevector(second, c, 0, 1, 2, 3, 4, 8, 11, 14);
        component[2] = __builtin_shufflevector(third, c, 0, 1, 2, 3, 4, 9, 12, 15);
    }
}

PIA_INLINE void see(const double *t, const double *q, int dim, sight *seen)
{
    lanes now = lanes_load(t), before = __builtin_shufflevector(seen->last, now, 7, 8, 9, 10, 11, 12, 13, 14);
    seen->fallen |= ~(before <= now);
    seen->last = now;
    for (int k = 0; k < dim; k++) {
        lanes value = lanes_load(q + k * LANES);
        seen->low[k] = lanes_lower(value, seen->low[k]);
        seen->high[k] = lanes_upper(value, seen->high[k]);
    }
}

#define TARGETS PIA_WIDE
#include "run_cubics_pass.h"

static sight open_sight(const pia_run *run, const pia_scout *scout)
{
    sight s = {.last = {0}};
    int first = scout == NULL || run->t == scout->parameters;
    for (int k = 0; k < 3; k++)
        for (int l = 0; l < LANES; l++) {
            s.low[k][l] = INFINITY;
            s.high[k][l] = -INFINITY;
        }
    s.last[LANES - 1] = first ? run->t[0] : run->t[-1];
    return s;
}

/* A sum of components that is no number comes of one, or of too large ones. */
static int have_numbers(const pia_run *run, double sum[PIA_CUBIC_SUMS][PIA_CUBIC_LANES])
{
    int all = 1;
    for (int d = 0; d < run->dim; d++)
        for (int l = 0; l < PIA_CUBIC_LANES; l++) all &= isfinite(sum[6 + 4 * d][l]) != 0;
    return all;
}

static void tell(const pia_run *run, pia_index rows, const sight *seen, int numbers, pia_scout *scout)
{
    pia_index next = run->t + rows - scout->parameters;
    for (int l = 0; l < LANES; l++) scout->ordered &= seen->fallen[l] == 0;
    pia_box_join(&scout->box, LANES, (const double *)seen->low, (const double *)seen->high);
    if (!numbers) pia_box_add(&scout->box, run->points, rows);
    if (next > scout->next) scout->next = next;
}

void pia_run_cubics_by_eight(const pia_run *run, pia_index rows, pia_scout *scout, double sum[PIA_CUBIC_SUMS][PIA_CUBIC_LANES])
{
    if (rows == 0) return;
    sight seen = open_sight(run, scout);
    add_rows(run, 0, rows, &seen, sum);
    if (scout != NULL) tell(run, rows, &seen, have_numbers(run, sum), scout);
}
