/* The Gram matrix A'WA of one direction in the space of its unknowns: banded, and cyclic where the direction is closed. */
#ifndef PIA_OP_GRAM_H
#define PIA_OP_GRAM_H

#include "collocation.h"

typedef struct pia_gram {
    pia_context *context;
    const pia_collocation *line; /* borrowed */
    pia_index count;             /* unknowns */
    int width;                   /* the degree */
    double *band;                /* [count x (width + 1)], entry (i, k) couples unknowns i and i + k (closed: modulo count) */
    double *factor, *border;     /* its LDL'; NULL until factored */
    unsigned char *still;        /* [count] then: 1 where an unknown is frozen or has no data */
    int any_still, factor_width;
    pia_index weak;    /* unknowns without data, or that the data do not tell apart */
    pia_index refused; /* those of the second kind, as far as the digits of the matrix say */
} pia_gram;

/* A matrix whose numbers are not set yet. */
pia_status pia_gram_open(pia_context *context, const pia_collocation *line, pia_gram *out);
void pia_gram_close(pia_gram *gram);
/* All numbers 0. */
void pia_gram_clear(pia_gram *gram);
/* Adds the share of span s (span_sums.h). */
void pia_gram_add(pia_gram *gram, pia_index s, const double *share);
/* Its part in one row alone: row [width + 1 - k] holds the products of function s + k with s + k .. s + width. */
void pia_gram_add_row(pia_gram *gram, pia_index s, int k, const double *row);
/* [count] */
void pia_gram_diagonal(const pia_gram *gram, double *out);

/* y = G x along one direction of arrays [before x count x after]. */
void pia_gram_multiply(const pia_gram *gram, const double *x, pia_index before, pia_index after, double *y);

/* One symmetric Gauss-Seidel sweep for G x = b, unknowns upwards and back: x, b [count x dim], dim at most PIA_MAX_DIM. Unknowns that
 * are frozen ([count]; NULL: none) or without data stay. diagonal as pia_gram_diagonal gives it. */
void pia_gram_sweep(const pia_gram *gram, const unsigned char *frozen, const double *diagonal, const double *b, int dim, double *x);

/* Prepares pia_gram_solve; again after every change of the matrix. frozen [count] (NULL: none): those unknowns solve to 0, and so do
 * those without data. Where the rest is singular to working precision, 1e-9 of the diagonal is added to it: corrections solved for
 * then stay small where the data say nothing. Errors: PIA_E_MEMORY. */
pia_status pia_gram_factor(pia_gram *gram, const unsigned char *frozen);
/* b [before x count x after] := G^-1 b. */
void pia_gram_solve(const pia_gram *gram, double *b, pia_index before, pia_index after);
/* x := G^-1 b once, without a factor, [count x dim], as pia_band_windows_solve does it. *done = 0 where this matrix is too small for
 * that or singular to working precision. Errors: PIA_E_MEMORY. */
pia_status pia_gram_leap(const pia_gram *gram, const double *b, int dim, double *x, int *done);
/* Sum of squares of b - G x [count x dim], in fixed order; r receives the difference, NULL: it is not wanted. */
double pia_gram_residual(const pia_gram *gram, const double *x, const double *b, int dim, double *r);

#endif
