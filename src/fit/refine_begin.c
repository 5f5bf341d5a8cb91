/* The knots to begin with: corners are knots of full multiplicity, and constraints need control points. Between the places that are
 * constrained go few knots first, then more, until the constraints can hold. */
#include "refine.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Places of the constraints in one direction, rising, none twice. */
typedef struct places {
    double *at;
    pia_index count;
} places;

static int compare(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static pia_status find_places(pia_fit *fit, int d, places *out)
{
    double low = fit->knots[d][fit->degree[d]];
    pia_index n = 0, kept = 0;
    *out = (places){pia_take(fit->context, fit->constraint_count, sizeof *out->at), 0};
    if (out->at == NULL) return PIA_E_MEMORY;
    for (pia_index i = 0; i < fit->constraint_count; i++) {
        const pia_constraint *c = &fit->constraint[i].asked;
        if (fit->constraint[i].released) continue;
        double t = c->at_point != PIA_AUTO ? pia_refine_parameter(fit, d, pia_fit_row(fit, c->at_point)) : c->at_parameter[d];
        out->at[n++] = fit->closed[d] ? t - floor(t - low) : t;
    }
    qsort(out->at, (size_t)n, sizeof *out->at, compare);
    for (pia_index i = 0; i < n; i++)
        if (kept == 0 || out->at[i] > out->at[kept - 1]) out->at[kept++] = out->at[i];
    out->count = kept;
    return PIA_OK;
}

/* How densely knots go between places: `each` of them into every `step`-th gap. */
typedef struct density {
    pia_index step;
    int each;
} density;

/* Corners, and knots between the places; inside has room for corners + (degree + 1) places. Returns how many. */
static pia_index knots_between(const pia_fit *fit, int d, const places *p, density dense, double *inside)
{
    pia_index n = 0;
    int degree = fit->degree[d];
    double low = fit->knots[d][degree], high = fit->knots[d][fit->full[d]];
    for (pia_index k = 0; d == 0 && k < fit->corner_count * degree; k++) inside[n++] = fit->parameter[0][fit->corner[k / degree]];
    for (pia_index gap = dense.step - 1; dense.each > 0 && gap + !fit->closed[d] < p->count; gap += dense.step)
        for (int k = 1; k <= dense.each; k++) {
            double to = gap + 1 < p->count ? p->at[gap + 1] : p->at[0] + 1;
            double knot = p->at[gap] + (to - p->at[gap]) * k / (dense.each + 1);
            if (knot >= high) knot -= 1;
            if (knot > low && knot < high) inside[n++] = knot;
        }
    qsort(inside, (size_t)n, sizeof *inside, compare);
    return n;
}

static pia_status place(pia_fit *fit, int d, const places *p, density dense)
{
    pia_index corners = d == 0 ? fit->corner_count * fit->degree[0] : 0;
    double *inside = pia_take(fit->context, corners + (fit->degree[d] + 1) * p->count + 1, sizeof *inside);
    if (inside == NULL) return PIA_E_MEMORY;
    pia_index count = knots_between(fit, d, p, dense, inside), least = fit->closed[d] ? fit->op->count[d] - 1 : 0;
    pia_status status = count >= least ? pia_refine_place(fit, d, inside, count) : PIA_OK;
    pia_give(fit->context, inside);
    return status;
}

static pia_status bind(pia_fit *fit)
{
    memset(fit->iterate.points, 0, (size_t)(fit->op->cols * fit->dim) * sizeof(double));
    return pia_fit_bind(fit);
}

/* Halves the step down to a knot a gap, then takes one more a gap. */
static density denser(density now)
{
    return now.each == 0 ? (density){now.step, 1} : now.step > 1 ? (density){now.step / 2, 1} : (density){1, now.each + 1};
}

static pia_status admit(pia_fit *fit)
{
    places p[2] = {{NULL, 0}, {NULL, 0}};
    pia_status status = PIA_OK;
    density dense = {1, 0};
    int most = fit->degree[0] + 1;
    for (int d = 0; d < fit->directions && status == PIA_OK; d++) {
        status = find_places(fit, d, &p[d]);
        while (2 * dense.step < p[d].count) dense.step *= 2;
        if (fit->degree[d] + 1 > most) most = fit->degree[d] + 1;
    }
    if (status == PIA_OK) status = bind(fit);
    while (status == PIA_E_CONSTRAINT && dense.each < most) {
        dense = denser(dense);
        status = PIA_OK;
        for (int d = 0; d < fit->directions && status == PIA_OK; d++) status = place(fit, d, &p[d], dense);
        if (status == PIA_OK) status = pia_fit_assemble(fit);
        if (status == PIA_OK) status = bind(fit);
    }
    for (int d = 0; d < 2; d++) pia_give(fit->context, p[d].at);
    return status;
}

/* A row that is to be met elsewhere than it is has to be met within its tolerance. */
static pia_status check_values(pia_fit *fit)
{
    for (pia_index i = 0; i < fit->constraint_count; i++) {
        const pia_fit_constraint *c = &fit->constraint[i];
        if (c->asked.at_point == PIA_AUTO || c->value == NULL || c->asked.derivative[0] + c->asked.derivative[1] > 0) continue;
        pia_index row = pia_fit_row(fit, c->asked.at_point);
        double deviation[PIA_MAX_DIM], square = 0;
        for (int d = 0; d < fit->dim; d++) {
            deviation[d] = c->value[d] - fit->points[row * fit->dim + d];
            square += deviation[d] * deviation[d];
        }
        if (pia_refine_ratio(fit, row, deviation) > 1)
            return pia_fail(
                fit->context, PIA_E_CONSTRAINT,
                "the constraint at point %lld asks for a value that is %.6g away from it, but it may deviate by %.6g; raise "
                "its tolerance or move the point",
                (long long)c->asked.at_point, sqrt(square), pia_refine_allowed(fit, row));
    }
    return PIA_OK;
}

static void note_weights(pia_fit *fit)
{
    pia_index without = 0;
    for (pia_index row = 0; fit->weights != NULL && row < fit->rows; row++) without += fit->weights[row] == 0;
    if (without > 0) pia_fit_note_add(fit, "%lld rows without weight may be farther away than the tolerance", (long long)without);
}

pia_status pia_refine_begin(pia_fit *fit)
{
    pia_status status = check_values(fit);
    pia_refine_reopen(fit);
    note_weights(fit);
    if (status == PIA_OK && fit->corner_count > 0) {
        status = place(fit, 0, &(places){NULL, 0}, (density){1, 0});
        if (status == PIA_OK) status = pia_fit_assemble(fit);
    }
    if (status == PIA_OK && fit->constraint_count > 0) status = admit(fit);
    return status == PIA_OK ? pia_fit_initial(fit) : status;
}
