/* A normal form without any structure, as a reference for what works on normal forms. */
#ifndef PIA_TESTS_DENSE_NORMAL_H
#define PIA_TESTS_DENSE_NORMAL_H

#include "normal.h"
#include "problems.h"

typedef struct dense_normal {
    double *h; /* [cols x cols] */
} dense_normal;

static inline void dense_multiply(const pia_normal *normal, const double *x, int dim, double *y)
{
    const double *h = ((const dense_normal *)normal->state)->h;
    pia_index n = normal->op->cols;
    for (pia_index i = 0; i < n; i++)
        for (int d = 0; d < dim; d++) {
            double sum = 0;
            for (pia_index j = 0; j < n; j++) sum += h[i * n + j] * x[j * dim + d];
            y[i * dim + d] = sum;
        }
    pia_op_mask(normal->op, y, dim);
}

static inline pia_status dense_factor(pia_normal *normal)
{
    (void)normal;
    return PIA_OK;
}

static inline void dense_solve(const pia_normal *normal, double *b, int dim)
{
    pia_index n = normal->op->cols;
    const unsigned char *frozen = normal->op->frozen;
    double *copy = malloc((size_t)(n * n) * sizeof *copy);
    memcpy(copy, ((const dense_normal *)normal->state)->h, (size_t)(n * n) * sizeof *copy);
    for (pia_index i = 0; frozen != NULL && i < n * n; i++)
        if (frozen[i / n] || frozen[i % n]) copy[i] = i / n == i % n;
    pia_op_mask(normal->op, b, dim);
    problem_solve(copy, n, b, dim);
    free(copy);
}

static inline void dense_close(pia_normal *normal)
{
    free(((dense_normal *)normal->state)->h);
    free(normal->state);
}

static inline pia_normal *dense_normal_open(const problem *p)
{
    static const pia_normal_class dense_class = {
        .name = "dense", .multiply = dense_multiply, .factor = dense_factor, .solve = dense_solve, .close = dense_close};
    pia_normal *normal = pia_take_zero(p->context, 1, sizeof *normal);
    dense_normal *state = malloc(sizeof *state);
    pia_index n = p->cols;
    normal->class = &dense_class;
    normal->op = p->op;
    normal->state = state;
    normal->right = pia_take(p->context, n, (size_t)p->dim * sizeof(double));
    normal->diagonal = pia_take(p->context, n, sizeof(double));
    normal->column_sum = pia_take_zero(p->context, n, sizeof(double));
    state->h = malloc((size_t)(n * n) * sizeof(double));
    problem_normal(p, state->h, normal->right);
    for (pia_index i = 0; i < n; i++) normal->diagonal[i] = state->h[i * n + i];
    for (pia_index row = 0; row < p->rows; row++)
        for (pia_index i = 0; i < n; i++) normal->column_sum[i] += (p->weights != NULL ? p->weights[row] : 1) * p->dense[row * n + i];
    pia_op_mask(p->op, normal->right, p->dim);
    return normal;
}

#endif
