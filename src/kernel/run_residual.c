#include "run_block.h"

/* value -= the polynomial of one component at x, by Clenshaw's recurrence; its squares are added up. */
PIA_INLINE void subtract(const double *x, int count, const double *coefficient, int stride, int degree, double *value, double *square)
{
    for (int k = 0; k < count; k++) {
        double twice = 2 * x[k], above = 0, two_above = 0;
        for (int j = degree; j >= 1; j--) {
            double next = coefficient[j * stride] + twice * above - two_above;
            two_above = above;
            above = next;
        }
        value[k] -= coefficient[0] + x[k] * above - two_above;
        square[k] += value[k] * value[k];
    }
}

/* The degrees that people use get their own loops, which the compiler turns into vectors. */
PIA_INLINE void subtract_polynomial(const double *x, int count, const double *coefficient, int stride, int degree,
                                    double *restrict value, double *restrict square)
{
    switch (degree) {
    case 1: subtract(x, count, coefficient, stride, 1, value, square); break;
    case 2: subtract(x, count, coefficient, stride, 2, value, square); break;
    case 3: subtract(x, count, coefficient, stride, 3, value, square); break;
    case 4: subtract(x, count, coefficient, stride, 4, value, square); break;
    case 5: subtract(x, count, coefficient, stride, 5, value, square); break;
    default: subtract(x, count, coefficient, stride, degree, value, square); break;
    }
}

PIA_INLINE double sum_lanes(const double *value, int count)
{
    pia_lanes sum = {0};
    for (int k = 0; k < count; k += PIA_LANES) sum += pia_vector_load(value + k);
    return pia_vector_sum(sum);
}

PIA_INLINE double largest(const double *value, int count)
{
    pia_lanes most = {0};
    double largest_of_all = 0;
    for (int k = 0; k < count; k += PIA_LANES) most = pia_vector_upper(pia_vector_load(value + k), most);
    for (int l = 0; l < PIA_LANES; l++) largest_of_all = most[l] > largest_of_all ? most[l] : largest_of_all;
    return largest_of_all;
}

/* square [whole], zero beyond count. */
PIA_INLINE void note_errors(double *square, const double *weight, int count, int whole, pia_index first, pia_run_errors *errors)
{
    double worst = largest(square, whole), sum = sum_lanes(square, whole);
    errors->sum_squares += sum;
    if (worst > errors->worst) {
        errors->worst = worst;
        for (int k = count - 1; k >= 0; k--)
            if (square[k] == worst) errors->index = first + k;
    }
    for (int k = 0; weight != NULL && k < count; k++) square[k] *= weight[k];
    errors->weighted += weight != NULL ? sum_lanes(square, whole) : sum;
}

PIA_CLONES static void take_blocks(const pia_run *run, const double *coefficient, pia_index first, double *out, pia_run_errors *errors)
{
    double x[PIA_BLOCK], component[PIA_MAX_DIM][PIA_BLOCK], square[PIA_BLOCK];
    int dim = run->dim;
    for (pia_index done = 0; done < run->count; done += PIA_BLOCK) {
        int count = pia_block_count(run, done), whole = pia_block_fill(run, done, count, x, component);
        for (int k = 0; k < whole; k++) square[k] = 0;
        for (int d = 0; d < dim; d++) {
            subtract_polynomial(x, whole, coefficient + d, dim, run->degree, component[d], square);
            for (int k = 0; out != NULL && k < count; k++) out[(done + k) * dim + d] = component[d][k];
        }
        for (int k = count; k < whole; k++) square[k] = 0;
        note_errors(square, run->weights != NULL ? run->weights + done : NULL, count, whole, first + done, errors);
    }
}

/* Squares of the differences of the rows from t and q on. */
PIA_INLINE pia_lanes cubic_squares(const pia_run *run, const double *t, const double *q, int dim, const double *coefficient)
{
    pia_lanes p[3], sum = {0};
    pia_run_cubic(run, t, p);
    for (int d = 0; d < dim; d++) {
        pia_lanes value = pia_vector_component(q, dim, d) - run->origin[d] - coefficient[d];
        for (int j = 0; j < 3; j++) value -= coefficient[(j + 1) * dim + d] * p[j];
        sum += value * value;
    }
    return sum;
}

/* Cubic, without weights, the differences not wanted, PIA_LANES rows at least. The last vector of a run is moved back to where it is
 * full: what it finds again is the same, or falls into the room before the block. */
PIA_INLINE void take_cubic(const pia_run *run, int dim, const double *coefficient, pia_index first, pia_run_errors *errors)
{
    double room[PIA_LANES + PIA_BLOCK], *square = room + PIA_LANES;
    for (pia_index done = 0; done < run->count; done += PIA_BLOCK) {
        int count = pia_block_count(run, done), whole = (count + PIA_LANES - 1) / PIA_LANES * PIA_LANES;
        for (int k = whole - PIA_LANES; k < whole; k++) square[k] = 0;
        for (int k = 0; k < whole; k += PIA_LANES) {
            int at = k + PIA_LANES <= count ? k : count - PIA_LANES;
            const double *t = run->t + done + at, *q = run->points + (done + at) * dim;
            pia_run_fetch(t, q, dim);
            pia_lanes sum = cubic_squares(run, t, q, dim, coefficient);
            memcpy(square + at, &sum, sizeof sum);
        }
        note_errors(square, NULL, count, whole, first + done, errors);
    }
}

PIA_CLONES static void take_cubics(const pia_run *run, const double *coefficient, pia_index first, pia_run_errors *errors)
{
    switch (run->dim) {
    case 1: take_cubic(run, 1, coefficient, first, errors); break;
    case 2: take_cubic(run, 2, coefficient, first, errors); break;
    default: take_cubic(run, 3, coefficient, first, errors); break;
    }
}

void pia_run_residual(const pia_run *run, const double *coefficient, pia_index first, double *out, pia_run_errors *errors)
{
    if (pia_run_is_cubic(run) && run->weights == NULL && out == NULL && run->count >= PIA_LANES)
        take_cubics(run, coefficient, first, errors);
    else
        take_blocks(run, coefficient, first, out, errors);
}
