/* Banded systems, small and exact in order: results do not depend on threads, and bandwidth 3 is where LAPACK is four times slower.
 * Right-hand sides are row-major [n x dim] and are overwritten by the solution. */
#ifndef PIA_LINALG_BAND_H
#define PIA_LINALG_BAND_H

#include "context.h"

/* Symmetric positive definite, upper band by rows: h[i * (width + 1) + k] = H(i, i + k), k = 0..width (entries past the last column
 * are ignored). LDL' in place. Returns the number of pivots that had to be refused: pivot <= threshold * original diagonal; such a
 * row is decoupled (its unknown becomes 0), its index goes to weak[0..], at most `weak_room` of them (weak may be NULL). */
pia_index pia_band_ldl_factor(double *h, pia_index n, int width, double threshold, pia_index *weak, pia_index weak_room);
enum { PIA_LDL_SIDES = 8 }; /* right-hand sides that are solved together at the least cost each */
void pia_band_ldl_solve(const double *ldl, pia_index n, int width, double *b, int dim);

/* The same for a cyclic band: H(i, (i + k) mod n), n > 2 width. The last `width` unknowns are bordered; border has room for
 * (n + width) * width values. Solving costs 2 n width dim more than without the border. */
pia_index pia_band_cyclic_factor(double *h, pia_index n, int width, double threshold, double *border);
void pia_band_cyclic_solve(const double *ldl, const double *border, pia_index n, int width, double *b, int dim);

/* One such band and right-hand side, cyclic where it wraps. */
typedef struct pia_band_system {
    const double *h, *b; /* [n x (width + 1)], [n x dim] */
    pia_index n;
    int width, dim, wraps;
    double threshold; /* of pivots, relative to the original diagonal */
} pia_band_system;

/* Solves it once, by all threads, with the same bits whatever their number, in windows of rows with a margin on both sides. The inverse
 * of a Gram matrix of B-splines decays exponentially away from its diagonal, so that a window with its margin knows its unknowns to
 * rounding; where data are so uneven that the margin is short, x [n x dim] is an approximation, which who calls looks at. *done = 0
 * where a pivot is refused: x is worthless then. n and width have to suit. Errors: PIA_E_MEMORY. */
int pia_band_windows_suit(pia_index n, int width);
pia_status pia_band_windows_solve(pia_context *context, const pia_band_system *system, double *x, int *done);

/* Square rows of a collocation matrix: row i has `width` entries, first[i] is the column of its first one, a[i * width + k] the
 * entry (i, first[i] + k); first is non-decreasing. Factors without pivoting, which is stable for the totally positive matrices of
 * B-spline interpolation (de Boor, Pinkus 1977). U has ones on its diagonal; L holds the pivots. width <= PIA_MAX_DEGREE + 1, and every
 * row must reach its diagonal: first[i] <= i < first[i] + width. */
typedef struct pia_band_lu {
    pia_index n;
    int lower, upper; /* bandwidths found; entries that are exactly 0 do not count */
    double *entry;    /* [n x (lower + 1 + upper)] */
    double smallest;  /* smallest |pivot| over the largest entry of its row */
} pia_band_lu;
/* PIA_E_DATA with the row when a pivot vanishes (Schoenberg-Whitney fails there), PIA_E_MEMORY, PIA_E_SIZE; *out is then empty. */
pia_status pia_band_lu_factor(pia_context *context, const double *a, const pia_index *first, pia_index n, int width, pia_band_lu *out);
enum { PIA_BAND_SIDES = 32 }; /* right-hand sides that are solved together at the least cost each */
void pia_band_lu_solve(const pia_band_lu *lu, double *b, int dim);
/* Solves the transposed system. */
void pia_band_lu_solve_transposed(const pia_band_lu *lu, double *b, int dim);
void pia_band_lu_clear(pia_context *context, pia_band_lu *lu);

/* Fills in the rows [begin, end): first[i - begin] and a[(i - begin) * width + k]. */
typedef void pia_band_rows(void *work, pia_index begin, pia_index end, pia_index *first, double *a);
/* Factors and solves once, in one pass over rows that are made as they are needed: the matrix and L are never stored. Rows are asked
 * for in order, 128 at a time. Memory [n x (width - 1)]. Errors as pia_band_lu_factor, b is then spoilt. */
pia_status pia_band_lu_stream(pia_context *context, pia_band_rows *rows, void *work, pia_index n, int width, double *b, int dim);

/* General band with partial pivoting: entries (i, j), -lower <= j - i <= upper, given in a dense row store
 * a[i * (lower + 1 + upper) + (j - i + lower)]; what lies outside the matrix is ignored. For KKT systems. PIA_E_DATA with the column
 * when a pivot is at most 2^-52 times the largest entry of its column. Cost n lower (lower + upper). */
typedef struct pia_band_plu {
    pia_index n;
    int lower, upper;
    double *entry;    /* [n x (2 lower + upper + 1)] */
    pia_index *pivot; /* [n] */
} pia_band_plu;
pia_status pia_band_plu_factor(pia_context *context, const double *a, pia_index n, int lower, int upper, pia_band_plu *out);
void pia_band_plu_solve(const pia_band_plu *plu, double *b, int dim);
void pia_band_plu_clear(pia_context *context, pia_band_plu *plu);

/* Least squares by orthogonal factorisation, one row at a time (Givens): rows of `width` entries from column `first`, sorted by
 * first. r is [columns x width] upper band by rows, q is [columns x dim]; both start as zeros. Cost O(width (width + dim)) a row. */
typedef struct pia_band_qr {
    pia_index columns;
    int width, dim;
    double *r, *q;
} pia_band_qr;
pia_status pia_band_qr_open(pia_context *context, pia_index columns, int width, int dim, pia_band_qr *out);
void pia_band_qr_clear(pia_band_qr *qr); /* back to no rows */
/* row [width] and right [dim] are overwritten; first + width <= columns. */
void pia_band_qr_add(pia_band_qr *qr, pia_index first, double *row, double *right);
/* Solution [columns x dim] into x; columns whose diagonal is at most threshold times the largest keep x as it was given, and the others
 * are the best for it. Returns how many those are; what their rows say about other columns is turned into the rows below, which costs
 * O(columns width) each and uses the factor up: solve once. */
pia_index pia_band_qr_solve(pia_band_qr *qr, double threshold, double *x);
void pia_band_qr_close(pia_context *context, pia_band_qr *qr);

#endif
