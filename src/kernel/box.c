#include "box.h"

#include <math.h>

/* Rows are taken PIA_LANES at a time, as `dim` vectors: component c is met in all lanes that are c modulo dim. */
PIA_INLINE void add_groups(const double *points, pia_index groups, int dim, pia_box *box)
{
    pia_lanes low[PIA_MAX_DIM], high[PIA_MAX_DIM];
    pia_lane_masks strange = {0};
    for (int k = 0; k < dim; k++) {
        low[k] = pia_vector_load(box->low + k * PIA_LANES);
        high[k] = pia_vector_load(box->high + k * PIA_LANES);
    }
    for (pia_index g = 0; g < groups; g++, points += PIA_LANES * dim)
        for (int k = 0; k < dim; k++) {
            pia_lanes value = pia_vector_load(points + k * PIA_LANES);
            low[k] = pia_vector_lower(value, low[k]);
            high[k] = pia_vector_upper(value, high[k]);
            strange |= value != value; /* NOLINT(misc-redundant-expression): NaN */
        }
    for (int k = 0; k < dim; k++) {
        memcpy(box->low + k * PIA_LANES, &low[k], sizeof low[k]);
        memcpy(box->high + k * PIA_LANES, &high[k], sizeof high[k]);
    }
    for (int l = 0; l < PIA_LANES; l++) box->numbers &= strange[l] == 0;
}

PIA_CLONES static void add_whole(const double *points, pia_index groups, pia_box *box)
{
    switch (box->dim) {
    case 1: add_groups(points, groups, 1, box); break;
    case 2: add_groups(points, groups, 2, box); break;
    case 3: add_groups(points, groups, 3, box); break;
    default: add_groups(points, groups, box->dim, box); break;
    }
}

void pia_box_open(int dim, pia_box *out)
{
    *out = (pia_box){.dim = dim, .numbers = 1};
    for (int l = 0; l < PIA_LANES * dim; l++) {
        out->low[l] = INFINITY;
        out->high[l] = -INFINITY;
    }
}

void pia_box_add(pia_box *box, const double *points, pia_index rows)
{
    pia_index groups = rows / PIA_LANES, taken = groups * PIA_LANES * box->dim;
    add_whole(points, groups, box);
    for (pia_index i = taken; i < rows * box->dim; i++) {
        pia_index lane = i - taken;
        box->low[lane] = fmin(box->low[lane], points[i]);
        box->high[lane] = fmax(box->high[lane], points[i]);
        box->numbers &= !isnan(points[i]);
    }
}

void pia_box_join(pia_box *box, int lanes, const double *low, const double *high)
{
    for (int place = 0; place < lanes * box->dim; place++) {
        int own = place % (PIA_LANES * box->dim);
        box->low[own] = low[place] < box->low[own] ? low[place] : box->low[own];
        box->high[own] = high[place] > box->high[own] ? high[place] : box->high[own];
    }
}

int pia_box_close(const pia_box *box, double *low, double *high)
{
    int finite = box->numbers;
    for (int d = 0; d < box->dim; d++) {
        low[d] = INFINITY;
        high[d] = -INFINITY;
    }
    for (int l = 0; l < PIA_LANES * box->dim; l++) {
        int d = l % box->dim;
        low[d] = fmin(low[d], box->low[l]);
        high[d] = fmax(high[d], box->high[l]);
    }
    for (int d = 0; d < box->dim; d++) finite &= low[d] > -INFINITY && high[d] < INFINITY;
    return finite;
}
