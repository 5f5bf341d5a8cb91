/* What a set of constraints holds inside its module, and the small dense systems S x = r over its independent conditions. */
#ifndef PIA_CONSTRAINT_CONDITIONS_H
#define PIA_CONSTRAINT_CONDITIONS_H

#include "constraint.h"
#include "functional.h"

/* Where a row came from, for messages. */
typedef struct pia_origin {
    pia_index point; /* data row, -1: a parameter */
    double at[2];
    int derivative[2];
    int directions;
} pia_origin;

enum { PIA_ORIGIN_SIZE = 96 };

/* The system over the conditions, S(a, b) = b_i' M b_j (e_a . e_b) for some symmetric positive M on the unknowns. */
typedef struct pia_schur {
    pia_index size, rank;
    int dim;             /* right-hand sides: the components of the points, or 1 when conditions are scalars */
    double *matrix;      /* [size x size] lower triangle of S, then its factor */
    pia_index *order;    /* [size] */
    double *x, *scratch; /* [size x dim] */
} pia_schur;

struct pia_constraints {
    pia_context *context;
    const pia_op *op;
    int dim;
    double extent;
    pia_index count; /* rows */
    pia_functional *row;
    pia_origin *origin;
    double *right;             /* R [count x dim], relative to the targets' origin */
    double *axis;              /* [count x dim] unit vector of the free component of a row, zeros: none; NULL: no row has one */
    pia_index rank;            /* conditions */
    pia_index *begin;          /* [count + 1] conditions of row i are begin[i] .. begin[i + 1] - 1: at most one without `axis` */
    pia_index *of;             /* [rank] row of a condition */
    double *basis;             /* [rank x dim] its vector e; NULL without `axis`: a condition is a whole row, all components */
    double *inverse;           /* [cols] D^-1, 0 where frozen */
    pia_schur metric;          /* of D^-1 */
    pia_schur direct;          /* of H^-1, once pia_constraints_factor was called */
    double *left, *multiplier; /* work [count x dim] */
    double *scratch;           /* work [cols] */
};

/* The row in words: "point 17", "derivative 1 at 0.25". Returns text. */
const char *pia_origin_text(const pia_origin *origin, char text[PIA_ORIGIN_SIZE]);

/* Takes the free component of row i out of value [dim]. */
void pia_row_across(const pia_constraints *c, pia_index i, double *value);

/* Room for S over the conditions of c. Errors: PIA_E_MEMORY, PIA_E_SIZE. */
pia_status pia_schur_open(const pia_constraints *c, pia_schur *out);
void pia_schur_close(const pia_constraints *c, pia_schur *s);
/* The lower triangle's part in the columns of row j, from column [count] = B M b_j, of which entries j and later are used. */
void pia_schur_fill(const pia_constraints *c, pia_schur *s, pia_index j, const double *column);
/* Cholesky with pivoting; pivots below rtol of the largest end it. */
void pia_schur_factor(pia_schur *s, double rtol);
/* x [size x dim of s] := S^-1 x; dependent conditions become 0. */
void pia_schur_solve_conditions(const pia_schur *s, double *x);
/* multiplier [count x dim] = S^-1 of the conditions' part of left [count x dim]. */
void pia_schur_solve(const pia_constraints *c, const pia_schur *s, const double *left, double *multiplier);
/* S of H^-1, unfactored. Errors: PIA_E_MEMORY. */
pia_status pia_schur_of_normal(const pia_constraints *c, const pia_normal *normal, pia_schur *s);
/* The same where H is a Kronecker product of full rank: O(count (count + unknowns a direction) degree). */
pia_status pia_schur_of_product(const pia_constraints *c, const pia_normal *normal, pia_schur *s);
/* S of the metric D^-1, unfactored. */
void pia_schur_of_metric(const pia_constraints *c, pia_schur *s);

/* Right-hand sides of the conditions, x [size x dim of s], from rows; and back. */
void pia_conditions_gather(const pia_constraints *c, const double *rows, double *x);
void pia_conditions_scatter(const pia_constraints *c, const double *x, double *rows);

/* The conditions of all rows; later, of those `keep` [rank] says. Errors: PIA_E_MEMORY. */
pia_status pia_conditions_open(pia_constraints *c);
void pia_conditions_keep(pia_constraints *c, const unsigned char *keep);

/* Finds conditions that depend on others, drops them with a note, refuses contradictions. Leaves the metric D = 1. */
pia_status pia_constraints_clean(pia_constraints *c, const double *points, pia_notes *notes);

#endif
