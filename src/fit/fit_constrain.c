/* Constraints of a fit: the list the caller keeps adding to and dropping from, and the rows it makes on the current operator. */
#include "constraint.h"
#include "evaluate.h"
#include "fit.h"
#include "options.h"

#include <math.h>
#include <string.h>

static void release_value(pia_fit *fit, pia_fit_constraint *c)
{
    pia_give(fit->context, c->value);
    c->value = NULL;
}

void pia_fit_constraints_close(pia_fit *fit)
{
    for (pia_index i = 0; i < fit->constraint_count; i++) release_value(fit, &fit->constraint[i]);
    pia_give(fit->context, fit->constraint);
    pia_fit_unbind(fit);
}

void pia_fit_unbind(pia_fit *fit)
{
    pia_iterate *iterate = &fit->iterate;
    if (iterate->normal != NULL && iterate->normal != fit->normal) pia_normal_close(iterate->normal);
    iterate->normal = fit->normal;
    pia_constraints_close(iterate->constraints != NULL ? iterate->constraints : fit->soft_constraints);
    iterate->constraints = fit->soft_constraints = NULL;
    iterate->constraint_error = NAN;
}

pia_index pia_fit_row(const pia_fit *fit, pia_index data_row)
{
    if (fit->row == NULL) return data_row >= 0 && data_row < fit->rows ? data_row : -1;
    pia_index before = -1, first = -1;
    for (pia_index i = 0; i < fit->rows; i++) {
        if (fit->row[i] == data_row) return i;
        if (fit->row[i] < data_row && (before < 0 || fit->row[i] > fit->row[before])) before = i;
        if (first < 0 || fit->row[i] < fit->row[first]) first = i;
    }
    for (pia_index i = 0; i < fit->dropped_count; i++)
        if (fit->dropped[i] == data_row) return fit->closed[0] && data_row == fit->given - 1 ? first : before;
    return -1;
}

static pia_status take_constraint(pia_fit *fit, const pia_constraint *given, pia_index number, pia_fit_constraint *out)
{
    pia_constraint c;
    pia_constraint_init(&c);
    pia_status status = pia_options_read(fit->context, "pia_constraint", &c, sizeof c, given);
    if (status != PIA_OK) return status;
    *out = (pia_fit_constraint){.asked = c};
    out->asked.value = NULL;
    if (c.at_point != PIA_AUTO && pia_fit_row(fit, c.at_point) < 0)
        return pia_fail(fit->context, PIA_E_ARGUMENT, "constraint %lld names data row %lld; there are rows 0 to %lld",
                        (long long)number, (long long)c.at_point, (long long)fit->given - 1);
    for (int d = 0; c.value != NULL && d < fit->dim; d++)
        if (!isfinite(c.value[d]))
            return pia_fail(fit->context, PIA_E_DATA, "constraint %lld: component %d of its value is not finite", (long long)number, d);
    if (c.value == NULL) return PIA_OK;
    out->value = pia_take(fit->context, fit->dim, sizeof(double));
    if (out->value == NULL) return PIA_E_MEMORY;
    memcpy(out->value, c.value, (size_t)fit->dim * sizeof(double));
    return PIA_OK;
}

pia_status pia_fit_add_constraint(pia_fit *fit, const pia_constraint *given)
{
    void *list = fit->constraint;
    int grown =
        pia_memory_grow(pia_memory_of(fit->context), &list, &fit->constraint_room, fit->constraint_count + 1, sizeof *fit->constraint);
    fit->constraint = list;
    if (!grown) return pia_fail(fit->context, PIA_E_MEMORY, "out of memory for a constraint");
    pia_status status = take_constraint(fit, given, fit->constraint_count, &fit->constraint[fit->constraint_count]);
    if (status == PIA_OK) fit->constraint_count++;
    return status;
}

