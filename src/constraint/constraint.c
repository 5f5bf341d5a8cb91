#include "conditions.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* ---- from what was asked to rows ---- */

typedef struct request {
    const pia_op *op;
    const pia_targets *targets;
    const pia_index *row_name;
    pia_index index; /* of the constraint in the list */
} request;

const char *pia_origin_text(const pia_origin *origin, char text[PIA_ORIGIN_SIZE])
{
    char order[32] = "", place[48];
    if (origin->directions == 1 && origin->derivative[0] > 0) snprintf(order, sizeof order, "derivative %d at ", origin->derivative[0]);
    if (origin->directions == 2 && origin->derivative[0] + origin->derivative[1] > 0)
        snprintf(order, sizeof order, "derivative (%d, %d) at ", origin->derivative[0], origin->derivative[1]);
    if (origin->point >= 0)
        snprintf(place, sizeof place, "point %lld", (long long)origin->point);
    else if (origin->directions == 1)
        snprintf(place, sizeof place, "%.9g", origin->at[0]);
    else
        snprintf(place, sizeof place, "(%.9g, %.9g)", origin->at[0], origin->at[1]);
    snprintf(text, PIA_ORIGIN_SIZE, "%s%s", order, place);
    return text;
}

static void parameters_of_row(const pia_op *op, pia_index row, double *t)
{
    if (op->pairs != NULL) {
        t[0] = op->pairs[2 * row];
        t[1] = op->pairs[2 * row + 1];
    } else if (op->directions == 1) {
        t[0] = op->line[0]->parameters[row];
    } else {
        t[0] = op->line[0]->parameters[row / op->line[1]->rows];
        t[1] = op->line[1]->parameters[row % op->line[1]->rows];
    }
}

static pia_status check_place(const request *r, const pia_constraint *asked, pia_origin *origin)
{
    pia_context *context = r->op->context;
    *origin = (pia_origin){.point = -1, .directions = r->op->directions};
    for (int d = 0; d < r->op->directions; d++) {
        origin->derivative[d] = asked->derivative[d];
        origin->at[d] = asked->at_parameter[d];
        if (asked->derivative[d] < 0)
            return pia_fail(context, PIA_E_ARGUMENT, "constraint %lld has derivative order %d; orders count from 0",
                            (long long)r->index, asked->derivative[d]);
    }
    if (asked->at_point == PIA_AUTO) {
        for (int d = 0; d < r->op->directions; d++) {
            const pia_collocation *axis = r->op->axis[d];
            double first = axis->knots[axis->degree], last = axis->knots[axis->full], t = asked->at_parameter[d];
            if (!(t >= first && t <= last))
                return pia_fail(context, PIA_E_ARGUMENT,
                                "constraint %lld is at parameter %.17g; choose one in the domain [%.17g, %.17g]", (long long)r->index,
                                t, first, last);
        }
        return PIA_OK;
    }
    if (asked->at_point < 0 || asked->at_point >= r->op->rows)
        return pia_fail(context, PIA_E_ARGUMENT, "constraint %lld is at point %lld; choose one from 0 to %lld", (long long)r->index,
                        (long long)asked->at_point, (long long)(r->op->rows - 1));
    origin->point = r->row_name != NULL ? r->row_name[asked->at_point] : asked->at_point;
    parameters_of_row(r->op, asked->at_point, origin->at);
    return PIA_OK;
}

/* The vector asked for: given, or the data point. */
static pia_status find_value(const request *r, const pia_constraint *asked, const pia_origin *origin, const double **value)
{
    char text[PIA_ORIGIN_SIZE];
    pia_context *context = r->op->context;
    int differentiates = origin->derivative[0] + origin->derivative[1] > 0;
    *value = asked->value;
    if (*value == NULL && (asked->at_point == PIA_AUTO || differentiates))
        return pia_fail(context, PIA_E_ARGUMENT, "constraint %lld (%s) needs a value; only a data point has one of its own",
                        (long long)r->index, pia_origin_text(origin, text));
    if (*value == NULL) *value = r->targets->points + asked->at_point * r->targets->dim;
    for (int d = 0; d < r->targets->dim; d++)
        if (!isfinite((*value)[d]))
            return pia_fail(context, asked->value != NULL ? PIA_E_ARGUMENT : PIA_E_CONSTRAINT,
                            "constraint %lld (%s) has a value that is not finite%s", (long long)r->index, pia_origin_text(origin, text),
                            asked->value != NULL ? "" : ": the grid has a hole there");
    if (asked->direction_only && (!differentiates || r->targets->dim < 2))
        return pia_fail(context, PIA_E_ARGUMENT, "constraint %lld (%s) asks for a direction; that needs a derivative and 2 components",
                        (long long)r->index, pia_origin_text(origin, text));
    return PIA_OK;
}

