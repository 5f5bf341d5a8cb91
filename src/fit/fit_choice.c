/* What the options leave open: method, parametrization, placement, limiter. Choices made by the library are noted. */
#include "fit.h"
#include "model.h"

#include <math.h>
#include <string.h>

/* Fairing where knots are found among points with gaps: little beside what their deviations feel, enough to keep what they do not hold
 * near them. Grids, whose knots cannot come closer than their lines, feel more of it. */
static const double BRIDGING = 1e-3, GRID_BRIDGING = 1e-5;

static void copy_name(char *to, size_t size, const char *name)
{
    size_t length = name != NULL ? strlen(name) : 0;
    if (length >= size) length = size - 1;
    if (length > 0) memcpy(to, name, length);
    to[length] = '\0';
}

/* Names of a registry, for messages. */
static const char *names_of(const char *registry, char *text, size_t size)
{
    pia_entry entry;
    text[0] = '\0';
    for (pia_index i = 0; pia_list(registry, i, &entry); i++) {
        size_t used = strlen(text);
        if (used + strlen(entry.name) + 3 > size) break;
        if (i > 0) strcat(text, ", ");
        strcat(text, entry.name);
    }
    return text;
}

static pia_status unknown(pia_fit *fit, const char *registry, const char *name)
{
    char text[400];
    return pia_fail(fit->context, PIA_E_ARGUMENT, "there is no %s \"%s\"; there are %s", registry, name,
                    names_of(registry, text, sizeof text));
}

/* Whether the start model has a control point for each row: the 2004 format has two more. */
static int start_is_square(const pia_fit *fit)
{
    const pia_model *start = fit->options.start;
    for (int d = 0; d < fit->directions; d++) {
        pia_index n = start->control[d] - (start->periodic[d] ? start->degree[d] : 0);
        if (n != fit->count[d] && (n != fit->count[d] + 2 || start->degree[d] != 3)) return 0;
    }
    return 1;
}

/* Fewer control points than data, constraints, holes or given weights make it least squares; else the data are interpolated. */
static int wants_least_squares(const pia_fit *fit)
{
    const pia_fit_options *o = &fit->options;
    int fewer = o->start != NULL && !start_is_square(fit);
    for (int d = 0; d < fit->directions; d++) {
        pia_index count = fit->kind == PIA_SCATTERED ? -1 : fit->count[d];
        if (o->control[d] != PIA_AUTO && o->control[d] != count) fewer = 1;
        if (o->knots[d] != NULL && o->knot_count[d] != count + o->degree[d] + 1) fewer = 1;
    }
    return fewer || fit->refining || fit->kind == PIA_SCATTERED || fit->has_holes || fit->weights != NULL || o->robust != NULL ||
           o->fairing > 0 || o->interpolate_count > 0 || o->constraint_count > 0 || o->join_count > 0;
}

/* A tolerance without control points, knots or a start asks for the knots as well; interpolating methods only stop at it. */
static int is_refining(const pia_fit *fit)
{
    const pia_fit_options *o = &fit->options;
    const pia_method *method = o->method != NULL ? pia_method_find(o->method) : NULL;
    if (!(o->tolerance > 0) || o->start != NULL || (method != NULL && (method->needs & PIA_LEAST_SQUARES) == 0)) return 0;
    for (int d = 0; d < fit->directions; d++)
        if (o->control[d] != PIA_AUTO || o->knots[d] != NULL) return 0;
    return 1;
}

/* Control points that were asked for; 0 where that is left open. */
static pia_index asked_controls(const pia_fit *fit)
{
    const pia_fit_options *o = &fit->options;
    pia_index product = 1;
    for (int d = 0; d < fit->directions; d++) {
        pia_index count = o->knots[d] != NULL ? o->knot_count[d] - o->degree[d] - 1 : o->control[d];
        if (count < 1 || !pia_multiply(product, count, &product)) return 0;
    }
    return product;
}

/* Surfaces whose equations are neither banded nor a Kronecker product: factors of a large one cost more than a few dozen products with
 * it, unless the data are so thin that the preconditioner says little. */
static const char *automatic_sparse(pia_fit *fit)
{
    pia_index control = asked_controls(fit);
    if (control > 10000 && fit->rows / 10 > control) {
        pia_fit_note_add(fit, "method: cg-kron, because a sparse factorisation of so many control points costs more");
        return "cg-kron";
    }
    pia_fit_note_add(fit, "method: direct, sparse normal equations");
    return "direct";
}

