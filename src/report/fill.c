#include "fill.h"

#include <math.h>

typedef struct lattice {
    double *value;
    unsigned char *known;
    pia_index rows, columns;
} lattice;

static int has_gaps(const lattice *l)
{
    for (pia_index i = 0; i < l->rows * l->columns; i++)
        if (!l->known[i]) return 1;
    return 0;
}

/* Each cell of the coarse lattice is the mean of the known ones among its four. */
static void pull(const lattice *fine, lattice *coarse)
{
    for (pia_index i = 0; i < coarse->rows; i++) {
        for (pia_index j = 0; j < coarse->columns; j++) {
            double sum = 0;
            int count = 0;
            for (int k = 0; k < 4; k++) {
                pia_index row = 2 * i + k / 2, column = 2 * j + k % 2;
                if (row >= fine->rows || column >= fine->columns || !fine->known[row * fine->columns + column]) continue;
                sum += fine->value[row * fine->columns + column];
                count++;
            }
            coarse->value[i * coarse->columns + j] = count > 0 ? sum / count : 0;
            coarse->known[i * coarse->columns + j] = count > 0;
        }
    }
}

static double clamp(double x, pia_index count)
{
    return fmin(fmax(x, 0), (double)(count - 1));
}

/* Bilinear interpolation between cell centres. */
static double value_at(const lattice *l, double row, double column)
{
    row = clamp(row, l->rows);
    column = clamp(column, l->columns);
    pia_index i = (pia_index)row, j = (pia_index)column;
    pia_index below = i + 1 < l->rows ? i + 1 : i, beside = j + 1 < l->columns ? j + 1 : j;
    double r = row - (double)i, c = column - (double)j;
    const double *v = l->value;
    return (1 - r) * ((1 - c) * v[i * l->columns + j] + c * v[i * l->columns + beside]) +
           r * ((1 - c) * v[below * l->columns + j] + c * v[below * l->columns + beside]);
}

static void push(const lattice *coarse, lattice *fine)
{
    for (pia_index i = 0; i < fine->rows; i++) {
        for (pia_index j = 0; j < fine->columns; j++) {
            pia_index k = i * fine->columns + j;
            if (!fine->known[k]) fine->value[k] = value_at(coarse, 0.5 * (double)i - 0.25, 0.5 * (double)j - 0.25);
            fine->known[k] = 1;
        }
    }
}

pia_status pia_fill_gaps(pia_context *context, double *value, unsigned char *known, pia_index rows, pia_index columns)
{
    lattice fine = {value, known, rows, columns};
    if (!has_gaps(&fine)) return PIA_OK;
    if (rows * columns == 1) {
        *value = 0;
        *known = 1;
        return PIA_OK;
    }
    lattice coarse = {.rows = (rows + 1) / 2, .columns = (columns + 1) / 2};
    coarse.value = pia_take(context, coarse.rows * coarse.columns, sizeof *coarse.value);
    coarse.known = pia_take(context, coarse.rows * coarse.columns, sizeof *coarse.known);
    pia_status status = PIA_E_MEMORY;
    if (coarse.value != NULL && coarse.known != NULL) {
        pull(&fine, &coarse);
        status = pia_fill_gaps(context, coarse.value, coarse.known, coarse.rows, coarse.columns);
        if (status == PIA_OK) push(&coarse, &fine);
    }
    pia_give(context, coarse.value);
    pia_give(context, coarse.known);
    return status;
}
