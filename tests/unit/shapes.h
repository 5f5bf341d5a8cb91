/* Shapes for the tests of the spline core, and their values straight from the definition. */
#ifndef PIA_TESTS_SHAPES_H
#define PIA_TESTS_SHAPES_H

#include <stdlib.h>

#include "check.h"

/* A small generator of its own: the same shapes on every machine. In [0, 1). */
static inline double shape_random(uint64_t *state)
{
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return (double)(*state >> 11) * 0x1p-53;
}

/* Clamped knots over [0, 1] at uneven places, every fifth one twice where the degree allows. */
static inline double *shape_knots(int degree, pia_index control, uint64_t *state)
{
    double *knots = malloc((size_t)(control + degree + 1) * sizeof *knots);
    double total = 0;
    for (pia_index i = 0; i < control + degree + 1; i++) {
        if (i > degree && i <= control && (degree < 2 || i % 5 != 0 || i == degree + 1 || i == control))
            total += 0.05 + shape_random(state);
        knots[i] = total;
    }
    for (pia_index i = 0; i < control + degree + 1; i++) knots[i] = i >= control ? 1 : knots[i] / total;
    return knots;
}

/* Control points wander around the unit box; weights between 0.5 and 2 when rational. Caller destroys. */
static inline pia_model *shape_model(pia_context *context, int directions, const int *degree, const pia_index *control, int dim,
                                     int rational, uint64_t seed)
{
    uint64_t state = seed * 77 + 5;
    double *knots[2] = {shape_knots(degree[0], control[0], &state), NULL};
    if (directions > 1) knots[1] = shape_knots(degree[1], control[1], &state);
    pia_index count = control[0] * (directions > 1 ? control[1] : 1);
    double *points = malloc((size_t)(count * dim) * sizeof *points), *weights = malloc((size_t)count * sizeof *weights);
    for (pia_index i = 0; i < count * dim; i++) points[i] = shape_random(&state) + 0.2 * (double)(i / dim);
    for (pia_index i = 0; i < count; i++) weights[i] = 0.5 + 1.5 * shape_random(&state);
    pia_model *model = NULL;
    assert_ok(context, pia_model_create(context, directions, degree, (const double *const *)knots, control, dim, points,
                                        rational ? weights : NULL, &model));
    free(points), free(weights), free(knots[0]), free(knots[1]);
    return model;
}

static inline pia_model *shape_curve(pia_context *context, int degree, pia_index control, int dim, int rational, uint64_t seed)
{
    return shape_model(context, 1, &degree, &control, dim, rational, seed);
}

static inline pia_model *shape_surface(pia_context *context, int degree_u, int degree_v, int dim, int rational, uint64_t seed)
{
    const int degree[2] = {degree_u, degree_v};
    const pia_index control[2] = {degree_u + 4, degree_v + 6};
    return shape_model(context, 2, degree, control, dim, rational, seed);
}

/* N_i of the Cox-de Boor definition, by recursion in long double; 0/0 is 0 and the last span holds its right end. */
static inline long double shape_basis(const double *knots, int degree, pia_index control, pia_index i, int d, double t)
{
    if (d == 0) {
        if (t >= knots[control]) return knots[i] < knots[control] && knots[i + 1] >= knots[control];
        return knots[i] <= t && t < knots[i + 1];
    }
    long double left = (long double)knots[i + d] - knots[i], right = (long double)knots[i + d + 1] - knots[i + 1], sum = 0;
    if (left > 0) sum += (t - (long double)knots[i]) / left * shape_basis(knots, degree, control, i, d - 1, t);
    if (right > 0) sum += (knots[i + d + 1] - (long double)t) / right * shape_basis(knots, degree, control, i + 1, d - 1, t);
    return sum;
}

/* Point of a model at (u, v) by the definition: out [dim]. */
static inline void shape_point(const pia_model *model, const double *parameter, double *out)
{
    pia_model_info info;
    pia_model_get_info(model, &info);
    pia_index count = info.control[0] * info.control[1];
    double *points = malloc((size_t)(count * info.dim) * sizeof *points), *weights = malloc((size_t)count * sizeof *weights);
    pia_model_control(model, points, weights);
    long double sum[PIA_MAX_DIM] = {0}, total = 0;
    for (pia_index i = 0; i < count; i++) {
        long double b = weights[i];
        for (int d = 0; d < info.directions; d++)
            b *= shape_basis(pia_model_knots(model, d), info.degree[d], info.control[d],
                             d == 0 ? i / info.control[1] : i % info.control[1], info.degree[d], parameter[d]);
        total += b;
        for (int c = 0; c < info.dim; c++) sum[c] += b * points[i * info.dim + c];
    }
    for (int c = 0; c < info.dim; c++) out[c] = (double)(sum[c] / total);
    free(points), free(weights);
}

/* Both models have the same shape: compared at `samples` places of the domain of `a` a direction. */
static inline void shape_assert_same(const pia_model *a, const pia_model *b, int samples, double tolerance)
{
    pia_model_info info;
    pia_model_get_info(a, &info);
    double p[PIA_MAX_DIM], q[PIA_MAX_DIM];
    for (int i = 0; i <= samples; i++)
        for (int j = 0; j <= (info.directions > 1 ? samples : 0); j++) {
            double at[2] = {info.domain[0][0] + (info.domain[0][1] - info.domain[0][0]) * i / samples,
                            info.domain[1][0] + (info.domain[1][1] - info.domain[1][0]) * j / samples};
            assert_ok(NULL, pia_model_eval(NULL, a, at, 1, 0, p));
            assert_ok(NULL, pia_model_eval(NULL, b, at, 1, 0, q));
            for (int c = 0; c < info.dim; c++) assert_near(q[c], p[c], tolerance);
        }
}

#endif
