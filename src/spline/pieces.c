#include "pieces.h"

#include <math.h>
#include <string.h>

pia_block pia_block_root(const pia_pieces *pieces)
{
    return (pia_block){.end = {pieces->count[0], pieces->count[1]}};
}

int pia_block_is_piece(const pia_block *block)
{
    return block->end[0] - block->begin[0] == 1 && block->end[1] - block->begin[1] == 1;
}

void pia_block_halve(const pia_block *block, pia_block half[2])
{
    pia_index length[2] = {block->end[0] - block->begin[0], block->end[1] - block->begin[1]};
    int d = length[1] > length[0];
    pia_index middle = block->begin[d] + length[d] / 2;
    half[0] = half[1] = *block;
    half[0].end[d] = half[1].begin[d] = middle;
    half[0].node = block->node + 1;
    half[1].node = block->node + 2 * (length[d] / 2) * length[1 - d];
}

void pia_piece_control(const pia_pieces *pieces, const pia_index piece[2], double *out)
{
    const pia_model *m = pieces->bezier;
    int width = pia_model_width(m);
    size_t row = (size_t)((m->degree[1] + 1) * width);
    for (int i = 0; i <= m->degree[0]; i++) {
        pia_index from = (piece[0] * m->degree[0] + i) * m->control[1] + piece[1] * m->degree[1];
        memcpy(out + (size_t)i * row, m->points + from * width, row * sizeof *out);
    }
}

void pia_piece_interval(const pia_pieces *pieces, pia_index piece, int d, double *low, double *high)
{
    int degree = pieces->bezier->degree[d];
    *low = pieces->bezier->knots[d][piece * degree + degree];
    *high = pieces->bezier->knots[d][piece * degree + degree + 1];
}

/* The box of a piece is that of its control points, which hold it in their hull. */
static void box_of_piece(const pia_pieces *pieces, const pia_index piece[2], double *box)
{
    const pia_model *m = pieces->bezier;
    int width = pia_model_width(m), dim = m->dim;
    for (int c = 0; c < dim; c++) {
        box[c] = INFINITY;
        box[dim + c] = -INFINITY;
    }
    for (int i = 0; i <= m->degree[0]; i++)
        for (int j = 0; j <= m->degree[1]; j++) {
            pia_index at = (piece[0] * m->degree[0] + i) * m->control[1] + piece[1] * m->degree[1] + j;
            const double *point = m->points + at * width;
            double w = m->rational ? point[dim] : 1;
            for (int c = 0; c < dim; c++) {
                box[c] = fmin(box[c], point[c] / w);
                box[dim + c] = fmax(box[dim + c], point[c] / w);
            }
        }
}

static void fill_boxes(pia_pieces *pieces, const pia_block *block)
{
    int dim = pieces->bezier->dim;
    double *box = pieces->box + block->node * 2 * dim;
    if (pia_block_is_piece(block)) {
        box_of_piece(pieces, block->begin, box);
        return;
    }
    pia_block half[2];
    pia_block_halve(block, half);
    const double *part[2];
    for (int k = 0; k < 2; k++) {
        fill_boxes(pieces, &half[k]);
        part[k] = pieces->box + half[k].node * 2 * dim;
    }
    for (int c = 0; c < dim; c++) {
        box[c] = fmin(part[0][c], part[1][c]);
        box[dim + c] = fmax(part[0][dim + c], part[1][dim + c]);
    }
}

pia_status pia_pieces_open(pia_context *context, const pia_model *model, pia_pieces *out)
{
    *out = (pia_pieces){.count = {1, 1}};
    pia_status status = pia_model_bezier(context, model, &out->bezier);
    if (status != PIA_OK) return status;
    for (int d = 0; d < model->directions; d++) out->count[d] = (out->bezier->control[d] - 1) / model->degree[d];
    /* No more than twice the control points that are already there, so the product is known to fit. */
    pia_index values = (2 * out->count[0] * out->count[1] - 1) * 2 * model->dim;
    out->box = pia_take(context, values, sizeof *out->box);
    if (out->box == NULL) {
        pia_pieces_close(context, out);
        return pia_take_status(context, values, sizeof *out->box);
    }
    pia_block root = pia_block_root(out);
    fill_boxes(out, &root);
    return PIA_OK;
}

void pia_pieces_close(pia_context *context, pia_pieces *pieces)
{
    pia_model_destroy(pieces->bezier);
    pia_give(context, pieces->box);
    *pieces = (pia_pieces){0};
}
