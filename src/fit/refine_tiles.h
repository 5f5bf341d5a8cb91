/* Relaxation on a grid: the same search as refine_relax.c, on tiles of columns, without all that a fit does beside it. Components that
 * vary along one direction alone, as x and y of heights over a lattice do, are fitted by least squares of a curve, and what they
 * deviate is taken off what the others may. */
#ifndef PIA_FIT_REFINE_TILES_H
#define PIA_FIT_REFINE_TILES_H

#include "projection.h"
#include "refine.h"

typedef struct pia_tiles {
    pia_fit *fit;
    int dim, component[PIA_MAX_DIM]; /* those that are relaxed */
    int direction[PIA_MAX_DIM];      /* of all: the one along which it varies alone and is not relaxed; -1: it is */
    pia_projection_line line[2];
    pia_projection projection;
    double *points;       /* [tiles x dim x rows x PIA_TILE] relative to the origin; 0 past the last column */
    double *moved, *next; /* [the same] the points as they have been moved by the last search that succeeded, and by this one: the
                             nearest spline to them keeps the tolerance */
    double *radius;       /* [tiles x rows x PIA_TILE] what the relaxed components may deviate */
    double *single[2];    /* [count x PIA_TILE] coefficients of components that vary along a direction, one a lane */
    double *squares[2];   /* [rows of the direction] what they deviate, squared */
    double *worst;        /* [tiles] largest square of a deviation over the radius, beyond 1 */
    double *room;         /* [longer direction x 2 PIA_TILE] */
    int moves;            /* 1: moved is there */
} pia_tiles;

/* Whether a fit can be relaxed on tiles. */
int pia_tiles_suit(const pia_fit *fit);
/* On the knots of the fit, from fit->relaxed where there is one. Errors: PIA_E_MEMORY, with nothing to close. */
pia_status pia_tiles_open(pia_fit *fit, pia_tiles *out);
/* What was found stays in fit->relaxed. Errors: PIA_E_MEMORY. */
pia_status pia_tiles_close(pia_tiles *tiles);
/* Looks for control points on the knots of the tiles that keep the tolerance. */
pia_status pia_tiles_search(pia_tiles *tiles, int *found);
/* [full[0] x full[1] x dim] of the fit. */
void pia_tiles_control(const pia_tiles *tiles, double *control);
/* Other knots, strictly inside the domain of a direction; the former ones are in *line, to be put back by exchange or closed. */
pia_status pia_tiles_place(pia_tiles *tiles, int direction, const double *inside, pia_index count, pia_projection_line *before);
void pia_tiles_put_back(pia_tiles *tiles, int direction, pia_projection_line *before);
/* What the last search found becomes what the next begins with. */
void pia_tiles_keep(pia_tiles *tiles);

#endif
