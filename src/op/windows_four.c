#include "clones.h"

#define LANES 4
#define JOIN(a, b) (a)
#define TARGETS PIA_CLONES
#include "windows_solver.h"

int pia_windows_solve_by_four(const pia_windows *w, const pia_window_group *g, void *room, pia_step_errors *errors)
{
    return solve_group(w, g, room, errors);
}
