/* Within a span the basis functions are polynomials: the sums of products of Chebyshev polynomials (kernel/moments.h) become those of
 * basis functions by one small change of basis a span. */
#include "span_sums.h"

#include "kernel.h"
#include "span_lanes.h"
#include "vector.h"

#include <string.h>

/* Below so many points a function, evaluating them is cheaper than the change of basis: FEW to find errors, MANY to sum products.
 * PIECE: rows of a span that one task sums; longer spans are shared between tasks. GRAIN: rows a task gets when spans are short.
 */
enum { FEW = 2, MANY = 16, PIECE = 262144, GRAIN = 16384, MAX_CHUNKS = 256 };

int pia_span_room(int degree, int dim)
{
    return (degree + 1) * (degree + 2) / 2 + (degree + 2) * dim;
}

static const double lost = 1e-12;

static int components(const pia_span_data *data)
{
    return data->targets != NULL ? data->targets->dim : 0;
}

static int has_fewer(const pia_collocation *line, pia_index s, int each)
{
    return line->begin[s + 1] - line->begin[s] < each * (line->degree + 1);
}

int pia_span_is_full(const pia_collocation *line, pia_index s)
{
    return !has_fewer(line, s, FEW);
}

pia_run pia_span_run(const pia_span_data *data, const pia_chebyshev *c, pia_index s, double *coefficient)
{
    const pia_collocation *line = data->line;
    int dim = components(data);
    pia_index from = line->begin[s];
    pia_run run = {.degree = line->degree, .dim = dim, .t = line->parameters + from, .count = line->begin[s + 1] - from};
    pia_chebyshev_span(c, line, s, &run.middle, &run.scale, coefficient);
    if (dim > 0) run.origin = data->targets->origin;
    if (dim > 0) run.points = data->targets->points + from * dim;
    if (data->weights != NULL) run.weights = data->weights + from;
    return run;
}

/* The same, relative to its first point. */
static pia_run centred_run(const pia_span_data *data, const pia_chebyshev *c, pia_index s, double *coefficient)
{
    pia_run run = pia_span_run(data, c, s, coefficient);
    run.origin = run.points;
    return run;
}

static void open_scout(const pia_span_data *data, pia_index from, pia_index to, pia_scout *out)
{
    pia_scout_open(data->line->parameters, data->targets->points, data->targets->dim, from, to, out);
}

/* Rows from .. to - 1 of a run. */
static void sum_rows(const pia_run *run, pia_index from, pia_index to, pia_scout *scout, double *sums)
{
    pia_run part = *run;
    part.count = to - from;
    part.t = run->t + from;
    if (run->points != NULL) part.points = run->points + from * run->dim;
    if (run->weights != NULL) part.weights = run->weights + from;
    pia_run_moments(&part, scout, sums);
}

enum { AT_ONCE = 16 }; /* pieces of a long run */

typedef struct pieces {
    const pia_span_data *data;
    const pia_run *run;
    pia_index first, from, count; /* rows [from, from + count) of the run, whose row 0 is `first` of the line */
    double (*sums)[PIA_RUN_SUMS];
    pia_survey *survey; /* [AT_ONCE], NULL: unwanted */
} pieces;

static void sum_piece(void *work, pia_index chunk)
{
    const pieces *p = work;
    pia_index from = p->from + pia_chunk_begin(p->count, AT_ONCE, chunk), to = p->from + pia_chunk_begin(p->count, AT_ONCE, chunk + 1);
    pia_scout scout;
    memset(p->sums[chunk], 0, sizeof *p->sums);
    if (p->survey != NULL) open_scout(p->data, p->first + from, p->first + to, &scout);
    sum_rows(p->run, from, to, p->survey != NULL ? &scout : NULL, p->sums[chunk]);
    if (p->survey != NULL) p->survey[chunk] = pia_scout_close(&scout);
}

