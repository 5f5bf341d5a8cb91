/* Control parameters ([2011] Eq. (37), (39), (40)): the data lines that the control points stand for, a direction. Knots are means of
 * their parameters, Eq. (38); adding a line adds a control point. */
#ifndef PIA_FIT_SEQUENCE_H
#define PIA_FIT_SEQUENCE_H

#include "fence.h"
#include "fit.h"
#include "groups.h"

enum { PIA_LINE_FREE, PIA_LINE_CHOSEN, PIA_LINE_ADDED /* chosen, but the knots do not know it yet */ };

typedef struct pia_sequence {
    pia_index lines[2];                      /* data lines; of scattered points their different parameters */
    const double *parameter[2];              /* [lines], rising */
    double *distinct[2];                     /* the same of scattered points, owned; else NULL */
    double *curvature[2];                    /* [lines] Eq. (30), (32), (33); 0 for scattered points */
    unsigned char *mark[2];                  /* [lines] PIA_LINE_... */
    unsigned char *own[2];                   /* [lines] 1: a group of its own */
    pia_index *chosen[2];                    /* [full of the fit] the chosen lines in order, room for all */
    pia_index *first[2], *begin[2], *end[2]; /* fences and groups (place/fence.h), room for all lines and one */
    pia_index *start, *row;                  /* groups of scattered points (op/groups.h) */
    pia_groups groups;
    double last_error; /* e_d of the iteration before; NAN: none */
    int grows;         /* towards a tolerance, lines are added */
    int validated;     /* the lines were chosen by curvature alone, so the validity check may add to them */
} pia_sequence;

/* Allocates the sequence with its curvatures, no line chosen. Errors: PIA_E_ARGUMENT for closed directions and holes, PIA_E_MEMORY. */
pia_status pia_sequence_open(pia_fit *fit);
void pia_sequence_close(pia_fit *fit);

/* Chooses the ends, the dominant lines and those of the rows to be met, as many as the options ask, at least degree + 1. */
pia_status pia_sequence_choose(pia_fit *fit);
/* Chooses the lines nearest to the Greville abscissae of the fit's knots, one a control point. */
pia_status pia_sequence_from_knots(pia_fit *fit);
/* The lines of a direction as numbers [lines], 1 chosen + 2 a group of its own; and back, which returns how many are chosen. */
void pia_sequence_flags(const pia_sequence *sequence, int direction, pia_index *flags);
pia_index pia_sequence_restore(pia_sequence *sequence, int direction, const pia_index *flags);
/* Knots of the fit from the chosen lines, Eq. (38); the operator is not made. */
pia_status pia_sequence_place(pia_fit *fit);

/* Marks up to `most` lines (of a surface pairs of lines) as added: those of the worst rows that are not chosen, no two in one gap, all
 * but the first above the tolerance. Needs the residuals of the iterate. *picked is how many rows were found. */
pia_status pia_sequence_pick(pia_fit *fit, pia_index most, pia_index *picked);
/* Takes the added lines into knots and operator. carry 1: the control points are carried over by knot insertion in the old knots,
 * which the means then replace, so that the shape moves a little; 0: they are left undefined. */
pia_status pia_sequence_grow(pia_fit *fit, int carry);

/* Method epia. Groups for the current operator, and knot insertion for the loop; control points that are the means of their groups, for
 * scattered points; the validity check of Eq. (47) before the first iteration; what the outcome tells. */
pia_status pia_epia_group(pia_fit *fit);
pia_status pia_epia_start(pia_fit *fit);
pia_status pia_epia_validate(pia_fit *fit);
void pia_epia_outcome(pia_fit *fit);

/* Park 2011: least squares, lines of the worst point added, least squares again, until the tolerance holds. */
pia_status pia_fit_dominant_columns(pia_fit *fit);

#endif
