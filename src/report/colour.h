/* Colours: ramps that are even to the eye, a qualitative set that colour-blind readers tell apart. */
#ifndef PIA_REPORT_COLOUR_H
#define PIA_REPORT_COLOUR_H

#include "pia/pia.h"

typedef struct pia_colour {
    double red, green, blue, alpha; /* sRGB, 0 to 1 */
} pia_colour;

/* Ramps of steadily changing lightness. */
typedef enum pia_ramp {
    PIA_RAMP_ERROR, /* pale yellow, red, dark purple: large values stand out on white paper */
    PIA_RAMP_HEIGHT /* dark blue, green, pale yellow */
} pia_ramp;

/* The colour at t in [0, 1]; t outside is taken at its nearest end, NaN is grey. */
pia_colour pia_ramp_colour(pia_ramp ramp, double t);

/* Colour number `index` of the set of Okabe and Ito (2008), which repeats after six. */
pia_colour pia_colour_cycle(pia_index index);

pia_colour pia_colour_grey(double level);
pia_colour pia_colour_faded(pia_colour colour, double alpha);
/* The colour under light of the given strength: 1 as it is, 0 black, above 1 towards white. */
pia_colour pia_colour_lit(pia_colour colour, double light);

#endif
