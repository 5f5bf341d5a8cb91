/* Which conditions others imply. Pivoted Cholesky of B B' over the free unknowns takes them in the order of what each adds; where it
 * stops, the rest are combinations of those before: consistent ones are dropped and named, the others contradict. */
#include "conditions.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { NAMED = 5 };
static const double dependent = 1e-10; /* pivots, relative to the largest: squares of lengths */
static const double consistent = 1e-9; /* of the extent: what a dropped condition may be off by */

typedef struct cleaning {
    pia_constraints *c;
    pia_schur s;      /* factored */
    double *matrix;   /* [rank x rank] S */
    double *residual; /* [count x dim] R - B P */
    double *x;        /* [rank x dim of s] */
    double *weights;  /* [rank x dim of s] of the conditions that imply another one */
    unsigned char *keep;
} cleaning;

/* Names of the rows that carry weight in a combination, other than `row`. */
static void name_partners(const cleaning *w, pia_index row, char *text, size_t size)
{
    const pia_constraints *c = w->c;
    char name[PIA_ORIGIN_SIZE];
    size_t used = 0;
    pia_index last = row, named = 0;
    text[0] = '\0';
    for (pia_index a = 0; a < c->rank; a++) {
        pia_index other = c->of[a];
        if (other == row || other == last || !(fabs(w->weights[a * w->s.dim]) > 1e-6)) continue;
        last = other;
        const char *separator = named == 0 ? "" : ", ";
        const char *word = named == NAMED ? "..." : pia_origin_text(&c->origin[other], name);
        int length = snprintf(text + used, size - used, "%s%s", separator, word);
        if (length < 0 || (size_t)length >= size - used || named++ == NAMED) return;
        used += (size_t)length;
    }
}

/* Free scalar unknowns, in conditions. */
static pia_index capacity(const pia_constraints *c)
{
    pia_index room = 0;
    for (pia_index i = 0; i < c->op->cols; i++) room += c->inverse[i] > 0;
    return c->basis != NULL ? room * c->dim : room;
}

static pia_status refuse(const cleaning *w, pia_index condition, double off)
{
    const pia_constraints *c = w->c;
    char name[PIA_ORIGIN_SIZE], partners[320];
    pia_index row = c->of[condition];
    if (c->rank > capacity(c))
        return pia_fail(
            c->context, PIA_E_CONSTRAINT,
            "%lld constraints are more than %lld free control points can meet; ask for more control points, drop constraints "
            "or make them soft",
            (long long)c->count, (long long)(c->basis != NULL ? capacity(c) / c->dim : capacity(c)));
    name_partners(w, row, partners, sizeof partners);
    if (partners[0] == '\0')
        return pia_fail(
            c->context, PIA_E_CONSTRAINT,
            "the constraint at %s cannot be met: the control points that it needs are frozen, and it is off by %.6g; free one of them",
            pia_origin_text(&c->origin[row], name), off);
    return pia_fail(
        c->context, PIA_E_CONSTRAINT,
        "the constraint at %s contradicts those at %s: it is off by %.6g; drop one, ask for more control points there or make "
        "them soft",
        pia_origin_text(&c->origin[row], name), partners, off);
}

/* By how much the combination of the kept conditions that gives condition b misses its right-hand side. */
static double deviation(cleaning *w, pia_index b)
{
    const pia_constraints *c = w->c;
    pia_index n = c->rank;
    int dim = w->s.dim;
    for (pia_index a = 0; a < n; a++)
        for (int d = 0; d < dim; d++) w->weights[a * dim + d] = a > b ? w->matrix[a * n + b] : w->matrix[b * n + a];
    pia_schur_solve_conditions(&w->s, w->weights);
    double square = 0;
    for (int d = 0; d < dim; d++) {
        double off = w->x[b * dim + d];
        for (pia_index a = 0; a < n; a++) off -= w->weights[a * dim + d] * w->x[a * dim + d];
        square += off * off;
    }
    return sqrt(square);
}

static pia_status judge(cleaning *w, const double *points, pia_notes *notes)
{
    pia_constraints *c = w->c;
    char name[PIA_ORIGIN_SIZE], partners[320];
    pia_constraints_residual(c, points, w->residual);
    pia_conditions_gather(c, w->residual, w->x);
    memset(w->keep, 0, (size_t)c->rank);
    for (pia_index k = 0; k < w->s.rank; k++) w->keep[w->s.order[k]] = 1;
    for (pia_index b = 0; b < c->rank; b++) {
        if (w->keep[b]) continue;
        double off = deviation(w, b);
        if (!(off <= consistent * c->extent)) return refuse(w, b, off);
        name_partners(w, c->of[b], partners, sizeof partners);
        if (notes != NULL && !pia_note_add(pia_memory_of(c->context), notes, "the constraint at %s follows from %s%s and was left out",
                                           pia_origin_text(&c->origin[c->of[b]], name),
                                           partners[0] != '\0' ? "those at " : "control points that are frozen", partners))
            return pia_fail(c->context, PIA_E_MEMORY, "out of memory for a note on constraints");
    }
    return PIA_OK;
}

static pia_status take(cleaning *w)
{
    pia_constraints *c = w->c;
    pia_status status = pia_schur_open(c, &w->s);
    if (status != PIA_OK) return status;
    size_t vector = (size_t)c->dim * sizeof(double);
    w->matrix = pia_take(c->context, c->rank * c->rank, sizeof *w->matrix);
    w->residual = pia_take(c->context, c->count, vector);
    w->x = pia_take(c->context, c->rank, vector);
    w->weights = pia_take(c->context, c->rank, vector);
    w->keep = pia_take(c->context, c->rank, 1);
    int ready = w->matrix != NULL && w->residual != NULL && w->x != NULL && w->weights != NULL && w->keep != NULL;
    return ready ? PIA_OK : pia_take_status(c->context, c->rank * c->rank, sizeof *w->matrix);
}

static void give(cleaning *w)
{
    void *blocks[] = {w->matrix, w->residual, w->x, w->weights, w->keep};
    for (size_t i = 0; i < sizeof blocks / sizeof *blocks; i++) pia_give(w->c->context, blocks[i]);
    pia_schur_close(w->c, &w->s);
}

/* Nothing to drop: the factor at hand is the metric's. */
static pia_status settle(cleaning *w)
{
    pia_constraints *c = w->c;
    if (w->s.rank < w->s.size) {
        pia_conditions_keep(c, w->keep);
        return pia_constraints_metric(c, NULL);
    }
    c->metric = w->s;
    w->s = (pia_schur){0};
    return PIA_OK;
}

pia_status pia_constraints_clean(pia_constraints *c, const double *points, pia_notes *notes)
{
    cleaning w = {.c = c};
    for (pia_index i = 0; i < c->op->cols; i++) c->inverse[i] = c->op->frozen == NULL || !c->op->frozen[i];
    pia_status status = take(&w);
    if (status == PIA_OK) {
        pia_schur_of_metric(c, &w.s);
        memcpy(w.matrix, w.s.matrix, (size_t)(c->rank * c->rank) * sizeof *w.matrix);
        pia_schur_factor(&w.s, dependent);
        status = judge(&w, points, notes);
    }
    if (status == PIA_OK) status = settle(&w);
    give(&w);
    return status;
}
