/* Symmetric positive definite bands. Row i is reduced by the rows before it (left-looking), so that its own diagonal is still the
 * original one when the pivot is judged. The inner loops get their bounds as constants: narrow bands live in registers. */
#include "band.h"
#include "clones.h"

/* Subtracts from row i what the `reach` rows before it contribute, farthest first. */
PIA_INLINE void reduce_row(double *h, pia_index i, int width, int reach)
{
    double *row = h + i * (width + 1);
    for (int r = reach; r >= 1; r--) {
        const double *above = row - r * (width + 1);
        double scaled = above[r] * above[0];
        for (int k = 0; k <= width - r; k++) row[k] -= scaled * above[r + k];
    }
}

/* Divides the row by its pivot, or decouples it: a pivot of 0 stands for "the unknown is 0". Returns 1 when decoupled. */
PIA_INLINE int finish_row(double *row, int width, double floor)
{
    double pivot = row[0];
    int weak = !(pivot > floor);
    if (weak) row[0] = 0;
    for (int k = 1; k <= width; k++) row[k] = weak ? 0 : row[k] / pivot;
    return weak;
}

PIA_INLINE pia_index factor(double *h, pia_index n, int width, double threshold, pia_index *weak, pia_index weak_room)
{
    pia_index refused = 0;
    for (pia_index i = 0; i < n; i++) {
        double *row = h + i * (width + 1);
        double floor = threshold * row[0];
        if (i < width)
            reduce_row(h, i, width, (int)i);
        else
            reduce_row(h, i, width, width);
        if (!finish_row(row, width, floor > 0 ? floor : 0)) continue;
        if (weak != NULL && refused < weak_room) weak[refused] = i;
        refused++;
    }
    return refused;
}

static void clear_past_last_column(double *h, pia_index n, int width)
{
    for (pia_index i = n > width ? n - width : 0; i < n; i++)
        for (pia_index k = n - i; k <= width; k++) h[i * (width + 1) + k] = 0;
}

pia_index pia_band_ldl_factor(double *h, pia_index n, int width, double threshold, pia_index *weak, pia_index weak_room)
{
    clear_past_last_column(h, n, width);
    switch (width) {
    case 1: return factor(h, n, 1, threshold, weak, weak_room);
    case 2: return factor(h, n, 2, threshold, weak, weak_room);
    case 3: return factor(h, n, 3, threshold, weak, weak_room);
    case 4: return factor(h, n, 4, threshold, weak, weak_room);
    case 5: return factor(h, n, 5, threshold, weak, weak_room);
    default: return factor(h, n, width, threshold, weak, weak_room);
    }
}

PIA_INLINE void forward_row(const double *ldl, pia_index i, int width, int reach, double *b, int dim)
{
    double *x = b + i * dim;
    for (int r = reach; r >= 1; r--) {
        double l = ldl[(i - r) * (width + 1) + r];
        for (int c = 0; c < dim; c++) x[c] -= l * x[c - r * dim];
    }
}

PIA_INLINE void backward_row(const double *ldl, pia_index i, int width, int reach, double *b, int dim)
{
    const double *row = ldl + i * (width + 1);
    double *x = b + i * dim;
    double pivot = row[0];
    for (int c = 0; c < dim; c++) x[c] = pivot > 0 ? x[c] / pivot : 0;
    for (int r = reach; r >= 1; r--) {
        double l = row[r];
        for (int c = 0; c < dim; c++) x[c] -= l * x[c + r * dim];
    }
}

PIA_INLINE void solve(const double *ldl, pia_index n, int width, double *b, int dim)
{
    pia_index inside = n > width ? n - width : 0;
    for (pia_index i = 0; i < n && i < width; i++) forward_row(ldl, i, width, (int)i, b, dim);
    for (pia_index i = width; i < n; i++) forward_row(ldl, i, width, width, b, dim);
    for (pia_index i = n - 1; i >= inside; i--) backward_row(ldl, i, width, (int)(n - 1 - i), b, dim);
    for (pia_index i = inside - 1; i >= 0; i--) backward_row(ldl, i, width, width, b, dim);
}

PIA_INLINE void solve_any_dim(const double *ldl, pia_index n, int width, double *b, int dim)
{
    switch (dim) {
    case 1: solve(ldl, n, width, b, 1); break;
    case 2: solve(ldl, n, width, b, 2); break;
    case 3: solve(ldl, n, width, b, 3); break;
    case 4: solve(ldl, n, width, b, 4); break;
    case PIA_LDL_SIDES: solve(ldl, n, width, b, PIA_LDL_SIDES); break;
    default: solve(ldl, n, width, b, dim); break;
    }
}

PIA_CLONES static void solve_any_width(const double *ldl, pia_index n, int width, double *b, int dim)
{
    switch (width) {
    case 1: solve_any_dim(ldl, n, 1, b, dim); break;
    case 2: solve_any_dim(ldl, n, 2, b, dim); break;
    case 3: solve_any_dim(ldl, n, 3, b, dim); break;
    case 4: solve_any_dim(ldl, n, 4, b, dim); break;
    case 5: solve_any_dim(ldl, n, 5, b, dim); break;
    default: solve_any_dim(ldl, n, width, b, dim); break;
    }
}

void pia_band_ldl_solve(const double *ldl, pia_index n, int width, double *b, int dim)
{
    solve_any_width(ldl, n, width, b, dim);
}