/* A span of very many rows: a few pieces at a time, their sums added in order. */
static void sum_long(const pia_span_data *data, const pia_run *run, pia_index first, pia_survey *survey, double *sums)
{
    double part[AT_ONCE][PIA_RUN_SUMS];
    pia_survey seen[AT_ONCE];
    for (pia_index from = 0; from < run->count; from += AT_ONCE * (pia_index)PIECE) {
        pia_index count = run->count - from < AT_ONCE * (pia_index)PIECE ? run->count - from : AT_ONCE * (pia_index)PIECE;
        pieces p = {data, run, first, from, count, part, survey != NULL ? seen : NULL};
        pia_for_each(data->context, AT_ONCE, sum_piece, &p);
        for (int c = 0; c < AT_ONCE; c++) {
            for (int k = 0; k < (run->dim + 2) * (run->degree + 1); k++) sums[k] += part[c][k];
            if (survey != NULL) *survey = pia_survey_join(survey, &seen[c], run->dim);
        }
    }
}

/* product(i, j) = sum w T_i T_j = (m(i + j) + m(|i - j|)) / 2, where m(degree + i) = 2 sum w T_degree T_i - m(degree - i). */
static void cross_moments(int degree, const double *sums, double *product)
{
    double m[2 * PIA_MAX_DEGREE + 1];
    for (int j = 0; j <= degree; j++) m[j] = sums[j];
    for (int i = 1; i <= degree; i++) m[degree + i] = 2 * sums[degree + 1 + i] - m[degree - i];
    for (int i = 0; i <= degree; i++)
        for (int j = 0; j <= degree; j++) product[i * (degree + 1) + j] = 0.5 * (m[i + j] + m[i > j ? i - j : j - i]);
}

static double *change_basis(int degree, int dim, const double *coefficient, const double *sums, double *share)
{
    enum { ROOM = (PIA_MAX_DEGREE + 1) * (PIA_MAX_DEGREE + 1) };
    int width = degree + 1;
    double product[ROOM], half[PIA_MAX_DEGREE + 1];
    cross_moments(degree, sums, product);
    for (int k = 0; k < width; k++) {
        for (int j = 0; j < width; j++) {
            half[j] = 0;
            for (int i = 0; i < width; i++) half[j] += coefficient[k * width + i] * product[i * width + j];
        }
        for (int l = k; l < width; l++) {
            double sum = 0;
            for (int j = 0; j < width; j++) sum += half[j] * coefficient[l * width + j];
            *share++ = sum;
        }
    }
    for (int k = 0; k < width; k++)
        for (int d = 0; d < dim; d++) {
            double sum = 0;
            for (int j = 0; j < width; j++) sum += coefficient[k * width + j] * sums[(2 + d) * width + j];
            *share++ = sum;
        }
    return share;
}

/* Moments know sums to a fixed part of the largest; where a function is smaller than that at all points, they know nothing of it. */
static int is_known(int degree, const double *share)
{
    double smallest = share[0], largest = share[0];
    for (int k = 0; k <= degree; share += degree + 1 - k, k++) {
        if (share[0] < smallest) smallest = share[0];
        if (share[0] > largest) largest = share[0];
    }
    return smallest > lost * largest;
}

static void finish(const pia_span_data *data, const pia_run *run, const double *coefficient, const double *sums, pia_index s,
                   double *share)
{
    double *origin = change_basis(run->degree, run->dim, coefficient, sums, share);
    for (int d = 0; d < run->dim; d++) origin[d] = run->origin[d];
    if (!is_known(run->degree, share)) pia_span_lanes(data, s, 1, share);
}

/* Of a span whose rows are one task's. */
static void sum_moments(const pia_span_data *data, const pia_chebyshev *c, pia_index s, pia_scout *scout, double *share)
{
    double coefficient[(PIA_MAX_DEGREE + 1) * (PIA_MAX_DEGREE + 1)], sums[PIA_RUN_SUMS];
    pia_run run = centred_run(data, c, s, coefficient);
    memset(sums, 0, (size_t)((run.dim + 2) * (run.degree + 1)) * sizeof *sums);
    pia_run_moments(&run, scout, sums);
    finish(data, &run, coefficient, sums, s, share);
}

