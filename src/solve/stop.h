/* The stop rules, asked once before and once after a step is computed. */
#ifndef PIA_SOLVE_STOP_H
#define PIA_SOLVE_STOP_H

#include "solve.h"

/* Whether errors of the current iterate are needed now: for the tolerance, the trace, progress or the method. */
int pia_stop_needs_errors(const pia_solve *solve);
/* Reasons that the current iterate alone gives: tolerance, gradient, iterations, time. PIA_STOP_NONE: go on. */
pia_stop pia_stop_before(const pia_solve *solve);
/* Reasons that the computed step gives: finished, stalled, change. */
pia_stop pia_stop_after(const pia_solve *solve);

#endif
