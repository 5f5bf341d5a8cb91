/* The nearest spline to values on a whole grid, over and over: P = Pu (x) Pv, P = N (N'N)^-1 N' of each direction, as fast as it gets.
 * Values lie in tiles of eight columns, which run down the rows of the grid, so that eight columns are one or two vectors and all that
 * a tile needs stays in the first cache. Components lie one after the other. */
#ifndef PIA_OP_PROJECTION_H
#define PIA_OP_PROJECTION_H

#include "collocation.h"

enum { PIA_TILE = 8 };

/* One direction: the basis at its data lines, and the factors of the Gram matrix. */
typedef struct pia_projection_line {
    pia_collocation basis;
    double *knots;  /* [count + degree + 1], owned */
    double *factor; /* [count x (degree + 1)] LDL' of band.h, pivots inverted */
    pia_index count;
} pia_projection_line;

/* Takes the knots over, in any case. Errors: PIA_E_MEMORY, PIA_E_SIZE, which leave *out nothing to close. */
pia_status pia_projection_line_open(pia_context *context, int degree, double *knots, pia_index count, const double *parameters,
                                    pia_index rows, pia_projection_line *out);
void pia_projection_line_close(pia_context *context, pia_projection_line *line);
/* Coefficients [count x PIA_TILE] of the nearest splines to eight columns of values [rows x PIA_TILE]; and the values of splines. */
void pia_projection_line_fit(const pia_projection_line *line, const double *values, double *coefficients);
void pia_projection_line_apply(const pia_projection_line *line, const double *coefficients, double *values);

/* Sees the values of the splines in a tile [dim x rows x PIA_TILE], and replaces them by what is to be projected next; columns past the
 * last one of the grid are 0 and stay so. Tiles are seen in any order, on any thread. */
typedef void pia_exchange(void *owner, pia_index tile, double *values);

typedef struct pia_projection {
    pia_context *context;
    const pia_projection_line *line[2]; /* down the rows of the grid, and along them; borrowed */
    int dim;
    pia_index tiles; /* of columns of the grid */
    double *down;    /* [tiles x dim x count[0] and up to a tile more x PIA_TILE] coefficients down each column of the spline */
    double *along;   /* [dim x tiles of count[0] x rows and up to a tile more x PIA_TILE] the same of the values, side by side */
    double *control; /* [dim x tiles of count[0] x count[1] x PIA_TILE] control points of the spline */
    double *room;    /* [chunks x ...] */
    pia_index chunks;
} pia_projection;

/* For lines of at most so many control points, which are then to be set. Errors: PIA_E_MEMORY, PIA_E_SIZE. */
pia_status pia_projection_open(pia_context *context, const pia_index rows[2], const pia_index most[2], int dim, pia_projection *out);
void pia_projection_close(pia_projection *p);
/* Shows the values of the spline (worthless before the first one is found) and takes the next ones. */
void pia_projection_exchange(pia_projection *p, pia_exchange *exchange, void *owner);
/* Then: makes the nearest spline to those. */
void pia_projection_find(pia_projection *p);
/* Component d of a control point. */
static inline double pia_projection_control(const pia_projection *p, int d, pia_index i, pia_index j)
{
    pia_index tiles = (p->line[0]->count + PIA_TILE - 1) / PIA_TILE;
    return p->control[((d * tiles + i / PIA_TILE) * p->line[1]->count + j) * PIA_TILE + i % PIA_TILE];
}

#endif
