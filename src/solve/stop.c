#include "stop.h"

#include <math.h>

/* An interpolation is stuck when it has found nothing better for long, and its errors are rounding or have stopped moving. Errors of
 * high degree may rise and fall for hundreds of steps before they reach a new low. */
static int is_stuck(const pia_solve *solve)
{
    const pia_iterate *iterate = solve->iterate;
    if (!iterate->square || !iterate->errors_known || iterate->iteration - solve->best_iteration < PIA_PATIENCE) return 0;
    return solve->standing || iterate->errors.max <= 1e-14 * iterate->extent;
}

/* No step that leads anywhere is that much longer than the problem is large; those of a diverging iteration are soon, and then not
 * finite. Methods that take one step, or none that does not lower the squared error, go as far as the solution is. */
static int runs_away(const pia_solve *solve)
{
    static const double FARTHEST = 1e4;
    if (solve->method->needs & PIA_IS_FINITE) return 0;
    if (solve->method->needs & PIA_DESCENDS) return !isfinite(solve->iterate->adjust_max);
    return !(solve->iterate->adjust_max <= FARTHEST * solve->reach);
}

static int keeps_tolerance(const pia_solve *solve)
{
    const pia_rules *rules = &solve->rules;
    if (!(rules->tolerance > 0) || !solve->iterate->errors_known) return 0;
    return rules->keeps != NULL ? rules->keeps(solve->iterate) : solve->iterate->errors.max <= rules->tolerance;
}

int pia_stop_needs_errors(const pia_solve *solve)
{
    const pia_rules *rules = &solve->rules;
    pia_index k = solve->iterate->iteration;
    return rules->tolerance > 0 || rules->progress != NULL || (rules->trace_every > 0 && k % rules->trace_every == 0);
}

pia_stop pia_stop_before(const pia_solve *solve)
{
    const pia_iterate *iterate = solve->iterate;
    const pia_rules *rules = &solve->rules;
    if (keeps_tolerance(solve)) return PIA_STOP_TOLERANCE;
    if (iterate->iteration - solve->first_iteration >= rules->iterations) return PIA_STOP_ITERATIONS;
    if (rules->time_limit > 0 && solve->seconds >= rules->time_limit) return PIA_STOP_TIME;
    return PIA_STOP_NONE;
}

pia_stop pia_stop_after(const pia_solve *solve)
{
    const pia_iterate *iterate = solve->iterate;
    const pia_rules *rules = &solve->rules;
    if (iterate->finished) return PIA_STOP_FINITE;
    if (keeps_tolerance(solve)) return PIA_STOP_TOLERANCE;
    if (runs_away(solve)) return PIA_STOP_STALLED;
    if (rules->gradient > 0 && iterate->relative_gradient <= rules->gradient) return PIA_STOP_GRADIENT;
    if (iterate->stalled) return PIA_STOP_STALLED;
    if (rules->change > 0 && is_stuck(solve)) return PIA_STOP_STALLED;
    int finite = (solve->method->needs & PIA_IS_FINITE) != 0; /* ends by itself */
    if (rules->change > 0 && !finite && iterate->adjust_max <= rules->change) return PIA_STOP_CHANGE;
    return PIA_STOP_NONE;
}
