/* Parameters of the rows: given ones are checked, others computed; rows that interpolation cannot tell apart are dropped; closed
 * directions are turned so that parameters rise through the domain of the knots. */
#include "fit.h"
#include "scan.h"

#include <math.h>
#include <string.h>

/* The first parameter that is not finite, falls, or leaves the period. */
pia_status pia_fit_refuse_parameters(pia_fit *fit, const double *given, int direction, pia_index given_count)
{
    pia_context *context = fit->context;
    const char *where = fit->directions == 1 ? "" : direction == 0 ? "u " : "v ";
    for (pia_index i = 0; i < given_count; i++) {
        if (!isfinite(given[i]))
            return pia_fail(context, PIA_E_DATA, "%sparameter %lld is %g; parameters are finite", where, (long long)i, given[i]);
        if (i > 0 && given[i] < given[i - 1])
            return pia_fail(context, PIA_E_DATA, "%sparameter %lld is %.17g, less than %.17g before it; sort the rows by parameter",
                            where, (long long)i, given[i], given[i - 1]);
        if (fit->closed[direction] && !(given[i] >= 0 && given[i] <= 1))
            return pia_fail(context, PIA_E_DATA, "%sparameter %lld is %g; parameters of a closed direction lie in [0, 1)", where,
                            (long long)i, given[i]);
    }
    return pia_fail(context, PIA_E_DATA, "all %sparameters equal %g; give ones that rise", where, given[0]);
}

/* *rising: no two parameters are equal. */
static pia_status take_given(pia_fit *fit, const double *given, int direction, pia_index count, pia_index given_count, int *rising)
{
    pia_context *context = fit->context;
    double first = given[0], last = given[given_count - 1];
    int unseen = fit->unseen && fit->directions == 1; /* the parameters of a grid are few */
    *rising = !unseen && pia_scan_rising(context, given, given_count);
    int ordered = *rising || (unseen ? isfinite(first) && isfinite(last) : pia_scan_ordered(context, given, given_count));
    if (!ordered || !(first < last) || (fit->closed[direction] && !(first >= 0 && last <= 1)))
        return pia_fit_refuse_parameters(fit, given, direction, given_count);
    if (fit->borrowed && fit->row == NULL && fit->directions == 1 && !fit->closed[0]) {
        fit->parameter[0] = (double *)(uintptr_t)given; /* never written while it is borrowed */
        fit->borrowed_parameters = 1;
        return PIA_OK;
    }
    fit->parameter[direction] = pia_take(context, count, sizeof(double));
    if (fit->parameter[direction] == NULL) return PIA_E_MEMORY;
    for (pia_index i = 0; i < count; i++)
        fit->parameter[direction][i] = given[fit->row != NULL && fit->directions == 1 ? fit->row[i] : i];
    return PIA_OK;
}

static pia_status take_given_pairs(pia_fit *fit, const double *given)
{
    for (pia_index i = 0; i < 2 * fit->rows; i++)
        if (!isfinite(given[i]))
            return pia_fail(fit->context, PIA_E_DATA, "parameter %c of row %lld is %g; parameters are finite", i % 2 == 0 ? 'u' : 'v',
                            (long long)(i / 2), given[i]);
    fit->parameter[0] = pia_take(fit->context, 2 * fit->rows, sizeof(double));
    if (fit->parameter[0] == NULL) return PIA_E_MEMORY;
    memcpy(fit->parameter[0], given, (size_t)(2 * fit->rows) * sizeof(double));
    return PIA_OK;
}

/* [2004] Eq. (1), (12), (13): raw chords, of a grid their means over the lines of the other direction. */
static void raw_chords(const pia_fit *fit, int direction, double *t)
{
    pia_index lines = fit->count[direction], other = fit->rows / lines;
    pia_index along = (direction == 0 ? other : 1) * fit->dim, across = (direction == 0 ? 1 : lines) * fit->dim;
    t[0] = 0;
    for (pia_index i = 1; i < lines; i++) {
        double sum = 0;
        for (pia_index j = 0; j < other; j++) {
            const double *p = fit->points + j * across + i * along, *q = p - along;
            double square = 0;
            for (int d = 0; d < fit->dim; d++) square += (p[d] - q[d]) * (p[d] - q[d]);
            sum += sqrt(square);
        }
        t[i] = t[i - 1] + sum / (double)other;
    }
}

