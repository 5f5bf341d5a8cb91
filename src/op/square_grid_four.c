#include "clones.h"

#define LANES 4
#define JOIN(a, b) (a)
#define QUARTER(a, k) (a)
#define EVEN(a, b) __builtin_shufflevector(a, b, 0, 4, 2, 6)
#define ODD(a, b) __builtin_shufflevector(a, b, 1, 5, 3, 7)
#define LOW(a, b) __builtin_shufflevector(a, b, 0, 1, 4, 5)
#define HIGH(a, b) __builtin_shufflevector(a, b, 2, 3, 6, 7)
#define LANE_NUMBERS ((masks){0, 1, 2, 3})
#define TARGETS PIA_CLONES
#include "square_grid_vectors.h"

#include "square_grid_lines.h"
#include "square_grid_panels.h"

const pia_grid_solver pia_grid_by_four = {lines, panel};
