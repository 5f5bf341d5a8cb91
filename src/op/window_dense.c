/* Fits of windows whose equations are no band: those of short closed curves, which wrap around, and those with conditions. */
#include "window_rows.h"

#include "basis.h"
#include "dense.h"
#include "knots.h"

#include <math.h>
#include <string.h>

enum { MOST = 2 * PIA_WINDOW_FREE };

/* What may be left of a condition, over the largest coordinate: more says that the equations were singular. */
static const double MET = 1e-12;

/* Where control point i is among the unknowns; -1: it stays. */
static int unknown_of(const pia_window *w, int cyclic, int i)
{
    if (cyclic) return i % w->free;
    return i >= w->first && i < w->first + w->free ? i - w->first : -1;
}

/* h [.. x stride] and b [.. x dim]: normal equations of the rows for corrections of the unknowns, added. */
static void sum_dense(const pia_window *w, const pia_rows *r, int p, int dim, int cyclic, double *h, int stride, double *b)
{
    for (pia_index k = 0; k < r->count; k++) {
        const double *value = r->value + k * (p + 1);
        const double *difference = r->difference + k * dim;
        double weight = r->weight[k] * r->inverse[k] * r->inverse[k];
        for (int i = 0; i <= p; i++) {
            int row = unknown_of(w, cyclic, r->first[k] + i);
            if (row < 0) continue;
            double factor = weight * value[i];
            for (int j = 0; j <= p; j++) {
                int column = unknown_of(w, cyclic, r->first[k] + j);
                if (column >= 0) h[row * stride + column] += factor * value[j];
            }
            for (int d = 0; d < dim; d++) b[row * dim + d] += factor * difference[d];
        }
    }
}

static void move(pia_window *w, int cyclic, int dim, const double *correction)
{
    for (int i = 0; i < w->count; i++) {
        int unknown = unknown_of(w, cyclic, i);
        for (int d = 0; d < dim && unknown >= 0; d++) w->point[i * dim + d] += correction[unknown * dim + d];
    }
}

void pia_window_correct_cyclic(pia_window *w, const pia_rows *r, int p, int dim)
{
    double h[PIA_WINDOW_FREE * PIA_WINDOW_FREE], b[PIA_WINDOW_FREE * PIA_MAX_DIM], scratch[PIA_WINDOW_FREE * PIA_MAX_DIM];
    pia_index order[PIA_WINDOW_FREE];
    int n = w->free;
    memset(h, 0, (size_t)(n * n) * sizeof *h);
    memset(b, 0, (size_t)(n * dim) * sizeof *b);
    sum_dense(w, r, p, dim, 1, h, n, b);
    pia_index rank = pia_dense_cholesky(h, n, 1e-14, order);
    pia_dense_cholesky_solve(h, n, rank, order, b, dim, scratch);
    move(w, 1, dim, b);
}

/* ---- conditions ---- */

/* Adds the condition at t; nothing when no moving control point touches it. Returns 0 when there is no room. */
static int add_condition(const pia_draft *draft, const pia_window *w, const pia_draft_condition *c, double t, pia_held *held)
{
    double basis[(PIA_MAX_DEGREE + 1) * (PIA_MAX_DEGREE + 1)], touched = 0, sum = 0;
    int p = draft->degree, dim = draft->dim, span = (int)pia_knots_span(w->knots, p, w->count, t);
    pia_basis_derivatives(w->knots, p, span, t, c->order, basis);
    const double *entry = basis + c->order * (p + 1);
    for (int i = 0; i <= p; i++) {
        sum += fabs(entry[i]);
        if (unknown_of(w, draft->cyclic, span - p + i) >= 0) touched += fabs(entry[i]);
    }
    if (!(touched > 0)) return 1;
    if (held->count >= w->free || held->count >= PIA_WINDOW_FREE) return 0;
    int k = held->count++;
    held->first[k] = span - p;
    for (int i = 0; i <= p; i++) held->value[k * (p + 1) + i] = entry[i] / sum;
    for (int d = 0; d < dim; d++) held->right[k * dim + d] = c->value[d] / sum;
    return 1;
}

