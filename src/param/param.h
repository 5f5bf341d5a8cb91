/* Parametrizations: from points to parameters, one file each. */
#ifndef PIA_PARAM_PARAM_H
#define PIA_PARAM_PARAM_H

#include "context.h"

typedef struct pia_parametrization {
    const char *name, *title, *reference, *detail;
    /* parameters [count] of ordered points [count x dim], count >= 2, non-decreasing from exactly 0 to exactly 1. Equal neighbours get
     * equal parameters where the rule says so. closed: the period ends at 1 where point 0 would come again; the last parameter is then
     * below 1 (the points do not repeat the first one). degree is for the universal rule. Allocates nothing. Errors: PIA_E_DATA
     * when all points are equal. */
    pia_status (*compute)(pia_context *context, const double *points, pia_index count, int dim, int degree, int closed,
                          double *parameters);
} pia_parametrization;

/* The registry, collected from the files param_*.c; NULL past the end. */
const pia_parametrization *pia_param_list(pia_index index);
const pia_parametrization *pia_param_find(const char *name);

/* Parameters of a grid [rows x columns x dim]: each direction's rule is averaged over the lines of the other; u [rows], v [columns].
 * What is averaged are the steps from point to point: points with a NaN component are left out, a step over them is shared evenly,
 * and an open line that lacks its ends counts for the share of the grid it covers. Lines of zero length and of fewer than two points
 * do not count; a step that no line covers is taken as 1 / (count - 1). closed as above, per direction. Errors: PIA_E_SHAPE for
 * fewer than two rows or columns, PIA_E_DATA when every line of a direction has zero length, PIA_E_MEMORY. */
pia_status pia_param_grid(pia_context *context, const pia_parametrization *rule, const double *points, const pia_index count[2],
                          int dim, const int degree[2], const int closed[2], double *u, double *v);

#endif
