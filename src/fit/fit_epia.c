/* The incremental algorithm of [2011], Algorithm 1, around the loop: groups for every operator, the validity check before it begins, a
 * control parameter more where it stalls. The iteration itself is method epia. */
#include "epia.h"
#include "sequence.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* ---- knot insertion ---- */

static double threshold(const pia_fit *fit)
{
    const pia_values *v = &fit->method_values;
    return v->is_word[PIA_EPIA_THRESHOLD] ? fit->solve.rules.tolerance / 2 : v->number[PIA_EPIA_THRESHOLD];
}

/* The loop goes on with the knots just inserted: its count and the last step stay. */
static pia_status go_on(pia_fit *fit, double moved)
{
    pia_solve *solve = &fit->solve;
    pia_index first = solve->first_iteration;
    pia_status status = pia_fit_bind(fit);
    if (status == PIA_OK) status = pia_solve_restart(solve, &fit->method_values, &fit->limiter_values);
    solve->first_iteration = first;
    fit->iterate.adjust_max = moved;
    return status;
}

/* The worst rows get control points of their own. */
static pia_status grow(pia_fit *fit, double moved)
{
    pia_sequence *s = fit->sequence;
    pia_index picked;
    int settled;
    pia_status status = pia_zone_settle(fit, &settled);
    if (status != PIA_OK || !settled) return status;
    status = pia_sequence_pick(fit, (pia_index)fit->method_values.number[PIA_EPIA_INSERT], &picked);
    if (status != PIA_OK) return status;
    if (picked == 0 && s->zone.open) {
        pia_zone_release(fit);
        return PIA_OK;
    }
    if (picked == 0) { /* every line has its control point: from here on this is PIA, which ends by itself */
        s->grows = 0;
        fit->solve.rules.change = fmax(fit->solve.rules.change, PIA_FIT_CHANGE * fit->extent);
        return PIA_OK;
    }
    pia_zone_reach_added(fit);
    fit->round++;
    status = pia_sequence_grow(fit, 1);
    return status == PIA_OK ? go_on(fit, moved) : status;
}

static pia_status revise(pia_iterate *iterate)
{
    pia_fit *fit = iterate->owner;
    pia_sequence *s = fit->sequence;
    double error = iterate->errors.max, before = s->last_error, moved = iterate->adjust_max;
    int wider;
    s->last_error = error;
    pia_status status = pia_zone_update(fit, moved, &wider);
    if (status != PIA_OK || wider) return status;
    int settled = moved < threshold(fit) || error > before;
    return s->grows && fit->solve.rules.tolerance > 0 && settled ? grow(fit, moved) : PIA_OK;
}

pia_status pia_epia_step(pia_fit *fit, pia_index iterations)
{
    pia_solve *solve = &fit->solve;
    pia_index done = fit->iterate.iteration;
    pia_status status = pia_solve_step(solve, iterations);
    if (status != PIA_OK || solve->stop != PIA_STOP_CHANGE || !fit->sequence->zone.open) return status;
    pia_zone_release(fit);
    solve->stop = PIA_STOP_NONE;
    return pia_solve_step(solve, iterations - (fit->iterate.iteration - done));
}

/* ---- groups ---- */

static void group_lines(pia_fit *fit)
{
    pia_sequence *s = fit->sequence;
    pia_fence_rule rule = fit->method_values.number[PIA_EPIA_FENCE] == 0 ? PIA_FENCE_PRINTED : PIA_FENCE_BALANCED;
    for (int d = 0; d < fit->directions; d++) {
        pia_fence_place(rule, s->parameter[d], s->curvature[d], s->lines[d], s->chosen[d], fit->full[d], s->first[d]);
        pia_fence_groups(s->first[d], s->chosen[d], fit->full[d], s->own[d], s->begin[d], s->end[d]);
    }
}

static pia_index nearest_control(const pia_sequence *s, int d, pia_index control, double t)
{
    pia_index a = 0, b = control - 1;
    while (a < b) {
        pia_index middle = a + (b - a) / 2;
        double between = s->parameter[d][s->chosen[d][middle]] / 2 + s->parameter[d][s->chosen[d][middle + 1]] / 2;
        if (t < between)
            b = middle;
        else
            a = middle + 1;
    }
    return a;
}

pia_index pia_epia_owner(const pia_fit *fit, int d, pia_index line)
{
    const pia_sequence *s = fit->sequence;
    pia_index a = 0, b = fit->full[d] - 1;
    if (fit->kind == PIA_SCATTERED) return nearest_control(s, d, fit->full[d], s->parameter[d][line]);
    while (a < b) {
        pia_index middle = a + (b - a) / 2;
        if (line < s->first[d][middle + 1])
            b = middle;
        else
            a = middle + 1;
    }
    return a;
}

