#include "iterate.h"

#include "kernel.h"
#include "part.h"

#include <math.h>

enum { GRAIN = 32768, MAX_CHUNKS = 256 };

typedef struct scan {
    const double *x, *y;
    pia_index count, chunks;
    int dim;
    double *part;
} scan;

static pia_index chunk_count(pia_index count)
{
    pia_index chunks = pia_chunk_count(count, GRAIN);
    return chunks < MAX_CHUNKS ? chunks : MAX_CHUNKS;
}

static void dot_chunk(void *work, pia_index chunk)
{
    const scan *s = work;
    double sum = 0;
    pia_index end = pia_chunk_begin(s->count, s->chunks, chunk + 1);
    for (pia_index i = pia_chunk_begin(s->count, s->chunks, chunk); i < end; i++) sum += s->x[i] * s->y[i];
    s->part[chunk] = sum;
}

static void longest_chunk(void *work, pia_index chunk)
{
    const scan *s = work;
    double worst = 0;
    pia_index end = pia_chunk_begin(s->count, s->chunks, chunk + 1);
    for (pia_index i = pia_chunk_begin(s->count, s->chunks, chunk); i < end; i++) {
        double square = 0;
        for (int d = 0; d < s->dim; d++) square += s->x[i * s->dim + d] * s->x[i * s->dim + d];
        if (!(square <= worst) && !isnan(worst)) worst = square;
    }
    s->part[chunk] = worst;
}

double pia_iterate_dot(const pia_iterate *iterate, const double *x, const double *y)
{
    double part[MAX_CHUNKS], sum = 0;
    pia_index count = iterate->op->cols * iterate->dim;
    scan s = {x, y, count, chunk_count(count), iterate->dim, part};
    pia_for_each(iterate->context, s.chunks, dot_chunk, &s);
    for (pia_index c = 0; c < s.chunks; c++) sum += part[c];
    return sum;
}

double pia_iterate_longest(const pia_iterate *iterate, const double *x)
{
    double part[MAX_CHUNKS], worst = 0;
    scan s = {x, x, iterate->op->cols, chunk_count(iterate->op->cols), iterate->dim, part};
    pia_for_each(iterate->context, s.chunks, longest_chunk, &s);
    for (pia_index c = 0; c < s.chunks; c++)
        if (!(part[c] <= worst) && !isnan(worst)) worst = part[c];
    return sqrt(worst);
}

typedef struct addition { /* x += y, or x := y - x */
    double *x;
    const double *y;
    pia_index count, chunks;
} addition;

static void add_chunk(void *work, pia_index chunk)
{
    const addition *a = work;
    pia_index to = pia_chunk_begin(a->count, a->chunks, chunk + 1);
    for (pia_index i = pia_chunk_begin(a->count, a->chunks, chunk); i < to; i++) a->x[i] += a->y[i];
}

static void take_from_chunk(void *work, pia_index chunk)
{
    const addition *a = work;
    pia_index to = pia_chunk_begin(a->count, a->chunks, chunk + 1);
    for (pia_index i = pia_chunk_begin(a->count, a->chunks, chunk); i < to; i++) a->x[i] = a->y[i] - a->x[i];
}

void pia_iterate_add(const pia_iterate *iterate, double *x, const double *y)
{
    pia_index count = iterate->op->cols * iterate->dim;
    addition a = {x, y, count, chunk_count(count)};
    pia_for_each(iterate->context, a.chunks, add_chunk, &a);
}

void pia_iterate_measure(pia_iterate *iterate)
{
    if (iterate->errors_known) return;
    iterate->errors = iterate->part != NULL ? pia_part_residual(iterate->part, iterate->points, &iterate->targets, iterate->residual)
                                            : pia_op_residual(iterate->op, iterate->points, &iterate->targets, iterate->residual);
    iterate->errors_known = 1;
}

static void set_gradient(pia_iterate *iterate, double norm)
{
    iterate->relative_gradient = iterate->right_norm > 0 ? norm / iterate->right_norm : norm;
}

static int has_residual(const pia_iterate *iterate)
{
    return iterate->normal != NULL && iterate->normal->class->residual != NULL && iterate->op->frozen == NULL;
}

int pia_iterate_gradient_length(pia_iterate *iterate)
{
    const pia_normal *normal = iterate->normal;
    if (!has_residual(iterate)) return 0;
    set_gradient(iterate, sqrt(normal->class->residual(normal, iterate->points, iterate->dim, NULL)));
    return 1;
}

void pia_iterate_gradient(pia_iterate *iterate, double *gradient)
{
    const pia_normal *normal = iterate->normal;
    if (has_residual(iterate)) {
        set_gradient(iterate, sqrt(normal->class->residual(normal, iterate->points, iterate->dim, gradient)));
        return;
    }
    if (normal != NULL) {
        pia_index count = iterate->op->cols * iterate->dim;
        addition a = {gradient, normal->right, count, chunk_count(count)};
        normal->class->multiply(normal, iterate->points, iterate->dim, gradient);
        pia_for_each(iterate->context, a.chunks, take_from_chunk, &a);
        pia_op_mask(iterate->op, gradient, iterate->dim);
    } else {
        pia_iterate_measure(iterate);
        pia_op_gather(iterate->op, iterate->residual, iterate->op->weights, iterate->dim, gradient);
    }
    set_gradient(iterate, sqrt(pia_iterate_dot(iterate, gradient, gradient)));
}
