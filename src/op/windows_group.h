/* Eight neighbouring windows, solved side by side in the lanes of vectors. */
#ifndef PIA_OP_WINDOWS_GROUP_H
#define PIA_OP_WINDOWS_GROUP_H

#include "windows.h"

enum { PIA_WINDOW_GROUP = 8 };

/* What all windows have in common. */
typedef struct pia_windows {
    const pia_collocation *line;
    const pia_targets *targets;
    const double *points; /* where control points start; NULL: at the targets */
    double *next;
    int degree, dim;
    pia_index count, size; /* windows; rows of each, its margins included, a multiple of PIA_LANES */
} pia_windows;

typedef struct pia_window_group {
    pia_index low[PIA_WINDOW_GROUP];                        /* the first row of each window */
    pia_index own[PIA_WINDOW_GROUP], end[PIA_WINDOW_GROUP]; /* the rows that are its share of the result, from low */
    int walks;                          /* 1: rows one after the other lie on spans one after the other, in all windows alike */
    pia_index column[PIA_WINDOW_GROUP]; /* then: of the first row of each */
    int before, reach;                  /* then: columns of a row before its diagonal; on the wider side */
} pia_window_group;

/* Bytes that a solver needs as `room`, aligned to 64. */
pia_index pia_windows_room(const pia_windows *w);

/* Writes the windows' own rows of next and joins their errors. Returns 0 where a row does not reach its diagonal, a parameter does not
 * rise or a pivot vanishes. With vectors of four, and of eight where the processor has them: the bits are the same. */
typedef int pia_windows_solver(const pia_windows *w, const pia_window_group *g, void *room, pia_step_errors *errors);
pia_windows_solver pia_windows_solve_by_four, pia_windows_solve_by_eight;
/* pia_windows_step with one of them. */
pia_status pia_windows_step_with(pia_windows_solver *solve, const pia_op *op, const double *x, const pia_targets *targets, double *next,
                                 pia_survey *survey, pia_step_errors *out, int *done);

#endif
