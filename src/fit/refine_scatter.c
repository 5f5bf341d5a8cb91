/* A grid whose true distance counts: once its knots are found at the parameters of its lines, every row takes a parameter pair of its
 * own, which may move to its foot point. From there on it is refined as scattered points are. */
#include "refine.h"

#include <math.h>
#include <string.h>

/* Of every row, from those of its lines. */
static double *pairs_of(const pia_fit *fit)
{
    double *pairs = pia_take(fit->context, fit->rows, 2 * sizeof *pairs);
    for (pia_index row = 0; pairs != NULL && row < fit->rows; row++)
        for (int d = 0; d < 2; d++) pairs[2 * row + d] = pia_refine_parameter(fit, d, row);
    return pairs;
}

/* Rows without a value are left out: keep [rows]; their pairs go, too. */
static void find_holes(const pia_fit *fit, unsigned char *keep, double *pairs)
{
    pia_index kept = 0;
    for (pia_index row = 0; row < fit->rows; row++) {
        keep[row] = 1;
        for (int d = 0; d < fit->dim; d++) keep[row] &= !isnan(fit->points[row * fit->dim + d]);
        if (keep[row]) memmove(pairs + 2 * kept++, pairs + 2 * row, 2 * sizeof *pairs);
    }
}

/* The rows of the fit, scattered; the operator is still that of the grid. */
static pia_status scatter_rows(pia_fit *fit)
{
    double *pairs = pairs_of(fit);
    unsigned char *keep = pia_take(fit->context, fit->rows, 1);
    pia_status status = pairs != NULL && keep != NULL ? PIA_OK : PIA_E_MEMORY;
    if (status == PIA_OK) {
        find_holes(fit, keep, pairs);
        status = pia_fit_drop_rows(fit, keep);
    }
    pia_give(fit->context, keep);
    if (status != PIA_OK) {
        pia_give(fit->context, pairs);
        return status;
    }
    for (int d = 0; d < 2; d++) {
        if (!fit->borrowed_parameters) pia_give(fit->context, fit->parameter[d]);
        fit->parameter[d] = NULL;
    }
    fit->borrowed_parameters = 0;
    fit->parameter[0] = pairs;
    fit->kind = PIA_SCATTERED;
    fit->was_grid = 1;
    fit->has_holes = 0;
    fit->count[0] = fit->rows;
    fit->count[1] = 1;
    pia_give(fit->context, fit->relaxed); /* of the rows as they were */
    fit->relaxed = NULL;
    return PIA_OK;
}

pia_status pia_refine_scatter(pia_fit *fit)
{
    pia_saved before;
    pia_status status = pia_refine_save(fit, &before);
    if (status != PIA_OK) return status;
    status = scatter_rows(fit);
    if (status == PIA_OK) status = pia_refine_go_back(fit, &before);
    if (status == PIA_OK) status = fit->iterate.project(&fit->iterate);
    if (status == PIA_OK) status = pia_refine_go_back(fit, &before);
    pia_refine_drop(fit, &before);
    pia_refine_reopen(fit);
    return status;
}
