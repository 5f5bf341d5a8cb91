/* The model: an immutable spline, clamped in every direction. Rational control points are stored as (w x, w). */
#ifndef PIA_SPLINE_MODEL_H
#define PIA_SPLINE_MODEL_H

#include "context.h"
#include "summary.h"
#include "trim.h"

enum { PIA_MAX_WIDTH = PIA_MAX_DIM + 1 };

struct pia_model {
    pia_memory memory;
    int directions; /* 1 curve, 2 surface */
    int dim;        /* components of a point, without the weight */
    int rational;
    int degree[2];        /* degree[1] is 0 for a curve */
    pia_index control[2]; /* control[1] is 1 for a curve */
    double *knots[2];     /* [control + degree + 1]; knots[1] is NULL for a curve */
    double *points;       /* [control[0] x control[1] x (dim + rational)] */
    int periodic[2];
    pia_summary *summary; /* NULL unless a fit made the model */
    pia_trim *trim;       /* NULL unless the surface is trimmed */
};

/* A model whose knots and points are still to be filled in. Checks degrees, counts and sizes only. */
pia_status pia_model_new(pia_context *context, int directions, const int *degree, const pia_index *control, int dim, int rational,
                         pia_model **out);

/* The same from arrays of the context's allocator where they are not NULL: knots[d] [control + degree + 1], *points [control[0] x
 * control[1] x (dim + rational)]. The model owns them, and the pointers are NULL, unless the shape is refused or there is no memory for
 * the model itself. */
pia_status pia_model_adopt(pia_context *context, int directions, const int *degree, const pia_index *control, int dim, int rational,
                           double **knots, double **points, pia_model **out);

/* Components of a stored control point: dim, or dim + 1 when rational. */
int pia_model_width(const pia_model *model);

/* A model as lines of control points along one direction: [outer x control x inner] doubles, inner contiguous. */
typedef struct pia_lines {
    pia_index outer, inner;
} pia_lines;
pia_lines pia_model_lines(const pia_model *model, int direction);

/* PIA_E_ARGUMENT unless model is there and `direction` is one of its directions. */
pia_status pia_model_check_direction(pia_context *context, const pia_model *model, int direction);

/* Whether start and end of `direction` join with degree-1 continuous derivatives, to 1e-9 of the control points' extent. */
int pia_model_joins(const pia_model *model, int direction);

/* A closed spline in its cyclic form, turned into the clamped model that files and CAD systems understand. knots[d] has
 * control[d] + degree[d] + 1 values, cyclic where closed[d] (see knots.h; control[d] then counts the wrapped copies too), clamped
 * elsewhere. points [control[0] x control[1] x dim] with the wrapped copies in place. A seam knot of multiplicity m gives a model with
 * m-1 control points less. */
pia_status pia_model_from_cyclic(pia_context *context, int directions, const int *degree, const double *const *knots,
                                 const pia_index *control, const int *closed, int dim, const double *points, pia_model **out);

/* The inverse for a periodic clamped direction: cyclic knots (caller gives room for control + degree + 1 values, the model's own
 * counts) and control points with the wrapped copies in place, [control[0] x control[1] x dim]. Directions that are not
 * periodic are copied. PIA_E_SHAPE when a direction called periodic does not join smoothly. Polynomial models only. */
pia_status pia_model_to_cyclic(pia_context *context, const pia_model *model, double *const *knots, double *points);

#endif