static const char *automatic(pia_fit *fit)
{
    const pia_fit_options *o = &fit->options;
    int limited = o->limiter != NULL && strcmp(o->limiter, "none") != 0;
    int constrained = o->interpolate_count + o->constraint_count + o->join_count > 0;
    if (!wants_least_squares(fit)) {
        pia_fit_note_add(fit,
                         limited ? "method: pia, because the limiter %s shortens its steps"
                                 : "method: direct, because nothing asked for fewer control points than data%.0s",
                         limited ? o->limiter : "");
        return limited ? "pia" : "direct";
    }
    if (constrained) {
        pia_fit_note_add(fit,
                         limited ? "method: clspia, because the limiter %s shortens its steps and points are to be met exactly"
                                 : "method: direct, constrained least squares%.0s",
                         limited ? o->limiter : "");
        return limited ? "clspia" : "direct";
    }
    if (limited) {
        pia_fit_note_add(fit, "method: lspia, because the limiter %s shortens its steps", o->limiter);
        return "lspia";
    }
    if (fit->refining) {
        pia_fit_note_add(
            fit, "method: direct, with knots added where the error is and spared where it is not, because a tolerance is asked");
        return "direct";
    }
    if (fit->kind == PIA_SCATTERED || (fit->kind == PIA_GRID && (fit->has_holes || fit->weights != NULL))) return automatic_sparse(fit);
    pia_fit_note_add(fit, "method: direct, banded normal equations");
    return "direct";
}

/* Whether knots may come to lie where no point counts. */
static int may_have_gaps(const pia_fit *fit)
{
    if (fit->kind == PIA_SCATTERED || fit->has_holes) return 1;
    for (pia_index row = 0; fit->weights != NULL && row < fit->rows; row++)
        if (fit->weights[row] == 0) return 1;
    return 0;
}

static pia_status check_fairing(pia_fit *fit)
{
    int bends = fit->degree[0] > 1 || (fit->directions == 2 && fit->degree[1] > 1);
    if (fit->refining && fit->options.fairing == 0 && bends && may_have_gaps(fit)) {
        fit->options.fairing = fit->kind == PIA_GRID ? GRID_BRIDGING : BRIDGING;
        pia_fit_note_add(fit, "method: fairing %g, which bridges regions without points", fit->options.fairing);
    }
    if (!(fit->options.fairing > 0)) return PIA_OK;
    if (fit->square || pia_fit_is_grouped(fit))
        return pia_fail(fit->context, PIA_E_ARGUMENT, "method %s leaves fairing no freedom; use direct, lspia or cg",
                        fit->solve.method->name);
    if (fit->directions == 1 && fit->degree[0] < 2)
        return pia_fail(fit->context, PIA_E_ARGUMENT, "a polygon has no curvature to fair; use degree 2 or more");
    return PIA_OK;
}

/* What makes no sense while the number of control points is still to be found. */
static pia_status check_refining(pia_fit *fit)
{
    const pia_fit_options *o = &fit->options;
    const char *what = o->freeze_count > 0                                     ? "frozen control points"
                       : o->soft > 0                                           ? "soft constraints"
                       : o->limiter != NULL && strcmp(o->limiter, "none") != 0 ? "shape limiters"
                                                                               : NULL;
    if (what == NULL) return PIA_OK;
    return pia_fail(
        fit->context, PIA_E_ARGUMENT,
        "the tolerance asks for the number of control points to be found, which %s cannot; give the number (--control), or leave one "
        "of the two out",
        what);
}

