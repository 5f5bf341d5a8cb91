/* A draft: a curve, or a piece of one, whose knots are being thinned out. A trial takes knots away and fits the control points of a
 * window around them anew, all others staying where they are, so that it costs the data of a few spans, however long the curve.
 *
 * Control point i lives on knots i .. i + degree + 1. A cyclic draft is a whole short closed curve: any integer is a knot and control
 * index, one period being `count` of each and 1 in the parameter. Longer closed curves are unrolled into pieces. */
#ifndef PIA_OP_DRAFT_H
#define PIA_OP_DRAFT_H

#include "context.h"

#include <math.h>

/* What a curve is to meet exactly: its derivative of this order at the parameter. */
typedef struct pia_draft_condition {
    double parameter;
    int order;
    const double *value; /* [dim]; of order 0 relative to the origin */
} pia_draft_condition;

/* The data, borrowed: sorted parameters, and the inverse of what each row may deviate. */
typedef struct pia_draft_data {
    const double *parameters, *points, *origin;
    const double *inverse_tolerance; /* [rows]; NULL: inverse_one for all */
    double inverse_one;
    const double *inverse_axis; /* [dim] the same of each component, which is kept as well; NULL: no such limits */
    double *swing; /* [rows] how far the curve may be from the straight line to the next row; INFINITY: no matter; NULL: nowhere */
    double *stand; /* [rows] the second derivative with which it surely is no farther */
    pia_index rows;
    int periodic; /* 1: rows repeat with period 1 in the parameter; row numbers are unrolled: any integer is one */
    const pia_draft_condition *condition; /* [condition_count], parameters rising */
    pia_index condition_count;
} pia_draft_data;

/* The largest component [dim] of a deviation over what it may be. */
static inline double pia_axis_ratio(const double *deviation, const double *inverse_axis, int dim)
{
    double ratio = 0;
    for (int d = 0; d < dim; d++) ratio = fmax(ratio, fabs(deviation[d]) * inverse_axis[d]);
    return ratio;
}

/* The distance of x [dim] from the straight line between a and b. */
static inline double pia_draft_distance(const double *x, const double *a, const double *b, int dim)
{
    double along = 0, length = 0, square = 0;
    for (int d = 0; d < dim; d++) {
        along += (x[d] - a[d]) * (b[d] - a[d]);
        length += (b[d] - a[d]) * (b[d] - a[d]);
    }
    double share = length > 0 ? fmin(fmax(along / length, 0), 1) : 0;
    for (int d = 0; d < dim; d++) {
        double off = x[d] - a[d] - share * (b[d] - a[d]);
        square += off * off;
    }
    return sqrt(square);
}

/* Places looked at where a span and the gap between two rows meet, and parts of the span that the gap has to be longer than. */
enum { PIA_DRAFT_PLACES = 3, PIA_DRAFT_PARTS = 8 };

/* Marks of a knot. */
enum { PIA_DRAFT_SPARED = 1, PIA_DRAFT_MERGED = 2, PIA_DRAFT_KEPT = 4 };

typedef struct pia_draft {
    const pia_draft_data *data;
    int degree, dim, cyclic;
    int stays[2];        /* control points that stay at either end: `degree` where the draft was cut off from a longer curve */
    pia_index count;     /* control points; of a cyclic draft the distinct ones */
    pia_index room;      /* control points that knots, control and mark have room for; 0: no more than there are */
    double *knots;       /* [count + degree + 1]; cyclic: one period [count]; room for more where a trial adds knots */
    double *control;     /* [count x dim], relative to origin */
    unsigned char *mark; /* [as knots] what was tried in vain with a knot since something changed near it, and knots that are kept */
    unsigned char *critical; /* [data->rows] 1: a row that has decided a trial, which later trials look at first */
    double *work;            /* [pia_draft_room] */
} pia_draft;

/* Doubles of work space that trials of this reach need. */
pia_index pia_draft_room(int degree, int dim, int reach);

double pia_draft_knot(const pia_draft *draft, pia_index i);
const double *pia_draft_point(const pia_draft *draft, pia_index i);
/* First and one past the last knot index that may be taken away. */
void pia_draft_inside(const pia_draft *draft, pia_index *first, pia_index *end);
/* An index of the inside knot of this value; -1: there is none. */
pia_index pia_draft_find(const pia_draft *draft, double knot);
/* Parameter of an unrolled row number, and the row behind it. */
double pia_draft_row(const pia_draft_data *data, pia_index row, pia_index *at);
/* Sets swing and stand of a row. */
void pia_draft_let_swing(const pia_draft_data *data, pia_index at, double swing);
/* First row whose parameter is at least t, unrolled. */
pia_index pia_draft_lower_row(const pia_draft_data *data, double t);

/* Tries the curve with knots first .. first + removed - 1 replaced by `added` (`inserted` of them, sorted, in the gap they leave). The
 * control points within `reach` of those knots are fitted anew (window.h), by at most `rounds` reweightings. Taken over when no row
 * deviates more than it may, the curve swings out nowhere between rows more than it may and all conditions are met; else nothing
 * changes. Returns 1 when taken over. */
int pia_draft_replace(pia_draft *draft, pia_index first, int removed, const double *added, int inserted, int reach, int rounds);
/* The same with at least as many knots as before, for `gaps` gaps from the one behind this unrolled row on, in which they all are. */
int pia_draft_fill(pia_draft *draft, pia_index row, int gaps, pia_index first, int removed, const double *added, int inserted,
                   int reach, int rounds);

#endif
