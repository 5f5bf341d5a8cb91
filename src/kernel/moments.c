/* Points are taken in blocks that stay in the first-level cache: a table of polynomials, one of components, then products of the rows
 * of the one with the rows of the other, four sums at a time in registers. Two lanes are what every 64-bit processor has. */
#include "moments.h"

#include <string.h>

enum { LANES = 2, BLOCK = 64, ROWS = PIA_MAX_DEGREE + 1, COLUMNS = PIA_MAX_DIM + 2 };

typedef double lanes __attribute__((vector_size(LANES * sizeof(double))));

typedef struct block {
    double polynomial[ROWS][BLOCK], column[COLUMNS][BLOCK];
} block;

/* sums[j] += polynomial[j] * column for `rows` consecutive j. */
static inline __attribute__((always_inline)) void add_products(const double (*polynomial)[BLOCK], int rows, const double *column,
                                                               int count, lanes *sums)
{
    lanes sum[4];
    for (int j = 0; j < rows; j++) sum[j] = sums[j];
    for (int k = 0; k < count; k += LANES) {
        lanes factor, value;
        memcpy(&factor, column + k, sizeof factor);
        for (int j = 0; j < rows; j++) {
            memcpy(&value, polynomial[j] + k, sizeof value);
            sum[j] += value * factor;
        }
    }
    for (int j = 0; j < rows; j++) sums[j] = sum[j];
}

static void add_column(const block *b, int degree, const double *column, int count, lanes *sums)
{
    int j = 0;
    for (; j + 4 <= degree + 1; j += 4) add_products(b->polynomial + j, 4, column, count, sums + j);
    if (j + 2 <= degree + 1) {
        add_products(b->polynomial + j, 2, column, count, sums + j);
        j += 2;
    }
    if (j <= degree) add_products(b->polynomial + j, 1, column, count, sums + j);
}

/* Fills the tables with `count` points, and with zeros up to whole lanes. */
static int fill(const pia_moments *m, const double *t, const double *points, const double *weights, int count, block *b)
{
    int whole = (count + LANES - 1) / LANES * LANES, degree = m->degree, dim = m->dim;
    double(*p)[BLOCK] = b->polynomial;
    for (int k = 0; k < count; k++) p[1][k] = (t[k] - m->middle) * m->scale;
    for (int d = 0; d < dim; d++)
        for (int k = 0; k < count; k++) b->column[2 + d][k] = points[k * dim + d] - m->origin[d];
    for (int k = count; k < whole; k++) {
        p[1][k] = 0;
        for (int d = 0; d < dim; d++) b->column[2 + d][k] = 0;
    }
    for (int k = 0; k < whole; k++) p[0][k] = b->column[0][k] = k < count;
    for (int j = 2; j <= degree; j++)
        for (int k = 0; k < whole; k++) p[j][k] = 2 * p[1][k] * p[j - 1][k] - p[j - 2][k];
    memcpy(b->column[1], p[degree], (size_t)whole * sizeof(double));
    for (int j = 0; weights != NULL && j <= degree; j++)
        for (int k = 0; k < count; k++) p[j][k] *= weights[k];
    return whole;
}

void pia_moments_add(const pia_moments *m, const double *t, const double *points, const double *weights, pia_index count, double *sums)
{
    block b;
    lanes sum[COLUMNS][ROWS];
    int width = m->degree + 1, columns = m->dim + 2;
    for (int c = 0; c < columns; c++) memset(sum[c], 0, (size_t)width * sizeof(lanes));
    for (pia_index done = 0; done < count; done += BLOCK) {
        int part = count - done < BLOCK ? (int)(count - done) : BLOCK;
        const double *some = m->dim > 0 ? points + done * m->dim : NULL;
        int whole = fill(m, t + done, some, weights != NULL ? weights + done : NULL, part, &b);
        for (int c = 0; c < columns; c++) add_column(&b, m->degree, b.column[c], whole, sum[c]);
    }
    for (int c = 0; c < columns; c++)
        for (int j = 0; j < width; j++) sums[c * width + j] += sum[c][j][0] + sum[c][j][1];
}
