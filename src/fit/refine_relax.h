/* How searches by relaxation go: see refine_relax.c. */
#ifndef PIA_FIT_REFINE_RELAX_H
#define PIA_FIT_REFINE_RELAX_H

#include "context.h"

/* Rows are brought a little inside of what they may deviate, so that the spline comes in with them. */
#define PIA_INSIDE 0.999

/* Whether a search is to be given up after so many rounds, of which the best came to this largest ratio. */
int pia_relax_is_vain(pia_index rounds, double best);

#endif
