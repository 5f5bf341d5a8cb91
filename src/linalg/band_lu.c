/* Collocation matrices without pivoting, in Crout's form: a finished row is divided by its pivot, so that back substitution needs no
 * division and a solve that happens once needs to keep the strict upper band only. */
#include "band.h"

#include "clones.h"

#include <float.h>
#include <math.h>
#include <string.h>

enum { BLOCK = 128 };

/* Reduces one row by those before it and divides its upper band by the pivot. `row` points to its diagonal entry, `u` to where its
 * strict upper band will be; the band of the row r places before it is at u - r * stride. A pivot that is only rounding left over from
 * the diagonal entry it came from (or no ordinary number) stands for a singular matrix: the result is then 0, otherwise 1 / pivot. */
PIA_INLINE double reduce_row(double *row, const double *u, pia_index stride, int reach, int upper, double tolerance)
{
    double least = tolerance * fabs(row[0]) + DBL_MIN;
    for (int r = reach; r >= 1; r--) {
        const double *above = u - r * stride;
        double l = row[-r];
        for (int k = 0; k < upper; k++) row[1 - r + k] -= l * above[k];
    }
    double pivot = fabs(row[0]), inverse = 1 / row[0];
    if (!(pivot > least && pivot <= DBL_MAX)) return 0;
    for (int k = 1; k <= upper; k++) row[k] *= inverse;
    return inverse;
}

static double vanishing(int width)
{
    return 4 * DBL_EPSILON * width;
}

static pia_status singular(pia_context *context, pia_index row)
{
    return pia_fail(context, PIA_E_DATA,
                    "row %lld of the collocation matrix depends on the rows before it: the knots do not suit the parameters "
                    "(Schoenberg-Whitney); place knots by averaging, or drop points with equal parameters",
                    (long long)row);
}

/* Returns the first row whose entries do not reach its diagonal, n when there is none. */
static pia_index find_bandwidths(const double *a, const pia_index *first, pia_index n, int width, int *lower, int *upper)
{
    *lower = *upper = 0;
    for (pia_index i = 0; i < n; i++) {
        int begin = 0, end = width - 1;
        while (begin < end && a[i * width + begin] == 0) begin++;
        while (end > begin && a[i * width + end] == 0) end--;
        pia_index before = i - first[i] - begin, after = first[i] + end - i;
        if (before < 0 || after < 0) return i;
        if (before > *lower) *lower = (int)before;
        if (after > *upper) *upper = (int)after;
    }
    return n;
}

static void copy_row(const double *a, int width, double *row)
{
    for (int k = 0; k < width; k++)
        if (a[k] != 0) row[k] = a[k];
}

static double largest_entry(const double *a, int width)
{
    double largest = 0;
    for (int k = 0; k < width; k++) largest = fmax(largest, fabs(a[k]));
    return largest;
}

/* The row is worked on in a copy that the compiler may keep in registers. */
PIA_INLINE int factor_row(double *entry, int before, int lower, int upper, double tolerance)
{
    double row[2 * PIA_MAX_DEGREE + 1];
    int size = lower + 1 + upper;
    for (int k = 0; k < size; k++) row[k] = entry[k];
    double inverse = reduce_row(row + lower, entry + lower + 1, size, before, upper, tolerance);
    for (int k = 0; k < size; k++) entry[k] = row[k];
    return inverse != 0;
}

/* Returns the first row whose pivot vanishes, n when there is none. */
PIA_INLINE pia_index factor(double *entry, pia_index n, int lower, int upper)
{
    pia_index size = lower + 1 + upper;
    double tolerance = vanishing((int)size);
    for (pia_index i = 0; i < n && i < lower; i++)
        if (!factor_row(entry + i * size, (int)i, lower, upper, tolerance)) return i;
    for (pia_index i = lower; i < n; i++)
        if (!factor_row(entry + i * size, lower, lower, upper, tolerance)) return i;
    return n;
}

static pia_index factor_any(double *entry, pia_index n, int lower, int upper)
{
    if (lower == 1 && upper == 1) return factor(entry, n, 1, 1);
    if (lower == 2 && upper == 2) return factor(entry, n, 2, 2);
    if (lower == 3 && upper == 3) return factor(entry, n, 3, 3);
    return factor(entry, n, lower, upper);
}