pia_status pia_fit_take_constraints(pia_fit *fit)
{
    const pia_fit_options *o = &fit->options;
    pia_status status = PIA_OK;
    for (pia_index i = 0; i < o->interpolate_count && status == PIA_OK; i++) {
        pia_constraint c;
        pia_constraint_init(&c);
        c.at_point = o->interpolate[i];
        status = pia_fit_add_constraint(fit, &c);
    }
    for (pia_index i = 0; i < o->constraint_count && status == PIA_OK; i++) status = pia_fit_add_constraint(fit, &o->constraints[i]);
    for (pia_index i = 0; i < o->join_count && status == PIA_OK; i++) status = pia_fit_add_join(fit, &o->joins[i]);
    return status;
}

static void fold(const pia_fit *fit, double *t)
{
    for (int d = 0; d < fit->directions; d++) {
        double low = fit->knots[d][fit->degree[d]];
        if (fit->closed[d]) t[d] -= floor(t[d] - low);
    }
}

/* The rows of B, hard or soft, for the constraints that are still asked. */
static pia_status build(pia_fit *fit, const pia_constraint *list, pia_index count)
{
    pia_iterate *iterate = &fit->iterate;
    int soft = fit->options.soft > 0;
    pia_constraints *made;
    pia_notes *notes = fit->refining && fit->solve.stop == PIA_STOP_NONE ? NULL : &fit->notes; /* said once, of the last knots */
    pia_status status =
        pia_constraints_build(fit->op, &iterate->targets, iterate->points, fit->extent, list, count, fit->row, soft, notes, &made);
    if (status != PIA_OK) return status;
    if (!soft) {
        iterate->constraints = made;
        return PIA_OK;
    }
    fit->soft_constraints = made;
    if (fit->normal == NULL)
        return pia_fail(fit->context, PIA_E_ARGUMENT, "soft constraints need normal equations, which these data have not; drop --soft");
    return pia_constraints_soften(made, fit->options.soft, fit->normal, &iterate->normal);
}

pia_status pia_fit_bind(pia_fit *fit)
{
    pia_index count = 0;
    pia_fit_unbind(fit);
    if (fit->constraint_count == 0) return PIA_OK;
    pia_constraint *list = pia_take(fit->context, fit->constraint_count, sizeof *list);
    if (list == NULL) return PIA_E_MEMORY;
    for (pia_index i = 0; i < fit->constraint_count; i++) {
        const pia_fit_constraint *c = &fit->constraint[i];
        if (c->released) continue;
        list[count] = c->asked;
        list[count].value = c->value;
        if (c->asked.at_point != PIA_AUTO)
            list[count].at_point = pia_fit_row(fit, c->asked.at_point);
        else
            fold(fit, list[count].at_parameter);
        count++;
    }
    pia_status status = count > 0 ? build(fit, list, count) : PIA_OK;
    pia_give(fit->context, list);
    return status;
}

void pia_fit_measure_constraints(pia_fit *fit)
{
    pia_iterate *iterate = &fit->iterate;
    const pia_constraints *c = iterate->constraints != NULL ? iterate->constraints : fit->soft_constraints;
    iterate->constraint_error = c != NULL ? pia_constraints_violation(c, iterate->points, NULL) : NAN;
}

static int asks_direction(const pia_fit_constraint *c)
{
    return !c->released && c->asked.direction_only && c->value != NULL && c->asked.derivative[0] <= PIA_MAX_DEGREE;
}

/* Whether the derivative of a curve points away from the direction asked: the condition is linear and cannot tell the two senses apart.
 */
static int is_backwards(const pia_fit *fit, const pia_model *model, const pia_fit_constraint *c)
{
    double rows[(PIA_MAX_DEGREE + 1) * PIA_MAX_DIM], t[2] = {c->asked.at_parameter[0], 0}, along = 0;
    int order = c->asked.derivative[0];
    pia_index hint[2] = {0, 0};
    if (c->asked.at_point != PIA_AUTO)
        t[0] = fit->parameter[0][pia_fit_row(fit, c->asked.at_point)];
    else
        fold(fit, t);
    pia_evaluate(model, t, order, hint, rows);
    for (int d = 0; d < fit->dim; d++) along += rows[order * fit->dim + d] * c->value[d];
    return along < 0;
}