static pia_status choose_method(pia_fit *fit)
{
    const char *name = fit->options.method;
    fit->refining = is_refining(fit);
    if (name == NULL || strcmp(name, "auto") == 0) name = automatic(fit);
    fit->solve.method = pia_method_find(name);
    if (fit->solve.method == NULL) return unknown(fit, "method", name);
    unsigned needs = fit->solve.method->needs;
    fit->square = (needs & PIA_NEEDS_SQUARE) != 0 || ((needs & PIA_IS_FINITE) != 0 && !wants_least_squares(fit));
    if ((needs & PIA_NEEDS_SQUARE) != 0 && fit->kind == PIA_SCATTERED)
        return pia_fail(fit->context, PIA_E_ARGUMENT,
                        "method %s interpolates curves and grids, not scattered points; use direct, lspia or cg", name);
    if (fit->square && fit->has_holes)
        return pia_fail(fit->context, PIA_E_ARGUMENT,
                        "method %s interpolates and cannot leave out points without a value; use direct, lspia or cg", name);
    if (fit->refining) {
        pia_status status = check_refining(fit);
        if (status != PIA_OK) return status;
    }
    pia_index beyond = fit->options.constraint_count + fit->options.join_count +
                       ((needs & PIA_NEEDS_GROUPS) != 0 ? 0 : fit->options.interpolate_count);
    if (beyond > 0 && (needs & PIA_KNOWS_CONSTRAINTS) == 0)
        return pia_fail(fit->context, PIA_E_ARGUMENT, "method %s knows no constraints; use clspia, clspia-pcg or direct", name);
    if (fit->square && fit->weights != NULL) pia_fit_note_add(fit, "weights do not change an interpolation and were not used");
    if ((needs & PIA_NEEDS_GROUPS) != 0 && fit->weights != NULL)
        pia_fit_note_add(fit, "method %s knows no weights; they were not used", name);
    return pia_values_read(fit->context, name, fit->solve.method->parameters, fit->options.method_options,
                           fit->options.method_option_count, &fit->method_values);
}

static pia_status choose_limiter(pia_fit *fit)
{
    const char *name = fit->options.limiter;
    if (name == NULL || strcmp(name, "none") == 0) {
        if (fit->options.limiter_option_count == 0) return PIA_OK;
        return pia_fail(fit->context, PIA_E_ARGUMENT, "shape options were given, but no shape to keep; name one");
    }
    fit->solve.limiter = pia_limit_find(name);
    if (fit->solve.limiter == NULL) return unknown(fit, "limiter", name);
    if ((fit->solve.method->needs & PIA_IS_LIMITABLE) == 0)
        return pia_fail(fit->context, PIA_E_ARGUMENT,
                        "limiter %s cannot shorten the steps of method %s; use pia, wpia, lspia or clspia", name,
                        fit->solve.method->name);
    return pia_values_read(fit->context, name, fit->solve.limiter->parameters, fit->options.limiter_options,
                           fit->options.limiter_option_count, &fit->limiter_values);
}

/* The 2004 format is the default of `pia` where it exists: cubic, open, nothing given. */
static int is_paper_format(const pia_fit *fit)
{
    if (strcmp(fit->solve.method->name, "pia") != 0 || fit->options.start != NULL || fit->function_graph) return 0;
    for (int d = 0; d < fit->directions; d++)
        if (fit->degree[d] != 3 || fit->closed[d] || fit->options.knots[d] != NULL || fit->options.control[d] != PIA_AUTO) return 0;
    return 1;
}

int pia_fit_is_grouped(const pia_fit *fit)
{
    return (fit->solve.method->needs & PIA_NEEDS_GROUPS) != 0;
}

int pia_fit_by_line(const pia_fit *fit)
{
    return pia_fit_is_grouped(fit) || (fit->placement != NULL && fit->placement->by_curvature);
}

static const char *automatic_placement(const pia_fit *fit)
{
    if (is_paper_format(fit)) return "pia2004";
    if (fit->square) return "average";
    if (fit->kind == PIA_SCATTERED) return "uniform";
    return pia_fit_is_grouped(fit) ? "dominant" : "lsq";
}

