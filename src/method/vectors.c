#include "vectors.h"

pia_status pia_vectors_take(const pia_iterate *iterate, int count, double **vector)
{
    pia_index size = iterate->op->cols * iterate->dim;
    vector[0] = pia_take_zero(iterate->context, size, (size_t)count * sizeof(double));
    if (vector[0] == NULL) return pia_take_status(iterate->context, size, (size_t)count * sizeof(double));
    for (int k = 1; k < count; k++) vector[k] = vector[k - 1] + size;
    return PIA_OK;
}

void pia_vectors_mix(const pia_iterate *iterate, double a, const double *x, double b, double *y)
{
    pia_index size = iterate->op->cols * iterate->dim;
    for (pia_index i = 0; i < size; i++) y[i] = a * x[i] + b * y[i];
}

void pia_vectors_scale(const pia_iterate *iterate, const double *factor, const double *x, double *y)
{
    int dim = iterate->dim;
    for (pia_index c = 0; c < iterate->op->cols; c++)
        for (int d = 0; d < dim; d++) y[c * dim + d] = factor[c] * x[c * dim + d];
}
