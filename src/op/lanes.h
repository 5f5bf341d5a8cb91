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

/* Component d of rows at[] of array [rows x dim]. */
PIA_INLINE pia_lanes pia_lanes_component(const double *array, const pia_index *at, int dim, int d)
{
    return (pia_lanes){array[at[0] * dim + d], array[at[1] * dim + d], array[at[2] * dim + d], array[at[3] * dim + d]};
}

/* To four neighbours. */
PIA_INLINE void pia_lanes_write(pia_lanes four, double *to)
{
    memcpy(to, &four, sizeof four);
}

/* Rows to columns and back. */
PIA_INLINE void pia_lanes_transpose(pia_lanes square[PIA_LANES])
{
    pia_lanes even = __builtin_shufflevector(square[0], square[1], 0, 4, 2, 6);
    pia_lanes odd = __builtin_shufflevector(square[0], square[1], 1, 5, 3, 7);
    pia_lanes even_below = __builtin_shufflevector(square[2], square[3], 0, 4, 2, 6);
    pia_lanes odd_below = __builtin_shufflevector(square[2], square[3], 1, 5, 3, 7);
    square[0] = __builtin_shufflevector(even, even_below, 0, 1, 4, 5);
    square[1] = __builtin_shufflevector(odd, odd_below, 0, 1, 4, 5);
    square[2] = __builtin_shufflevector(even, even_below, 2, 3, 6, 7);
    square[3] = __builtin_shufflevector(odd, odd_below, 2, 3, 6, 7);
}

/* `yes` where the mask is set, `no` elsewhere. */
PIA_INLINE pia_lanes pia_lanes_choose(pia_lane_masks mask, pia_lanes yes, pia_lanes no)
{
    return (pia_lanes)((mask & (pia_lane_masks)yes) | (~mask & (pia_lane_masks)no));
}

PIA_INLINE int pia_lanes_all(pia_lane_masks mask)
{
    return (mask[0] & mask[1] & mask[2] & mask[3]) != 0;
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

/* The quotients' denominators alone, inverted: [degree (degree + 1) / 2], those of degree 1 first. */
PIA_INLINE void pia_lanes_inverses(const pia_lanes *knot, int degree, pia_lanes *inverse)
{
    for (int d = 1; d <= degree; inverse += d++)
        for (int r = 0; r < d; r++) inverse[r] = 1 / (knot[degree + r] - knot[degree + r - d]);
}

/* Basis values from the inverses, as sums of products of factors that are not negative: small values keep all their digits. */
PIA_INLINE void pia_lanes_exact_basis(const pia_lanes *knot, const pia_lanes *inverse, int degree, pia_lanes t, pia_lanes *value)
{
    pia_lanes left[PIA_MAX_DEGREE], right[PIA_MAX_DEGREE];
    for (int k = 0; k < degree; k++) {
        left[k] = t - knot[degree - 1 - k];
        right[k] = knot[degree + k] - t;
    }
    value[0] = (pia_lanes){1, 1, 1, 1};
    for (int d = 1; d <= degree; inverse += d++) {
        pia_lanes carried = {0};
        for (int r = 0; r < d; r++) {
            pia_lanes part = value[r] * inverse[r];
            value[r] = carried + part * right[r];
            carried = part * left[d - 1 - r];
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

/* The same for PIA_LANES rows from `row` on spans one after the other from `span` on, which they mostly lie on where there are as many
 * knots as rows: nothing is gathered. Returns 0 where they do not. */
PIA_INLINE int pia_lanes_neighbours(const pia_collocation *c, pia_index row, pia_index span, int degree, pia_lanes *value)
{
    if (c->values != NULL || span + PIA_LANES > c->last) return 0;
    pia_lanes t = pia_vector_load(c->parameters + row), knot[2 * PIA_MAX_DEGREE];
    if (!pia_lanes_all((pia_vector_load(c->knots + span) <= t) & (t < pia_vector_load(c->knots + span + 1)))) return 0;
    for (int k = 0; k < 2 * degree; k++) knot[k] = pia_vector_load(c->knots + span - degree + 1 + k);
    pia_lanes_basis(knot, degree, t, value);
    return 1;
}

/* Rows of dim numbers, one after the other, fill dim vectors; dim <= 3. Vector `part` of a number each row, repeated for its
 * components. */
PIA_INLINE pia_lanes pia_lanes_spread(pia_lanes each, int dim, int part)
{
    if (dim == 1) return each;
    if (dim == 2) return part == 0 ? __builtin_shufflevector(each, each, 0, 0, 1, 1) : __builtin_shufflevector(each, each, 2, 2, 3, 3);
    if (part == 0) return __builtin_shufflevector(each, each, 0, 0, 0, 1);
    return part == 1 ? __builtin_shufflevector(each, each, 1, 1, 2, 2) : __builtin_shufflevector(each, each, 2, 3, 3, 3);
}

/* The sum over the components of each row. */
PIA_INLINE pia_lanes pia_lanes_row_sums(const pia_lanes *part, int dim)
{
    if (dim == 1) return part[0];
    if (dim == 2) return __builtin_shufflevector(part[0], part[1], 0, 2, 4, 6) + __builtin_shufflevector(part[0], part[1], 1, 3, 5, 7);
    pia_lanes first = __builtin_shufflevector(__builtin_shufflevector(part[0], part[1], 0, 1, 6, 3), part[2], 0, 5, 2, 3);
    pia_lanes second = __builtin_shufflevector(__builtin_shufflevector(part[0], part[1], 4, 1, 2, 7), part[2], 0, 1, 6, 3);
    pia_lanes third = __builtin_shufflevector(__builtin_shufflevector(part[0], part[1], 0, 5, 2, 3), part[2], 4, 1, 2, 7);
    return __builtin_shufflevector(first, first, 0, 3, 2, 1) + __builtin_shufflevector(second, second, 1, 0, 3, 2) +
           __builtin_shufflevector(third, third, 2, 1, 0, 3);
}

#endif
