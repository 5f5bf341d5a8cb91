/* Control parameters ([2011] Eq. (37), (39), (40)): the data lines that the control points stand for, a direction. Knots are means of
 * their parameters, Eq. (38); adding a line adds a control point. */
#ifndef PIA_FIT_SEQUENCE_H
#define PIA_FIT_SEQUENCE_H

#include "fence.h"
#include "fit.h"
#include "groups.h"
#include "part.h"

enum { PIA_LINE_FREE, PIA_LINE_CHOSEN, PIA_LINE_ADDED /* chosen, but the knots do not know it yet */ };

/* The control points that follow when data points of a settled fit have moved. They are kept as data lines, which new knots do not
 * renumber. */
typedef struct pia_zone {
    int open;         /* 0: all control points move */
    pia_index low[2]; /* data line of the first and of the last of them */
    pia_index high[2];
    pia_block control;  /* these control points */
    pia_part *part;     /* the rows they touch; NULL unless open */
    pia_index edits;    /* points moved since the fit was last settled; 0: none */
    pia_index updates;  /* iterations since */
    pia_index followed; /* most control points that moved in one of them */
    pia_index read;     /* rows that they have looked at */
} pia_zone;

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
    pia_zone zone;
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

/* The line of a row in direction d. */
pia_index pia_sequence_line(const pia_fit *fit, pia_index row, int d);
/* Marks up to `most` lines (of a surface pairs of lines) as added: those of the worst rows that are not chosen and whose owners move,
 * no two in one gap, all but the first above the tolerance. Needs the residuals of the iterate. *picked is how many rows were found. */
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
/* The control point of direction d whose group has the line. */
pia_index pia_epia_owner(const pia_fit *fit, int d, pia_index line);
/* As pia_solve_step; before it ends because no control point moves, those beside an edit get their turn. */
pia_status pia_epia_step(pia_fit *fit, pia_index iterations);

/* ---- local edits of method epia (sequence_zone.c) ---- */

/* A row has moved, and the loop is about to begin anew: the owner of its group and four control points on either side follow, beside
 * those of earlier edits that are not settled yet. Where the fit itself is not settled all move, as before. */
pia_status pia_zone_edit(pia_fit *fit, pia_index row);
/* The zone on the current operator and groups. */
pia_status pia_zone_bind(pia_fit *fit);
/* An update of the loop is done, R still that of the iterate before it. Counts it. A control point beside the zone that would move
 * farther than `moved` and than the tolerance takes the zone over itself and degree more on every side; *wider tells. */
pia_status pia_zone_update(pia_fit *fit, double moved, int *wider);
/* No control point of the zone moves much any more. *settled 1: and the worst row is one of theirs. Else the zone takes its owner in,
 * or where that is not beside it, all control points move. */
pia_status pia_zone_settle(pia_fit *fit, int *settled);
/* Whether the owner of a row moves. */
int pia_zone_owns(const pia_fit *fit, pia_index row);
/* Before growing: the zone reaches degree + 1 control points beyond the owners of added lines. */
void pia_zone_reach_added(pia_fit *fit);
/* All control points move again. What was counted stays; or is forgotten as well, for a fit with or without a sequence. */
void pia_zone_release(pia_fit *fit);
void pia_zone_close(pia_fit *fit);
/* As numbers [PIA_ZONE_NUMBERS], and back; then bind. */
enum { PIA_ZONE_NUMBERS = 9 };
void pia_zone_numbers(const pia_fit *fit, pia_index *numbers);
void pia_zone_restore(pia_fit *fit, const pia_index *numbers);
/* What the edits have cost, into the outcome. */
void pia_zone_outcome(pia_fit *fit);

/* Park 2011: least squares, lines of the worst point added, least squares again, until the tolerance holds. */
pia_status pia_fit_dominant_columns(pia_fit *fit);

#endif
