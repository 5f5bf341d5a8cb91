#include "sequence.h"

#include "discrete_curvature.h"
#include "dominant.h"
#include "epia.h"
#include "knots.h"
#include "model.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { SMOOTH = 3 }; /* where no method says otherwise */
static const double SHARE = 0.03;

static int take_arrays(pia_fit *fit, pia_sequence *s, int d)
{
    pia_index lines = s->lines[d];
    s->curvature[d] = pia_take_zero(fit->context, lines, sizeof(double));
    s->mark[d] = pia_take_zero(fit->context, lines, 1);
    s->own[d] = pia_take_zero(fit->context, lines, 1);
    s->chosen[d] = pia_take(fit->context, lines, sizeof(pia_index));
    s->first[d] = pia_take(fit->context, lines + 1, sizeof(pia_index));
    s->begin[d] = pia_take(fit->context, lines + 1, sizeof(pia_index));
    s->end[d] = pia_take(fit->context, lines + 1, sizeof(pia_index));
    return s->curvature[d] != NULL && s->mark[d] != NULL && s->own[d] != NULL && s->chosen[d] != NULL && s->first[d] != NULL &&
           s->begin[d] != NULL && s->end[d] != NULL;
}

static int compare_doubles(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* The different parameters of scattered points in one direction, sorted. */
static pia_status take_distinct(pia_fit *fit, pia_sequence *s, int d)
{
    double *t = s->distinct[d] = pia_take(fit->context, fit->rows, sizeof *t);
    if (t == NULL) return PIA_E_MEMORY;
    for (pia_index i = 0; i < fit->rows; i++) t[i] = fit->parameter[0][2 * i + d];
    qsort(t, (size_t)fit->rows, sizeof *t, compare_doubles);
    pia_index kept = 1;
    for (pia_index i = 1; i < fit->rows; i++)
        if (t[i] > t[kept - 1]) t[kept++] = t[i];
    s->lines[d] = kept;
    s->parameter[d] = t;
    return PIA_OK;
}

/* A function graph bends as its picture does: the abscissa, scaled to the extent of the values, goes first. */
static pia_status graph_curvature(pia_fit *fit, pia_index most, double *curvature)
{
    int dim = fit->dim + 1;
    const double *t = fit->parameter[0];
    double *points = pia_take(fit->context, fit->rows, (size_t)dim * sizeof *points);
    if (points == NULL) return PIA_E_MEMORY;
    for (pia_index i = 0; i < fit->rows; i++) {
        points[i * dim] = (t[i] - t[0]) / (t[fit->rows - 1] - t[0]) * fit->extent;
        memcpy(points + i * dim + 1, fit->points + i * fit->dim, (size_t)fit->dim * sizeof *points);
    }
    pia_status status = pia_curvature_of_curve(fit->context, points, fit->rows, dim, most, curvature);
    pia_give(fit->context, points);
    return status;
}

static pia_status measure_curvature(pia_fit *fit, pia_sequence *s)
{
    pia_index most = pia_fit_is_grouped(fit) ? (pia_index)fit->method_values.number[PIA_EPIA_SMOOTH] : SMOOTH;
    if (fit->kind == PIA_SCATTERED) return PIA_OK;
    if (fit->function_graph) return graph_curvature(fit, most, s->curvature[0]);
    if (fit->directions == 1) return pia_curvature_of_curve(fit->context, fit->points, fit->rows, fit->dim, most, s->curvature[0]);
    return pia_curvature_of_grid(fit->context, fit->points, fit->count, fit->dim, most, s->curvature[0], s->curvature[1]);
}

static pia_status check_kind(pia_fit *fit)
{
    const char *what = pia_fit_is_grouped(fit) ? "method epia" : fit->placement->name;
    if (fit->has_holes)
        return pia_fail(fit->context, PIA_E_ARGUMENT,
                        "%s cannot leave out points without a value; use direct, lspia or cg with other knots", what);
    if (fit->closed[0] || (fit->directions == 2 && fit->closed[1]))
        return pia_fail(fit->context, PIA_E_ARGUMENT,
                        "%s is made for open directions; leave out --closed (both ends are met), or use pia, lspia or direct", what);
    return PIA_OK;
}

pia_status pia_sequence_open(pia_fit *fit)
{
    pia_status status = check_kind(fit);
    if (status != PIA_OK) return status;
    pia_sequence *s = fit->sequence = pia_take_zero(fit->context, 1, sizeof *s);
    if (s == NULL) return PIA_E_MEMORY;
    s->last_error = NAN;
    s->grows = fit->options.knots[0] == NULL && fit->options.control[0] == PIA_AUTO && fit->options.control[1] == PIA_AUTO;
    s->validated = s->grows && fit->options.start == NULL && fit->placement != NULL && fit->placement->by_curvature;
    for (int d = 0; d < fit->directions && status == PIA_OK; d++) {
        s->lines[d] = fit->count[d];
        s->parameter[d] = fit->parameter[d];
        if (fit->kind == PIA_SCATTERED) status = take_distinct(fit, s, d);
        if (status == PIA_OK && !take_arrays(fit, s, d)) status = PIA_E_MEMORY;
    }
    return status == PIA_OK ? measure_curvature(fit, s) : status;
}

void pia_sequence_close(pia_fit *fit)
{
    pia_sequence *s = fit->sequence;
    if (s == NULL) return;
    pia_zone_close(fit);
    for (int d = 0; d < 2; d++) {
        void *blocks[] = {s->distinct[d], s->curvature[d], s->mark[d], s->own[d], s->chosen[d], s->first[d], s->begin[d], s->end[d]};
        for (size_t k = 0; k < sizeof blocks / sizeof *blocks; k++) pia_give(fit->context, blocks[k]);
    }
    pia_give(fit->context, s->start);
    pia_give(fit->context, s->row);
    pia_give(fit->context, s);
    fit->sequence = NULL;
}

/* ---- choosing ---- */

/* Lines that are groups of their own: those of the rows to be met, and the ends unless they are free. */
static pia_status choose_own(pia_fit *fit)
{
    pia_sequence *s = fit->sequence;
    if (!pia_fit_is_grouped(fit)) return PIA_OK;
    if (fit->kind == PIA_SCATTERED && fit->options.interpolate_count > 0)
        return pia_fail(fit->context, PIA_E_ARGUMENT, "method epia meets chosen points of curves and grids only; use clspia or direct");
    for (int d = 0; d < fit->directions && fit->method_values.number[PIA_EPIA_ENDS] == 0 && fit->kind != PIA_SCATTERED; d++)
        s->own[d][0] = s->own[d][s->lines[d] - 1] = 1;
    for (pia_index i = 0; i < fit->options.interpolate_count; i++) {
        pia_index row = pia_fit_row(fit, fit->options.interpolate[i]);
        if (row < 0)
            return pia_fail(fit->context, PIA_E_ARGUMENT, "there is no data row %lld to be met; there are rows 0 to %lld",
                            (long long)fit->options.interpolate[i], (long long)fit->given - 1);
        pia_index line[2] = {row / fit->count[1], row % fit->count[1]};
        for (int d = 0; d < fit->directions; d++) s->own[d][line[d]] = 1;
    }
    return PIA_OK;
}

static pia_status choose_lines(pia_fit *fit, int d)
{
    pia_sequence *s = fit->sequence;
    double share = pia_fit_is_grouped(fit) ? fit->method_values.number[PIA_EPIA_DOMINANT] : SHARE;
    pia_index lines = s->lines[d], asked = fit->options.control[d], least = fit->degree[d] + 1;
    for (pia_index i = 0; i < lines; i++) s->mark[d][i] = s->own[d][i] ? PIA_LINE_CHOSEN : PIA_LINE_FREE;
    pia_index marked = pia_dominant_mark(s->curvature[d], lines, share, s->mark[d]);
    pia_index wanted = asked != PIA_AUTO ? asked : marked > least ? marked : least;
    pia_status status = pia_fit_check_control(fit, d, wanted);
    if (status == PIA_OK) status = pia_dominant_thin(fit->context, s->curvature[d], lines, wanted, s->own[d], s->mark[d]);
    if (status == PIA_OK && pia_dominant_fill(s->parameter[d], lines, wanted, s->mark[d]) != wanted)
        return pia_fail(fit->context, PIA_E_ARGUMENT, "%lld control points in %c are fewer than the points to be met; ask for more",
                        (long long)wanted, 'u' + d);
    return status;
}

pia_status pia_sequence_choose(pia_fit *fit)
{
    pia_status status = choose_own(fit);
    for (int d = 0; d < fit->directions && status == PIA_OK; d++) status = choose_lines(fit, d);
    return status;
}

static pia_index nearest_line(const pia_sequence *s, int d, double t, pia_index low, pia_index high)
{
    pia_index a = low, b = high;
    while (a < b) {
        pia_index middle = a + (b - a) / 2;
        if (s->parameter[d][middle] < t)
            a = middle + 1;
        else
            b = middle;
    }
    return a > low && t - s->parameter[d][a - 1] < s->parameter[d][a] - t ? a - 1 : a;
}

/* Lines of a group of their own that are not yet chosen take the place of the nearest chosen one. */
static void move_to_own(const pia_sequence *s, int d, pia_index control)
{
    for (pia_index line = 0; line < s->lines[d]; line++) {
        if (!s->own[d][line]) continue;
        pia_index best = -1;
        for (pia_index i = 0; i < control; i++) {
            int between = (i == 0 || s->chosen[d][i - 1] < line) && (i + 1 == control || line < s->chosen[d][i + 1]);
            if (s->chosen[d][i] == line || (between && !s->own[d][s->chosen[d][i]] && best < 0)) best = i;
        }
        if (best >= 0) s->chosen[d][best] = line;
    }
}

pia_status pia_sequence_from_knots(pia_fit *fit)
{
    pia_sequence *s = fit->sequence;
    pia_status status = choose_own(fit);
    for (int d = 0; d < fit->directions && status == PIA_OK; d++) {
        pia_index control = fit->full[d], lines = s->lines[d], next = 0;
        if (control > lines)
            return pia_fail(fit->context, PIA_E_ARGUMENT,
                            "%lld control points in %c are more than the %lld different parameters there; ask for fewer",
                            (long long)control, 'u' + d, (long long)lines);
        for (pia_index i = 0; i < control; i++) {
            double t = pia_knots_greville(fit->knots[d], fit->degree[d], i);
            next = i + 1 == control ? lines - 1 : nearest_line(s, d, t, next, lines - control + i);
            s->chosen[d][i] = next++;
        }
        move_to_own(s, d, control);
        for (pia_index i = 0; i < control; i++) s->mark[d][s->chosen[d][i]] = PIA_LINE_CHOSEN;
        for (pia_index line = 0; line < lines; line++)
            if (s->own[d][line] && s->mark[d][line] == PIA_LINE_FREE)
                return pia_fail(fit->context, PIA_E_ARGUMENT,
                                "the knots in %c have no control point left for line %lld, which is to be met", 'u' + d,
                                (long long)line);
    }
    return status;
}

/* Puts the marked lines into `chosen`; returns how many. */
static pia_index collect(pia_sequence *s, int d)
{
    pia_index control = 0;
    for (pia_index i = 0; i < s->lines[d]; i++) {
        if (s->mark[d][i] == PIA_LINE_FREE) continue;
        s->mark[d][i] = PIA_LINE_CHOSEN;
        s->chosen[d][control++] = i;
    }
    return control;
}

enum { CHOSEN = 1, OWN = 2 };

void pia_sequence_flags(const pia_sequence *sequence, int direction, pia_index *flags)
{
    for (pia_index i = 0; i < sequence->lines[direction]; i++)
        flags[i] = (sequence->mark[direction][i] != PIA_LINE_FREE ? CHOSEN : 0) + (sequence->own[direction][i] ? OWN : 0);
}

pia_index pia_sequence_restore(pia_sequence *sequence, int direction, const pia_index *flags)
{
    for (pia_index i = 0; i < sequence->lines[direction]; i++) {
        sequence->mark[direction][i] = (flags[i] & CHOSEN) != 0 ? PIA_LINE_CHOSEN : PIA_LINE_FREE;
        sequence->own[direction][i] = (flags[i] & OWN) != 0;
    }
    return collect(sequence, direction);
}

pia_status pia_sequence_place(pia_fit *fit)
{
    pia_sequence *s = fit->sequence;
    pia_status status = PIA_OK;
    for (int d = 0; d < fit->directions && status == PIA_OK; d++) {
        pia_index control = collect(s, d);
        double *t = pia_take(fit->context, control, sizeof *t);
        if (t == NULL) return PIA_E_MEMORY;
        for (pia_index i = 0; i < control; i++) t[i] = s->parameter[d][s->chosen[d][i]];
        fit->map[d] = PIA_MAP_IDENTITY;
        status = pia_fit_take_knots(fit, d, control);
        pia_place_problem problem = {fit->degree[d], 0, control, t, control};
        if (status == PIA_OK) status = pia_place_find("average")->place(fit->context, &problem, fit->knots[d]);
        pia_give(fit->context, t);
    }
    return status;
}
