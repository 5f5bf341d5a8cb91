#include "orthogonal.h"

#include <math.h>
#include <string.h>

static const double nothing = 1e-14; /* a diagonal of R that is rounding beside the largest */

/* Rows go in by their first column; a pulled unknown has its row before those that begin after it. */
typedef struct rows {
    const pia_normal *normal;
    const pia_collocation *line;
    const pia_targets *targets;
    const double *x;
    pia_band_qr *qr;
    pia_index pulled; /* unknowns whose pull is in */
} rows;

int pia_orthogonal_suits(const pia_normal *normal)
{
    const pia_op *op = normal->op;
    return op->directions == 1 && op->line[0]->map != PIA_MAP_CYCLIC && op->cols > op->line[0]->degree && normal->energy == NULL;
}

static int is_frozen(const rows *r, pia_index unknown)
{
    const unsigned char *frozen = r->normal->op->frozen;
    return frozen != NULL && frozen[unknown];
}

static void pull_until(rows *r, pia_index end)
{
    const pia_normal *normal = r->normal;
    int width = r->qr->width, dim = r->qr->dim;
    double root = sqrt(normal->pull), entry[PIA_MAX_DEGREE + 1], right[PIA_MAX_DIM];
    for (; normal->pull > 0 && r->pulled < end; r->pulled++) {
        pia_index i = r->pulled, first = i < r->qr->columns - width ? i : r->qr->columns - width;
        if (is_frozen(r, i)) continue;
        memset(entry, 0, sizeof entry);
        entry[i - first] = root;
        for (int d = 0; d < dim; d++) right[d] = root * (normal->start[i * dim + d] - r->x[i * dim + d]);
        pia_band_qr_add(r->qr, first, entry, right);
    }
}

static void add_row(rows *r, pia_index row, pia_index span)
{
    const double *weights = r->normal->op->weights;
    int width = r->qr->width, dim = r->qr->dim;
    double entry[PIA_MAX_DEGREE + 1], right[PIA_MAX_DIM], root = weights != NULL ? sqrt(weights[row]) : 1;
    pia_index first;
    pia_collocation_entries(r->line, row, span, &first, entry);
    pull_until(r, first);
    for (int d = 0; d < dim; d++) {
        right[d] = r->targets->points[row * dim + d] - r->targets->origin[d];
        for (int k = 0; k < width; k++) right[d] -= entry[k] * r->x[(first + k) * dim + d];
        right[d] *= root;
    }
    for (int k = 0; k < width; k++) entry[k] = is_frozen(r, first + k) ? 0 : root * entry[k];
    pia_band_qr_add(r->qr, first, entry, right);
}

static pia_index count_frozen(const rows *r)
{
    pia_index count = 0;
    for (pia_index i = 0; i < r->qr->columns; i++) count += is_frozen(r, i);
    return count;
}

pia_status pia_orthogonal_correct(const pia_normal *normal, const pia_targets *targets, const double *x, double *d, pia_band_qr *out,
                                  pia_index *weak)
{
    const pia_op *op = normal->op;
    rows r = {.normal = normal, .line = op->line[0], .targets = targets, .x = x, .qr = out};
    pia_status status = pia_band_qr_open(op->context, op->cols, r.line->degree + 1, targets->dim, out);
    if (status != PIA_OK) return status;
    pia_index span = r.line->degree;
    for (pia_index row = 0; row < r.line->rows; row++) {
        span = pia_collocation_advance(r.line, row, span);
        add_row(&r, row, span);
    }
    pull_until(&r, op->cols);
    memset(d, 0, (size_t)(op->cols * targets->dim) * sizeof *d);
    *weak = pia_band_qr_solve(out, nothing, d) - count_frozen(&r);
    return PIA_OK;
}

static pia_index reach(const pia_band_qr *qr, pia_index i)
{
    return qr->columns - 1 - i < qr->width - 1 ? qr->columns - 1 - i : qr->width - 1;
}

void pia_orthogonal_solve(const pia_band_qr *qr, double *b, int dim)
{
    for (pia_index i = 0; i < qr->columns; i++) {
        const double *row = qr->r + i * qr->width;
        for (int c = 0; c < dim; c++) {
            double value = b[i * dim + c] = row[0] != 0 ? b[i * dim + c] / row[0] : 0;
            for (pia_index k = 1; k <= reach(qr, i); k++) b[(i + k) * dim + c] -= row[k] * value;
        }
    }
    for (pia_index i = qr->columns - 1; i >= 0; i--) {
        const double *row = qr->r + i * qr->width;
        for (int c = 0; c < dim; c++) {
            double sum = b[i * dim + c];
            for (pia_index k = 1; k <= reach(qr, i); k++) sum -= row[k] * b[(i + k) * dim + c];
            b[i * dim + c] = row[0] != 0 ? sum / row[0] : 0;
        }
    }
}
