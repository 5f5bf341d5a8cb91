/* The ends of the spectrum of the tridiagonal matrix that Lanczos builds are found by bisection with Sturm counts. What is missing at
 * the upper end is at most the residual of its Ritz vector, which is added, so that a step chosen by it cannot make an iteration
 * diverge. */
#include "spectrum.h"

#include "normalise.h"
#include "product.h"

#include <math.h>

enum { MAX_STEPS = 300, CHECK = 10, BISECTIONS = 60, INVERSE_STEPS = 3 };

static const double settled = 1e-3, vanishing = 1e-12;

typedef struct lanczos {
    pia_product product;
    const double *scale;
    pia_index cols;
    double *last, *now, *image, *work; /* [cols] */
    double alpha[MAX_STEPS], beta[MAX_STEPS];
    int steps;
} lanczos;

static double dot(pia_index count, const double *x, const double *y)
{
    double sum = 0;
    for (pia_index i = 0; i < count; i++) sum += x[i] * y[i];
    return sum;
}

/* image = S H S now */
static void apply(lanczos *l)
{
    for (pia_index i = 0; i < l->cols; i++) l->work[i] = l->scale != NULL ? l->scale[i] * l->now[i] : l->now[i];
    pia_product_apply(&l->product, l->work, 1, l->image);
    for (pia_index i = 0; l->scale != NULL && i < l->cols; i++) l->image[i] *= l->scale[i];
}

/* now = image / |image|; returns that length. */
static double take_direction(lanczos *l)
{
    double length = sqrt(dot(l->cols, l->image, l->image));
    for (pia_index i = 0; i < l->cols; i++) l->now[i] = length > 0 ? l->image[i] / length : 0;
    return length;
}

/* A start with something of every eigenvector, the same on every machine; one product brings it into the range of H. */
static double start(lanczos *l)
{
    uint64_t seed = 1;
    for (pia_index i = 0; i < l->cols; i++) {
        seed = seed * 6364136223846793005u + 1442695040888963407u;
        l->now[i] = (double)(seed >> 11) * 0x1p-53 - 0.5;
    }
    apply(l);
    return take_direction(l);
}

static void advance(lanczos *l)
{
    int k = l->steps++;
    apply(l);
    for (pia_index i = 0; k > 0 && i < l->cols; i++) l->image[i] -= l->beta[k - 1] * l->last[i];
    l->alpha[k] = dot(l->cols, l->image, l->now);
    for (pia_index i = 0; i < l->cols; i++) l->image[i] -= l->alpha[k] * l->now[i];
    double *spare = l->last;
    l->last = l->now;
    l->now = spare;
    l->beta[k] = take_direction(l);
}

/* Eigenvalues of the tridiagonal matrix below x: negative pivots of T - x. */
static int count_below(const lanczos *l, double x)
{
    int count = 0;
    double pivot = 1;
    for (int k = 0; k < l->steps; k++) {
        double square = k > 0 ? l->beta[k - 1] * l->beta[k - 1] : 0;
        pivot = l->alpha[k] - x - square / pivot;
        if (pivot == 0) pivot = -1e-300;
        count += pivot < 0;
    }
    return count;
}

/* The eigenvalue with `index` others below it, in [0, bound]. */
static double eigenvalue(const lanczos *l, int index, double bound)
{
    double low = 0, high = bound;
    for (int i = 0; i < BISECTIONS; i++) {
        double middle = 0.5 * (low + high);
        if (count_below(l, middle) > index)
            high = middle;
        else
            low = middle;
    }
    return 0.5 * (low + high);
}

/* Length of the residual of the Ritz vector of `value`: beta times the last component of the eigenvector of T, by inverse iteration
 * just above the spectrum, where the factors of x - T are positive. */
static double residual(const lanczos *l, double value)
{
    double vector[MAX_STEPS], pivot[MAX_STEPS], shift = value * (1 + 1e-9);
    for (int k = 0; k < l->steps; k++) {
        vector[k] = 1;
        pivot[k] = shift - l->alpha[k] - (k > 0 ? l->beta[k - 1] * l->beta[k - 1] / pivot[k - 1] : 0);
        if (!(pivot[k] > 1e-15 * value)) pivot[k] = 1e-15 * value;
    }
    for (int i = 0; i < INVERSE_STEPS; i++) {
        double square = 0;
        for (int k = 1; k < l->steps; k++) vector[k] += l->beta[k - 1] / pivot[k - 1] * vector[k - 1];
        for (int k = l->steps - 1; k >= 0; k--) {
            vector[k] = (vector[k] + (k + 1 < l->steps ? l->beta[k] * vector[k + 1] : 0)) / pivot[k];
            square += vector[k] * vector[k];
        }
        for (int k = 0; k < l->steps; k++) vector[k] /= sqrt(square);
    }
    return l->beta[l->steps - 1] * fabs(vector[l->steps - 1]);
}

/* Rounding lets the null space of a singular H in after many steps: then the smallest value seen before it came is kept. */
static void run(lanczos *l, double bound, pia_spectrum *out)
{
    int most = l->cols < MAX_STEPS ? (int)l->cols : MAX_STEPS;
    *out = (pia_spectrum){0, bound};
    while (l->steps < most) {
        advance(l);
        int exhausted = !(l->beta[l->steps - 1] > vanishing * bound) || l->steps == most;
        if (l->steps % CHECK != 0 && !exhausted) continue;
        double largest = eigenvalue(l, l->steps - 1, bound), smallest = eigenvalue(l, 0, bound);
        int same = fabs(largest - out->largest) <= settled * largest && fabs(smallest - out->smallest) <= settled * smallest;
        out->largest = largest;
        if (!(smallest > vanishing * largest)) break;
        out->smallest = smallest;
        if (same || exhausted) break;
    }
    double safe = out->largest + residual(l, out->largest);
    out->largest = safe < bound ? safe : bound;
    if (out->smallest > out->largest) out->smallest = out->largest;
}

pia_status pia_spectrum_estimate(const pia_iterate *iterate, const double *scale, double bound, pia_spectrum *out)
{
    pia_index cols = iterate->op->cols;
    lanczos l = {.scale = scale, .cols = cols};
    double *block = pia_take(iterate->context, cols, 4 * sizeof *block);
    if (block == NULL) return pia_take_status(iterate->context, cols, 4 * sizeof *block);
    l.last = block;
    l.now = block + cols;
    l.image = block + 2 * cols;
    l.work = block + 3 * cols;
    pia_status status = pia_product_open(iterate, &l.product);
    *out = (pia_spectrum){0, 0};
    if (status == PIA_OK && start(&l) > 0) run(&l, bound, out);
    pia_product_close(&l.product);
    pia_give(iterate->context, block);
    return status;
}

pia_status pia_spectrum_of_gradient(const pia_iterate *iterate, pia_spectrum *out)
{
    pia_index cols = iterate->op->cols;
    double *sums = pia_take(iterate->context, cols, sizeof *sums);
    if (sums == NULL) return pia_take_status(iterate->context, cols, sizeof *sums);
    pia_status status = pia_column_sums(iterate, sums);
    if (status == PIA_OK) status = pia_spectrum_estimate(iterate, NULL, pia_largest(cols, sums), out);
    pia_give(iterate->context, sums);
    return status;
}
