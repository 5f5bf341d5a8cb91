#include "groups.h"

#include "kernel.h"

#include <math.h>
#include <string.h>

enum { GRAIN = 8192, MAX_CHUNKS = 256 };

typedef struct pass {
    const pia_groups *groups;
    const double *values;
    pia_index count, chunks;
    int dim;
    double factor;
    double *out;
} pass;

/* What a group's rows add up to. */
typedef struct tally {
    pia_index rows;
    double sum[PIA_MAX_DIM], lengths;
} tally;

static void add_row(tally *t, const double *value, int dim, int lengths)
{
    double square = 0;
    t->rows++;
    for (int d = 0; d < dim; d++) t->sum[d] += value[d];
    if (!lengths) return;
    for (int d = 0; d < dim; d++) square += value[d] * value[d];
    t->lengths += sqrt(square);
}

/* One group, its rows in the order of the data. */
static tally add_group(const pass *p, pia_index c, int lengths)
{
    const pia_groups *g = p->groups;
    tally t = {0};
    if (g->start != NULL) {
        for (pia_index k = g->start[c]; k < g->start[c + 1]; k++) add_row(&t, p->values + g->row[k] * p->dim, p->dim, lengths);
        return t;
    }
    pia_index a = c / g->count[1], b = c % g->count[1];
    for (pia_index i = g->begin[0][a]; i < g->end[0][a]; i++)
        for (pia_index j = g->begin[1][b]; j < g->end[1][b]; j++) add_row(&t, p->values + (i * g->lines + j) * p->dim, p->dim, lengths);
    return t;
}

static int moves(const pia_groups *g, pia_index c)
{
    pia_index at[2] = {c / g->count[1], c % g->count[1]};
    const pia_block *m = g->moving;
    return m == NULL || (at[0] >= m->low[0] && at[0] < m->high[0] && at[1] >= m->low[1] && at[1] < m->high[1]);
}

static void mean_chunk(void *work, pia_index chunk)
{
    const pass *p = work;
    for (pia_index c = pia_chunk_begin(p->count, p->chunks, chunk); c < pia_chunk_begin(p->count, p->chunks, chunk + 1); c++) {
        tally t = {0};
        if (moves(p->groups, c)) t = add_group(p, c, 0);
        for (int d = 0; d < p->dim; d++) p->out[c * p->dim + d] = t.rows > 0 ? p->factor * (t.sum[d] / (double)t.rows) : 0;
    }
}

static void agreement_chunk(void *work, pia_index chunk)
{
    const pass *p = work;
    for (pia_index c = pia_chunk_begin(p->count, p->chunks, chunk); c < pia_chunk_begin(p->count, p->chunks, chunk + 1); c++) {
        tally t = add_group(p, c, 1);
        double square = 0;
        for (int d = 0; d < p->dim; d++) square += t.sum[d] * t.sum[d];
        p->out[c] = t.rows > 1 && t.lengths > 0 ? sqrt(square) / t.lengths : 1;
    }
}

static pass pass_over(const pia_groups *groups, const double *values, int dim, double factor, double *out)
{
    pia_index count = groups->count[0] * groups->count[1], chunks = pia_chunk_count(groups->rows, GRAIN);
    if (chunks > count) chunks = count;
    if (chunks > MAX_CHUNKS) chunks = MAX_CHUNKS;
    return (pass){groups, values, count, chunks, dim, factor, out};
}

void pia_groups_mean(pia_context *context, const pia_groups *groups, const double *values, int dim, double factor, double *means)
{
    pass p = pass_over(groups, values, dim, factor, means);
    pia_for_each(context, p.chunks, mean_chunk, &p);
}

void pia_groups_agreement(pia_context *context, const pia_groups *groups, const double *values, int dim, double *agreement)
{
    pass p = pass_over(groups, values, dim, 1, agreement);
    pia_for_each(context, p.chunks, agreement_chunk, &p);
}

double pia_groups_longest(const pia_groups *groups, const double *values, int dim, const pia_block *box)
{
    pass p = pass_over(groups, values, dim, 1, NULL);
    double longest = 0;
    for (pia_index a = box->low[0]; a < box->high[0]; a++)
        for (pia_index b = box->low[1]; b < box->high[1]; b++) {
            pia_index c = a * groups->count[1] + b;
            double square = 0;
            if (moves(groups, c)) continue;
            tally t = add_group(&p, c, 0);
            for (int d = 0; d < dim && t.rows > 0; d++) square += (t.sum[d] / (double)t.rows) * (t.sum[d] / (double)t.rows);
            longest = fmax(longest, sqrt(square));
        }
    return longest;
}

pia_index pia_groups_empty(const pia_groups *groups)
{
    pia_index empty = 0;
    for (pia_index c = 0; c < groups->count[0] * groups->count[1]; c++) {
        if (groups->start != NULL)
            empty += groups->start[c + 1] == groups->start[c];
        else
            empty += groups->end[0][c / groups->count[1]] <= groups->begin[0][c / groups->count[1]] ||
                     groups->end[1][c % groups->count[1]] <= groups->begin[1][c % groups->count[1]];
    }
    return empty;
}