static pia_status choose_placement(pia_fit *fit)
{
    const char *name = fit->options.placement;
    if (fit->options.start != NULL || fit->options.knots[0] != NULL) {
        if (name != NULL && strcmp(name, "auto") != 0)
            return pia_fail(fit->context, PIA_E_ARGUMENT, "knots are given, so they cannot also be placed by \"%s\"; leave one out",
                            name);
        return PIA_OK;
    }
    if (name == NULL || strcmp(name, "auto") == 0) name = automatic_placement(fit);
    fit->placement = pia_place_find(name);
    if (fit->placement == NULL) return unknown(fit, "placement", name);
    if (fit->kind == PIA_SCATTERED && strcmp(name, "uniform") != 0)
        return pia_fail(fit->context, PIA_E_ARGUMENT,
                        "knots %s are for curves and grids; scattered points take uniform ones, or knots that are given", name);
    if (fit->placement->by_curvature && (fit->square || (fit->placement->adds_lines && fit->directions == 1)))
        return pia_fail(fit->context, PIA_E_ARGUMENT, "knots %s are for least squares and epia%s; use average or lsq", name,
                        fit->placement->adds_lines ? " of grids" : " of curves and grids");
    if (strcmp(name, "pia2004") != 0) return PIA_OK;
    for (int d = 0; d < fit->directions; d++)
        if (fit->degree[d] != 3 || fit->closed[d])
            return pia_fail(fit->context, PIA_E_ARGUMENT, "knots pia2004 are cubic and open; use --knots average with degree %d%s",
                            fit->degree[d], fit->closed[d] ? " and closed directions" : "");
    if (!fit->square)
        return pia_fail(fit->context, PIA_E_ARGUMENT, "knots pia2004 interpolate; method %s does not", fit->solve.method->name);
    return PIA_OK;
}

/* Where foot points were asked for and are not to be had. */
static void note_measure(pia_fit *fit)
{
    const pia_fit_options *o = &fit->options;
    if (!o->measure_distance && o->correct <= 0) return;
    int grid = fit->kind == PIA_GRID && !(o->measure_distance && fit->refining);
    if (grid || fit->function_graph)
        pia_fit_note_add(fit,
                         "parameters of %s are not corrected: deviations are those at the parameters given or chosen, and true "
                         "distances are never larger",
                         fit->function_graph ? "function graphs" : "grids without --tolerance and --measure distance");
    else if (fit->square || (o->measure_distance && !fit->refining))
        pia_fit_note_add(fit, "true distance is what a tolerance without a number of control points can ask for; here deviations are "
                              "those at the parameters");
}

pia_status pia_fit_choose(pia_fit *fit)
{
    for (int d = 0; d < fit->directions; d++) {
        fit->degree[d] = fit->options.degree[d];
        fit->closed[d] = fit->options.closed[d] != 0;
        if (fit->closed[d] && fit->function_graph)
            return pia_fail(fit->context, PIA_E_ARGUMENT,
                            "a function graph cannot be closed; fit the values with given parameters instead");
    }
    pia_status status = choose_method(fit);
    if (status == PIA_OK) status = pia_fit_choose_loss(fit);
    if (status == PIA_OK) status = check_fairing(fit);
    if (status == PIA_OK) note_measure(fit);
    if (status == PIA_OK) status = choose_limiter(fit);
    if (status == PIA_OK) status = choose_placement(fit);
    const char *name = fit->options.parametrization;
    if (status != PIA_OK || fit->parameter[0] != NULL) return status;
    if (fit->kind == PIA_SCATTERED) {
        if (name == NULL || strcmp(name, "auto") == 0) return PIA_OK;
        fit->cloud = pia_cloud_find(name);
        return fit->cloud != NULL
                   ? PIA_OK
                   : pia_fail(fit->context, PIA_E_ARGUMENT,
                              "parametrization %s is not one of scattered points; there are auto, xy, plane, cylinder, sphere", name);
    }
    if (name != NULL && pia_cloud_find(name) != NULL)
        return pia_fail(fit->context, PIA_E_ARGUMENT, "parametrization %s is one of scattered points; take another, or say --surface",
                        name);
    fit->parametrization = pia_param_find(name != NULL ? name : "chord");
    return fit->parametrization != NULL ? PIA_OK : unknown(fit, "parametrization", name);
}

static const char *placement_name(const pia_fit *fit)
{
    if (fit->refining && !(fit->placement != NULL && fit->placement->adds_lines)) return "adaptive";
    return fit->placement != NULL ? fit->placement->name : "given";
}

void pia_fit_names(const pia_fit *fit, pia_report *report)
{
    copy_name(report->method, sizeof report->method, fit->solve.method->name);
    copy_name(report->parametrization, sizeof report->parametrization,
              fit->parametrization != NULL ? fit->parametrization->name
              : fit->cloud != NULL         ? fit->cloud->name
                                           : "given");
    copy_name(report->placement, sizeof report->placement, placement_name(fit));
    copy_name(report->limiter, sizeof report->limiter, fit->solve.limiter != NULL ? fit->solve.limiter->name : "none");
}
