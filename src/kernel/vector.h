/* Vectors of doubles for the hot loops: four lanes, which newer processors have in one register and others in two. */
#ifndef PIA_KERNEL_VECTOR_H
#define PIA_KERNEL_VECTOR_H

#include "clones.h"

enum { PIA_LANES = 4 };

typedef double pia_lanes __attribute__((vector_size(PIA_LANES * sizeof(double))));
typedef int64_t pia_lane_masks __attribute__((vector_size(PIA_LANES * sizeof(int64_t)))); /* -1: true */

#endif