static pia_status compute(pia_fit *fit)
{
    for (int d = 0; d < fit->directions; d++) {
        fit->parameter[d] = pia_take(fit->context, fit->count[d], sizeof(double));
        if (fit->parameter[d] == NULL) return PIA_E_MEMORY;
    }
    if (fit->placement != NULL && strcmp(fit->placement->name, "pia2004") == 0 && strcmp(fit->parametrization->name, "chord") == 0) {
        for (int d = 0; d < fit->directions; d++) raw_chords(fit, d, fit->parameter[d]);
        return PIA_OK;
    }
    if (fit->directions == 2)
        return pia_param_grid(fit->context, fit->parametrization, fit->points, fit->count, fit->dim, fit->degree, fit->closed,
                              fit->parameter[0], fit->parameter[1]);
    return fit->parametrization->compute(fit->context, fit->points, fit->count[0], fit->dim, fit->degree[0], fit->closed[0],
                                         fit->parameter[0]);
}

/* By value: 0 and -0 are one place. Holes are alike. */
static int equal_points(const pia_fit *fit, pia_index row, pia_index other)
{
    const double *a = fit->points + row * fit->dim, *b = fit->points + other * fit->dim;
    for (int d = 0; d < fit->dim; d++)
        if (a[d] != b[d] && !(isnan(a[d]) && isnan(b[d]))) return 0;
    return 1;
}

/* Equal points one after the other, for rules whose parameters would not be equal there (uniform) as well. */
static pia_status drop_equal_points(pia_fit *fit)
{
    pia_index repeats = 0;
    for (pia_index i = 1; i < fit->rows; i++) repeats += equal_points(fit, i, i - 1);
    if (repeats == 0) return PIA_OK;
    unsigned char *keep = pia_take(fit->context, fit->rows, 1);
    if (keep == NULL) return PIA_E_MEMORY;
    for (pia_index i = 0; i < fit->rows; i++) keep[i] = i == 0 || !equal_points(fit, i, i - 1);
    pia_status status = pia_fit_drop_rows(fit, keep);
    pia_give(fit->context, keep);
    if (status == PIA_OK) pia_fit_note_add(fit, "%lld rows repeat the point before them and were dropped", (long long)repeats);
    return status;
}

/* A function graph's repeated abscissas become one row: the mean by weight. */
static pia_status merge_equal_abscissas(pia_fit *fit)
{
    unsigned char *keep = pia_take(fit->context, fit->rows, 1);
    if (keep == NULL) return PIA_E_MEMORY;
    pia_index merged = 0;
    for (pia_index i = 0, j; i < fit->rows; i = j) {
        double *y = fit->own_points + i * fit->dim, total = fit->weights != NULL ? fit->weights[i] : 1;
        keep[i] = 1;
        for (j = i + 1; j < fit->rows && fit->parameter[0][j] == fit->parameter[0][i]; j++) {
            double w = fit->weights != NULL ? fit->weights[j] : 1;
            keep[j] = 0;
            merged++;
            total += w;
            for (int d = 0; d < fit->dim && total > 0; d++) y[d] += (fit->own_points[j * fit->dim + d] - y[d]) * (w / total);
        }
        if (fit->weights != NULL) fit->weights[i] = total;
    }
    pia_status status = pia_fit_drop_rows(fit, keep);
    pia_give(fit->context, keep);
    if (status == PIA_OK && merged > 0)
        pia_fit_note_add(fit, "%lld rows share an abscissa with a row before them and were averaged into it", (long long)merged);
    return status;
}

