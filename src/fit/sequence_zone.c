/* Local edits: when a data point of a settled fit has moved, its group's owner and the control points beside it follow, and more of
 * them only where one more would move farther than any that does. An iteration then looks at their rows alone. What ends the iteration
 * is measured over all rows, so that the result keeps what a fit of the whole would keep. */
#include "sequence.h"

#include <math.h>
#include <string.h>

enum { NEIGHBOURS = 4 };

/* The first chosen line at or behind `line`. */
static pia_index chosen_from(const pia_fit *fit, int d, pia_index line)
{
    const pia_index *chosen = fit->sequence->chosen[d];
    pia_index low = 0, high = fit->full[d];
    while (low < high) {
        pia_index middle = low + (high - low) / 2;
        if (chosen[middle] < line)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

static pia_index limited(pia_index value, pia_index low, pia_index high)
{
    return value < low ? low : value > high ? high : value;
}

/* The zone reaches at least from control point `low` to `high` of a direction. */
static void reach(pia_fit *fit, int d, pia_index low, pia_index high)
{
    const pia_sequence *s = fit->sequence;
    pia_zone *zone = &fit->sequence->zone;
    pia_index first = s->chosen[d][limited(low, 0, fit->full[d] - 1)], last = s->chosen[d][limited(high, 0, fit->full[d] - 1)];
    if (first < zone->low[d]) zone->low[d] = first;
    if (last > zone->high[d]) zone->high[d] = last;
}

static int is_all(const pia_fit *fit)
{
    const pia_block *c = &fit->sequence->zone.control;
    int all = 1;
    for (int d = 0; d < fit->directions; d++) all &= c->low[d] == 0 && c->high[d] == fit->full[d];
    return all;
}

static void close_part(pia_fit *fit)
{
    pia_part_close(fit->sequence->zone.part);
    fit->sequence->zone.part = fit->iterate.part = NULL;
}

void pia_zone_release(pia_fit *fit)
{
    close_part(fit);
    fit->sequence->zone.open = 0;
    fit->sequence->groups.moving = NULL;
}

void pia_zone_close(pia_fit *fit)
{
    if (fit->sequence == NULL) return;
    pia_zone_release(fit);
    fit->sequence->zone.edits = 0;
}

/* residual: NULL, or that of all rows outside the zone as it is. */
static pia_status bind(pia_fit *fit, const double *residual)
{
    pia_sequence *s = fit->sequence;
    pia_zone *zone = &s->zone;
    close_part(fit);
    zone->control = (pia_block){{0, 0}, {1, 1}};
    for (int d = 0; d < fit->directions; d++) {
        zone->control.low[d] = chosen_from(fit, d, zone->low[d]);
        zone->control.high[d] = chosen_from(fit, d, zone->high[d] + 1);
    }
    if (is_all(fit)) {
        pia_zone_release(fit);
        return PIA_OK;
    }
    s->groups.moving = &zone->control;
    pia_status status = pia_part_open(fit->op, &fit->iterate.targets, &zone->control, residual, &zone->part);
    fit->iterate.part = zone->part;
    return status;
}

pia_status pia_zone_bind(pia_fit *fit)
{
    return fit->sequence->zone.open ? bind(fit, NULL) : PIA_OK;
}

/* ---- an edit ---- */

static int is_settled(const pia_fit *fit)
{
    pia_stop stop = fit->solve.stop;
    return stop == PIA_STOP_TOLERANCE || stop == PIA_STOP_CHANGE || stop == PIA_STOP_STALLED;
}

pia_status pia_zone_edit(pia_fit *fit, pia_index row)
{
    pia_sequence *s = fit->sequence;
    pia_zone *zone = &s->zone;
    s->last_error = NAN;
    if (is_settled(fit)) {
        close_part(fit);
        *zone = (pia_zone){.open = 1, .low = {s->lines[0], s->lines[1]}, .high = {-1, -1}};
    }
    if (!zone->open) return PIA_OK;
    for (int d = 0; d < fit->directions; d++) {
        pia_index owner = pia_epia_owner(fit, d, pia_sequence_line(fit, row, d));
        reach(fit, d, owner - NEIGHBOURS, owner + NEIGHBOURS);
    }
    zone->edits++;
    zone->read += fit->rows;
    return bind(fit, NULL);
}

/* ---- as the loop goes on ---- */

static pia_index moving_controls(const pia_fit *fit)
{
    const pia_zone *zone = &fit->sequence->zone;
    pia_index count = 1;
    if (!zone->open) return fit->op->cols;
    for (int d = 0; d < 2; d++) count *= zone->control.high[d] - zone->control.low[d];
    return count;
}

static void count_update(pia_fit *fit)
{
    pia_zone *zone = &fit->sequence->zone;
    pia_index moving = moving_controls(fit);
    if (zone->edits == 0) return;
    zone->updates++;
    zone->read += zone->open ? zone->part->rows : fit->rows;
    if (moving > zone->followed) zone->followed = moving;
}

/* The zone and degree + 1 control points on every side. */
static pia_block surroundings(const pia_fit *fit)
{
    pia_block around = fit->sequence->zone.control;
    for (int d = 0; d < fit->directions; d++) {
        around.low[d] = limited(around.low[d] - fit->degree[d] - 1, 0, fit->full[d]);
        around.high[d] = limited(around.high[d] + fit->degree[d] + 1, 0, fit->full[d]);
    }
    return around;
}

static pia_status widen(pia_fit *fit, const pia_block *around)
{
    for (int d = 0; d < fit->directions; d++) reach(fit, d, around->low[d], around->high[d] - 1);
    return bind(fit, fit->iterate.residual);
}

pia_status pia_zone_update(pia_fit *fit, double moved, int *wider)
{
    const pia_sequence *s = fit->sequence;
    *wider = 0;
    count_update(fit);
    if (!s->zone.open) return PIA_OK;
    pia_block around = surroundings(fit);
    double most = pia_groups_longest(&s->groups, fit->iterate.residual, fit->dim, &around);
    *wider = most > fmax(moved, fit->solve.rules.tolerance);
    return *wider ? widen(fit, &around) : PIA_OK;
}

static int owns(const pia_fit *fit, const pia_block *box, pia_index row)
{
    int inside = 1;
    for (int d = 0; d < fit->directions; d++) {
        pia_index owner = pia_epia_owner(fit, d, pia_sequence_line(fit, row, d));
        inside &= owner >= box->low[d] && owner < box->high[d];
    }
    return inside;
}

int pia_zone_owns(const pia_fit *fit, pia_index row)
{
    return !fit->sequence->zone.open || owns(fit, &fit->sequence->zone.control, row);
}

pia_status pia_zone_settle(pia_fit *fit, int *settled)
{
    pia_index row = fit->iterate.errors.max_row;
    *settled = pia_zone_owns(fit, row);
    if (*settled) return PIA_OK;
    pia_block around = surroundings(fit);
    if (owns(fit, &around, row)) return widen(fit, &around);
    pia_zone_release(fit);
    return PIA_OK;
}

void pia_zone_reach_added(pia_fit *fit)
{
    const pia_sequence *s = fit->sequence;
    for (int d = 0; d < fit->directions && s->zone.open; d++)
        for (pia_index line = 0; line < s->lines[d]; line++) {
            if (s->mark[d][line] != PIA_LINE_ADDED) continue;
            pia_index owner = pia_epia_owner(fit, d, line);
            reach(fit, d, owner - fit->degree[d] - 1, owner + fit->degree[d] + 1);
        }
}

void pia_zone_numbers(const pia_fit *fit, pia_index *numbers)
{
    const pia_zone *z = &fit->sequence->zone;
    const pia_index now[PIA_ZONE_NUMBERS] = {z->open,  z->low[0],  z->low[1],   z->high[0], z->high[1],
                                             z->edits, z->updates, z->followed, z->read};
    memcpy(numbers, now, sizeof now);
}

/* Lines are kept inside the data whatever the numbers say. */
void pia_zone_restore(pia_fit *fit, const pia_index *numbers)
{
    const pia_sequence *s = fit->sequence;
    pia_zone *z = &fit->sequence->zone;
    *z = (pia_zone){.open = numbers[0] != 0, .edits = numbers[5], .updates = numbers[6], .followed = numbers[7], .read = numbers[8]};
    for (int d = 0; d < fit->directions; d++) {
        z->low[d] = limited(numbers[1 + d], 0, s->lines[d] - 1);
        z->high[d] = limited(numbers[3 + d], z->low[d], s->lines[d] - 1);
    }
}

void pia_zone_outcome(pia_fit *fit)
{
    const pia_zone *zone = &fit->sequence->zone;
    if (zone->edits == 0) return;
    pia_note_add(pia_memory_of(fit->context), &fit->outcome,
                 "epia: %lld moved points: %lld iterations moved up to %lld of %lld control points and looked at %lld rows, where all "
                 "would have been %lld",
                 (long long)zone->edits, (long long)zone->updates, (long long)zone->followed, (long long)fit->op->cols,
                 (long long)zone->read, (long long)(zone->updates + 1) * (long long)fit->rows);
}
