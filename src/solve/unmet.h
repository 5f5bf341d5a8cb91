/* Constraints under a limiter, which may leave no way to meet them: their multipliers then grow for ever and drive the rest of the
 * model away. The loop keeps the iterate that meets them best and returns to it. */
#ifndef PIA_SOLVE_UNMET_H
#define PIA_SOLVE_UNMET_H

#include "solve.h"

/* After a step was computed and limited. Sets solve->stop to PIA_STOP_INFEASIBLE, and the iterate back to the best one, when the step
 * has nothing left or when 400 limited steps in a row have not met the constraints better by a tenth. Nothing without limiter and
 * constraints. Errors: PIA_E_MEMORY. */
pia_status pia_unmet_watch(pia_solve *solve);

#endif