/* Interpolation needs rising parameters: equal ones are dropped where the points are equal too, and refused where they are not. */
static pia_status separate(pia_fit *fit, int direction)
{
    pia_index lines = fit->count[direction], other = fit->rows / lines, repeats = 0;
    const double *t = fit->parameter[direction];
    for (pia_index i = 1; i < lines; i++) repeats += !(t[i] > t[i - 1]);
    if (repeats == 0) return PIA_OK;
    unsigned char *keep = pia_take(fit->context, lines, 1);
    if (keep == NULL) return PIA_E_MEMORY;
    pia_status status = PIA_OK;
    for (pia_index i = 0; i < lines && status == PIA_OK; i++) {
        keep[i] = i == 0 || t[i] > t[i - 1];
        for (pia_index j = 0; !keep[i] && j < other && status == PIA_OK; j++) {
            pia_index at = direction == 0 ? i * other + j : j * lines + i, before = direction == 0 ? at - other : at - 1;
            if (!equal_points(fit, at, before))
                status = pia_fail(
                    fit->context, PIA_E_DATA,
                    "parameters %lld and %lld are equal (%.17g) but their points differ; least squares (--control) can fit them",
                    (long long)i - 1, (long long)i, t[i]);
        }
    }
    if (status == PIA_OK) status = fit->directions == 1 ? pia_fit_drop_rows(fit, keep) : pia_fit_drop_lines(fit, direction, keep);
    pia_give(fit->context, keep);
    if (status == PIA_OK && fit->directions == 1)
        pia_fit_note_add(fit, "%lld rows repeat the point before them and were dropped", (long long)repeats);
    if (status == PIA_OK && fit->directions == 2)
        pia_fit_note_add(fit, "%lld lines in %c repeat the line before them and were dropped", (long long)repeats, 'u' + direction);
    return status;
}

/* Scattered points on the base surface that was asked for, or on the one that suits them. */
static pia_status parametrize_cloud(pia_fit *fit)
{
    int around, least = fit->cloud != NULL ? fit->cloud->dim : 2;
    if (fit->rows < 3 || fit->dim < least)
        return pia_fail(fit->context, PIA_E_DATA,
                        "parametrization %s needs at least three points of %d components; these are %lld of %d",
                        fit->cloud != NULL ? fit->cloud->name : "auto", least, (long long)fit->rows, fit->dim);
    pia_status status = fit->cloud != NULL ? PIA_OK : pia_fit_choose_base(fit);
    if (status != PIA_OK) return status;
    fit->parameter[0] = pia_take(fit->context, 2 * fit->rows, sizeof(double));
    if (fit->parameter[0] == NULL) return PIA_E_MEMORY;
    status = fit->cloud->compute(fit->context, fit->points, fit->rows, fit->dim, fit->parameter[0], &around);
    if (status == PIA_OK && around) {
        fit->closed[0] = 1;
        pia_fit_note_add(fit, "direction u is closed: the points go all the way round the %s", fit->cloud->name);
    }
    return status;
}

pia_status pia_fit_parametrize(pia_fit *fit, const pia_data *data)
{
    pia_status status = PIA_OK;
    int apart = fit->square || pia_fit_by_line(fit); /* every row has a control point, or may get one */
    int rising[2] = {0, 0};
    if (fit->function_graph) return apart ? merge_equal_abscissas(fit) : PIA_OK;
    if (data->parameters != NULL) {
        fit->parametrization = NULL;
        fit->cloud = NULL;
        if (fit->kind == PIA_SCATTERED) return take_given_pairs(fit, data->parameters);
        for (int d = 0; status == PIA_OK && d < fit->directions; d++)
            status = take_given(fit, data->parameters + (d == 0 ? 0 : data->count[0]), d, fit->count[d], data->count[d], &rising[d]);
    } else {
        if (fit->kind == PIA_SCATTERED) return parametrize_cloud(fit);
        if ((apart || fit->refining) && fit->directions == 1) status = drop_equal_points(fit);
        if (status == PIA_OK) status = pia_fit_take_corners(fit);
        if (status == PIA_OK) status = compute(fit);
    }
    for (int d = 0; status == PIA_OK && apart && fit->kind != PIA_SCATTERED && d < fit->directions; d++)
        if (!rising[d] && !fit->unseen) status = separate(fit, d);
    return status;
}
