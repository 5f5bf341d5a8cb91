/* Collocation matrices without pivoting, in Crout's form: a finished row is divided by its pivot, so that back substitution needs no
 * division and a solve that happens once needs to keep the strict upper band only. */
#include "band.h"

#include <float.h>
#include <math.h>
#include <string.h>

#define INLINE static inline __attribute__((always_inline))

enum { BLOCK = 128 };

/* `row` points to the diagonal entry of row i, `u` to its strict upper band; the band of row i - r is at u - r * stride. */
INLINE void reduce_row(double *row, const double *u, pia_index stride, int reach, int upper)
{
    for (int r = reach; r >= 1; r--) {
        const double *above = u - r * stride;
        double l = row[-r];
        for (int k = 0; k < upper; k++) row[1 - r + k] -= l * above[k];
    }
}

/* A pivot that is only rounding left over from the diagonal entry it came from (or no number) stands for a singular matrix. */
INLINE int pivot_vanishes(double pivot, double diagonal, int width)
{
    return !(fabs(pivot) > 4 * DBL_EPSILON * width * fabs(diagonal)) || !isfinite(pivot);
}

static pia_status singular(pia_context *context, pia_index row)
{
    return pia_fail(context, PIA_E_DATA,
                    "row %lld of the collocation matrix depends on the rows before it: the knots do not suit the parameters "
                    "(Schoenberg-Whitney); place knots by averaging, or drop points with equal parameters",
                    (long long)row);
}

static void find_bandwidths(const double *a, const pia_index *first, pia_index n, int width, pia_index *lower, pia_index *upper)
{
    *lower = *upper = 0;
    for (pia_index i = 0; i < n; i++) {
        pia_index offset = first[i] - i;
        int begin = 0, end = width - 1;
        while (begin < end && a[i * width + begin] == 0) begin++;
        while (end > begin && a[i * width + end] == 0) end--;
        if (-(offset + begin) > *lower) *lower = -(offset + begin);
        if (offset + end > *upper) *upper = offset + end;
    }
}

static void copy_row(const double *a, pia_index offset, int width, int lower, int upper, double *row)
{
    for (int k = 0; k < width; k++)
        if (a[k] != 0 && offset + k >= -lower && offset + k <= upper) row[offset + k] = a[k];
}

static double largest_entry(const double *a, int width)
{
    double largest = 0;
    for (int k = 0; k < width; k++) largest = fmax(largest, fabs(a[k]));
    return largest;
}

/* Returns the first row whose pivot vanishes, n when there is none. */
INLINE pia_index factor(double *entry, pia_index n, int lower, int upper)
{
    pia_index stride = lower + 1 + upper;
    for (pia_index i = 0; i < n; i++) {
        double *row = entry + i * stride + lower;
        double diagonal = row[0];
        if (i < lower)
            reduce_row(row, row + 1, stride, (int)i, upper);
        else
            reduce_row(row, row + 1, stride, lower, upper);
        if (pivot_vanishes(row[0], diagonal, (int)stride)) return i;
        for (int k = 1; k <= upper; k++) row[k] /= row[0];
    }
    return n;
}

static pia_index factor_any(double *entry, pia_index n, int lower, int upper)
{
    if (lower == 1 && upper == 1) return factor(entry, n, 1, 1);
    if (lower == 2 && upper == 2) return factor(entry, n, 2, 2);
    if (lower == 3 && upper == 3) return factor(entry, n, 3, 3);
    return factor(entry, n, lower, upper);
}

pia_status pia_band_lu_factor(pia_context *context, const double *a, const pia_index *first, pia_index n, int width, pia_band_lu *out)
{
    pia_index lower, upper, size;
    *out = (pia_band_lu){0};
    find_bandwidths(a, first, n, width, &lower, &upper);
    if (!pia_multiply(n, lower + 1 + upper, &size))
        return pia_fail(context, PIA_E_SIZE, "a band of %lld rows is too large", (long long)n);
    double *entry = pia_take_zero(context, size, sizeof *entry);
    if (entry == NULL) return pia_take_status(context, size, sizeof *entry);
    pia_band_lu lu = {n, (int)lower, (int)upper, entry, INFINITY};
    for (pia_index i = 0; i < n; i++)
        copy_row(a + i * width, first[i] - i, width, lu.lower, lu.upper, entry + i * (lower + 1 + upper) + lower);
    pia_index bad = factor_any(entry, n, lu.lower, lu.upper);
    if (bad < n) {
        pia_give(context, entry);
        return singular(context, bad);
    }
    for (pia_index i = 0; i < n; i++)
        lu.smallest = fmin(lu.smallest, fabs(entry[i * (lower + 1 + upper) + lower]) / largest_entry(a + i * width, width));
    *out = lu;
    return PIA_OK;
}

