/* Least squares by other means than the library's, for what tests compare with. */
#ifndef PIA_TESTS_DENSE_SOLVE_H
#define PIA_TESTS_DENSE_SOLVE_H

#include <math.h>

#include "pia/pia.h"

/* x [n x dim] := the least-squares solution of a [m x n] x = q [m x dim], by Householder reflections; a and q are overwritten. */
static inline void dense_solve(double *a, double *q, pia_index m, pia_index n, int dim, double *x)
{
    for (pia_index k = 0; k < n; k++) {
        double length = 0;
        for (pia_index i = k; i < m; i++) length += a[i * n + k] * a[i * n + k];
        length = a[k * n + k] > 0 ? -sqrt(length) : sqrt(length);
        double head = a[k * n + k] - length, scale = -1 / (length * head);
        a[k * n + k] = head;
        for (pia_index c = k + 1; c < n + dim; c++) {
            double *column = c < n ? a + c : q + (c - n), sum = 0;
            pia_index stride = c < n ? n : dim;
            for (pia_index i = k; i < m; i++) sum += a[i * n + k] * column[i * stride];
            for (pia_index i = k; i < m; i++) column[i * stride] -= scale * sum * a[i * n + k];
        }
        a[k * n + k] = length;
    }
    for (pia_index k = n; k-- > 0;)
        for (int d = 0; d < dim; d++) {
            x[k * dim + d] = q[k * dim + d];
            for (pia_index c = k + 1; c < n; c++) x[k * dim + d] -= a[k * n + c] * x[c * dim + d];
            x[k * dim + d] /= a[k * n + k];
        }
}

#endif
