/* One direction of an operator: the rows of basis values of sorted parameters on one knot vector, and how the control points that
 * the knots see ("full", wrapped and doubled copies included) come from the unknowns. Curves have one, grids two. */
#ifndef PIA_OP_COLLOCATION_H
#define PIA_OP_COLLOCATION_H

#include "context.h"

typedef enum pia_map {
    PIA_MAP_IDENTITY, /* full = unknowns */
    PIA_MAP_CYCLIC,   /* full = unknowns + degree, the last degree columns repeat the first */
    PIA_MAP_DOUBLED   /* full = unknowns + 2, the first and the last column repeat their neighbour ([2004] Eq. 2) */
} pia_map;

typedef struct pia_collocation {
    int degree;
    pia_map map;
    pia_index full, unknowns, rows;
    const double *knots;      /* [full + degree + 1], borrowed */
    const double *parameters; /* [rows], non-decreasing, inside the domain, borrowed */
    pia_index last;           /* the last span that is not empty; it owns the right end of the domain */
    pia_index *begin;         /* [full - degree + 1]: rows of span degree + s are begin[s] .. begin[s + 1] - 1; NULL: not kept */
    pia_index most;           /* rows of a span at most, where begins are kept */
    double *values;           /* [rows x (degree + 1)] basis values, or NULL: evaluated where needed */
    pia_index offset;         /* cyclic: full column i is unknown (i + offset) mod unknowns; interpolation chooses it so that unknown c
                                 is centred on row c */
} pia_collocation;

enum {
    PIA_STORE_VALUES = 1,  /* basis values (8 (degree + 1) bytes a row), for methods that pass over the rows often */
    PIA_WITHOUT_BEGINS = 2 /* no `begin` (8 bytes a span): nothing will ask for the rows of a span */
};

pia_status pia_collocation_open(pia_context *context, int degree, pia_map map, pia_index offset, const double *knots, pia_index full,
                                const double *parameters, pia_index rows, int keep, pia_collocation *out);
void pia_collocation_close(pia_context *context, pia_collocation *c);
/* The parameters behind the pointer have changed (still sorted): spans and values anew. */
void pia_collocation_rebucket(pia_collocation *c);

/* The degree + 1 basis values of a row on its span, computed into scratch, which is returned. */
const double *pia_collocation_compute_row(const pia_collocation *c, pia_index row, pia_index span, double *scratch);
/* The same, stored ones where there are. */
static inline const double *pia_collocation_row(const pia_collocation *c, pia_index row, pia_index span, double *scratch)
{
    return c->values != NULL ? c->values + row * (c->degree + 1) : pia_collocation_compute_row(c, row, span, scratch);
}
/* Span of a row; O(log spans). */
pia_index pia_collocation_span(const pia_collocation *c, pia_index row);
/* Span of a row of a square matrix that holds its own unknown, at most `degree` knots further; -1 for others. O(degree). */
pia_index pia_collocation_own_span(const pia_collocation *c, pia_index row);
/* Span of a row, from that of a row before it. */
static inline pia_index pia_collocation_advance(const pia_collocation *c, pia_index row, pia_index span)
{
    while (span < c->last && c->parameters[row] >= c->knots[span + 1]) span++;
    return span;
}
/* First row of span `span` or a later one. O(log rows). */
pia_index pia_collocation_begin(const pia_collocation *c, pia_index span);
/* The unknown behind a full column. */
pia_index pia_collocation_unknown(const pia_collocation *c, pia_index column);

/* Along one direction of an array seen as [before x (length) x after] doubles:
 * full from unknowns (copies), and unknowns from full (sums: the transposed map). */
void pia_collocation_expand(const pia_collocation *c, const double *unknowns, pia_index before, pia_index after, double *full);
void pia_collocation_reduce(const pia_collocation *c, const double *full, pia_index before, pia_index after, double *unknowns);

/* Sum of the basis values in each unknown, weighted by weights [rows] (NULL: 1): sums [unknowns]. */
void pia_collocation_column_sums(const pia_collocation *c, const double *weights, double *sums);

/* Dense row in the unknowns: entries [width] from column *first, wrapped copies folded in. width is degree + 1; returns 0 when the row
 * wraps around (cyclic), where *first + k is meant modulo the unknowns. */
int pia_collocation_entries(const pia_collocation *c, pia_index row, pia_index span, pia_index *first, double *entries);

#endif
