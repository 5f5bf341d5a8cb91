#include "spacing.h"

#include <math.h>

static pia_status check_counts(pia_context *context, const pia_place_problem *p)
{
    if (p->degree < 1 || p->degree > PIA_MAX_DEGREE)
        return pia_fail(context, PIA_E_ARGUMENT, "degree %d; 1 to %d are possible", p->degree, PIA_MAX_DEGREE);
    if (p->control <= p->degree)
        return pia_fail(context, PIA_E_SHAPE, "%lld control points are too few for degree %d; at least %d are needed",
                        (long long)p->control, p->degree, p->degree + 1);
    if (p->count < 2) return pia_fail(context, PIA_E_SHAPE, "knots need at least 2 parameters, not %lld", (long long)p->count);
    return PIA_OK;
}

pia_status pia_spacing_check_problem(pia_context *context, const pia_place_problem *p)
{
    pia_status status = check_counts(context, p);
    if (status != PIA_OK) return status;
    for (pia_index i = 0; i < p->count; i++)
        if (!isfinite(p->parameters[i]) || (i > 0 && p->parameters[i] < p->parameters[i - 1]))
            return pia_fail(context, PIA_E_DATA, "parameter %lld is %g; parameters must be finite and not decrease", (long long)i,
                            p->parameters[i]);
    double first = p->parameters[0], last = p->parameters[p->count - 1];
    if (first == last) return pia_fail(context, PIA_E_DATA, "all %lld parameters are equal; give ones that rise", (long long)p->count);
    if (p->closed && !(first >= 0 && last < 1))
        return pia_fail(context, PIA_E_DATA, "parameters run from %g to %g; those of a closed curve lie in [0, 1)", first, last);
    return PIA_OK;
}

pia_status pia_spacing_check_square(pia_context *context, const pia_place_problem *p)
{
    if (p->control != p->count)
        return pia_fail(
            context, PIA_E_SHAPE,
            "interpolation of %lld parameters needs %lld control points, not %lld; leave their number out, or place knots by lsq",
            (long long)p->count, (long long)p->count, (long long)p->control);
    return pia_spacing_check_problem(context, p);
}

double pia_spacing_cyclic(const pia_place_problem *p, pia_index index)
{
    pia_index turns = index / p->count, rest = index % p->count;
    if (rest < 0) rest += p->count, turns--;
    return p->parameters[rest] + (double)turns;
}

void pia_spacing_clamp(const pia_place_problem *p, double *knots)
{
    for (int k = 0; k <= p->degree; k++) {
        knots[k] = p->parameters[0];
        knots[p->control + k] = p->parameters[p->count - 1];
    }
}

static void put_in_order(double *knots, pia_index begin, pia_index end, double last)
{
    for (pia_index i = begin; i < end; i++) knots[i] = fmin(fmax(knots[i], knots[i - 1]), last);
}

static void wrap(const pia_place_problem *p, double *knots)
{
    int degree = p->degree;
    double *domain = knots + degree;
    for (pia_index i = 0; i < p->control; i++) domain[i] = (domain[i] + 3) - 3;
    put_in_order(domain, 1, p->control, domain[0] + 1);
    for (pia_index i = 1; i <= degree; i++) domain[-i] = domain[p->control - i] - 1;
    for (pia_index i = 0; i <= degree; i++) domain[p->control + i] = domain[i] + 1;
}

/* No knot may equal the one `degree` places before it; of clamped vectors the outermost two knots are exempt. */
static pia_status check_multiplicity(pia_context *context, const pia_place_problem *p, const double *knots)
{
    pia_index degree = p->degree, begin = p->closed ? 0 : 1, end = p->closed ? p->control + 2 * degree + 1 : p->control + degree;
    for (pia_index i = begin; i + degree < end; i++)
        if (!(knots[i + degree] > knots[i]))
            return pia_fail(context, PIA_E_SHAPE,
                            "equal parameters near %.17g would make a knot more than %lld-fold; drop repeated points or ask for fewer "
                            "control points than %lld",
                            knots[i], (long long)degree, (long long)p->control);
    return PIA_OK;
}

pia_status pia_spacing_finish(pia_context *context, const pia_place_problem *p, double *knots)
{
    if (p->closed)
        wrap(p, knots);
    else
        put_in_order(knots, p->degree + 1, p->control, knots[p->control]);
    return check_multiplicity(context, p, knots);
}
