#include "knots.h"

#include "clones.h"
#include "kernel.h"

#include <float.h>
#include <math.h>
#include <string.h>

static pia_status check_counts(pia_context *context, int degree, pia_index count, pia_index control)
{
    if (degree < 1 || degree > PIA_MAX_DEGREE)
        return pia_fail(context, PIA_E_ARGUMENT, "degree %d is outside 1 to %d", degree, PIA_MAX_DEGREE);
    if (control < degree + 1)
        return pia_fail(context, PIA_E_SHAPE, "%lld control points cannot have degree %d; it needs at least %d", (long long)control,
                        degree, degree + 1);
    if (count < control || count - control != degree + 1)
        return pia_fail(context, PIA_E_SHAPE,
                        "%lld knots do not go with %lld control points of degree %d; give %d knots more than points", (long long)count,
                        (long long)control, degree, degree + 1);
    return PIA_OK;
}

static pia_status check_order(pia_context *context, const double *knots, pia_index count)
{
    for (pia_index i = 0; i < count; i++) {
        if (!isfinite(knots[i])) return pia_fail(context, PIA_E_DATA, "knot %lld is %g; it must be finite", (long long)i, knots[i]);
        double gap = i > 0 ? knots[i] - knots[i - 1] : 0;
        if (gap < 0)
            return pia_fail(context, PIA_E_DATA, "knot %lld (%.17g) is below knot %lld (%.17g); sort them", (long long)i, knots[i],
                            (long long)i - 1, knots[i - 1]);
        /* A quotient by a subnormal gap overflows. */
        if (gap > 0 && gap < DBL_MIN)
            return pia_fail(context, PIA_E_DATA, "knots %lld and %lld differ by only %g; make them equal", (long long)i - 1,
                            (long long)i, gap);
    }
    if (!isfinite(knots[count - 1] - knots[0]))
        return pia_fail(context, PIA_E_DATA, "the knots reach from %g to %g, too far to subtract; scale them", knots[0],
                        knots[count - 1]);
    return PIA_OK;
}

static pia_status check_multiplicities(pia_context *context, int degree, const double *knots, pia_index control)
{
    if (knots[0] == knots[control + degree]) return pia_fail(context, PIA_E_DATA, "all knots are %g; the domain is empty", knots[0]);
    if (knots[0] != knots[degree] || knots[control] != knots[control + degree])
        return pia_fail(context, PIA_E_DATA, "the knots are not clamped; the first %d must be equal, and the last %d", degree + 1,
                        degree + 1);
    for (pia_index i = 1; i < control; i++)
        if (knots[i] == knots[i + degree])
            return pia_fail(context, PIA_E_DATA, "knot %lld (%.17g) occurs too often; at most %d times inside, %d times at an end",
                            (long long)i, knots[i], degree, degree + 1);
    return PIA_OK;
}

enum { BLOCK = 2048 }; /* knots that stay in the first-level cache between their check and their copy */

typedef struct inner_knots {
    const double *knots; /* without the first one */
    int degree;
    double *copy; /* NULL: none is wanted */
} inner_knots;

/* What the checks above ask of a knot, the next one and the one `degree` further on. */
PIA_CLONES static int are_in_order(const double *knots, pia_index count, int degree)
{
    int all = 1;
    for (pia_index i = 0; i < count; i++) {
        double gap = knots[i + 1] - knots[i];
        all &= ((gap == 0) | (gap >= DBL_MIN)) & (knots[i] < knots[i + degree]);
    }
    return all;
}

static int check_inner(const void *data, pia_index from, pia_index to)
{
    const inner_knots *inner = data;
    int all = 1;
    for (pia_index begin = from, end; begin < to; begin = end) {
        end = to - begin > BLOCK ? begin + BLOCK : to;
        all &= are_in_order(inner->knots + begin, end - begin, inner->degree);
        if (inner->copy != NULL) memcpy(inner->copy + begin, inner->knots + begin, (size_t)(end - begin) * sizeof(double));
    }
    return all;
}

/* Found side by side; where the knots are not plainly good, the checks above find out why. */
static int are_good(pia_context *context, int degree, const double *knots, pia_index control, double *copy)
{
    inner_knots inner = {knots + 1, degree, copy != NULL ? copy + 1 : NULL};
    double length = knots[control] - knots[0];
    for (int k = 0; k < degree; k++)
        if (knots[k] != knots[k + 1] || knots[control + k] != knots[control + k + 1]) return 0;
    return isfinite(length) && pia_all(context, control - 1, check_inner, &inner);
}

pia_status pia_knots_copy(pia_context *context, int degree, const double *knots, pia_index count, pia_index control, double *copy)
{
    pia_status status = check_counts(context, degree, count, control);
    if (status != PIA_OK) return status;
    if (are_good(context, degree, knots, control, copy)) {
        if (copy != NULL) copy[0] = knots[0];
        if (copy != NULL) memcpy(copy + control, knots + control, (size_t)(degree + 1) * sizeof *copy);
        return PIA_OK;
    }
    status = check_order(context, knots, count);
    if (status == PIA_OK) status = check_multiplicities(context, degree, knots, control);
    if (status == PIA_OK && copy != NULL) pia_copy(context, copy, knots, count);
    return status;
}

pia_status pia_knots_check(pia_context *context, int degree, const double *knots, pia_index count, pia_index control)
{
    return pia_knots_copy(context, degree, knots, count, control, NULL);
}

static pia_index last_span(const double *knots, int degree, pia_index control)
{
    pia_index span = control - 1;
    while (span > degree && !(knots[span] < knots[control])) span--;
    return span;
}

/* Keeps knots[low] <= t < knots[high]. */
static pia_index bisect(const double *knots, pia_index low, pia_index high, double t)
{
    while (high - low > 1) {
        pia_index middle = low + (high - low) / 2;
        if (t < knots[middle])
            high = middle;
        else
            low = middle;
    }
    return low;
}

pia_index pia_knots_span(const double *knots, int degree, pia_index control, double t)
{
    return pia_knots_span_near(knots, degree, control, t, degree + (control - degree) / 2);
}

pia_index pia_knots_span_near(const double *knots, int degree, pia_index control, double t, pia_index hint)
{
    if (!(t > knots[degree])) t = knots[degree]; /* NaN goes the same way */
    if (t >= knots[control]) return last_span(knots, degree, control);
    pia_index low = hint < degree ? degree : hint >= control ? control - 1 : hint;
    pia_index high = low + 1;
    for (pia_index step = 1; t >= knots[high]; step *= 2) {
        low = high;
        high = control - high > step ? high + step : control;
    }
    for (pia_index step = 1; t < knots[low]; step *= 2) {
        high = low;
        low = low - degree > step ? low - step : degree;
    }
    return bisect(knots, low, high, t);
}

int pia_knots_multiplicity(const double *knots, pia_index count, pia_index index)
{
    pia_index first = index, last = index;
    while (first > 0 && knots[first - 1] == knots[index]) first--;
    while (last < count - 1 && knots[last + 1] == knots[index]) last++;
    return (int)(last - first + 1);
}

double pia_knots_greville(const double *knots, int degree, pia_index i)
{
    double sum = 0;
    for (int k = 1; k <= degree; k++) sum += knots[i + k] - knots[i + 1]; /* equal knots give exactly themselves */
    return knots[i + 1] + sum / degree;
}
