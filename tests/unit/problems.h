/* Small fitting problems with everything about them in the open: operators of all kinds, their dense matrices by the Cox-de Boor
 * recursion, and dense solves, to hold the library against. */
#ifndef PIA_TESTS_PROBLEMS_H
#define PIA_TESTS_PROBLEMS_H

#include <stdlib.h>

#include "check.h"
#include "op.h"
#include "op_scatter.h"

typedef struct problem {
    pia_context *context;
    pia_kind kind;
    int degree[2], cyclic[2], dim;
    pia_index unknowns[2], full[2], rows, cols;
    double *knots[2], *parameters[2]; /* scattered: parameters[0] holds pairs */
    double *points, *weights, *dense; /* dense [rows x cols] */
    double origin[PIA_MAX_DIM];
    pia_collocation line[2];
    pia_targets targets;
    pia_op *op;
} problem;

/* Numbers in [0, 1), the same on every machine. */
static inline double problem_random(uint64_t *seed)
{
    *seed = *seed * 6364136223846793005u + 1442695040888963407u;
    return (double)(*seed >> 11) / 9007199254740992.0;
}

static inline double problem_basis(const double *knots, pia_index i, int degree, double t, pia_index last)
{
    if (degree == 0) return t == knots[last + 1] ? i == last : knots[i] <= t && t < knots[i + 1];
    double left = knots[i + degree] - knots[i], right = knots[i + degree + 1] - knots[i + 1], sum = 0;
    if (left > 0) sum += (t - knots[i]) / left * problem_basis(knots, i, degree - 1, t, last);
    if (right > 0) sum += (knots[i + degree + 1] - t) / right * problem_basis(knots, i + 1, degree - 1, t, last);
    return sum;
}

/* Derivative by the recursion on the degree. */
static inline double problem_derivative(const double *knots, pia_index i, int degree, int order, double t, pia_index last)
{
    if (order == 0) return problem_basis(knots, i, degree, t, last);
    double left = knots[i + degree] - knots[i], right = knots[i + degree + 1] - knots[i + 1], sum = 0;
    if (left > 0) sum += degree / left * problem_derivative(knots, i, degree - 1, order - 1, t, last);
    if (right > 0) sum -= degree / right * problem_derivative(knots, i + 1, degree - 1, order - 1, t, last);
    return sum;
}

/* row [cols] of derivatives `order` at t[directions]. */
static inline void problem_row(const problem *p, const double *t, const int *order, double *row)
{
    int directions = p->kind == PIA_CURVE ? 1 : 2;
    for (pia_index c = 0; c < p->cols; c++) row[c] = 0;
    for (pia_index i = 0; i < p->full[0]; i++) {
        double u = problem_derivative(p->knots[0], i, p->degree[0], order[0], t[0], p->full[0] - 1);
        if (directions == 1) row[i % p->unknowns[0]] += u;
        for (pia_index j = 0; directions == 2 && j < p->full[1]; j++)
            row[i % p->unknowns[0] * p->unknowns[1] + j % p->unknowns[1]] +=
                u * problem_derivative(p->knots[1], j, p->degree[1], order[1], t[1], p->full[1] - 1);
    }
}

static inline void problem_parameters(const problem *p, pia_index row, double *t)
{
    if (p->kind == PIA_SCATTERED) {
        t[0] = p->parameters[0][2 * row];
        t[1] = p->parameters[0][2 * row + 1];
    } else {
        pia_index across = p->kind == PIA_GRID ? p->line[1].rows : 1;
        t[0] = p->parameters[0][row / across];
        if (p->kind == PIA_GRID) t[1] = p->parameters[1][row % across];
    }
}

static inline double *problem_knots(int degree, int cyclic, pia_index unknowns, uint64_t *seed)
{
    pia_index full = unknowns + (cyclic ? degree : 0);
    double *knots = malloc((size_t)(full + degree + 1) * sizeof *knots), *inside = malloc((size_t)(unknowns + 1) * sizeof *inside);
    pia_index spans = full - degree;
    for (pia_index i = 0; i <= spans; i++)
        inside[i] = ((double)i + (i > 0 && i < spans ? 0.6 * (problem_random(seed) - 0.5) : 0)) / (double)spans;
    for (pia_index i = 0; i <= full + degree; i++) {
        pia_index s = i - degree;
        if (cyclic)
            knots[i] = s < 0 ? inside[s + spans] - 1 : s > spans ? inside[s - spans] + 1 : inside[s];
        else
            knots[i] = s < 0 ? 0 : s > spans ? 1 : inside[s];
    }
    free(inside);
    return knots;
}