void pia_fit_describe_directions(pia_fit *fit)
{
    pia_model *model;
    pia_index list[PIA_LISTED], count = 0, asked = 0;
    for (pia_index i = 0; i < fit->constraint_count; i++) asked += asks_direction(&fit->constraint[i]);
    if (asked == 0 || fit->directions != 1 || fit->function_graph || pia_fit_bare_model(fit, &model) != PIA_OK) return;
    for (pia_index i = 0; i < fit->constraint_count; i++) {
        if (!asks_direction(&fit->constraint[i]) || !is_backwards(fit, model, &fit->constraint[i])) continue;
        if (count < PIA_LISTED) list[count] = i - fit->options.interpolate_count;
        count++;
    }
    if (count > 0)
        pia_fit_outcome_add(fit, "constraints whose direction is met the other way round, by their place in the list", list, count);
    pia_model_destroy(model);
}

static int knows_constraints(const pia_fit *fit)
{
    return (fit->solve.method->needs & PIA_KNOWS_CONSTRAINTS) != 0 || fit->options.soft > 0;
}

static pia_status check_knows(pia_fit *fit)
{
    if (pia_fit_whole(fit) != PIA_OK) return PIA_E_MEMORY;
    if (!fit->square && knows_constraints(fit)) return PIA_OK;
    return pia_fail(fit->context, PIA_E_ARGUMENT,
                    "method %s knows no constraints here; use clspia, clspia-pcg or direct with fewer control "
                    "points than data",
                    fit->solve.method->name);
}

/* Takes what was added after the first `before` into the fit, or drops it again. */
static pia_status settle(pia_fit *fit, pia_status status, pia_index before, pia_index *first_id)
{
    if (status == PIA_OK) status = pia_fit_bind(fit);
    if (status == PIA_OK) status = pia_fit_restart(fit);
    if (status == PIA_OK) {
        if (first_id != NULL) *first_id = before;
        return PIA_OK;
    }
    while (fit->constraint_count > before) release_value(fit, &fit->constraint[--fit->constraint_count]);
    if (pia_fit_bind(fit) == PIA_OK)
        pia_fit_restart(fit);
    else
        fit->lost = 1;
    return status;
}

pia_status pia_fit_constrain(pia_fit *fit, const pia_constraint *constraints, pia_index count, pia_index *first_id)
{
    pia_index before = fit->constraint_count;
    pia_status status = check_knows(fit);
    if (status != PIA_OK) return status;
    for (pia_index i = 0; i < count && status == PIA_OK; i++) status = pia_fit_add_constraint(fit, &constraints[i]);
    return settle(fit, status, before, first_id);
}

pia_status pia_fit_join(pia_fit *fit, const pia_join *join, pia_index *first_id, pia_index *count)
{
    pia_index before = fit->constraint_count;
    pia_status status = check_knows(fit);
    if (status != PIA_OK) return status;
    status = settle(fit, pia_fit_add_join(fit, join), before, first_id);
    if (status == PIA_OK && count != NULL) *count = fit->constraint_count - before;
    return status;
}

pia_status pia_fit_release(pia_fit *fit, pia_index id)
{
    if (pia_fit_whole(fit) != PIA_OK) return PIA_E_MEMORY;
    if (id < 0 || id >= fit->constraint_count || fit->constraint[id].released)
        return pia_fail(fit->context, PIA_E_ARGUMENT, "constraint %lld is not there to be released", (long long)id);
    fit->constraint[id].released = 1;
    pia_status status = pia_fit_bind(fit);
    return pia_fit_changed(fit, status == PIA_OK ? pia_fit_restart(fit) : status);
}
