/* A block of rows goes through the first-level cache: the scout first, then one half of the lanes, then the other. */
#define LANES 4
#include "vector_lanes.h"

enum { AHEAD = 1024, BLOCK = 512 };

typedef struct sight {
    int nothing;
} sight;

PIA_INLINE void split(const double *q, int dim, lanes *component)
{
    for (int d = 0; d < dim; d++) component[d] = pia_vector_component(q, dim, d);
}

PIA_INLINE void see(const double *t, const double *q, int dim, sight *seen)
{
    (void)t, (void)q, (void)dim, (void)seen;
}

#define TARGETS PIA_CLONES
#include "run_cubics_pass.h"

void pia_run_cubics_by_four(const pia_run *run, pia_index rows, pia_scout *scout, double sum[PIA_CUBIC_SUMS][PIA_CUBIC_LANES])
{
    sight nothing = {0};
    for (pia_index from = 0; from < rows; from += BLOCK) {
        pia_index to = rows - from < BLOCK ? rows : from + BLOCK;
        if (scout != NULL) pia_scout_reach(scout, run->t + to - scout->parameters);
        add_rows(run, from, to, &nothing, sum);
    }
}
