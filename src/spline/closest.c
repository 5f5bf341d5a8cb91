#include <math.h>

#include "evaluate.h"
#include "finite.h"
#include "foot.h"
#include "kernel.h"

enum { GRAIN = 256 };

static double square_to_box(const pia_foot *f, pia_index node)
{
    int dim = f->pieces->bezier->dim;
    const double *low = f->pieces->box + node * 2 * dim, *high = low + dim;
    double sum = 0;
    for (int c = 0; c < dim; c++) {
        double below = low[c] - f->point[c], above = f->point[c] - high[c];
        double gap = below > 0 ? below : above > 0 ? above : 0;
        sum += gap / f->scale * (gap / f->scale);
    }
    return sum;
}

/* Depth first, the nearer half first; what is no nearer than the best candidate is left out. */
static void descend(pia_foot *f, const pia_block *block)
{
    if (pia_block_is_piece(block)) {
        pia_foot_search(f, block->begin);
        return;
    }
    pia_block half[2];
    pia_block_halve(block, half);
    double square[2] = {square_to_box(f, half[0].node), square_to_box(f, half[1].node)};
    int first = square[1] < square[0];
    if (square[first] < f->minimum.value) descend(f, &half[first]);
    if (square[1 - first] < f->minimum.value) descend(f, &half[1 - first]);
}

/* The farthest that the model can be along one axis; INFINITY when that cannot be told in a double. */
static double reach(const pia_pieces *pieces, const double *point)
{
    int dim = pieces->bezier->dim;
    double far = 0;
    for (int c = 0; c < dim; c++) far = fmax(far, fmax(fabs(point[c] - pieces->box[c]), fabs(pieces->box[dim + c] - point[c])));
    return far;
}

typedef struct sweep {
    const pia_model *model;
    pia_pieces pieces;
    const double *points;
    pia_index count, chunks;
    double *parameters, *distances;
} sweep;

static void find_foot(const sweep *s, pia_foot *f, pia_index index, pia_index hint[2])
{
    int dim = s->model->dim, directions = s->model->directions;
    const double *point = s->points + index * dim;
    pia_foot_start(f, point, reach(&s->pieces, point));
    pia_block root = pia_block_root(&s->pieces);
    descend(f, &root);
    double at[PIA_MAX_DIM], sum = 0;
    pia_evaluate(s->model, f->parameter, 0, hint, at);
    for (int c = 0; c < dim; c++) sum += (at[c] - point[c]) / f->scale * ((at[c] - point[c]) / f->scale);
    for (int d = 0; s->parameters != NULL && d < directions; d++) s->parameters[index * directions + d] = f->parameter[d];
    if (s->distances != NULL) s->distances[index] = f->scale * sqrt(sum);
}

static void closest_of_chunk(void *work, pia_index chunk)
{
    const sweep *s = work;
    pia_foot foot;
    pia_foot_open(&s->pieces, &foot);
    pia_index hint[2] = {0, 0}, end = pia_chunk_begin(s->count, s->chunks, chunk + 1);
    for (pia_index i = pia_chunk_begin(s->count, s->chunks, chunk); i < end; i++) find_foot(s, &foot, i, hint);
}

static pia_status check_reach(pia_context *context, const sweep *s)
{
    for (pia_index i = 0; i < s->count; i++)
        if (!isfinite(reach(&s->pieces, s->points + i * s->model->dim)))
            return pia_fail(context, PIA_E_DATA, "point %lld is too far from the model for its distance to be a number; scale both",
                            (long long)i);
    return PIA_OK;
}

pia_status pia_model_closest(pia_context *context, const pia_model *model, const double *points, pia_index count, double *parameters,
                             double *distances)
{
    if (model == NULL) return pia_fail(context, PIA_E_ARGUMENT, "pia_model_closest needs a model");
    pia_status status = pia_check_finite(context, "point", points, count, model->dim);
    if (status != PIA_OK) return status;
    sweep s = {.model = model, .points = points, .count = count, .parameters = parameters, .distances = distances};
    s.chunks = pia_chunk_count(count, GRAIN);
    status = pia_pieces_open(context, model, &s.pieces);
    if (status != PIA_OK) return status;
    status = check_reach(context, &s);
    if (status == PIA_OK) pia_for_each(context, s.chunks, closest_of_chunk, &s);
    pia_pieces_close(context, &s.pieces);
    return status;
}
