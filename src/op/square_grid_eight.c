#include "clones.h"

#define LANES 8
#define JOIN(a, b) __builtin_shufflevector(a, b, 0, 1, 2, 3, 4, 5, 6, 7)
#define QUARTER(a, k) ((k) == 0 ? __builtin_shufflevector(a, a, 0, 1, 2, 3) : __builtin_shufflevector(a, a, 4, 5, 6, 7))
#define EVEN(a, b) __builtin_shufflevector(a, b, 0, 8, 2, 10, 4, 12, 6, 14)
#define ODD(a, b) __builtin_shufflevector(a, b, 1, 9, 3, 11, 5, 13, 7, 15)
#define LOW(a, b) __builtin_shufflevector(a, b, 0, 1, 8, 9, 4, 5, 12, 13)
#define HIGH(a, b) __builtin_shufflevector(a, b, 2, 3, 10, 11, 6, 7, 14, 15)
#define LANE_NUMBERS ((masks){0, 1, 2, 3, 4, 5, 6, 7})
#define TARGETS PIA_WIDE
#include "square_grid_vectors.h"

#include "square_grid_lines.h"
#include "square_grid_panels.h"

const pia_grid_solver pia_grid_by_eight = {lines, panel};
