/* Holding a curve between rows that are far apart. A gap where it swings out gets knots of its own: more and more of them, closer and
 * closer to its ends, until the curve stays near the straight line there. */
#include "refine.h"

#include "window.h"

#include <math.h>
#include <string.h>

enum { REACH = PIA_HOLD_REACH, ROUNDS = 8, MOST_PAIRS = 4 };

/* Where a gap cannot be held as is wanted, so many times that is tried, and so on. */
static const double EASIER = 16;

/* A gap may swing out so much more than it does, while others are held, and where it cannot be. */
static const double SLACK = 1.5;

/* Knots to come, rising, and the parameters that none of the old ones stays between. */
typedef struct filling {
    double low, high, knot[4 * MOST_PAIRS];
    int count;
    pia_index row; /* unrolled, the first of `gaps` gaps that the knots are in */
    int gaps;
} filling;

/* At 4^-k of a gap from its begin, k = pairs .. 1, or from its end the other way round. */
static void add_before(filling *f, double begin, double end, int pairs)
{
    for (int k = 1; k <= pairs; k++) f->knot[f->count++] = end - ldexp(end - begin, -2 * k);
}

static void add_behind(filling *f, double begin, double end, int pairs)
{
    for (int k = pairs; k >= 1; k--) f->knot[f->count++] = begin + ldexp(end - begin, -2 * k);
}

/* Parameter of an unrolled row if the gap that it begins, or ends, is one to be held; else not a number. */
static double far_end(const pia_draft_data *data, pia_index row, int ends)
{
    pia_index at, first = row - (ends ? 1 : 0);
    if (!data->periodic && (first < 0 || first + 1 >= data->rows)) return NAN;
    pia_draft_row(data, first, &at);
    return data->swing[at] < INFINITY ? pia_draft_row(data, first + 1 - (ends ? 1 : 0), &at) : NAN;
}

/* In the gap, and where `wide` in those beside it, too: to turn a corner takes knots on both sides. */
static filling fill_of(const pia_draft_data *data, pia_index row, int pairs, int wide)
{
    pia_index at;
    double from = pia_draft_row(data, row, &at), to = pia_draft_row(data, row + 1, &at);
    double before = wide ? far_end(data, row, 1) : NAN, behind = wide ? far_end(data, row + 1, 0) : NAN;
    filling f = {.low = from, .high = to, .row = row, .gaps = 1};
    if (before < from) {
        f.row--;
        f.gaps++;
        add_before(&f, before, from, pairs);
        f.low = f.knot[0];
    }
    if (pairs == 0) f.knot[f.count++] = from + (to - from) / 2;
    add_behind(&f, from, to, pairs);
    add_before(&f, from, to, pairs);
    if (behind > to) {
        add_behind(&f, to, behind, pairs);
        f.high = f.knot[f.count - 1];
        f.gaps++;
    }
    return f;
}

/* First knot index of a draft whose knot is more than t. */
static pia_index upper_knot(const pia_draft *draft, double t)
{
    pia_index low = 0, high = draft->count + (draft->cyclic ? 0 : draft->degree + 1);
    while (low < high) {
        pia_index middle = low + (high - low) / 2;
        if (draft->knots[middle] <= t)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

/* Takes over a filling where no knot that is to stay is in its way. */
static int take(pia_draft *draft, const filling *f)
{
    double added[4 * MOST_PAIRS], shift = draft->cyclic ? floor(f->low - draft->knots[0]) : 0;
    pia_index first = upper_knot(draft, f->low - shift), begin, end;
    int inside = 0;
    pia_draft_inside(draft, &begin, &end);
    if (!draft->cyclic && first < begin) return 0;
    for (; pia_draft_knot(draft, first + inside) < f->high - shift; inside++) {
        if (!draft->cyclic && first + inside >= end) return 0;
        if (draft->mark[(first + inside) % draft->count] & PIA_DRAFT_KEPT) return 0;
    }
    for (int k = 0; k < f->count; k++) added[k] = f->knot[k] - shift;
    return (draft->cyclic || first + inside <= end) && f->count >= inside &&
           pia_draft_fill(draft, f->row, f->gaps, first, inside, added, f->count, REACH, ROUNDS);
}

static int fill(pia_draft *draft, pia_index row)
{
    for (int pairs = 0; pairs <= MOST_PAIRS; pairs++)
        for (int wide = 0; wide <= (pairs > 0); wide++) {
            filling f = fill_of(draft->data, row, pairs, wide);
            if ((wide == 0 || f.gaps > 1) && take(draft, &f)) return 1;
        }
    return 0;
}

pia_index pia_refine_hold(pia_draft *draft, const double *wanted)
{
    const pia_draft_data *data = draft->data;
    pia_index before = draft->count, at, next;
    double low = draft->knots[draft->cyclic ? 0 : draft->stays[0]];
    double high = draft->cyclic ? low + 1 : draft->knots[draft->count + draft->degree - draft->stays[1]];
    pia_index row = pia_draft_lower_row(data, low), end = draft->cyclic ? row + data->rows : pia_draft_lower_row(data, high);
    for (; row < end && draft->count + 4 * MOST_PAIRS <= draft->room; row++) {
        pia_draft_row(data, row, &at);
        if (!(data->swing[at] > wanted[at]) || (!data->periodic && row + 1 >= data->rows)) continue;
        double to = pia_draft_row(data, row + 1, &next), now = data->swing[at];
        if (to > high && !draft->cyclic) continue;
        int held = 0;
        for (double swing = wanted[at]; swing < now && !held; swing *= EASIER) {
            pia_draft_let_swing(data, at, swing);
            held = fill(draft, row);
        }
        if (!held) pia_draft_let_swing(data, at, now);
    }
    return draft->count - before;
}

pia_status pia_refine_find_gaps(const pia_fit *fit, pia_draft_data *data, double **wanted)
{
    const double *full = pia_op_full(fit->op, fit->iterate.points, fit->dim);
    pia_index span = fit->degree[0], wide = 0;
    if (!(fit->options.between > 0) || fit->axis_tolerances != NULL) return PIA_OK;
    data->swing = pia_take(fit->context, fit->rows, sizeof(double));
    data->stand = pia_take(fit->context, fit->rows, sizeof(double));
    *wanted = pia_take(fit->context, fit->rows, sizeof(double));
    if (data->swing == NULL || data->stand == NULL || *wanted == NULL) return PIA_E_MEMORY;
    for (pia_index row = 0; row < fit->rows; row++) {
        double far = pia_fit_excursion(fit, full, row, &span);
        (*wanted)[row] = far < 0 ? INFINITY : pia_fit_swing(fit, row, fit->options.between);
        pia_draft_let_swing(data, row, fmax((*wanted)[row], far * SLACK));
        wide += isfinite((*wanted)[row]);
    }
    if (wide == 0) pia_refine_drop_gaps(fit, data, wanted);
    return PIA_OK;
}

void pia_refine_drop_gaps(const pia_fit *fit, pia_draft_data *data, double **wanted)
{
    pia_give(fit->context, data->swing);
    pia_give(fit->context, data->stand);
    pia_give(fit->context, *wanted);
    data->swing = data->stand = *wanted = NULL;
}
