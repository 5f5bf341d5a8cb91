/* Knots so that every span holds about as many different parameters (The NURBS Book, Eq. 9.68 and 9.69). Repeated parameters count
 * once: with n <= m different ones every span then holds at least one. With n = m, where the rule would squeeze the first spans, the
 * knots are those of interpolation. */
#include "place.h"
#include "spacing.h"

extern const pia_placement pia_place_average;

static pia_index count_different(const pia_place_problem *p)
{
    pia_index different = 1;
    for (pia_index i = 1; i < p->count; i++) different += p->parameters[i] != p->parameters[i - 1];
    return different;
}

/* (1 - a) t[i - 1] + a t[i] at the position i + a = j m / spans, without rounding in i. */
static void place_open(const pia_place_problem *p, double *knots)
{
    const double *t = p->parameters;
    pia_index spans = p->control - p->degree;
    pia_spacing_clamp(p, knots);
    for (pia_index j = 1; j < spans; j++) {
        pia_index i = j * p->count / spans;
        double a = (double)(j * p->count % spans) / (double)spans;
        knots[p->degree + j] = (1 - a) * t[i - 1] + a * t[i];
    }
}

/* The same on the cyclic parameters, from t[0] on; even degrees start half a span early (see place_uniform.c). */
static void place_closed(const pia_place_problem *p, double *knots)
{
    pia_index halves = 2 * p->control, early = p->degree % 2 == 0;
    for (pia_index j = 0; j < p->control; j++) {
        pia_index position = (2 * j - early) * p->count, i = position / halves, rest = position % halves;
        if (rest < 0) rest += halves, i--;
        double a = (double)rest / (double)halves;
        knots[p->degree + j] = (1 - a) * pia_spacing_cyclic(p, i) + a * pia_spacing_cyclic(p, i + 1);
    }
}

static pia_status place_different(pia_context *context, const pia_place_problem *p, double *knots)
{
    if (p->control == p->count) return pia_place_average.place(context, p, knots);
    if (p->closed)
        place_closed(p, knots);
    else
        place_open(p, knots);
    return pia_spacing_finish(context, p, knots);
}

static pia_status place_once_each(pia_context *context, const pia_place_problem *p, pia_index different, double *knots)
{
    double *once = pia_take(context, different, sizeof *once);
    if (once == NULL) return pia_take_status(context, different, sizeof *once);
    pia_index kept = 0;
    for (pia_index i = 0; i < p->count; i++)
        if (i == 0 || p->parameters[i] != p->parameters[i - 1]) once[kept++] = p->parameters[i];
    pia_place_problem reduced = *p;
    reduced.parameters = once;
    reduced.count = different;
    pia_status status = place_different(context, &reduced, knots);
    pia_give(context, once);
    return status;
}

static pia_status place(pia_context *context, const pia_place_problem *p, double *knots)
{
    pia_index product;
    pia_status status = pia_spacing_check_problem(context, p);
    if (status != PIA_OK) return status;
    pia_index different = count_different(p);
    if (p->control > different)
        return pia_fail(context, PIA_E_SHAPE, "%lld different parameters hold at most %lld control points, not %lld; ask for fewer",
                        (long long)different, (long long)different, (long long)p->control);
    if (!pia_multiply(2 * p->control, p->count, &product))
        return pia_fail(context, PIA_E_SIZE, "%lld control points for %lld parameters do not fit in 64 bits", (long long)p->control,
                        (long long)p->count);
    return different == p->count ? place_different(context, p, knots) : place_once_each(context, p, different, knots);
}

const pia_placement pia_place_lsq = {
    .name = "lsq",
    .title = "least-squares spacing: about as many parameters in every span",
    .reference = "piegl1997",
    .detail = "up to as many control points as there are different parameters; every span holds data",
    .square = 0,
    .place = place,
};