static inline int problem_order(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* `rows` points of a curve, rows x rows of a grid, rows * rows scattered ones. Rows are many enough for full rank when they are about
 * three for each unknown of a direction. cyclic: bit 0 u, bit 1 v. */
static inline problem *problem_open(pia_context *context, pia_kind kind, int p, int q, pia_index nu, pia_index nv, pia_index rows,
                                    int dim, int cyclic, int weighted)
{
    problem *self = calloc(1, sizeof *self);
    uint64_t seed = (uint64_t)(977 * p + 31 * q + 7 * nu + 3 * rows + dim + 5 * cyclic);
    int directions = kind == PIA_CURVE ? 1 : 2;
    pia_map map[2];
    *self = (problem){.context = context, .kind = kind, .degree = {p, q}, .cyclic = {cyclic & 1, cyclic >> 1}, .dim = dim};
    self->unknowns[0] = nu;
    self->unknowns[1] = directions == 2 ? nv : 1;
    self->full[1] = 1;
    self->cols = nu * self->unknowns[1];
    self->rows = directions == 2 ? rows * rows : rows;
    for (int d = 0; d < directions; d++) {
        self->full[d] = self->unknowns[d] + (self->cyclic[d] ? self->degree[d] : 0);
        self->knots[d] = problem_knots(self->degree[d], self->cyclic[d], self->unknowns[d], &seed);
        map[d] = self->cyclic[d] ? PIA_MAP_CYCLIC : PIA_MAP_IDENTITY;
        pia_index count = kind == PIA_SCATTERED ? 2 * self->rows : rows;
        self->parameters[d] = malloc((size_t)count * sizeof(double));
        for (pia_index i = 0; i < count; i++) self->parameters[d][i] = problem_random(&seed);
        if (kind != PIA_SCATTERED) {
            qsort(self->parameters[d], (size_t)count, sizeof(double), problem_order);
            self->parameters[d][0] = 0;
            self->parameters[d][count - 1] = 1;
            assert_ok(context, pia_collocation_open(context, self->degree[d], map[d], 0, self->knots[d], self->full[d],
                                                    self->parameters[d], count, d, &self->line[d]));
        }
    }
    if (kind == PIA_SCATTERED) self->parameters[0][0] = self->parameters[0][3] = 1; /* both far edges */
    self->points = malloc((size_t)(self->rows * dim) * sizeof(double));
    for (pia_index i = 0; i < self->rows * dim; i++) self->points[i] = 4 * problem_random(&seed) - 1;
    if (weighted) {
        self->weights = malloc((size_t)self->rows * sizeof(double));
        for (pia_index i = 0; i < self->rows; i++) self->weights[i] = 0.1 + 3 * problem_random(&seed);
    }
    for (int d = 0; d < dim; d++) self->origin[d] = 1 + d;
    self->targets = (pia_targets){.points = self->points, .origin = self->origin, .dim = dim};
    if (kind == PIA_CURVE)
        assert_ok(context, pia_op_curve_open(context, &self->line[0], self->weights, dim, &self->op));
    else if (kind == PIA_GRID)
        assert_ok(context, pia_op_grid_open(context, &self->line[0], &self->line[1], self->weights, dim, &self->op));
    else
        assert_ok(context, pia_op_scatter_open(context, self->degree, map, (const double *const *)self->knots, self->full,
                                               self->parameters[0], self->rows, self->weights, dim, &self->op));
    self->dense = malloc((size_t)(self->rows * self->cols) * sizeof(double));
    for (pia_index row = 0; row < self->rows; row++) {
        const int value[2] = {0, 0};
        double t[2] = {0, 0};
        problem_parameters(self, row, t);
        problem_row(self, t, value, self->dense + row * self->cols);
    }
    return self;
}

static inline void problem_close(problem *p)
{
    pia_op_close(p->op);
    for (int d = 0; d < 2; d++) {
        pia_collocation_close(p->context, &p->line[d]);
        free(p->knots[d]);
        free(p->parameters[d]);
    }
    free(p->points);
    free(p->weights);
    free(p->dense);
    free(p);
}

/* x [n x dim] := A^-1 x by Gaussian elimination with partial pivoting; a is overwritten. */
static inline void problem_solve(double *a, pia_index n, double *x, int dim)
{
    for (pia_index k = 0; k < n; k++) {
        pia_index best = k;
        for (pia_index i = k; i < n; i++)
            if (fabs(a[i * n + k]) > fabs(a[best * n + k])) best = i;
        for (pia_index j = 0; j < n; j++) {
            double swap = a[k * n + j];
            a[k * n + j] = a[best * n + j];
            a[best * n + j] = swap;
        }
        for (int d = 0; d < dim; d++) {
            double swap = x[k * dim + d];
            x[k * dim + d] = x[best * dim + d];
            x[best * dim + d] = swap;
        }
        for (pia_index i = k + 1; i < n; i++) {
            double factor = a[i * n + k] / a[k * n + k];
            for (pia_index j = k; j < n && factor != 0; j++) a[i * n + j] -= factor * a[k * n + j];
            for (int d = 0; d < dim; d++) x[i * dim + d] -= factor * x[k * dim + d];
        }
    }
    for (pia_index i = n; i-- > 0;)
        for (int d = 0; d < dim; d++) {
            for (pia_index j = i + 1; j < n; j++) x[i * dim + d] -= a[i * n + j] * x[j * dim + d];
            x[i * dim + d] /= a[i * n + i];
        }
}

/* Dense H [cols x cols] = A'WA and b [cols x dim] = A'W(Q - origin). Rows with NaN are holes. */
static inline void problem_normal(const problem *p, double *h, double *b)
{
    for (pia_index i = 0; i < p->cols * p->cols; i++) h[i] = 0;
    for (pia_index i = 0; i < p->cols * p->dim; i++) b[i] = 0;
    for (pia_index row = 0; row < p->rows; row++) {
        const double *a = p->dense + row * p->cols;
        double w = p->weights != NULL ? p->weights[row] : 1;
        if (isnan(p->points[row * p->dim])) continue;
        for (pia_index i = 0; i < p->cols; i++) {
            if (a[i] == 0) continue;
            for (pia_index j = 0; j < p->cols; j++) h[i * p->cols + j] += w * a[i] * a[j];
            for (int d = 0; d < p->dim; d++) b[i * p->dim + d] += w * a[i] * (p->points[row * p->dim + d] - p->origin[d]);
        }
    }
}

#endif