static pia_index group_of(const pia_fit *fit, pia_index row)
{
    const double *t = fit->parameter[0] + 2 * row;
    return nearest_control(fit->sequence, 0, fit->full[0], t[0]) * fit->full[1] + nearest_control(fit->sequence, 1, fit->full[1], t[1]);
}

/* Scattered rows go to the nearest control parameter in each direction; sorted by group, in the order of the data within one. */
static pia_status group_scattered(pia_fit *fit)
{
    pia_sequence *s = fit->sequence;
    pia_index groups = fit->op->cols;
    pia_give(fit->context, s->start);
    pia_give(fit->context, s->row);
    s->start = pia_take_zero(fit->context, groups + 2, sizeof *s->start);
    s->row = pia_take(fit->context, fit->rows, sizeof *s->row);
    if (s->start == NULL || s->row == NULL) return PIA_E_MEMORY;
    for (pia_index row = 0; row < fit->rows; row++) s->start[group_of(fit, row) + 2]++;
    for (pia_index c = 0; c < groups; c++) s->start[c + 2] += s->start[c + 1];
    for (pia_index row = 0; row < fit->rows; row++) s->row[s->start[group_of(fit, row) + 1]++] = row;
    return PIA_OK;
}

pia_status pia_epia_group(pia_fit *fit)
{
    static const pia_index zero = 0, one = 1; /* the only group of a curve's second direction */
    pia_sequence *s = fit->sequence;
    pia_status status = PIA_OK;
    s->groups = (pia_groups){.rows = fit->rows, .lines = fit->count[1]};
    for (int d = 0; d < 2; d++) {
        s->groups.count[d] = fit->op->count[d];
        s->groups.begin[d] = d < fit->directions ? s->begin[d] : &zero;
        s->groups.end[d] = d < fit->directions ? s->end[d] : &one;
    }
    if (fit->kind == PIA_SCATTERED)
        status = group_scattered(fit);
    else
        group_lines(fit);
    s->groups.start = s->start;
    s->groups.row = s->row;
    fit->iterate.groups = &s->groups;
    fit->solve.revise = revise;
    return status == PIA_OK ? pia_zone_bind(fit) : status;
}

/* ---- the start of scattered points ---- */

/* Adds the control points beside c that are known to the sum; returns how many. */
static int add_neighbours(const pia_fit *fit, const unsigned char *known, pia_index c, double *sum)
{
    pia_index across = fit->op->count[1], column = c % across;
    const pia_index beside[4] = {c - across, c + across, column > 0 ? c - 1 : -1, column + 1 < across ? c + 1 : -1};
    int found = 0;
    for (int k = 0; k < 4; k++) {
        if (beside[k] < 0 || beside[k] >= fit->op->cols || !known[beside[k]]) continue;
        found++;
        for (int d = 0; d < fit->dim; d++) sum[d] += fit->iterate.points[beside[k] * fit->dim + d];
    }
    return found;
}

/* Control points without data take the mean of their neighbours, from those with data outwards. */
static pia_status fill_empty(pia_fit *fit)
{
    const pia_groups *groups = fit->iterate.groups;
    unsigned char *known = pia_take(fit->context, fit->op->cols, 1);
    pia_index left = pia_groups_empty(groups);
    if (known == NULL) return PIA_E_MEMORY;
    for (pia_index c = 0; c < fit->op->cols; c++) known[c] = groups->start[c + 1] > groups->start[c];
    while (left > 0)
        for (pia_index c = 0; c < fit->op->cols; c++) {
            double sum[PIA_MAX_DIM] = {0};
            int found = known[c] ? 0 : add_neighbours(fit, known, c, sum);
            if (found == 0) continue;
            for (int d = 0; d < fit->dim; d++) fit->iterate.points[c * fit->dim + d] = sum[d] / found;
            known[c] = 1;
            left--;
        }
    pia_give(fit->context, known);
    return PIA_OK;
}

pia_status pia_epia_start(pia_fit *fit)
{
    pia_iterate *iterate = &fit->iterate;
    memset(iterate->points, 0, (size_t)(fit->op->cols * fit->dim) * sizeof(double));
    iterate->errors_known = 0;
    pia_iterate_measure(iterate);
    pia_groups_mean(fit->context, iterate->groups, iterate->residual, fit->dim, 1, iterate->points);
    iterate->errors_known = 0;
    return fill_empty(fit);
}

/* ---- the validity check ---- */

