/* The extremes of one component at a time, each the minimum of a quotient of Bernstein polynomials. */
#include <float.h>
#include <math.h>
#include <string.h>

#include "minimum.h"
#include "pieces.h"

enum { BUDGET = 1 << 17 };

/* One end of one component: sign 1 for its smallest value, -1 for its largest, turned over. Values are taken from `centre`, where
 * rounding is least. */
typedef struct extreme {
    const pia_pieces *pieces;
    int component, width; /* width 2 with the weight */
    double sign, centre;
    pia_minimum minimum;
    double piece[2 * PIA_PIECE_COUNT], part[2 * PIA_PIECE_COUNT];
} extreme;

static void expand(pia_minimum *minimum, const pia_cell *cell)
{
    extreme *e = minimum->user;
    const int *degree = e->pieces->bezier->degree, count = (degree[0] + 1) * (degree[1] + 1);
    memcpy(e->part, e->piece, (size_t)(count * e->width) * sizeof *e->part);
    for (int d = 0; d < minimum->directions; d++) pia_bernstein_restrict(e->part, degree, e->width, d, cell->low[d], cell->high[d]);
    for (int k = 0; k < count; k++) {
        minimum->numerator[k] = e->part[k * e->width];
        if (minimum->rational) minimum->denominator[k] = e->part[k * e->width + 1];
    }
}

static void look(const pia_minimum *minimum, const double at[2], pia_look *out)
{
    const extreme *e = minimum->user;
    pia_bernstein_rows r;
    pia_bernstein_look(e->piece, e->pieces->bezier->degree, e->width, minimum->rational, at, r);
    *out = (pia_look){.at = {at[0], at[1]},
                      .value = r[PIA_S][0],
                      .slope = {r[PIA_SU][0], r[PIA_SV][0]},
                      .hessian = {r[PIA_SUU][0], r[PIA_SUV][0], r[PIA_SVV][0]}};
}

static void load(extreme *e, const pia_index piece[2])
{
    const pia_model *m = e->pieces->bezier;
    double control[PIA_PIECE_COUNT * PIA_MAX_WIDTH];
    int width = pia_model_width(m), count = (m->degree[0] + 1) * (m->degree[1] + 1);
    pia_piece_control(e->pieces, piece, control);
    for (int k = 0; k < count; k++) {
        double w = m->rational ? control[k * width + m->dim] : 1;
        e->piece[k * e->width] = e->sign * (control[k * width + e->component] - w * e->centre);
        if (m->rational) e->piece[2 * k + 1] = w;
    }
}

/* The block whose box promises less comes first. */
static void descend(extreme *e, const pia_block *block)
{
    if (pia_block_is_piece(block)) {
        load(e, block->begin);
        e->minimum.budget = BUDGET;
        pia_minimum_find(&e->minimum);
        return;
    }
    pia_block half[2];
    pia_block_halve(block, half);
    double least[2];
    int dim = e->pieces->bezier->dim;
    for (int k = 0; k < 2; k++)
        least[k] = e->sign * (e->pieces->box[(2 * half[k].node + (e->sign < 0)) * dim + e->component] - e->centre);
    for (int k = 0, h = least[1] < least[0]; k < 2; k++, h = 1 - h)
        if (least[h] < e->minimum.value) descend(e, &half[h]);
}

static double find_extreme(const pia_pieces *pieces, int component, double sign)
{
    const pia_model *m = pieces->bezier;
    double low = pieces->box[component], high = pieces->box[m->dim + component];
    extreme e = {.pieces = pieces, .component = component, .width = 1 + m->rational, .sign = sign, .centre = low + (high - low) / 2};
    e.minimum.directions = m->directions;
    e.minimum.rational = m->rational;
    e.minimum.absolute = 1e-14 * (high - low) + 8 * DBL_EPSILON * fmax(fabs(low), fabs(high));
    e.minimum.user = &e;
    e.minimum.expand = expand;
    e.minimum.look = look;
    e.minimum.value = INFINITY;
    for (int d = 0; d < 2; d++) e.minimum.degree[d] = m->degree[d];
    pia_block root = pia_block_root(pieces);
    descend(&e, &root);
    return e.centre + sign * e.minimum.value;
}

pia_status pia_model_bounds(pia_context *context, const pia_model *model, double *low, double *high)
{
    if (model == NULL || low == NULL || high == NULL)
        return pia_fail(context, PIA_E_ARGUMENT, "pia_model_bounds needs a model, low and high");
    pia_pieces pieces;
    pia_status status = pia_pieces_open(context, model, &pieces);
    if (status != PIA_OK) return status;
    for (int c = 0; c < model->dim; c++) {
        low[c] = find_extreme(&pieces, c, 1);
        high[c] = find_extreme(&pieces, c, -1);
    }
    pia_pieces_close(context, &pieces);
    return PIA_OK;
}
