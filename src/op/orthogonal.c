#include "orthogonal.h"

#include <math.h>
#include <string.h>

static const double nothing = 1e-14; /* a diagonal of R that is rounding beside the largest */
static const double wild = 1e4;      /* a correction so many times what the data ask for comes from columns that are nearly dependent */
static const double damping = 1e-10; /* singular values below this share of the largest are held back then */

/* Rows go in by their first column; a pulled or damped unknown has its row before those that begin after it. */
typedef struct rows {
    const pia_normal *normal;
    const pia_collocation *line;
    const pia_targets *targets;
    const double *x;
    pia_band_qr *qr;
    double damping;   /* of the correction itself: 0 but for a second try */
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
    double root = sqrt(normal->pull + r->damping * r->damping), entry[PIA_MAX_DEGREE + 1], right[PIA_MAX_DIM];
    for (; root > 0 && r->pulled < end; r->pulled++) {
        pia_index i = r->pulled, first = i < r->qr->columns - width ? i : r->qr->columns - width;
        if (is_frozen(r, i)) continue;
        memset(entry, 0, sizeof entry);
        entry[i - first] = root;
        for (int d = 0; d < dim; d++)
            right[d] = normal->pull > 0 ? normal->pull / root * (normal->start[i * dim + d] - r->x[i * dim + d]) : 0;
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

static void add_rows(rows *r)
{
    pia_index span = r->line->degree;
    for (pia_index row = 0; row < r->line->rows; row++) {
        span = pia_collocation_advance(r->line, row, span);
        add_row(r, row, span);
    }
    pull_until(r, r->qr->columns);
}

static double largest(const double *x, pia_index count, int step)
{
    double most = 0;
    for (pia_index i = 0; i < count; i += step) most = fmax(most, fabs(x[i]));
    return most;
}

/* Columns that are nearly dependent need not show on the diagonal of R, but they do in the solution: the rows are taken again, with a
 * row for each unknown that wants no correction. Singular values that are clear of the damping lose nothing by it, and the next
 * correction takes up what the others lost. */
static void damp(rows *r, double *d, pia_index *weak)
{
    pia_band_qr *qr = r->qr;
    pia_band_qr_clear(qr);
    r->pulled = 0;
    add_rows(r);
    memset(d, 0, (size_t)(qr->columns * qr->dim) * sizeof *d);
    *weak = pia_band_qr_solve(qr, nothing, d);
}

pia_status pia_orthogonal_correct(const pia_normal *normal, const pia_targets *targets, const double *x, double *d, pia_band_qr *out,
                                  pia_index *weak)
{
    const pia_op *op = normal->op;
    pia_index size = op->cols * targets->dim;
    rows r = {.normal = normal, .line = op->line[0], .targets = targets, .x = x, .qr = out};
    pia_status status = pia_band_qr_open(op->context, op->cols, r.line->degree + 1, targets->dim, out);
    if (status != PIA_OK) return status;
    add_rows(&r);
    double diagonal = largest(out->r, op->cols * out->width, out->width), right = largest(out->q, size, 1);
    memset(d, 0, (size_t)size * sizeof *d);
    *weak = pia_band_qr_solve(out, nothing, d);
    r.damping = damping * diagonal;
    if (!(largest(d, size, 1) * diagonal <= wild * right)) damp(&r, d, weak);
    *weak -= count_frozen(&r);
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
