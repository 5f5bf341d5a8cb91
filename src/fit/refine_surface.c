/* A surface to a tolerance. Grow: the strips of spans that deviate too much are split in one direction or the other, whichever takes
 * more of the error away for the control points it costs. Spare: knot lines are taken away as long as the tolerance holds. Where true
 * distances count, a grid goes through that twice: at the parameters of its lines, then with foot points. */
#include "refine.h"

#include <math.h>
#include <string.h>

enum { MAX_GROWTH = 60, MAX_CYCLES = 3, MAX_FEET = 20 };

/* A strip is split when it deviates at least this share of what the worst one does. */
static const double SHARE = 0.25;

typedef struct strip {
    double worst;    /* largest ratio */
    pia_index lines; /* grid: data lines; scattered: data rows */
} strip;

static pia_index strip_at(const pia_fit *fit, int d, double t)
{
    const double *inside = pia_refine_inside(fit, d);
    pia_index low = 0, high = pia_refine_inside_count(fit, d);
    while (low < high) {
        pia_index middle = low + (high - low) / 2;
        if (inside[middle] <= t)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

static void look_at_strips(const pia_fit *fit, int d, strip *strips)
{
    memset(strips, 0, (size_t)(pia_refine_inside_count(fit, d) + 1) * sizeof *strips);
    for (pia_index row = 0; row < fit->rows; row++) {
        strip *s = &strips[strip_at(fit, d, pia_refine_parameter(fit, d, row))];
        s->worst = fmax(s->worst, pia_refine_worst(fit, row, row + 1));
        s->lines += fit->kind == PIA_SCATTERED;
    }
    for (pia_index line = 0; fit->kind != PIA_SCATTERED && line < fit->count[d]; line++)
        strips[strip_at(fit, d, fit->parameter[d][line])].lines++;
}

/* Where a strip is to be split: between two data lines of a grid, in the middle of a strip of scattered rows. */
static double split_of(const pia_fit *fit, int d, double low, double high)
{
    double middle = low + (high - low) / 2;
    if (fit->kind == PIA_SCATTERED) return middle;
    const double *t = fit->parameter[d];
    pia_index after = 0, first = 0;
    while (first < fit->count[d] && t[first] < low) first++;
    for (after = first; after < fit->count[d] && t[after] < middle;) after++;
    if (after == first) after++;
    return after < fit->count[d] && t[after] < high ? t[after - 1] + (t[after] - t[after - 1]) / 2 : middle;
}

/* Knots with one more in each strip that deviates too much. Returns how many are new. */
static pia_index split_strips(const pia_fit *fit, int d, const strip *strips, double *out, pia_index *count)
{
    const double *inside = pia_refine_inside(fit, d);
    pia_index old = pia_refine_inside_count(fit, d), added = 0, n = 0,
              least = fit->kind == PIA_SCATTERED ? 4 * (fit->degree[d] + 1) : 2;
    double low = fit->knots[d][fit->degree[d]], high = fit->knots[d][fit->full[d]], limit = 1;
    for (pia_index s = 0; s <= old; s++) limit = fmax(limit, SHARE * strips[s].worst);
    for (pia_index s = 0; s <= old; s++) {
        double left = s > 0 ? inside[s - 1] : low, right = s < old ? inside[s] : high;
        double knot = split_of(fit, d, left, right);
        if (strips[s].worst > limit && strips[s].lines >= least && knot > left && knot < right) {
            out[n++] = knot;
            added++;
        }
        if (s < old) out[n++] = right;
    }
    *count = n;
    return added;
}

/* Whether the data can hold so many knots inside in a direction: no more lines than a grid has, no more control points than there are
 * scattered rows. */
static int can_hold(const pia_fit *fit, int d, pia_index inside)
{
    pia_index lines = inside + (fit->closed[d] ? 1 : fit->degree[d] + 1);
    return fit->kind == PIA_SCATTERED ? lines <= fit->rows / fit->op->count[1 - d] : lines <= fit->count[d];
}

static pia_status split(pia_fit *fit, int d, int *possible)
{
    pia_index old = pia_refine_inside_count(fit, d), count;
    double *inside = pia_take(fit->context, 2 * old + 1, sizeof *inside);
    strip *strips = pia_take(fit->context, old + 1, sizeof *strips);
    pia_status status = inside != NULL && strips != NULL ? PIA_OK : PIA_E_MEMORY;
    *possible = 0;
    if (status == PIA_OK) {
        look_at_strips(fit, d, strips);
        *possible = split_strips(fit, d, strips, inside, &count) > 0 && can_hold(fit, d, count);
        if (*possible) status = pia_refine_refit(fit, d, inside, count);
    }
    pia_give(fit->context, inside);
    pia_give(fit->context, strips);
    return status;
}

/* How fast the squared error falls with the number of control points. */
static double gain_of(const pia_fit *fit, double before, pia_index controls)
{
    double after = fit->iterate.errors.sum_squares;
    return log(before / fmax(after, 1e-300)) / log((double)fit->op->cols / (double)controls);
}

static pia_status grow(pia_fit *fit, int *possible)
{
    pia_saved start, first = {.points = NULL};
    double gain[2] = {0, 0}, before = fit->iterate.errors.sum_squares;
    pia_index controls = fit->op->cols;
    int can[2] = {0, 0};
    pia_status status = pia_refine_save(fit, &start);
    if (status != PIA_OK) return status;
    status = split(fit, 0, &can[0]);
    if (status == PIA_OK && can[0]) {
        gain[0] = gain_of(fit, before, controls);
        status = pia_refine_save(fit, &first);
        if (status == PIA_OK) status = pia_refine_go_back(fit, &start);
    }
    if (status == PIA_OK) status = split(fit, 1, &can[1]);
    if (status == PIA_OK && can[1]) gain[1] = gain_of(fit, before, controls);
    if (status == PIA_OK && can[0] && (!can[1] || gain[0] > gain[1])) status = pia_refine_go_back(fit, &first);
    *possible = can[0] || can[1];
    pia_refine_drop(fit, &start);
    pia_refine_drop(fit, &first);
    return status;
}

static pia_status grow_and_spare(pia_fit *fit)
{
    pia_status status = fit->round == 0 ? pia_refine_solve(fit) : PIA_OK;
    if (status == PIA_OK && fit->round == 0 && fit->solve.rules.trace_every > 0) status = pia_solve_trace(&fit->solve);
    if (status == PIA_OK) status = pia_refine_look_for_sheets(fit);
    if (status != PIA_OK || fit->solve.stop != PIA_STOP_NONE) return status;
    pia_stage *stage = &fit->stage;
    int more = pia_refine_helps(fit);
    for (int k = 0; k < MAX_GROWTH && status == PIA_OK && more && !pia_refine_reached(fit) && !pia_refine_stopped(fit); k++) {
        status = grow(fit, &more);
        if (status == PIA_OK && more) status = pia_refine_move_to_feet(fit);
        if (status == PIA_OK) status = pia_refine_relax(fit);
        if (status == PIA_OK && more) status = pia_refine_count(fit);
        if (status == PIA_OK && more) pia_refine_watch(fit);
        more = more && pia_refine_helps(fit);
    }
    for (int k = 0; k < MAX_FEET && status == PIA_OK && stage->feet && !pia_refine_reached(fit) && !pia_refine_stopped(fit); k++)
        status = pia_refine_move_to_feet(fit);
    if (status == PIA_OK && !pia_refine_reached(fit) && !pia_refine_stopped(fit)) status = pia_refine_interpolate(fit);
    int kept = status == PIA_OK && pia_refine_reached(fit);
    while (kept && stage->sparing < MAX_CYCLES && stage->spares && status == PIA_OK && !pia_refine_stopped(fit)) {
        pia_index spared;
        status = pia_refine_spare_lines(fit, &spared);
        stage->sparing++;
        stage->spares = spared > 0;
        if (status == PIA_OK) status = pia_refine_move_to_feet(fit);
        if (status == PIA_OK) status = pia_refine_count(fit);
    }
    return status;
}

pia_status pia_refine_surface(pia_fit *fit)
{
    pia_status status = grow_and_spare(fit);
    if (status != PIA_OK || fit->kind != PIA_GRID || !fit->options.measure_distance || pia_refine_stopped(fit)) return status;
    status = pia_refine_scatter(fit);
    return status == PIA_OK ? grow_and_spare(fit) : status;
}
