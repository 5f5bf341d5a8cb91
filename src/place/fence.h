/* Fences of [2011]: which data lines belong to which control parameter. Control parameter i stands at line chosen[i]; the marker
 * between i - 1 and i is the first line of group i, first[i]. Where it is a line of neither (its parameter is f_i = t_w, Eq. (44)) it
 * can become a control parameter itself; between adjacent lines it stands for the midpoint, and first[i] == chosen[i]. */
#ifndef PIA_PLACE_FENCE_H
#define PIA_PLACE_FENCE_H

#include "context.h"

typedef enum pia_fence_rule {
    PIA_FENCE_PRINTED, /* lambda as printed: sums of exp(k) t; constant curvature puts the marker at .707 of the interval */
    PIA_FENCE_BALANCED /* sums of exp(k) times parameter increments: the halves weigh the same */
} pia_fence_rule;

/* first [control + 1] for parameters and curvature [count], chosen [control] rising from 0 to count - 1, control >= 2; first[0] = 0,
 * first[control] = count. O(count). */
void pia_fence_place(pia_fence_rule rule, const double *parameters, const double *curvature, pia_index count, const pia_index *chosen,
                     pia_index control, pia_index *first);

/* Groups begin [control] .. end [control] - 1, ordered, disjoint, never empty. A group in `own` [count, by line] holds only its control
 * parameter's line; the lines it sheds go to its neighbours, or to none where these are also their own. */
void pia_fence_groups(const pia_index *first, const pia_index *chosen, pia_index control, const unsigned char *own, pia_index *begin,
                      pia_index *end);

#endif
