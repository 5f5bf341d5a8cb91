/* The initial control points: the data themselves for interpolation ([2004] Eq. 2), data picked evenly for least squares ([2014]), or
 * those of the start model. */
#include "fit.h"

#include "basis.h"
#include "kernel.h"
#include "knots.h"
#include "model.h"
#include "sequence.h"

#include <math.h>
#include <string.h>

enum { GRAIN = 4096 }; /* control points a thread should get at least */

/* The row of a line that unknown i starts from. */
static pia_index picked_row(const pia_fit *fit, int d, pia_index i)
{
    pia_index n = fit->op->count[d], m = fit->count[d];
    if (fit->square) return i;
    if (fit->sequence != NULL) return fit->sequence->chosen[d][i];
    if (!fit->closed[d]) {
        if (i == n - 1) return m - 1;
        pia_index at = n > 1 ? (pia_index)((double)m * (double)i / (double)(n - 1)) : 0;
        return at < m ? at : m - 1;
    }
    double t = pia_knots_greville(fit->knots[d], fit->degree[d], i), low = fit->knots[d][fit->degree[d]];
    while (t < low) t += 1;
    while (t >= low + 1) t -= 1;
    pia_index a = 0, b = m - 1;
    while (a < b) {
        pia_index middle = a + (b - a) / 2;
        if (fit->parameter[d][middle] < t)
            a = middle + 1;
        else
            b = middle;
    }
    return a;
}

typedef struct picking {
    pia_fit *fit;
    pia_index chunks;
} picking;

static void pick_chunk(void *work, pia_index chunk)
{
    const picking *p = work;
    const pia_fit *fit = p->fit;
    pia_index from = pia_chunk_begin(fit->op->count[0], p->chunks, chunk),
              end = pia_chunk_begin(fit->op->count[0], p->chunks, chunk + 1);
    double *to = fit->iterate.points + from * fit->op->count[1] * fit->dim;
    for (pia_index i = from; i < end; i++) {
        pia_index line = picked_row(fit, 0, i) * fit->count[1];
        for (pia_index j = 0; j < fit->op->count[1]; j++, to += fit->dim) {
            pia_index row = line + (fit->directions == 2 ? picked_row(fit, 1, j) : 0);
            for (int d = 0; d < fit->dim; d++) to[d] = fit->points[row * fit->dim + d] - fit->origin[d];
        }
    }
}

static void from_data(pia_fit *fit)
{
    picking p = {fit, pia_chunk_count(fit->op->cols, GRAIN)};
    if (p.chunks > fit->op->count[0]) p.chunks = fit->op->count[0];
    pia_for_each(fit->context, p.chunks, pick_chunk, &p);
}

/* Means of the data by basis value, for scattered points and grids with holes; unknowns without data take the mean of all. Both are in
 * the normal form already: A'W(Q - origin) over the column sums of WA. */
static void from_means(pia_fit *fit)
{
    const pia_normal *normal = fit->normal;
    double mean[PIA_MAX_DIM] = {0}, total = 0;
    int dim = fit->dim;
    for (pia_index c = 0; c < fit->op->cols; c++) {
        total += normal->column_sum[c];
        for (int d = 0; d < dim; d++) mean[d] += normal->right[c * dim + d];
    }
    for (pia_index c = 0; c < fit->op->cols; c++)
        for (int d = 0; d < dim; d++)
            fit->iterate.points[c * dim + d] =
                normal->column_sum[c] > 0 ? normal->right[c * dim + d] / normal->column_sum[c] : mean[d] / total;
}

pia_status pia_fit_adopt_control(pia_fit *fit, const pia_model *start)
{
    int skip = fit->function_graph, wide = start->dim;
    double *knots[2] = {NULL, NULL};
    pia_index fulls = start->control[0] * start->control[1];
    double *points = pia_take(fit->context, fulls * wide, sizeof *points);
    for (int d = 0; d < fit->directions; d++) knots[d] = pia_take(fit->context, fit->full[d] + fit->degree[d] + 1, sizeof(double));
    pia_status status = points != NULL && knots[0] != NULL && (fit->directions == 1 || knots[1] != NULL) ? PIA_OK : PIA_E_MEMORY;
    if (status == PIA_OK) status = pia_model_to_cyclic(fit->context, start, knots, points);
    for (pia_index i = 0; status == PIA_OK && i < fulls; i++)
        for (int d = 0; d < fit->dim; d++)
            fit->iterate.points[pia_op_unknown(fit->op, i) * fit->dim + d] = points[i * wide + skip + d] - fit->origin[d];
    pia_give(fit->context, points);
    pia_give(fit->context, knots[0]);
    pia_give(fit->context, knots[1]);
    return status;
}

pia_status pia_fit_initial(pia_fit *fit)
{
    if (fit->options.start != NULL) return pia_fit_adopt_control(fit, fit->options.start);
    if (fit->kind == PIA_SCATTERED && pia_fit_is_grouped(fit)) return pia_epia_start(fit);
    if (fit->kind == PIA_SCATTERED || fit->has_holes)
        from_means(fit);
    else if (fit->iterate.points != NULL)
        from_data(fit);
    return PIA_OK;
}
