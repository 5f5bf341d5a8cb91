#include "clones.h"

#define LANES 8
#define JOIN(a, b) __builtin_shufflevector(a, b, 0, 1, 2, 3, 4, 5, 6, 7)
#define TARGETS PIA_WIDE
#include "windows_solver.h"

int pia_windows_solve_by_eight(const pia_windows *w, const pia_window_group *g, void *room, pia_step_errors *errors)
{
    return solve_group(w, g, room, errors);
}