/* Adds the two markers of a group of direction d, where these are lines of their own (see fence.h). Returns how many. */
static pia_index add_markers(pia_sequence *s, int d, pia_index group)
{
    pia_index added = 0;
    for (pia_index k = group; k <= group + 1; k++) {
        pia_index line = s->first[d][k];
        if (k == 0 || line == s->lines[d] || s->mark[d][line] != PIA_LINE_FREE) continue;
        s->mark[d][line] = PIA_LINE_ADDED;
        added++;
    }
    return added;
}

/* Counts the invalid groups and adds their markers. */
static pia_status check_groups(pia_fit *fit, pia_index *invalid, pia_index *added)
{
    pia_sequence *s = fit->sequence;
    pia_index groups = fit->op->cols;
    double *agreement = pia_take(fit->context, groups, sizeof *agreement), eta = fit->method_values.number[PIA_EPIA_ETA];
    if (agreement == NULL) return PIA_E_MEMORY;
    pia_iterate_measure(&fit->iterate);
    pia_groups_agreement(fit->context, &s->groups, fit->iterate.residual, fit->dim, agreement);
    *invalid = *added = 0;
    for (pia_index c = 0; c < groups; c++) {
        if (agreement[c] > eta) continue;
        ++*invalid;
        *added += add_markers(s, 0, c / fit->op->count[1]);
        if (fit->directions == 2) *added += add_markers(s, 1, c % fit->op->count[1]);
    }
    pia_give(fit->context, agreement);
    return PIA_OK;
}

static void remove_added(pia_sequence *s)
{
    for (int d = 0; d < 2; d++)
        for (pia_index i = 0; i < s->lines[d]; i++)
            if (s->mark[d][i] == PIA_LINE_ADDED) s->mark[d][i] = PIA_LINE_FREE;
}

/* The first few invalid groups, for the note. */
static pia_status note_invalid(pia_fit *fit, pia_index invalid)
{
    enum { LISTED = 12 };
    char list[LISTED * 24] = "";
    size_t used = 0;
    pia_index groups = fit->op->cols, listed = 0;
    double *agreement = pia_take(fit->context, groups, sizeof *agreement), eta = fit->method_values.number[PIA_EPIA_ETA];
    if (agreement == NULL) return PIA_E_MEMORY;
    pia_groups_agreement(fit->context, &fit->sequence->groups, fit->iterate.residual, fit->dim, agreement);
    for (pia_index c = 0; c < groups && listed < LISTED; c++) {
        if (agreement[c] > eta) continue;
        used += (size_t)snprintf(list + used, sizeof list - used, "%s%lld", listed++ > 0 ? ", " : "", (long long)c);
    }
    pia_give(fit->context, agreement);
    pia_fit_note_add(fit, "epia: %lld groups are still invalid after the validity check: %s%s", (long long)invalid, list,
                     invalid > listed ? ", ..." : "");
    return PIA_OK;
}

static pia_index most_rounds(const pia_fit *fit)
{
    if (!fit->method_values.is_word[PIA_EPIA_ROUNDS]) return (pia_index)fit->method_values.number[PIA_EPIA_ROUNDS];
    return fit->kind == PIA_CURVE ? 100 : 1;
}

pia_status pia_epia_validate(pia_fit *fit)
{
    pia_sequence *s = fit->sequence;
    pia_index invalid, added, rounds = 0, before = fit->op->cols, most = most_rounds(fit);
    if (!s->validated) return PIA_OK;
    pia_status status = check_groups(fit, &invalid, &added);
    while (status == PIA_OK && added > 0 && rounds < most) {
        status = pia_sequence_grow(fit, 0);
        if (status == PIA_OK) status = pia_fit_initial(fit);
        if (status == PIA_OK) status = check_groups(fit, &invalid, &added);
        rounds++;
    }
    remove_added(s);
    if (status != PIA_OK) return status;
    pia_fit_note_add(fit, "epia: %lld control points at dominant points, %lld after %lld rounds of the validity check",
                     (long long)before, (long long)fit->op->cols, (long long)rounds);
    return invalid > 0 ? note_invalid(fit, invalid) : PIA_OK;
}

void pia_epia_outcome(pia_fit *fit)
{
    const pia_memory *memory = pia_memory_of(fit->context);
    const pia_iterate *iterate = &fit->iterate;
    pia_index empty = pia_groups_empty(iterate->groups);
    pia_note_add(
        memory, &fit->outcome, "epia: %lld rounds of knot insertion, %lld control points after %lld iterations; e_c %.6g, e_d %.6g",
        (long long)fit->round, (long long)fit->op->cols, (long long)iterate->iteration, iterate->adjust_max, iterate->errors.max);
    if (empty > 0)
        pia_note_add(memory, &fit->outcome, "epia: %lld control points have no data in their group and did not move", (long long)empty);
    pia_zone_outcome(fit);
}
