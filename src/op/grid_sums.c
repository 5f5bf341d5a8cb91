#include "grid_sums.h"

#include "kernel.h"
#include "vector.h"

/* ROWS: taken together, as many streams of memory as a processor follows with ease. TWO: vectors side by side, so that every basis
 * value is used twice. COLUMNS: doubles of a line that stay in the first-level cache while all rows of a span are added to them, about.
 */
enum { MAX_CHUNKS = 32, ROWS = 4, TWO = 2, STEP = TWO * PIA_LANES, COLUMNS = 512 };

typedef struct pass {
    const pia_grid_sums *sums;
    const pia_collocation *u, *v;
    const double *points;
    double *full;
    pia_survey *survey; /* [chunks], NULL: unwanted */
} pass;

/* ---- along u ---- */

/* A few rows of data in one span, and the lines that they are added to. */
typedef struct strip {
    int rows;
    const double *value[ROWS], *data[ROWS]; /* basis values, points of a row */
    double *line[PIA_MAX_DEGREE + 1];
} strip;

PIA_INLINE void add_columns(const strip *s, const double *origin, pia_index at, int degree)
{
    pia_lanes sum[PIA_MAX_DEGREE + 1][TWO], centre[TWO];
    for (int w = 0; w < TWO; w++) centre[w] = pia_vector_load(origin + at + w * PIA_LANES);
    for (int k = 0; k <= degree; k++)
        for (int w = 0; w < TWO; w++) sum[k][w] = pia_vector_load(s->line[k] + at + w * PIA_LANES);
    for (int r = 0; r < s->rows; r++)
        for (int w = 0; w < TWO; w++) {
            pia_lanes q = pia_vector_load(s->data[r] + at + w * PIA_LANES) - centre[w];
            for (int k = 0; k <= degree; k++) sum[k][w] += s->value[r][k] * q;
        }
    for (int k = 0; k <= degree; k++)
        for (int w = 0; w < TWO; w++) memcpy(s->line[k] + at + w * PIA_LANES, &sum[k][w], sizeof(pia_lanes));
}

PIA_INLINE void add_strip(const strip *s, const double *origin, pia_index from, pia_index to, int degree)
{
    pia_index at = from;
    for (; at + STEP <= to; at += STEP) add_columns(s, origin, at, degree);
    for (; at < to; at++)
        for (int r = 0; r < s->rows; r++)
            for (int k = 0; k <= degree; k++) s->line[k][at] += s->value[r][k] * (s->data[r][at] - origin[at]);
}

PIA_CLONES static void add_strip_of(const strip *s, const double *origin, pia_index from, pia_index to, int degree)
{
    switch (degree) {
    case 1: add_strip(s, origin, from, to, 1); break;
    case 2: add_strip(s, origin, from, to, 2); break;
    case 3: add_strip(s, origin, from, to, 3); break;
    default: add_strip(s, origin, from, to, degree); break;
    }
}

/* The lines of a task are a ring: that of a control row which is complete is the next one's. */
static double *ring_line(const pass *p, pia_index chunk, pia_index control)
{
    pia_index lines = p->u->degree + 1;
    return p->sums->lines + (chunk * lines + control % lines) * p->sums->width;
}

/* Rows row .. row + rows - 1 of span s. */
static void take_rows(const pass *p, pia_index row, int rows, pia_index s, double (*scratch)[PIA_MAX_DEGREE + 1], strip *out)
{
    out->rows = rows;
    for (int r = 0; r < rows; r++) {
        out->value[r] = pia_collocation_row(p->u, row + r, p->u->degree + s, scratch[r]);
        out->data[r] = p->points + (row + r) * p->sums->width;
    }
}

/* Whole vectors of whole points. */
static pia_index piece_width(int dim)
{
    return COLUMNS / (STEP * dim) * (STEP * dim);
}

/* The scout sees the columns from .. to - 1 of a strip before they are summed. */
static void see_strip(const strip *s, pia_index from, pia_index to, pia_box *box)
{
    for (int r = 0; r < s->rows; r++) pia_box_add(box, s->data[r] + from, (to - from) / box->dim);
}

/* box NULL: unwanted. */
static void add_span(const pass *p, pia_index chunk, pia_index s, pia_box *box)
{
    const pia_collocation *u = p->u;
    double scratch[ROWS][PIA_MAX_DEGREE + 1];
    pia_index width = p->sums->width, end = u->begin[s + 1], piece = piece_width(p->sums->dim);
    strip part;
    for (int k = 0; k <= u->degree; k++) part.line[k] = ring_line(p, chunk, s + k);
    for (pia_index from = 0; from < width; from += piece) {
        pia_index to = from + piece < width ? from + piece : width;
        for (pia_index row = u->begin[s]; row < end; row += ROWS) {
            take_rows(p, row, end - row < ROWS ? (int)(end - row) : ROWS, s, scratch, &part);
            if (box != NULL) see_strip(&part, from, to, box);
            add_strip_of(&part, p->sums->origin, from, to, u->degree);
        }
    }
}

/* ---- along v ---- */

/* Cubic: the four functions of a span are the lanes. */
PIA_INLINE void contract_cubic(const pia_collocation *v, const double *line, int dim, double *to)
{
    for (pia_index s = 0; s < v->full - 3; s++) {
        pia_lanes sum[3] = {{0}};
        for (pia_index row = v->begin[s]; row < v->begin[s + 1]; row++) {
            pia_lanes value = pia_vector_load(v->values + row * 4);
            for (int d = 0; d < dim; d++) sum[d] += value * line[row * dim + d];
        }
        for (int k = 0; k < 4; k++)
            for (int d = 0; d < dim; d++) to[(s + k) * dim + d] += sum[d][k];
    }
}