static pia_status check_size(pia_context *context, pia_index n, int width, pia_index *size)
{
    if (width < 1 || width > PIA_MAX_DEGREE + 1)
        return pia_fail(context, PIA_E_ARGUMENT, "rows of %d entries; 1 to %d are possible", width, PIA_MAX_DEGREE + 1);
    if (!pia_multiply(n, 2 * width, size)) return pia_fail(context, PIA_E_SIZE, "a band of %lld rows is too large", (long long)n);
    return PIA_OK;
}

static double smallest_pivot(const double *a, int width, const pia_band_lu *lu)
{
    double smallest = INFINITY;
    for (pia_index i = 0; i < lu->n; i++) {
        double pivot = lu->entry[i * (lu->lower + 1 + lu->upper) + lu->lower];
        smallest = fmin(smallest, fabs(pivot) / largest_entry(a + i * width, width));
    }
    return smallest;
}

pia_status pia_band_lu_factor(pia_context *context, const double *a, const pia_index *first, pia_index n, int width, pia_band_lu *out)
{
    pia_index size;
    *out = (pia_band_lu){0};
    pia_status status = check_size(context, n, width, &size);
    if (status != PIA_OK) return status;
    pia_band_lu lu = {.n = n};
    pia_index bad = find_bandwidths(a, first, n, width, &lu.lower, &lu.upper);
    if (bad < n) return singular(context, bad);
    int row = lu.lower + 1 + lu.upper;
    lu.entry = pia_take_zero(context, n * row, sizeof *lu.entry);
    if (lu.entry == NULL) return pia_take_status(context, n * row, sizeof *lu.entry);
    for (pia_index i = 0; i < n; i++) copy_row(a + i * width, width, lu.entry + i * row + lu.lower + first[i] - i);
    bad = factor_any(lu.entry, n, lu.lower, lu.upper);
    if (bad < n) {
        pia_give(context, lu.entry);
        return singular(context, bad);
    }
    lu.smallest = smallest_pivot(a, width, &lu);
    *out = lu;
    return PIA_OK;
}

/* x_i = (b_i - sum L x) / pivot with the `reach` rows before it. */
PIA_INLINE void forward_row(const double *row, double inverse, int reach, double *x, int dim)
{
    for (int r = reach; r >= 1; r--)
        for (int c = 0; c < dim; c++) x[c] -= row[-r] * x[c - r * dim];
    for (int c = 0; c < dim; c++) x[c] *= inverse;
}

PIA_INLINE void backward_row(const double *u, int reach, double *x, int dim)
{
    for (int r = reach; r >= 1; r--)
        for (int c = 0; c < dim; c++) x[c] -= u[r - 1] * x[c + r * dim];
}

PIA_INLINE void back_substitute(const double *u, pia_index stride, pia_index n, int upper, double *b, int dim)
{
    for (pia_index i = n - 1; i >= 0 && n - 1 - i < upper; i--) backward_row(u + i * stride, (int)(n - 1 - i), b + i * dim, dim);
    for (pia_index i = n - 1 - upper; i >= 0; i--) backward_row(u + i * stride, upper, b + i * dim, dim);
}

PIA_INLINE void solve(const pia_band_lu *lu, int lower, int upper, double *b, int dim)
{
    pia_index stride = lower + 1 + upper;
    const double *entry = lu->entry + lower;
    for (pia_index i = 0; i < lu->n && i < lower; i++) forward_row(entry + i * stride, 1 / entry[i * stride], (int)i, b + i * dim, dim);
    for (pia_index i = lower; i < lu->n; i++) forward_row(entry + i * stride, 1 / entry[i * stride], lower, b + i * dim, dim);
    back_substitute(entry + 1, stride, lu->n, upper, b, dim);
}

PIA_INLINE void solve_any_dim(const pia_band_lu *lu, int lower, int upper, double *b, int dim)
{
    switch (dim) {
    case 1: solve(lu, lower, upper, b, 1); break;
    case 2: solve(lu, lower, upper, b, 2); break;
    case 3: solve(lu, lower, upper, b, 3); break;
    case 4: solve(lu, lower, upper, b, 4); break;
    default: solve(lu, lower, upper, b, dim); break;
    }
}

