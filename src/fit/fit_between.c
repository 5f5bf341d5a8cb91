/* What a curve that keeps its tolerance at the points does between them: nothing asks it to stay near the straight line there, and
 * where points are far apart beside the curve's own spans it may swing out. Looked at where a gap takes a good part of a span. */
#include "fit.h"

#include "model.h"

#include <math.h>

/* Places looked at in a gap; parts of a span that a gap has to be longer than; how many times the tolerance is worth a note. */
enum { PLACES = 3, PARTS = 16, WORTH = 3 };

typedef struct gaps {
    pia_index *row; /* [count] rows that the gaps begin with */
    double *at;     /* [count x PLACES] parameters */
    pia_index count;
} gaps;

static double after(const pia_fit *fit, pia_index row)
{
    return row + 1 < fit->rows ? fit->parameter[0][row + 1] : fit->parameter[0][0] + 1;
}

/* Gaps that are wide beside the span they begin in. */
static pia_status find_gaps(pia_fit *fit, gaps *g)
{
    pia_index last = fit->closed[0] ? fit->rows : fit->rows - 1, span = fit->degree[0];
    double high = fit->knots[0][fit->full[0]];
    *g = (gaps){.row = pia_take(fit->context, fit->rows, sizeof *g->row),
                .at = pia_take(fit->context, PLACES * fit->rows, sizeof *g->at)};
    if (g->row == NULL || g->at == NULL) return PIA_E_MEMORY;
    for (pia_index row = 0; row < last; row++) {
        double from = fit->parameter[0][row], width = after(fit, row) - from;
        span = pia_collocation_advance(&fit->line[0], row, span);
        if (!(PARTS * width > fit->knots[0][span + 1] - fit->knots[0][span])) continue;
        for (int k = 0; k < PLACES; k++) {
            double t = from + width * (k + 1) / (PLACES + 1);
            g->at[PLACES * g->count + k] = t > high ? t - 1 : t;
        }
        g->row[g->count++] = row;
    }
    return PIA_OK;
}

static double distance_to_segment(const double *x, const double *a, const double *b, int dim)
{
    double along = 0, length = 0, square = 0;
    for (int d = 0; d < dim; d++) {
        along += (x[d] - a[d]) * (b[d] - a[d]);
        length += (b[d] - a[d]) * (b[d] - a[d]);
    }
    double share = length > 0 ? fmin(fmax(along / length, 0), 1) : 0;
    for (int d = 0; d < dim; d++) square += pow(x[d] - a[d] - share * (b[d] - a[d]), 2);
    return sqrt(square);
}

static pia_status look(pia_fit *fit, const gaps *g)
{
    int dim = fit->dim, wide = dim + fit->function_graph; /* the model of a graph has the abscissa, too */
    pia_model *model = NULL;
    double *value = pia_take(fit->context, PLACES * g->count * wide, sizeof *value);
    pia_status status = value != NULL ? pia_fit_bare_model(fit, &model) : PIA_E_MEMORY;
    if (status == PIA_OK) status = pia_model_eval(fit->context, model, g->at, PLACES * g->count, 0, value);
    for (pia_index k = 0; k < PLACES * g->count && status == PIA_OK; k++) {
        pia_index row = g->row[k / PLACES], next = row + 1 < fit->rows ? row + 1 : 0;
        const double *at = value + k * wide + fit->function_graph;
        double distance = distance_to_segment(at, fit->points + row * dim, fit->points + next * dim, dim);
        if (distance <= fit->between_error) continue;
        fit->between_error = distance;
        fit->between_row = row;
    }
    pia_model_destroy(model);
    pia_give(fit->context, value);
    return status;
}

void pia_fit_look_between(pia_fit *fit)
{
    gaps g;
    fit->between_error = NAN;
    fit->between_row = -1;
    if (!fit->refining || fit->directions != 1) return;
    pia_status status = find_gaps(fit, &g);
    if (status == PIA_OK) {
        fit->between_error = 0;
        status = g.count > 0 ? look(fit, &g) : PIA_OK;
    }
    if (status != PIA_OK) fit->between_error = NAN;
    pia_give(fit->context, g.row);
    pia_give(fit->context, g.at);
    if (!(fit->between_error > WORTH * fit->options.tolerance)) return;
    pia_index row = fit->row != NULL ? fit->row[fit->between_row] : fit->between_row;
    pia_note_add(
        pia_memory_of(fit->context), &fit->outcome,
        "between the points, behind row %lld, the curve is up to %g away from the straight line, %.3g times the tolerance, which "
        "holds at the points; more points there, corners or a lower degree keep it closer",
        (long long)row, fit->between_error, fit->between_error / fit->options.tolerance);
}