/* x_i = (b_i - sum L x) / pivot with the `reach` rows before it. */
INLINE void forward_row(const double *row, int reach, double *x, int dim)
{
    for (int r = reach; r >= 1; r--)
        for (int c = 0; c < dim; c++) x[c] -= row[-r] * x[c - r * dim];
    for (int c = 0; c < dim; c++) x[c] /= row[0];
}

INLINE void backward_row(const double *u, int reach, double *x, int dim)
{
    for (int r = reach; r >= 1; r--)
        for (int c = 0; c < dim; c++) x[c] -= u[r - 1] * x[c + r * dim];
}

INLINE void back_substitute(const double *u, pia_index stride, pia_index n, int upper, double *b, int dim)
{
    for (pia_index i = n - 1; i >= 0 && n - 1 - i < upper; i--) backward_row(u + i * stride, (int)(n - 1 - i), b + i * dim, dim);
    for (pia_index i = n - 1 - upper; i >= 0; i--) backward_row(u + i * stride, upper, b + i * dim, dim);
}

INLINE void solve(const pia_band_lu *lu, int lower, int upper, double *b, int dim)
{
    pia_index stride = lower + 1 + upper;
    const double *entry = lu->entry + lower;
    for (pia_index i = 0; i < lu->n && i < lower; i++) forward_row(entry + i * stride, (int)i, b + i * dim, dim);
    for (pia_index i = lower; i < lu->n; i++) forward_row(entry + i * stride, lower, b + i * dim, dim);
    back_substitute(entry + 1, stride, lu->n, upper, b, dim);
}

INLINE void solve_any_dim(const pia_band_lu *lu, int lower, int upper, double *b, int dim)
{
    switch (dim) {
    case 1: solve(lu, lower, upper, b, 1); break;
    case 2: solve(lu, lower, upper, b, 2); break;
    case 3: solve(lu, lower, upper, b, 3); break;
    case 4: solve(lu, lower, upper, b, 4); break;
    default: solve(lu, lower, upper, b, dim); break;
    }
}

void pia_band_lu_solve(const pia_band_lu *lu, double *b, int dim)
{
    if (lu->lower == 1 && lu->upper == 1)
        solve_any_dim(lu, 1, 1, b, dim);
    else if (lu->lower == 2 && lu->upper == 2)
        solve_any_dim(lu, 2, 2, b, dim);
    else
        solve_any_dim(lu, lu->lower, lu->upper, b, dim);
}

/* A' = U' L': first the unit lower triangle U', then the upper triangle L', whose row i is column i of L. */
void pia_band_lu_solve_transposed(const pia_band_lu *lu, double *b, int dim)
{
    pia_index stride = lu->lower + 1 + lu->upper, n = lu->n;
    const double *entry = lu->entry + lu->lower;
    for (pia_index i = 0; i < n; i++) {
        int reach = (int)(n - 1 - i < lu->upper ? n - 1 - i : lu->upper);
        for (int k = 1; k <= reach; k++)
            for (int c = 0; c < dim; c++) b[(i + k) * dim + c] -= entry[i * stride + k] * b[i * dim + c];
    }
    for (pia_index i = n - 1; i >= 0; i--) {
        int reach = (int)(i < lu->lower ? i : lu->lower);
        for (int c = 0; c < dim; c++) b[i * dim + c] /= entry[i * stride];
        for (int k = 1; k <= reach; k++)
            for (int c = 0; c < dim; c++) b[(i - k) * dim + c] -= entry[i * stride - k] * b[i * dim + c];
    }
}

