#include "sparse.h"

#include <suitesparse/cholmod.h>

struct pia_sparse {
    pia_context *context;
    cholmod_common common;
    cholmod_factor *factor; /* LDL', columns of L with D as their first entry */
    double *work;           /* [n x PIA_MAX_DIM] */
};

static cholmod_sparse *compress(const pia_triplets *matrix, cholmod_common *common)
{
    cholmod_triplet triplet = {.nrow = (size_t)matrix->n,
                               .ncol = (size_t)matrix->n,
                               .nzmax = (size_t)matrix->count,
                               .nnz = (size_t)matrix->count,
                               .i = matrix->row,
                               .j = matrix->column,
                               .x = matrix->value,
                               .stype = -1,
                               .itype = CHOLMOD_LONG,
                               .xtype = CHOLMOD_REAL,
                               .dtype = CHOLMOD_DOUBLE};
    return cholmod_l_triplet_to_sparse(&triplet, (size_t)matrix->count, common);
}

static void factorise(pia_sparse *s, const pia_triplets *matrix)
{
    cholmod_sparse *compressed = compress(matrix, &s->common);
    if (compressed == NULL) return;
    s->factor = cholmod_l_analyze(compressed, &s->common);
    if (s->factor != NULL) cholmod_l_factorize(compressed, s->factor, &s->common);
    cholmod_l_free_sparse(&compressed, &s->common);
}

static pia_index count_weak(const cholmod_factor *factor, double threshold)
{
    const SuiteSparse_long *begin = factor->p;
    const double *entry = factor->x;
    pia_index weak = 0;
    for (size_t j = 0; j < factor->n; j++) weak += !(entry[begin[j]] > threshold);
    return weak;
}

pia_status pia_sparse_factor(pia_context *context, const pia_triplets *matrix, double threshold, pia_sparse **out, pia_index *weak)
{
    *out = NULL;
    pia_sparse *s = pia_take_zero(context, 1, sizeof *s);
    if (s == NULL) return pia_take_status(context, 1, sizeof *s);
    s->context = context;
    cholmod_l_start(&s->common);
    s->common.supernodal = CHOLMOD_SIMPLICIAL; /* the supernodal module is not ours to use: it is under the GPL */
    s->common.print = 0;
    factorise(s, matrix);
    s->work = pia_take(context, matrix->n, PIA_MAX_DIM * sizeof *s->work);
    int singular = s->common.status == CHOLMOD_NOT_POSDEF,
        complete = s->factor != NULL && s->work != NULL && s->common.status == CHOLMOD_OK;
    if (complete) {
        *weak = count_weak(s->factor, threshold);
        *out = s;
        return PIA_OK;
    }
    int too_large = s->common.status == CHOLMOD_TOO_LARGE;
    pia_sparse_close(s);
    *weak = singular;
    if (singular) return PIA_OK;
    return pia_fail(context, too_large ? PIA_E_SIZE : PIA_E_MEMORY, "no room for the factors of a system of %lld unknowns; use cg-kron",
                    (long long)matrix->n);
}

void pia_sparse_close(pia_sparse *s)
{
    if (s == NULL) return;
    cholmod_l_free_factor(&s->factor, &s->common);
    cholmod_l_finish(&s->common);
    pia_give(s->context, s->work);
    pia_give(s->context, s);
}

/* x := L^-1 x, then D^-1, then L'^-1. */
static void solve_permuted(const cholmod_factor *factor, double *x, int dim)
{
    const SuiteSparse_long *begin = factor->p, *count = factor->nz, *row = factor->i;
    const double *entry = factor->x;
    pia_index n = (pia_index)factor->n;
    for (pia_index j = 0; j < n; j++)
        for (pia_index k = begin[j] + 1; k < begin[j] + count[j]; k++)
            for (int d = 0; d < dim; d++) x[row[k] * dim + d] -= entry[k] * x[j * dim + d];
    for (pia_index j = n - 1; j >= 0; j--) {
        for (int d = 0; d < dim; d++) x[j * dim + d] /= entry[begin[j]];
        for (pia_index k = begin[j] + 1; k < begin[j] + count[j]; k++)
            for (int d = 0; d < dim; d++) x[j * dim + d] -= entry[k] * x[row[k] * dim + d];
    }
}

void pia_sparse_solve(const pia_sparse *s, double *b, int dim)
{
    const SuiteSparse_long *order = s->factor->Perm;
    pia_index n = (pia_index)s->factor->n;
    for (pia_index i = 0; i < n; i++)
        for (int d = 0; d < dim; d++) s->work[i * dim + d] = b[order[i] * dim + d];
    solve_permuted(s->factor, s->work, dim);
    for (pia_index i = 0; i < n; i++)
        for (int d = 0; d < dim; d++) b[order[i] * dim + d] = s->work[i * dim + d];
}