static void contract_any(const pia_collocation *v, const double *line, int dim, double *to)
{
    double scratch[PIA_MAX_DEGREE + 1];
    for (pia_index s = 0; s < v->full - v->degree; s++)
        for (pia_index row = v->begin[s]; row < v->begin[s + 1]; row++) {
            const double *value = pia_collocation_row(v, row, v->degree + s, scratch);
            for (int k = 0; k <= v->degree; k++)
                for (int d = 0; d < dim; d++) to[(s + k) * dim + d] += value[k] * line[row * dim + d];
        }
}

PIA_CLONES static void contract(const pia_collocation *v, const double *line, int dim, double *to)
{
    memset(to, 0, (size_t)(v->full * dim) * sizeof *to);
    if (v->degree != 3 || v->values == NULL || dim > 3)
        contract_any(v, line, dim, to);
    else if (dim == 3)
        contract_cubic(v, line, 3, to);
    else if (dim == 1)
        contract_cubic(v, line, 1, to);
    else
        contract_cubic(v, line, 2, to);
}

/* ---- all of it ---- */

/* A chunk of u-spans owns the control rows that begin with them; the degree rows beyond go to its tail. */
static void sum_chunk(void *work, pia_index chunk)
{
    const pass *p = work;
    const pia_grid_sums *sums = p->sums;
    const pia_collocation *u = p->u;
    pia_index all = u->full - u->degree, row = p->v->full * sums->dim;
    pia_index from = pia_chunk_begin(all, sums->chunks, chunk), to = pia_chunk_begin(all, sums->chunks, chunk + 1);
    size_t line = (size_t)sums->width * sizeof(double);
    pia_box box;
    pia_box_open(sums->dim, &box);
    for (int k = 0; k <= u->degree; k++) memset(ring_line(p, chunk, from + k), 0, line);
    for (pia_index s = from; s < to; s++) {
        add_span(p, chunk, s, p->survey != NULL ? &box : NULL);
        contract(p->v, ring_line(p, chunk, s), sums->dim, p->full + s * row);
        memset(ring_line(p, chunk, s), 0, line);
    }
    for (int k = 0; k < u->degree; k++)
        contract(p->v, ring_line(p, chunk, to + k), sums->dim, sums->tail + (chunk * u->degree + k) * row);
    if (p->survey != NULL) p->survey[chunk] = pia_survey_of(&box);
}

void pia_grid_sums_run(const pia_grid_sums *sums, const double *points, double *full, pia_survey *survey)
{
    const pia_op *op = sums->op;
    pia_survey seen[MAX_CHUNKS];
    pass p = {sums, op->line[0], op->line[1], points, full, survey != NULL ? seen : NULL};
    pia_index all = p.u->full - p.u->degree, degree = p.u->degree, row = p.v->full * sums->dim;
    for (pia_index c = 0; c < sums->width; c++) sums->origin[c] = points[c % sums->dim];
    pia_for_each(op->context, sums->chunks, sum_chunk, &p);
    if (survey != NULL) *survey = seen[0];
    for (pia_index c = 1; c < sums->chunks && survey != NULL; c++) *survey = pia_survey_join(survey, &seen[c], sums->dim);
    memset(full + all * row, 0, (size_t)(degree * row) * sizeof *full);
    for (pia_index chunk = 0; chunk < sums->chunks; chunk++) {
        double *to = full + pia_chunk_begin(all, sums->chunks, chunk + 1) * row;
        const double *tail = sums->tail + chunk * degree * row;
        for (pia_index c = 0; c < degree * row; c++) to[c] += tail[c];
    }
}

/* Enough spans a task that its tail is small beside them. */
static pia_index count_chunks(const pia_collocation *u)
{
    pia_index chunks = (u->full - u->degree) / (2 * (u->degree + 1));
    return chunks < 1 ? 1 : chunks < MAX_CHUNKS ? chunks : MAX_CHUNKS;
}

pia_status pia_grid_sums_open(const pia_op *op, int dim, pia_grid_sums *out)
{
    const pia_collocation *u = op->line[0], *v = op->line[1];
    pia_grid_sums s = {.op = op, .dim = dim, .chunks = count_chunks(u), .width = v->rows * dim};
    pia_index lines;
    if (!pia_multiply(s.chunks * (u->degree + 1), s.width, &lines))
        return pia_fail(op->context, PIA_E_SIZE, "lines of %lld numbers are too long", (long long)s.width);
    s.lines = pia_take(op->context, lines, sizeof *s.lines);
    s.tail = pia_take(op->context, s.chunks * u->degree, (size_t)(v->full * dim) * sizeof *s.tail);
    s.origin = pia_take(op->context, s.width, sizeof *s.origin);
    if (s.lines == NULL || s.tail == NULL || s.origin == NULL) {
        pia_grid_sums_close(&s);
        return pia_take_status(op->context, lines, sizeof *s.lines);
    }
    *out = s;
    return PIA_OK;
}

void pia_grid_sums_close(pia_grid_sums *sums)
{
    if (sums->op == NULL) return;
    pia_give(sums->op->context, sums->lines);
    pia_give(sums->op->context, sums->tail);
    pia_give(sums->op->context, sums->origin);
    *sums = (pia_grid_sums){0};
}