void pia_band_lu_clear(pia_context *context, pia_band_lu *lu)
{
    pia_give(context, lu->entry);
    *lu = (pia_band_lu){0};
}

typedef struct stream {
    pia_band_rows *rows;
    void *work;
    pia_index n;
    pia_index *first; /* [BLOCK] */
    double *a;        /* [BLOCK x width] */
    double *u;        /* [n x (width - 1)] */
    double *b;
} stream;

/* One row: spread it over the window of columns i - reach .. i + reach, reduce it, keep its upper band, carry its right-hand side. */
INLINE int stream_row(const stream *s, pia_index i, pia_index in_block, int before, int width, int dim)
{
    int reach = width - 1;
    double window[2 * PIA_MAX_DEGREE + 1];
    double *row = window + reach, *u = s->u + i * reach, *x = s->b + i * dim;
    pia_index offset = s->first[in_block] - i;
    if (offset > 0 || offset < -reach) return 0;
    for (int k = 0; k <= 2 * reach; k++) window[k] = 0;
    for (int k = 0; k < width; k++) row[offset + k] = s->a[in_block * width + k];
    double diagonal = row[0];
    reduce_row(row, u, reach, before, reach);
    if (pivot_vanishes(row[0], diagonal, width)) return 0;
    for (int k = 0; k < reach; k++) u[k] = row[k + 1] / row[0];
    forward_row(row, before, x, dim);
    return 1;
}

INLINE pia_index eliminate(const stream *s, int width, int dim)
{
    for (pia_index begin = 0; begin < s->n; begin += BLOCK) {
        pia_index end = s->n - begin < BLOCK ? s->n : begin + BLOCK;
        s->rows(s->work, begin, end, s->first, s->a);
        for (pia_index i = begin; i < end; i++) {
            int done =
                i < width - 1 ? stream_row(s, i, i - begin, (int)i, width, dim) : stream_row(s, i, i - begin, width - 1, width, dim);
            if (!done) return i;
        }
    }
    back_substitute(s->u, width - 1, s->n, width - 1, s->b, dim);
    return s->n;
}

INLINE pia_index eliminate_any_dim(const stream *s, int width, int dim)
{
    switch (dim) {
    case 1: return eliminate(s, width, 1);
    case 2: return eliminate(s, width, 2);
    case 3: return eliminate(s, width, 3);
    case 4: return eliminate(s, width, 4);
    default: return eliminate(s, width, dim);
    }
}

static pia_index eliminate_any(const stream *s, int width, int dim)
{
    switch (width) {
    case 2: return eliminate_any_dim(s, 2, dim);
    case 3: return eliminate_any_dim(s, 3, dim);
    case 4: return eliminate_any_dim(s, 4, dim);
    case 6: return eliminate_any_dim(s, 6, dim);
    default: return eliminate_any_dim(s, width, dim);
    }
}

pia_status pia_band_lu_stream(pia_context *context, pia_band_rows *rows, void *work, pia_index n, int width, double *b, int dim)
{
    pia_index size;
    if (width < 1 || width > PIA_MAX_DEGREE + 1)
        return pia_fail(context, PIA_E_ARGUMENT, "rows of %d entries; 1 to %d are possible", width, PIA_MAX_DEGREE + 1);
    if (!pia_multiply(n, width - 1, &size)) return pia_fail(context, PIA_E_SIZE, "a band of %lld rows is too large", (long long)n);
    stream s = {rows, work, n, NULL, NULL, NULL, b};
    s.u = pia_take(context, size, sizeof *s.u);
    s.a = pia_take(context, BLOCK * width, sizeof *s.a);
    s.first = pia_take(context, BLOCK, sizeof *s.first);
    pia_status status = PIA_OK;
    if (s.u == NULL || s.a == NULL || s.first == NULL) {
        status = pia_take_status(context, size, sizeof *s.u);
    } else {
        pia_index bad = eliminate_any(&s, width, dim);
        if (bad < n) status = singular(context, bad);
    }
    pia_give(context, s.first);
    pia_give(context, s.a);
    pia_give(context, s.u);
    return status;
}