static void sum_long_moments(const pia_span_data *data, const pia_chebyshev *c, pia_index s, pia_survey *survey, double *share)
{
    double coefficient[(PIA_MAX_DEGREE + 1) * (PIA_MAX_DEGREE + 1)], sums[PIA_RUN_SUMS] = {0};
    pia_run run = centred_run(data, c, s, coefficient);
    sum_long(data, &run, data->line->begin[s], survey, sums);
    finish(data, &run, coefficient, sums, s, share);
}

typedef struct sweep {
    const pia_span_data *data;
    pia_index first, last, chunks;
    double *share;
    const pia_chebyshev *chebyshev;
    pia_survey *survey; /* [chunks], NULL: unwanted */
} sweep;

/* First span of a chunk: chunks hold about the same number of rows. */
static pia_index chunk_span(const sweep *w, pia_index chunk)
{
    const pia_index *begin = w->data->line->begin;
    pia_index low = w->first, high = w->last + 1;
    if (chunk == w->chunks) return high;
    pia_index row = begin[low] + pia_chunk_begin(begin[high] - begin[low], w->chunks, chunk);
    while (low < high) {
        pia_index middle = low + (high - low) / 2;
        if (begin[middle] < row)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

static int is_long(const pia_span_data *data, pia_index s)
{
    return data->line->begin[s + 1] - data->line->begin[s] > PIECE;
}

/* How many spans from s on, at most a vector's lanes, have few rows. */
static int count_short(const pia_collocation *line, pia_index s, pia_index end)
{
    int count = 0;
    while (count < PIA_LANES && s + count < end && has_fewer(line, s + count, MANY)) count++;
    return count;
}

/* Spans that are shared between tasks are left out. */
static void sum_spans(const sweep *w, pia_index from, pia_index to, pia_scout *scout)
{
    const pia_collocation *line = w->data->line;
    int room = pia_span_room(line->degree, components(w->data)), count;
    for (pia_index s = from; s<to; s += count> 0 ? count : 1) {
        double *share = w->share + (s - w->first) * room;
        count = count_short(line, s, to);
        if (count > 0) {
            if (scout != NULL) pia_scout_reach(scout, line->begin[s + count]);
            pia_span_lanes(w->data, s, count, share);
        } else if (!is_long(w->data, s)) {
            sum_moments(w->data, w->chebyshev, s, scout, share);
        } else if (scout != NULL) {
            scout->next = line->begin[s + 1];
        }
    }
}

static void sum_chunk(void *work, pia_index chunk)
{
    const sweep *w = work;
    const pia_index *begin = w->data->line->begin;
    pia_index from = chunk_span(w, chunk), to = chunk_span(w, chunk + 1);
    pia_scout scout;
    if (w->survey != NULL) open_scout(w->data, begin[from], begin[to], &scout);
    sum_spans(w, from, to, w->survey != NULL ? &scout : NULL);
    if (w->survey != NULL) w->survey[chunk] = pia_scout_close(&scout);
}

void pia_span_sums(const pia_span_data *data, pia_index first, pia_index last, double *share, pia_survey *survey)
{
    pia_chebyshev chebyshev;
    pia_survey seen[MAX_CHUNKS];
    const pia_collocation *line = data->line;
    pia_chebyshev_fill(line->degree, &chebyshev);
    pia_index chunks = pia_chunk_count(line->begin[last + 1] - line->begin[first], GRAIN);
    sweep w = {data, first, last, chunks < MAX_CHUNKS ? chunks : MAX_CHUNKS, share, &chebyshev, survey != NULL ? seen : NULL};
    pia_for_each(data->context, w.chunks, sum_chunk, &w);
    if (survey != NULL) *survey = seen[0];
    for (pia_index c = 1; c < w.chunks && survey != NULL; c++) *survey = pia_survey_join(survey, &seen[c], components(data));
    for (pia_index s = first; s <= last; s++) /* their rows are shared between the threads, one such span after the other */
        if (is_long(data, s))
            sum_long_moments(data, &chebyshev, s, survey, share + (s - first) * pia_span_room(line->degree, components(data)));
}
