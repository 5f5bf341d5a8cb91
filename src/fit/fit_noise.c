/* The noise of points along a line, from what their neighbours say of them: each point is predicted by the cubic through the two points
 * before and the two behind it. A smooth curve sampled well leaves next to nothing; noise of deviation s leaves s times the root of one
 * plus the squares of the four weights. The median over all points knows nothing of corners and jumps. */
#include "fit.h"

#include "options.h"
#include "select.h"

#include <math.h>

/* Weights of the cubic through parameters t[0], t[1], t[3], t[4] at t[2]; returns 0 where they do not differ. */
static int cubic_weights(const double *t, double *weight)
{
    for (int i = 0; i < 5; i++) {
        weight[i] = 1;
        for (int j = 0; j < 5 && i != 2; j++) {
            if (j == i || j == 2) continue;
            if (t[i] == t[j]) return 0;
            weight[i] *= (t[2] - t[j]) / (t[i] - t[j]);
        }
    }
    return 1;
}

/* What the distance of two points on a line counts: their number, their chord, or the difference of their first components. */
typedef enum measure { STEPS, CHORDS, ABSCISSAS } measure;

/* Five points, `stride` values apart. */
static void parameters_of(const double *point, pia_index stride, int dim, measure by, double *t)
{
    t[0] = 0;
    for (int i = 1; i < 5; i++) {
        const double *here = point + i * stride, *before = here - stride;
        double square = 0;
        for (int d = 0; d < dim; d++) square += (here[d] - before[d]) * (here[d] - before[d]);
        t[i] = t[i - 1] + (by == STEPS ? 1 : by == CHORDS ? sqrt(square) : here[0] - before[0]);
    }
}

/* The size of the noise that the middle one of five points shows; NAN where it says nothing. */
static double noise_of(const double *point, pia_index stride, int dim, measure by)
{
    double t[5], weight[5], gain = 1, square = 0;
    parameters_of(point, stride, dim, by, t);
    if (!cubic_weights(t, weight)) return NAN;
    for (int d = by == ABSCISSAS; d < dim; d++) {
        double difference = -point[2 * stride + d];
        for (int i = 0; i < 5; i++)
            if (i != 2) difference += weight[i] * point[i * stride + d];
        square += difference * difference;
    }
    for (int i = 0; i < 5; i++)
        if (i != 2) gain += weight[i] * weight[i];
    return sqrt(square / gain);
}

/* Median length of normal vectors of deviation 1 (Wilson, Hilferty 1931). */
static double median_length(double dim)
{
    return sqrt(dim * pow(1 - 2 / (9 * dim), 3));
}

/* The deviation of the noise, a component, by the median over all points of all lines in one direction; NAN where no line has five
 * points. Chords take noise along the line for distance: what is left is across it. size has room for all points. */
static double deviation_of(const pia_data *data, int direction, measure by, double *size)
{
    pia_index lines = data->count[1 - direction], length = data->count[direction], count = 0;
    pia_index along = direction == 0 ? data->count[1] * data->dim : data->dim;
    pia_index across = direction == 0 ? data->dim : length * data->dim;
    for (pia_index line = 0; line < lines; line++)
        for (pia_index k = 0; k + 5 <= length; k++) {
            double noise = noise_of(data->points + line * across + k * along, along, data->dim, by);
            if (isfinite(noise)) size[count++] = noise;
        }
    int dim = data->dim - (by == ABSCISSAS), seen = by == CHORDS && dim > 1 ? dim - 1 : dim;
    return count > 0 ? pia_select(size, count, count / 2) / median_length(seen) : NAN;
}

pia_status pia_suggest_tolerance(pia_context *context, const pia_data *data, double *tolerance, double *noise)
{
    pia_data own;
    pia_data_init(&own);
    if (data == NULL || tolerance == NULL) return pia_fail(context, PIA_E_ARGUMENT, "data or tolerance is NULL");
    pia_status status = pia_options_read(context, "pia_data", &own, sizeof own, data);
    if (status != PIA_OK) return status;
    pia_index rows;
    if (own.points == NULL || own.dim < 1 || own.dim > PIA_MAX_DIM || own.count[0] < 0 || own.count[1] < 0 ||
        !pia_multiply(own.count[0], own.count[1], &rows))
        return pia_fail(context, PIA_E_SHAPE, "points, counts and dimension do not make up data");
    if (own.kind == PIA_SCATTERED)
        return pia_fail(context, PIA_E_UNAVAILABLE, "scattered points have no neighbours that would show their noise");
    double *size = pia_take(context, rows, sizeof *size), least = INFINITY;
    if (size == NULL) return pia_take_status(context, rows, sizeof *size);
    for (int direction = 0; direction <= (own.kind == PIA_GRID); direction++)
        for (measure by = STEPS; by <= ABSCISSAS; by++)
            if ((by == ABSCISSAS) == (own.function_graph != 0)) least = fmin(least, deviation_of(&own, direction, by, size));
    pia_give(context, size);
    if (!isfinite(least)) return pia_fail(context, PIA_E_DATA, "no five points in a row that differ: they are too few to show noise");
    /* The largest of `rows` lengths of normal vectors (Laurent, Massart 2000). */
    double dim = own.dim - (own.function_graph != 0), log_rows = log((double)rows);
    *tolerance = least * sqrt(dim + 2 * sqrt(dim * log_rows) + 2 * log_rows);
    if (noise != NULL) *noise = least;
    return PIA_OK;
}