static pia_index lower_condition(const pia_draft_data *data, double t)
{
    pia_index low = 0, high = data->condition_count;
    while (low < high) {
        pia_index middle = low + (high - low) / 2;
        if (data->condition[middle].parameter < t)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

/* Conditions of one period, shifted by it. */
static int hold_period(const pia_draft *draft, const pia_window *w, double shift, pia_held *held)
{
    const pia_draft_data *data = draft->data;
    for (pia_index i = lower_condition(data, w->begin - shift); i < data->condition_count; i++) {
        double t = data->condition[i].parameter + shift;
        if (t > w->end || (t == w->end && !w->has_end)) return 1;
        if (!add_condition(draft, w, &data->condition[i], t, held)) return 0;
    }
    return 1;
}

int pia_window_hold(const pia_draft *draft, const pia_window *w, pia_held *held)
{
    held->count = 0;
    if (draft->data->condition_count == 0) return 1;
    if (!draft->data->periodic) return hold_period(draft, w, 0, held);
    double base = draft->data->condition[0].parameter, first = floor(w->begin - base);
    for (int k = 0; base + first + k <= w->end; k++)
        if (!hold_period(draft, w, first + k, held)) return 0;
    return 1;
}

/* What is left of condition k. */
static void condition_left(const pia_window *w, const pia_held *held, int k, int p, int dim, double *left)
{
    for (int d = 0; d < dim; d++) {
        left[d] = held->right[k * dim + d];
        for (int i = 0; i <= p; i++) left[d] -= held->value[k * (p + 1) + i] * w->point[(held->first[k] + i) * dim + d];
    }
}

int pia_window_holds(const pia_window *w, const pia_held *held, int p, int dim)
{
    double left[PIA_MAX_DIM], worst = 0, size = 0;
    for (int k = 0; k < held->count; k++) {
        condition_left(w, held, k, p, dim, left);
        for (int d = 0; d < dim; d++) worst = fmax(worst, fabs(left[d]));
    }
    for (int i = 0; i < w->count * dim && held->count > 0; i++) size = fmax(size, fabs(w->point[i]));
    return worst <= MET * size;
}

/* The equations of Lagrange, the rows in units of their largest diagonal element. */
int pia_window_correct_held(pia_window *w, const pia_rows *r, const pia_held *held, int p, int dim, int cyclic)
{
    double m[MOST * MOST], b[MOST * PIA_MAX_DIM], largest = 0;
    pia_index pivot[MOST];
    int n = w->free, size = n + held->count;
    memset(m, 0, (size_t)(size * size) * sizeof *m);
    memset(b, 0, (size_t)(size * dim) * sizeof *b);
    sum_dense(w, r, p, dim, cyclic, m, size, b);
    for (int i = 0; i < n; i++) largest = fmax(largest, m[i * size + i]);
    for (int i = 0; i < n && largest > 0; i++) {
        for (int j = 0; j < n; j++) m[i * size + j] /= largest;
        for (int d = 0; d < dim; d++) b[i * dim + d] /= largest;
    }
    for (int k = 0; k < held->count; k++) {
        for (int i = 0; i <= p; i++) {
            int unknown = unknown_of(w, cyclic, held->first[k] + i);
            if (unknown < 0) continue;
            m[unknown * size + n + k] += held->value[k * (p + 1) + i];
            m[(n + k) * size + unknown] += held->value[k * (p + 1) + i];
        }
        condition_left(w, held, k, p, dim, b + (n + k) * dim);
    }
    if (!pia_dense_lu(m, size, pivot)) return 0;
    pia_dense_lu_solve(m, size, pivot, b, dim);
    move(w, cyclic, dim, b);
    return 1;
}