static pia_status make_axis(const request *r, const double *value, int dim, double *axis)
{
    double length = 0;
    for (int d = 0; d < dim; d++) length = hypot(length, value[d]);
    if (!(length > 0))
        return pia_fail(r->op->context, PIA_E_ARGUMENT,
                        "constraint %lld asks for the direction of a zero vector; give one that points somewhere", (long long)r->index);
    for (int d = 0; d < dim; d++) axis[d] = value[d] / length;
    return PIA_OK;
}

/* Row i of B and R. A direction has R = 0: its derivative is parallel to the axis, whatever its length. */
static pia_status make_row(const request *r, const pia_constraint *asked, pia_constraints *c)
{
    char text[PIA_ORIGIN_SIZE];
    const double *value;
    pia_origin *origin = &c->origin[r->index];
    double *right = c->right + r->index * c->dim;
    pia_status status = check_place(r, asked, origin);
    if (status == PIA_OK) status = find_value(r, asked, origin, &value);
    if (status != PIA_OK) return status;
    double scale = pia_functional_make(r->op, origin->at, origin->derivative, &c->row[r->index]);
    if (!(scale > 0))
        return pia_fail(r->op->context, PIA_E_ARGUMENT,
                        "constraint %lld (%s): this derivative is zero for every curve of the degree; raise the degree",
                        (long long)r->index, pia_origin_text(origin, text));
    int differentiates = origin->derivative[0] + origin->derivative[1] > 0;
    for (int d = 0; d < c->dim; d++)
        right[d] = asked->direction_only ? 0 : scale * (differentiates ? value[d] : value[d] - r->targets->origin[d]);
    return asked->direction_only ? make_axis(r, value, c->dim, c->axis + r->index * c->dim) : PIA_OK;
}

/* ---- the set ---- */

static pia_status take_arrays(pia_constraints *c, int directed)
{
    size_t vector = (size_t)c->dim * sizeof(double);
    c->row = pia_take(c->context, c->count, sizeof *c->row);
    c->origin = pia_take(c->context, c->count, sizeof *c->origin);
    c->right = pia_take(c->context, c->count, vector);
    c->left = pia_take(c->context, c->count, vector);
    c->multiplier = pia_take(c->context, c->count, vector);
    c->inverse = pia_take(c->context, c->op->cols, sizeof *c->inverse);
    c->scratch = pia_take(c->context, c->op->cols, sizeof *c->scratch);
    if (directed) c->axis = pia_take_zero(c->context, c->count, vector);
    int ready = c->row != NULL && c->origin != NULL && c->right != NULL && c->left != NULL && c->multiplier != NULL &&
                c->inverse != NULL && c->scratch != NULL && (!directed || c->axis != NULL);
    return ready ? PIA_OK : pia_take_status(c->context, c->count, sizeof *c->row);
}

static pia_status fill(pia_constraints *c, const pia_targets *targets, const pia_constraint *list, const pia_index *row_name)
{
    int directed = 0;
    for (pia_index i = 0; i < c->count; i++) directed |= list[i].direction_only;
    pia_status status = take_arrays(c, directed);
    for (pia_index i = 0; i < c->count && status == PIA_OK; i++) {
        request r = {c->op, targets, row_name, i};
        status = make_row(&r, &list[i], c);
    }
    return status == PIA_OK ? pia_conditions_open(c) : status;
}

pia_status pia_constraints_build(const pia_op *op, const pia_targets *targets, const double *points, double extent,
                                 const pia_constraint *list, pia_index count, const pia_index *row_name, int soft, pia_notes *notes,
                                 pia_constraints **out)
{
    pia_constraints *c = pia_take_zero(op->context, 1, sizeof *c);
    if (c == NULL) return pia_take_status(op->context, 1, sizeof *c);
    c->context = op->context;
    c->op = op;
    c->dim = targets->dim;
    c->extent = extent;
    c->count = count;
    pia_status status = fill(c, targets, list, row_name);
    if (status == PIA_OK) status = soft ? pia_constraints_metric(c, NULL) : pia_constraints_clean(c, points, notes);
    if (status == PIA_OK)
        *out = c;
    else
        pia_constraints_close(c);
    return status;
}

