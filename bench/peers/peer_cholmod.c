#include "peer_cholmod.h"

#include <stdlib.h>
#include <suitesparse/cholmod.h>
#include <time.h>

enum { MAX_DEGREE = 9 };

static double now(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static int basis(const double *knots, int degree, int control, double t, double *value)
{
    int span = degree + (int)((t - knots[degree]) / (knots[control] - knots[degree]) * (control - degree)); /* even knots */
    if (span >= control) span = control - 1;
    value[0] = 1;
    for (int d = 1; d <= degree; d++) {
        double carried = 0;
        for (int r = 0; r < d; r++) {
            double left = t - knots[span + 1 + r - d], right = knots[span + 1 + r] - t, part = value[r] / (left + right);
            value[r] = carried + right * part;
            carried = left * part;
        }
        value[d] = carried;
    }
    return span - degree;
}

/* A' [control^2 x count], one column of (degree + 1)^2 entries a point. */
static cholmod_sparse *design(long count, const double *parameters, int control, int degree, const double *knots,
                              cholmod_common *common)
{
    long width = (long)(degree + 1) * (degree + 1);
    cholmod_sparse *a = cholmod_l_allocate_sparse((size_t)control * (size_t)control, (size_t)count, (size_t)(count * width), 1, 1, 0,
                                                  CHOLMOD_REAL, common);
    SuiteSparse_long *begin = a->p, *row = a->i;
    double *value = a->x, u[MAX_DEGREE + 1], v[MAX_DEGREE + 1];
    for (long k = 0; k <= count; k++) begin[k] = k * width;
    for (long k = 0; k < count; k++) {
        int i0 = basis(knots, degree, control, parameters[2 * k], u), j0 = basis(knots, degree, control, parameters[2 * k + 1], v);
        for (int i = 0; i <= degree; i++)
            for (int j = 0; j <= degree; j++) {
                *row++ = (long)(i0 + i) * control + j0 + j;
                *value++ = u[i] * v[j];
            }
    }
    return a;
}

double peer_cholmod(long count, const double *parameters, const double *points, int dim, int control, int degree, const double *knots,
                    double *solution)
{
    cholmod_common common;
    cholmod_l_start(&common);
    double start = now(), one[2] = {1, 0}, zero[2] = {0, 0};
    size_t cols = (size_t)control * (size_t)control;
    cholmod_sparse *a = design(count, parameters, control, degree, knots, &common);
    cholmod_sparse *gram = cholmod_l_aat(a, NULL, 0, 1, &common);
    gram->stype = -1;
    cholmod_dense *data = cholmod_l_allocate_dense((size_t)count, (size_t)dim, (size_t)count, CHOLMOD_REAL, &common);
    for (long k = 0; k < count; k++)
        for (int d = 0; d < dim; d++) ((double *)data->x)[d * count + k] = points[k * dim + d];
    cholmod_dense *right = cholmod_l_allocate_dense(cols, (size_t)dim, cols, CHOLMOD_REAL, &common);
    cholmod_l_sdmult(a, 0, one, zero, data, right, &common);
    cholmod_factor *factor = cholmod_l_analyze(gram, &common);
    cholmod_l_factorize(gram, factor, &common);
    cholmod_dense *x = cholmod_l_solve(CHOLMOD_A, factor, right, &common);
    double seconds = now() - start;
    for (size_t c = 0; c < cols; c++)
        for (int d = 0; d < dim; d++) solution[c * (size_t)dim + (size_t)d] = ((double *)x->x)[(size_t)d * cols + c];
    cholmod_l_free_sparse(&a, &common);
    cholmod_l_free_sparse(&gram, &common);
    cholmod_l_free_dense(&data, &common);
    cholmod_l_free_dense(&right, &common);
    cholmod_l_free_dense(&x, &common);
    cholmod_l_free_factor(&factor, &common);
    cholmod_l_finish(&common);
    return seconds;
}
