/* More control parameters: the lines of the worst rows, and the fit with them. */
#include "sequence.h"

#include "model.h"

#include <math.h>
#include <string.h>

/* ---- picking ---- */

pia_index pia_sequence_line(const pia_fit *fit, pia_index row, int d)
{
    const pia_sequence *s = fit->sequence;
    if (fit->kind != PIA_SCATTERED) return d == 0 ? row / fit->count[1] : row % fit->count[1];
    pia_index a = 0, b = s->lines[d] - 1;
    while (a < b) {
        pia_index middle = a + (b - a) / 2;
        if (s->parameter[d][middle] < fit->parameter[0][2 * row + d])
            a = middle + 1;
        else
            b = middle;
    }
    return a;
}

/* The worst row that has a line neither chosen nor blocked, and an owner that moves; -1: none. */
static pia_index worst_row(const pia_fit *fit, unsigned char *const blocked[2], double *error)
{
    const pia_sequence *s = fit->sequence;
    pia_index worst = -1;
    double most = -1;
    for (pia_index row = 0; row < fit->rows; row++) {
        const double *r = fit->iterate.residual + row * fit->dim;
        double square = 0;
        int open = 0;
        for (int d = 0; d < fit->dim; d++) square += r[d] * r[d];
        if (!(square > most)) continue;
        for (int d = 0; d < fit->directions; d++) {
            pia_index line = pia_sequence_line(fit, row, d);
            open |= s->mark[d][line] == PIA_LINE_FREE && !blocked[d][line];
        }
        if (!open || !pia_zone_owns(fit, row)) continue;
        most = square;
        worst = row;
    }
    *error = worst >= 0 ? sqrt(most) : 0;
    return worst;
}

/* Marks a line and blocks the gap it is in. */
static void add_line(pia_sequence *s, int d, pia_index line, unsigned char *blocked)
{
    if (s->mark[d][line] != PIA_LINE_FREE || blocked[line]) return;
    s->mark[d][line] = PIA_LINE_ADDED;
    for (pia_index i = line; i > 0 && s->mark[d][i - 1] == PIA_LINE_FREE; i--) blocked[i - 1] = 1;
    for (pia_index i = line + 1; i < s->lines[d] && s->mark[d][i] == PIA_LINE_FREE; i++) blocked[i] = 1;
}

pia_status pia_sequence_pick(pia_fit *fit, pia_index most, pia_index *picked)
{
    pia_sequence *s = fit->sequence;
    unsigned char *blocked[2] = {NULL, NULL};
    pia_status status = PIA_OK;
    for (int d = 0; d < fit->directions && status == PIA_OK; d++) {
        blocked[d] = pia_take_zero(fit->context, s->lines[d], 1);
        if (blocked[d] == NULL) status = PIA_E_MEMORY;
    }
    *picked = 0;
    while (status == PIA_OK && *picked < most) {
        double error;
        pia_index row = worst_row(fit, blocked, &error);
        if (row < 0 || (*picked > 0 && error <= fit->solve.rules.tolerance)) break;
        for (int d = 0; d < fit->directions; d++) add_line(s, d, pia_sequence_line(fit, row, d), blocked[d]);
        ++*picked;
    }
    for (int d = 0; d < 2; d++) pia_give(fit->context, blocked[d]);
    return status;
}

/* ---- growing ---- */

/* Replaces *model by one with the parameters of the added lines as knots of direction d. */
static pia_status insert_added(pia_fit *fit, int d, pia_model **model)
{
    const pia_sequence *s = fit->sequence;
    pia_index count = 0;
    double *values = pia_take(fit->context, s->lines[d], sizeof *values);
    if (values == NULL) return PIA_E_MEMORY;
    for (pia_index i = 0; i < s->lines[d]; i++)
        if (s->mark[d][i] == PIA_LINE_ADDED) values[count++] = s->parameter[d][i];
    pia_model *finer = NULL;
    pia_status status = count > 0 ? pia_model_insert_knots(fit->context, *model, d, values, count, &finer) : PIA_OK;
    pia_give(fit->context, values);
    if (finer == NULL) return status;
    pia_model_destroy(*model);
    *model = finer;
    return status;
}

/* The current spline with the added parameters as knots. */
static pia_status refine_model(pia_fit *fit, pia_model **out)
{
    pia_status status = pia_model_new(fit->context, fit->directions, fit->degree, fit->full, fit->dim, 0, out);
    if (status != PIA_OK) return status;
    for (int d = 0; d < fit->directions; d++)
        memcpy((*out)->knots[d], fit->knots[d], (size_t)(fit->full[d] + fit->degree[d] + 1) * sizeof(double));
    memcpy((*out)->points, fit->iterate.points, (size_t)(fit->op->cols * fit->dim) * sizeof(double));
    for (int d = 0; d < fit->directions && status == PIA_OK; d++) status = insert_added(fit, d, out);
    return status;
}

pia_status pia_sequence_grow(pia_fit *fit, int carry)
{
    pia_model *finer = NULL;
    if (fit->op->frozen != NULL) pia_fit_note_add(fit, "control points were freed: knots were inserted");
    pia_status status = carry ? refine_model(fit, &finer) : PIA_OK;
    if (status == PIA_OK) status = pia_sequence_place(fit);
    if (status == PIA_OK) status = pia_fit_assemble(fit);
    if (status == PIA_OK && carry) memcpy(fit->iterate.points, finer->points, (size_t)(fit->op->cols * fit->dim) * sizeof(double));
    pia_model_destroy(finer);
    return status;
}
