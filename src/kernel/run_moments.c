/* In general: a table of polynomials, one of components, then products of the rows of the one with the rows of the other, four sums at
 * a time in registers. */
#include "run_block.h"

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

PIA_CLONES static void add_blocks(const pia_run *run, pia_index done, double *sums)
{
    block b;
    pia_lanes sum[COLUMNS][ROWS];
    int width = run->degree + 1, columns = run->dim + 2;
    for (int c = 0; c < columns; c++) memset(sum[c], 0, (size_t)width * sizeof(pia_lanes));
    for (; done < run->count; done += PIA_BLOCK) {
        int whole = fill(run, done, pia_block_count(run, done), &b);
        for (int c = 0; c < columns; c++) add_column(&b, run->degree, b.column[c], whole, sum[c]);
    }
    for (int c = 0; c < columns; c++)
        for (int j = 0; j < width; j++) sums[c * width + j] += pia_vector_sum(sum[c][j]);
}

/* Cubic, all weights 1: returns how many rows have been taken. */
PIA_INLINE pia_index add_cubic(const pia_run *run, int dim, double *sums)
{
    pia_lanes plain[3] = {{0}}, product[3] = {{0}}, component[3][4] = {{{0}}};
    pia_index done = 0;
    for (; done + PIA_LANES <= run->count; done += PIA_LANES) {
        const double *t = run->t + done, *q = run->points + done * dim;
        pia_lanes p[3];
        pia_run_fetch(t, q, dim);
        pia_run_cubic(run, t, p);
        for (int j = 0; j < 3; j++) plain[j] += p[j];
        for (int j = 0; j < 3; j++) product[j] += p[2] * p[j];
        for (int d = 0; d < dim; d++) {
            pia_lanes value = pia_vector_component(q, dim, d) - run->origin[d];
            component[d][0] += value;
            for (int j = 0; j < 3; j++) component[d][j + 1] += value * p[j];
        }
    }
    sums[0] += (double)done;
    sums[4] += pia_vector_sum(plain[2]);
    for (int j = 0; j < 3; j++) sums[j + 1] += pia_vector_sum(plain[j]);
    for (int j = 0; j < 3; j++) sums[j + 5] += pia_vector_sum(product[j]);
    for (int d = 0; d < dim; d++)
        for (int j = 0; j < 4; j++) sums[8 + 4 * d + j] += pia_vector_sum(component[d][j]);
    return done;
}

PIA_CLONES static pia_index add_cubics(const pia_run *run, double *sums)
{
    switch (run->dim) {
    case 1: return add_cubic(run, 1, sums);
    case 2: return add_cubic(run, 2, sums);
    default: return add_cubic(run, 3, sums);
    }
}

void pia_run_moments(const pia_run *run, double *sums)
{
    pia_index done = 0;
    if (pia_run_is_cubic(run) && run->weights == NULL) done = add_cubics(run, sums);
    if (done < run->count) add_blocks(run, done, sums);
}
