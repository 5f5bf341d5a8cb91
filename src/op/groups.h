/* Groups of data rows, one a control point, whose mean residual moves it ([2011] Eq. (5), (9), (22)). Groups are disjoint and need not
 * cover all rows. */
#ifndef PIA_OP_GROUPS_H
#define PIA_OP_GROUPS_H

#include "op.h"

/* Curves and grids: control point (g, h) has the lines begin[0][g] .. end[0][g] - 1 and, of a grid, begin[1][h] .. end[1][h] - 1 of the
 * second direction. Scattered points: control point c has the rows row[start[c]] .. row[start[c + 1] - 1]. */
typedef struct pia_groups {
    pia_index count[2];                 /* control points a direction; count[1] is 1 of a curve */
    pia_index rows;                     /* data rows in all */
    pia_index lines;                    /* data lines of the second direction; 1 of a curve */
    const pia_index *begin[2], *end[2]; /* [count]; of a curve the second direction is 0 .. 0; NULL for scattered points */
    const pia_index *start, *row;       /* [count + 1], [rows]; NULL for curves and grids */
    const pia_block *moving;            /* control points that move, whatever the groups of the others say; NULL: all */
} pia_groups;

/* means [groups x dim] of values [rows x dim], times `factor`; 0 for a group without rows and for control points that stay. On threads,
 * the same bits for any number of them. */
void pia_groups_mean(pia_context *context, const pia_groups *groups, const double *values, int dim, double factor, double *means);

/* agreement [groups] = |sum of values| / sum of |value| of each group, Eq. (47): 1 where all point the same way, and where there are
 * no two rows that are not 0. */
void pia_groups_agreement(pia_context *context, const pia_groups *groups, const double *values, int dim, double *agreement);

/* The longest mean of the groups in `box` whose control points stay: how far one of them would move. */
double pia_groups_longest(const pia_groups *groups, const double *values, int dim, const pia_block *box);

/* Number of groups without rows. */
pia_index pia_groups_empty(const pia_groups *groups);

#endif
