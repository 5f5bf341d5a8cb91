/* A draft: a curve whose knots are being thinned out. A trial takes knots away and fits the control points of a window around them
 * anew, all others staying where they are, so that it costs the data of a few spans, however long the curve.
 *
 * Control point i lives on knots i .. i + degree + 1. Closed drafts are cyclic: any integer is a knot and control index, one period
 * being `count` of each and 1 in the parameter. Open drafts have clamped ends. */
#ifndef PIA_OP_DRAFT_H
#define PIA_OP_DRAFT_H

#include "context.h"

typedef struct pia_draft {
    pia_context *context;
    int degree, dim, closed;
    pia_index count;      /* control points; of a closed draft the distinct ones */
    double *knots;        /* open: [count + degree + 1]; closed: one period [count] */
    double *control;      /* [count x dim], relative to origin */
    unsigned char *tried; /* [as knots] the caller\'s marks; cleared for every knot whose trial a taken one has made worth repeating */
    /* The data, borrowed: sorted parameters, and the inverse of what each row may deviate. */
    const double *parameters, *points, *origin;
    const double *inverse_tolerance; /* [rows]; NULL: inverse_one for all */
    double inverse_one;
    pia_index rows;
    double *work; /* what a window needs of its data rows */
    pia_index work_rows;
} pia_draft;

double pia_draft_knot(const pia_draft *draft, pia_index i);
/* First and one past the last knot index that may be taken away. */
void pia_draft_inside(const pia_draft *draft, pia_index *first, pia_index *end);

/* An index of the removable knot of this value (of a closed draft, up to whole periods); -1: there is none. */
pia_index pia_draft_find(const pia_draft *draft, double knot);

typedef struct pia_trial {
    double ratio; /* largest deviation over what is allowed, after the fit; at most 1 is good */
    int taken;    /* the draft has changed */
} pia_trial;

/* Tries the curve with knots first .. first + removed - 1 replaced by `added` (inserted < removed of them, at most 4, sorted, in the
 * gap they leave). The control points within `reach` of those knots are fitted anew: by least squares, then reweighted towards the
 * smallest largest deviation (Lawson 1961), at most `rounds` times, as long as the bound from below (the weighted root mean square)
 * does not prove that 1 cannot be had. Taken over when the ratio is at most 1; else nothing changes. Closed drafts may renumber their
 * knots (a rotation). Errors: PIA_E_MEMORY, PIA_E_SIZE. */
pia_status pia_draft_replace(pia_draft *draft, pia_index first, int removed, const double *added, int inserted, int reach, int rounds,
                             pia_trial *trial);

/* Releases the work array; the other arrays belong to the caller. */
void pia_draft_close(pia_draft *draft);

#endif
