/* In general: a table of polynomials, one of components, then products of the rows of the one with the rows of the other, four sums at
 * a time in registers. */
#include "run_block.h"
#include "run_cubics.h"

enum { ROWS = PIA_MAX_DEGREE + 1, COLUMNS = PIA_MAX_DIM + 2 };

typedef struct block {
    double polynomial[ROWS][PIA_BLOCK], column[COLUMNS][PIA_BLOCK];
} block;

/* sums[j] += polynomial[j] * column for `rows` consecutive j. */
PIA_INLINE void add_products(const double (*polynomial)[PIA_BLOCK], int rows, const double *column, int count, pia_lanes *sums)
{
    pia_lanes sum[4];
    for (int j = 0; j < rows; j++) sum[j] = sums[j];
    for (int k = 0; k < count; k += PIA_LANES) {
        pia_lanes factor, value;
        memcpy(&factor, column + k, sizeof factor);
        for (int j = 0; j < rows; j++) {
            memcpy(&value, polynomial[j] + k, sizeof value);
            sum[j] += value * factor;
        }
    }
    for (int j = 0; j < rows; j++) sums[j] = sum[j];
}

PIA_INLINE void add_column(const block *b, int degree, const double *column, int count, pia_lanes *sums)
{
    int j = 0;
    for (; j + 4 <= degree + 1; j += 4) add_products(b->polynomial + j, 4, column, count, sums + j);
    if (j + 2 <= degree + 1) {
        add_products(b->polynomial + j, 2, column, count, sums + j);
        j += 2;
    }
    if (j <= degree) add_products(b->polynomial + j, 1, column, count, sums + j);
}

/* Columns: 1, T_degree, the components; polynomials with the weights in them. Points that only fill the lanes count as 0. */
PIA_INLINE int fill(const pia_run *run, pia_index done, int count, block *b)
{
    double(*p)[PIA_BLOCK] = b->polynomial;
    int whole = pia_block_fill(run, done, count, p[1], b->column + 2);
    const double *weights = run->weights != NULL ? run->weights + done : NULL;
    for (int k = 0; k < whole; k++) p[0][k] = b->column[0][k] = k < count;
    for (int j = 2; j <= run->degree; j++)
        for (int k = 0; k < whole; k++) p[j][k] = 2 * p[1][k] * p[j - 1][k] - p[j - 2][k];
    memcpy(b->column[1], p[run->degree], (size_t)whole * sizeof(double));
    for (int k = count; k < whole; k++) b->column[1][k] = 0;
    for (int j = 0; weights != NULL && j <= run->degree; j++)
        for (int k = 0; k < count; k++) p[j][k] *= weights[k];
    return whole;
}

PIA_CLONES static void add_blocks(const pia_run *run, pia_index done, pia_index to, double *sums)
{
    block b;
    pia_lanes sum[COLUMNS][ROWS];
    int width = run->degree + 1, columns = run->dim + 2;
    for (int c = 0; c < columns; c++) memset(sum[c], 0, (size_t)width * sizeof(pia_lanes));
    for (; done < to; done += PIA_BLOCK) {
        int whole = fill(run, done, to - done < PIA_BLOCK ? (int)(to - done) : PIA_BLOCK, &b);
        for (int c = 0; c < columns; c++) add_column(&b, run->degree, b.column[c], whole, sum[c]);
    }
    for (int c = 0; c < columns; c++)
        for (int j = 0; j < width; j++) sums[c * width + j] += pia_vector_sum(sum[c][j]);
}

/* The lanes together. */
PIA_INLINE double sum_of(const double lane[PIA_CUBIC_LANES])
{
    return pia_vector_sum(pia_vector_load(lane) + pia_vector_load(lane + PIA_LANES));
}

/* Cubic, all weights 1: returns how many rows have been taken. */
static pia_index add_cubics(const pia_run *run, pia_scout *scout, double *sums)
{
    pia_run_cubics *best = pia_has_wide() ? pia_run_cubics_by_eight : pia_run_cubics_by_four;
    double sum[PIA_CUBIC_SUMS][PIA_CUBIC_LANES] = {{0}};
    pia_index done = run->count / PIA_CUBIC_LANES * PIA_CUBIC_LANES;
    best(run, done, scout, sum);
    sums[0] += (double)done;
    sums[4] += sum_of(sum[2]);
    for (int j = 0; j < 3; j++) sums[j + 1] += sum_of(sum[j]);
    for (int j = 0; j < 3; j++) sums[j + 5] += sum_of(sum[j + 3]);
    for (int j = 0; j < 4 * run->dim; j++) sums[j + 8] += sum_of(sum[j + 6]);
    return done;
}

/* Rows that the scout sees first stay in the first-level cache. */
void pia_run_moments(const pia_run *run, pia_scout *scout, double *sums)
{
    enum { AT_ONCE = 512 };
    pia_index done = pia_run_is_cubic(run) && run->weights == NULL ? add_cubics(run, scout, sums) : 0;
    for (pia_index to; done < run->count; done = to) {
        to = run->count - done < AT_ONCE ? run->count : done + AT_ONCE;
        if (scout != NULL) pia_scout_reach(scout, run->t + to - scout->parameters);
        add_blocks(run, done, to, sums);
    }
}
