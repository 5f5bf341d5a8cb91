/* What is worth saying of the current result: written anew whenever the iteration stops or a model is taken, so that it is never stale.
 */
#include "fit.h"
#include "sequence.h"
#include "shape.h"

#include <stdio.h>
#include <string.h>

void pia_fit_outcome_add(pia_fit *fit, const char *text, const pia_index *list, pia_index count)
{
    char line[480];
    int used = snprintf(line, sizeof line, "%lld %s:", (long long)count, text);
    for (pia_index i = 0; i < count && i < PIA_LISTED && used < (int)sizeof line - 32; i++)
        used += snprintf(line + used, sizeof line - (size_t)used, "%s %lld", i > 0 ? "," : "", (long long)list[i]);
    pia_note_add(pia_memory_of(fit->context), &fit->outcome, "%s%s", line, count > PIA_LISTED ? ", ..." : "");
}

/* The guarantee of the limiters is for the polygon: inflections are counted on data, polygon and curve, and it is said whether the
 * curve has to follow its polygon. */
static void describe_shape(pia_fit *fit)
{
    const pia_memory *memory = pia_memory_of(fit->context);
    pia_model *model;
    pia_index on_curve;
    if (fit->solve.limiter == NULL || fit->directions != 1 || fit->dim != 2 || fit->function_graph) return;
    if (pia_fit_bare_model(fit, &model) != PIA_OK) return;
    if (pia_curve_inflections(fit->context, model, &on_curve) == PIA_OK)
        pia_note_add(memory, &fit->outcome, "inflections: %lld of the data polygon, %lld of the control polygon, %lld of the curve",
                     (long long)pia_polygon_inflections(fit->points, fit->rows, fit->closed[0]),
                     (long long)pia_polygon_inflections(fit->iterate.points, fit->op->cols, fit->closed[0]), (long long)on_curve);
    pia_model_destroy(model);
    pia_index wide = pia_polygon_first_wide_turn(pia_op_full(fit->op, fit->iterate.points, 2), fit->op->fulls, fit->degree[0]);
    if (wide < 0)
        pia_note_add(memory, &fit->outcome, "the curve bends as its control polygon does: any %d legs in a row turn by less than pi",
                     fit->degree[0]);
    else
        pia_note_add(
            memory, &fit->outcome,
            "legs %lld to %lld of the control polygon turn by pi or more in all: the curve may have inflections that the polygon "
            "has not",
            (long long)wide, (long long)wide + fit->degree[0] - 1);
}

void pia_fit_conclude(pia_fit *fit)
{
    pia_notes_clear(pia_memory_of(fit->context), &fit->outcome);
    describe_shape(fit);
    pia_fit_describe_directions(fit);
    pia_fit_describe_outliers(fit);
    pia_fit_describe_axes(fit);
    pia_fit_look_between(fit);
    if (fit->iterate.groups != NULL) pia_epia_outcome(fit);
    pia_fit_describe_support(fit);
}
