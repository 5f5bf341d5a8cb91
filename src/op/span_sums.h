/* The share of one knot span in the normal form: products of its degree + 1 basis functions, and their products with the data. */
#ifndef PIA_OP_SPAN_SUMS_H
#define PIA_OP_SPAN_SUMS_H

#include "chebyshev.h"
#include "op.h"
#include "run.h"
#include "survey.h"

/* Doubles of a share: the upper triangle by rows, sum w N_k N_l for k <= l, then sum w N_k (q - q0) [(degree + 1) x dim], then q0
 * [dim], the first point of the span, any where it has none. */
int pia_span_room(int degree, int dim);

/* What is summed: the rows of a line, their weights [rows] (NULL: 1) and targets (NULL: the triangle alone). */
typedef struct pia_span_data {
    pia_context *context;
    const pia_collocation *line;
    const double *weights;
    const pia_targets *targets;
} pia_span_data;

/* Shares of spans first .. last (span s begins at knot degree + s) into share[(s - first) * room]. Spans of many points go by moments.
 * The same bits whatever the threads and whatever the range. survey: receives what there is to know of these rows; NULL: unwanted. */
void pia_span_sums(const pia_span_data *data, pia_index first, pia_index last, double *share, pia_survey *survey);

/* The rows of span s as a run, and the Chebyshev coefficients of its basis functions [(degree + 1) x (degree + 1)]. */
pia_run pia_span_run(const pia_span_data *data, const pia_chebyshev *c, pia_index s, double *coefficient);
/* Whether span s has so many rows that this pays. */
int pia_span_is_full(const pia_collocation *line, pia_index s);

#endif