PIA_CLONES static void solve_sides(const pia_band_lu *lu, double *b)
{
    if (lu->lower == 1 && lu->upper == 1)
        solve(lu, 1, 1, b, PIA_BAND_SIDES);
    else if (lu->lower == 2 && lu->upper == 2)
        solve(lu, 2, 2, b, PIA_BAND_SIDES);
    else
        solve(lu, lu->lower, lu->upper, b, PIA_BAND_SIDES);
}

void pia_band_lu_solve(const pia_band_lu *lu, double *b, int dim)
{
    if (dim == PIA_BAND_SIDES)
        solve_sides(lu, b);
    else if (lu->lower == 1 && lu->upper == 1)
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
    double *window;   /* [BLOCK x (2 width - 1)] row i over the columns i - width + 1 .. i + width - 1 */
    double *u;        /* [n x (width - 1)] */
    double *b;
} stream;

/* Rows are spread over their windows well before they are reduced, so that no load waits for a store that straddles it. Returns the
 * first row that does not reach its diagonal, `end` when there is none. */
PIA_INLINE pia_index spread(const stream *s, pia_index begin, pia_index end, int width)
{
    int size = 2 * width - 1;
    s->rows(s->work, begin, end, s->first, s->a);
    for (pia_index i = begin; i < end; i++) {
        pia_index offset = s->first[i - begin] - i + width - 1;
        const double *a = s->a + (i - begin) * width;
        double *window = s->window + (i - begin) * size;
        if (offset < 0 || offset >= width) return i;
        for (int k = 0; k < size; k++) window[k] = 0;
        for (int k = 0; k < width; k++) window[offset + k] = a[k];
    }
    return end;
}

/* Reduces one row, keeps its upper band, carries its right-hand side. */
PIA_INLINE int stream_row(const stream *s, pia_index i, const double *window, int before, int width, int dim)
{
    int reach = width - 1;
    double row[2 * PIA_MAX_DEGREE + 1], *u = s->u + i * reach;
    for (int k = 0; k <= 2 * reach; k++) row[k] = window[k];
    double inverse = reduce_row(row + reach, u, reach, before, reach, vanishing(width));
    for (int k = 0; k < reach; k++) u[k] = row[width + k];
    forward_row(row + reach, inverse, before, s->b + i * dim, dim);
    return inverse != 0;
}

/* Returns the first row whose pivot vanishes, n when there is none. */
PIA_INLINE pia_index eliminate(const stream *s, int width, int dim)
{
    for (pia_index begin = 0; begin < s->n; begin += BLOCK) {
        pia_index end = s->n - begin < BLOCK ? s->n : begin + BLOCK, bad = spread(s, begin, end, width);
        for (pia_index i = begin; i < bad; i++) {
            const double *window = s->window + (i - begin) * (2 * width - 1);
            int done = i < width - 1 ? stream_row(s, i, window, (int)i, width, dim) : stream_row(s, i, window, width - 1, width, dim);
            if (!done) return i;
        }
        if (bad < end) return bad;
    }
    back_substitute(s->u, width - 1, s->n, width - 1, s->b, dim);
    return s->n;
}

PIA_INLINE pia_index eliminate_any_dim(const stream *s, int width, int dim)
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
    pia_status status = check_size(context, n, width, &size);
    if (status != PIA_OK) return status;
    stream s = {rows, work, n, NULL, NULL, NULL, NULL, b};
    s.u = pia_take(context, n * (width - 1), sizeof *s.u);
    s.a = pia_take(context, BLOCK * width, sizeof *s.a);
    s.window = pia_take(context, BLOCK * (2 * width - 1), sizeof *s.window);
    s.first = pia_take(context, BLOCK, sizeof *s.first);
    if (s.u == NULL || s.a == NULL || s.window == NULL || s.first == NULL) {
        status = pia_take_status(context, n * (width - 1), sizeof *s.u);
    } else {
        pia_index bad = eliminate_any(&s, width, dim);
        if (bad < n) status = singular(context, bad);
    }
    pia_give(context, s.first);
    pia_give(context, s.window);
    pia_give(context, s.a);
    pia_give(context, s.u);
    return status;
}