void pia_constraints_close(pia_constraints *c)
{
    if (c == NULL) return;
    void *blocks[] = {c->row, c->origin, c->right, c->axis, c->begin, c->of, c->basis, c->inverse, c->left, c->multiplier, c->scratch};
    for (size_t i = 0; i < sizeof blocks / sizeof *blocks; i++) pia_give(c->context, blocks[i]);
    pia_schur_close(c, &c->metric);
    pia_schur_close(c, &c->direct);
    pia_give(c->context, c);
}

/* ---- what rows say ---- */

pia_index pia_constraints_count(const pia_constraints *c)
{
    return c->count;
}

pia_index pia_constraints_rank(const pia_constraints *c)
{
    return c->rank;
}

int pia_constraints_keeps(const pia_constraints *c, pia_index i)
{
    return c->begin[i + 1] > c->begin[i];
}

int pia_constraints_are_points(const pia_constraints *c)
{
    if (c->axis != NULL || c->rank != c->count) return 0;
    for (pia_index i = 0; i < c->count; i++)
        if (c->origin[i].point < 0 || c->origin[i].derivative[0] + c->origin[i].derivative[1] > 0) return 0;
    return 1;
}

int pia_constraints_coupled(const pia_constraints *c)
{
    return c->axis != NULL;
}

void pia_row_across(const pia_constraints *c, pia_index i, double *value)
{
    if (c->axis == NULL) return;
    const double *axis = c->axis + i * c->dim;
    double along = 0;
    for (int d = 0; d < c->dim; d++) along += axis[d] * value[d];
    for (int d = 0; d < c->dim; d++) value[d] -= along * axis[d];
}

static void row_residual(const pia_constraints *c, pia_index i, const double *points, double *residual)
{
    pia_functional_value(&c->row[i], points, c->dim, residual);
    for (int d = 0; d < c->dim; d++) residual[d] = c->right[i * c->dim + d] - residual[d];
    pia_row_across(c, i, residual);
}

void pia_constraints_residual(const pia_constraints *c, const double *points, double *residual)
{
    for (pia_index i = 0; i < c->count; i++) row_residual(c, i, points, residual + i * c->dim);
}

double pia_constraints_violation(const pia_constraints *c, const double *points, pia_index *index)
{
    double residual[PIA_MAX_DIM], worst = -1;
    for (pia_index i = 0; i < c->count; i++) {
        double square = 0;
        row_residual(c, i, points, residual);
        for (int d = 0; d < c->dim; d++) square += residual[d] * residual[d];
        if (square <= worst) continue; /* not a number is worse than any */
        worst = square;
        if (index != NULL) *index = i;
    }
    return sqrt(fmax(worst, 0));
}

void pia_constraints_multipliers(const pia_constraints *c, double value, double *multipliers)
{
    for (pia_index i = 0; i < c->count; i++) {
        for (int d = 0; d < c->dim; d++) multipliers[i * c->dim + d] = value;
        pia_row_across(c, i, multipliers + i * c->dim);
    }
}

void pia_constraints_add(const pia_constraints *c, const double *multipliers, double factor, double *y)
{
    int dim = c->dim;
    for (pia_index i = 0; i < c->count; i++) {
        double entry;
        int size = pia_functional_size(&c->row[i]);
        for (int k = 0; k < size; k++) {
            pia_index unknown = pia_functional_unknown(&c->row[i], k, &entry);
            if (c->inverse[unknown] == 0) continue; /* frozen */
            for (int d = 0; d < dim; d++) y[unknown * dim + d] += factor * entry * multipliers[i * dim + d];
        }
    }
}

double pia_constraints_column_bound(const pia_constraints *c)
{
    double largest = 0;
    double *sum = c->scratch;
    for (pia_index i = 0; i < c->op->cols; i++) sum[i] = 0;
    for (pia_index i = 0; i < c->count; i++)
        for (int k = 0; k < pia_functional_size(&c->row[i]); k++) {
            double entry;
            pia_index unknown = pia_functional_unknown(&c->row[i], k, &entry);
            sum[unknown] += fabs(entry);
        }
    for (pia_index i = 0; i < c->op->cols; i++) largest = fmax(largest, sum[i]);
    return largest;
}
