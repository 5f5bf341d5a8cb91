/* Row i of L reaches from the first entry of row i of the matrix to the diagonal: fill stays inside this envelope. */
#include "sparse.h"

#include <math.h>
#include <string.h>

struct pia_sparse {
    pia_context *context;
    pia_index n;
    pia_index *first; /* [n] first column of a row */
    pia_index *begin; /* [n + 1] where the row starts in entry */
    double *entry;
};

static double *at(const pia_sparse *s, pia_index i, pia_index j)
{
    return s->entry + s->begin[i] + (j - s->first[i]);
}

static pia_status take_envelope(pia_sparse *s, const pia_triplets *matrix)
{
    s->first = pia_take(s->context, s->n, sizeof *s->first);
    s->begin = pia_take(s->context, s->n + 1, sizeof *s->begin);
    if (s->first == NULL || s->begin == NULL) return pia_take_status(s->context, s->n + 1, sizeof *s->begin);
    for (pia_index i = 0; i < s->n; i++) s->first[i] = i;
    for (pia_index k = 0; k < matrix->count; k++)
        if (matrix->column[k] < s->first[matrix->row[k]]) s->first[matrix->row[k]] = matrix->column[k];
    s->begin[0] = 0;
    for (pia_index i = 0; i < s->n; i++)
        if (__builtin_add_overflow(s->begin[i], i - s->first[i] + 1, &s->begin[i + 1])) return PIA_E_SIZE;
    s->entry = pia_take_zero(s->context, s->begin[s->n], sizeof *s->entry);
    return s->entry != NULL ? PIA_OK : pia_take_status(s->context, s->begin[s->n], sizeof *s->entry);
}

static double product(const double *x, const double *y, pia_index count)
{
    double sum[4] = {0};
    pia_index k = 0;
    for (; k + 4 <= count; k += 4)
        for (int lane = 0; lane < 4; lane++) sum[lane] += x[k + lane] * y[k + lane];
    for (; k < count; k++) sum[0] += x[k] * y[k];
    return (sum[0] + sum[1]) + (sum[2] + sum[3]);
}

/* Returns the pivots that are at most threshold, -1 when one is not positive. */
static pia_index factorise(pia_sparse *s, double threshold)
{
    pia_index weak = 0;
    for (pia_index i = 0; i < s->n; i++) {
        double *row = s->entry + s->begin[i];
        for (pia_index j = s->first[i]; j <= i; j++) {
            pia_index from = s->first[i] > s->first[j] ? s->first[i] : s->first[j];
            double left = *at(s, i, j) - product(at(s, i, from), at(s, j, from), j - from);
            if (j < i) {
                row[j - s->first[i]] = left / *at(s, j, j);
            } else {
                if (!(left > 0)) return -1;
                weak += left <= threshold;
                row[j - s->first[i]] = sqrt(left);
            }
        }
    }
    return weak;
}

pia_status pia_sparse_factor(pia_context *context, const pia_triplets *matrix, double threshold, pia_sparse **out, pia_index *weak)
{
    *out = NULL;
    pia_sparse *s = pia_take_zero(context, 1, sizeof *s);
    if (s == NULL) return pia_take_status(context, 1, sizeof *s);
    s->context = context;
    s->n = matrix->n;
    pia_status status = take_envelope(s, matrix);
    if (status != PIA_OK) {
        pia_sparse_close(s);
        return status;
    }
    for (pia_index k = 0; k < matrix->count; k++) *at(s, matrix->row[k], matrix->column[k]) += matrix->value[k];
    *weak = factorise(s, threshold);
    if (*weak >= 0) {
        *out = s;
        return PIA_OK;
    }
    *weak = 1;
    pia_sparse_close(s);
    return PIA_OK;
}

void pia_sparse_close(pia_sparse *s)
{
    if (s == NULL) return;
    pia_give(s->context, s->first);
    pia_give(s->context, s->begin);
    pia_give(s->context, s->entry);
    pia_give(s->context, s);
}

void pia_sparse_solve(const pia_sparse *s, double *b, int dim)
{
    for (pia_index i = 0; i < s->n; i++) {
        const double *row = s->entry + s->begin[i] - s->first[i];
        for (pia_index j = s->first[i]; j < i; j++)
            for (int d = 0; d < dim; d++) b[i * dim + d] -= row[j] * b[j * dim + d];
        for (int d = 0; d < dim; d++) b[i * dim + d] /= row[i];
    }
    for (pia_index i = s->n - 1; i >= 0; i--) {
        const double *row = s->entry + s->begin[i] - s->first[i];
        for (int d = 0; d < dim; d++) b[i * dim + d] /= row[i];
        for (pia_index j = s->first[i]; j < i; j++)
            for (int d = 0; d < dim; d++) b[j * dim + d] -= row[j] * b[i * dim + d];
    }
}
