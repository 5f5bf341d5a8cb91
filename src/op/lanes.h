/* Rows of a curve side by side in the lanes of a vector. */
#ifndef PIA_OP_LANES_H
#define PIA_OP_LANES_H

#include "collocation.h"
#include "vector.h"

/* One number of each place. */
PIA_INLINE pia_lanes pia_lanes_load(const double *array, const pia_index *at)
{
    return (pia_lanes){array[at[0]], array[at[1]], array[at[2]], array[at[3]]};
}

/* Basis values at t as pia_basis_values gives them, but with one division for each pair of neighbours: their quotients add up to 1,
 * and are exactly 0 and 1 at a knot. knot[k] is the knot at span - degree + 1 + k, k < 2 degree. */
PIA_INLINE void pia_lanes_basis(const pia_lanes *knot, int degree, pia_lanes t, pia_lanes *value)
{
    value[0] = (pia_lanes){1, 1, 1, 1};
    for (int d = 1; d <= degree; d++) {
        pia_lanes carried = {0};
        for (int r = 0; r < d; r++) {
            pia_lanes left = knot[degree + r - d], right = knot[degree + r];
            pia_lanes part = value[r] * ((t - left) / (right - left));
            value[r] = carried + (value[r] - part);
            carried = part;
        }
        value[d] = carried;
    }
}

/* The degree + 1 basis values of rows row[] on the spans that begin with column[]. */
PIA_INLINE void pia_lanes_row(const pia_collocation *c, const pia_index *row, const pia_index *column, int degree, pia_lanes *value)
{
    if (c->values != NULL) {
        pia_index at[PIA_LANES];
        for (int l = 0; l < PIA_LANES; l++) at[l] = row[l] * (degree + 1);
        for (int k = 0; k <= degree; k++) value[k] = pia_lanes_load(c->values + k, at);
        return;
    }
    pia_lanes knot[2 * PIA_MAX_DEGREE];
    for (int k = 0; k < 2 * degree; k++) knot[k] = pia_lanes_load(c->knots + 1 + k, column);
    pia_lanes_basis(knot, degree, pia_lanes_load(c->parameters, row), value);
}

#endif
