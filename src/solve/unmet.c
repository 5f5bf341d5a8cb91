#include "unmet.h"

#include "constraint.h"

#include <string.h>

enum { PATIENCE = 400 };

static const double MET = 1e-9; /* of the extent: smaller violations are no concern of the limiter */

static pia_status keep_best(pia_solve *solve, double unmet)
{
    const pia_iterate *iterate = solve->iterate;
    pia_index size = iterate->op->cols * iterate->dim;
    solve->blocked = 0;
    solve->safe_error = unmet;
    if (solve->safe == NULL) solve->safe = pia_take(iterate->context, size, sizeof *solve->safe);
    if (solve->safe == NULL) return pia_take_status(iterate->context, size, sizeof *solve->safe);
    memcpy(solve->safe, iterate->points, (size_t)size * sizeof *solve->safe);
    return PIA_OK;
}

pia_status pia_unmet_watch(pia_solve *solve)
{
    pia_iterate *iterate = solve->iterate;
    if (solve->limiter == NULL || iterate->constraints == NULL) return PIA_OK;
    double unmet = pia_constraints_violation(iterate->constraints, iterate->points, NULL);
    if (!(unmet >= 0.9 * solve->safe_error)) {
        pia_status status = keep_best(solve, unmet);
        if (status != PIA_OK) return status;
    }
    solve->blocked = iterate->shortened ? solve->blocked + 1 : 0;
    if (solve->safe_error <= MET * iterate->extent || (!iterate->stalled && solve->blocked < PATIENCE)) return PIA_OK;
    memcpy(iterate->points, solve->safe, (size_t)(iterate->op->cols * iterate->dim) * sizeof *solve->safe);
    iterate->errors_known = 0;
    solve->stop = PIA_STOP_INFEASIBLE;
    return PIA_OK;
}
