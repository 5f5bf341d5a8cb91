/* The squared distance to a Bezier piece is a quotient N/W of Bernstein polynomials. A cell (part of the piece) whose smallest quotient
 * of coefficients is not below the best distance holds nothing better. Where N - x W is convex for every distance x that the cell can
 * have, each local minimum is the cell's only one, and Newton's method finds it. Any other cell is halved. */
#include "foot.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "newton.h"

typedef struct cell {
    double low[2], high[2]; /* in the unit square of the piece */
} cell;

static const double SLACK = 1e-12;      /* of a squared distance: what a better candidate must gain */
static const double SMALLEST = 0x1p-45; /* side of a cell that is not halved any more */

static void load_piece(pia_foot *f, const pia_index piece[2])
{
    const pia_model *m = f->pieces->bezier;
    int width = pia_model_width(m), count = (m->degree[0] + 1) * (m->degree[1] + 1);
    double heaviest = 1;
    for (int d = 0; d < m->directions; d++) pia_piece_interval(f->pieces, piece[d], d, &f->low[d], &f->high[d]);
    pia_piece_control(f->pieces, piece, f->piece);
    if (m->rational) {
        heaviest = 0;
        for (int i = 0; i < count; i++) heaviest = fmax(heaviest, f->piece[i * width + m->dim]);
    }
    for (int i = 0; i < count; i++) {
        double *p = f->piece + i * width, w = m->rational ? p[m->dim] / heaviest : 1;
        for (int c = 0; c < m->dim; c++) p[c] = (p[c] / heaviest - w * f->point[c]) / f->scale;
        if (m->rational) p[m->dim] = w;
    }
}

/* Fills distance and weight for a cell; returns the number of coefficients. */
static int expand(pia_foot *f, const cell *at)
{
    const pia_model *m = f->pieces->bezier;
    int width = pia_model_width(m);
    memcpy(f->cell, f->piece, (size_t)((m->degree[0] + 1) * (m->degree[1] + 1) * width) * sizeof *f->cell);
    for (int d = 0; d < m->directions; d++) pia_bernstein_restrict(f->cell, m->degree, width, d, at->low[d], at->high[d]);
    pia_bernstein_square(&f->scales, f->cell, width, 0, m->dim, f->distance);
    if (m->rational) pia_bernstein_square(&f->scales, f->cell, width, m->dim, width, f->weight);
    return (2 * m->degree[0] + 1) * (2 * m->degree[1] + 1);
}

static double quotient(const pia_foot *f, int k)
{
    return f->pieces->bezier->rational ? f->distance[k] / f->weight[k] : f->distance[k];
}

static void take(pia_foot *f, double square, const double at[2], int settled)
{
    f->square = square;
    f->settled = settled;
    for (int d = 0; d < f->pieces->bezier->directions; d++) f->parameter[d] = (1 - at[d]) * f->low[d] + at[d] * f->high[d];
}

/* Corner coefficients are distances; returns the smallest. */
static double try_corners(pia_foot *f, const cell *at)
{
    const int *degree = f->pieces->bezier->degree;
    int row = 2 * degree[1] + 1;
    double least = INFINITY;
    for (int i = 0; i < 2; i++)
        for (int j = 0; j < f->pieces->bezier->directions; j++) {
            double square = quotient(f, i * 2 * degree[0] * row + j * 2 * degree[1]);
            double place[2] = {i ? at->high[0] : at->low[0], j ? at->high[1] : at->low[1]};
            least = fmin(least, square);
            if (square < f->square) take(f, square, place, 0);
        }
    return least;
}

/* Bounds of the second derivatives of N - x W over a cell, in the cell's unit square. */
typedef struct bend {
    double least[2], most[2]; /* uu and vv */
    double mixed;             /* largest |uv| */
} bend;

static double value_at(const pia_foot *f, double x, int k)
{
    return f->pieces->bezier->rational ? f->distance[k] - x * f->weight[k] : f->distance[k];
}

static bend find_bend(const pia_foot *f, double x)
{
    const int n = 2 * f->pieces->bezier->degree[0], m = 2 * f->pieces->bezier->degree[1], row = m + 1;
    bend b = {{m > 0 ? INFINITY : 0, m > 0 ? INFINITY : 0}, {0, 0}, 0};
    b.least[0] = INFINITY;
    for (int i = 0; i <= n; i++)
        for (int j = 0; j <= m; j++) {
            int k = i * row + j;
            double here = value_at(f, x, k);
            if (i + 2 <= n) {
                double uu = n * (n - 1) * (here - 2 * value_at(f, x, k + row) + value_at(f, x, k + 2 * row));
                b.least[0] = fmin(b.least[0], uu);
                b.most[0] = fmax(b.most[0], fabs(uu));
            }
            if (j + 2 <= m) {
                double vv = m * (m - 1) * (here - 2 * value_at(f, x, k + 1) + value_at(f, x, k + 2));
                b.least[1] = fmin(b.least[1], vv);
                b.most[1] = fmax(b.most[1], fabs(vv));
            }
            if (i < n && j < m) {
                double uv = n * m * (here - value_at(f, x, k + 1) - value_at(f, x, k + row) + value_at(f, x, k + row + 1));
                b.mixed = fmax(b.mixed, fabs(uv));
            }
        }
    return b;
}

/* Positive semidefinite everywhere, but for what rounding may have taken. */
static int is_convex(const bend *b, double rounding)
{
    double uu = b->least[0] + rounding, vv = b->least[1] + rounding;
    return uu >= 0 && vv >= 0 && uu * vv >= b->mixed * b->mixed;
}

static void settle(pia_foot *f, const cell *at, const double start[2])
{
    const pia_model *m = f->pieces->bezier;
    pia_newton problem = {m->directions, m->dim, m->rational, {m->degree[0], m->degree[1]}, f->piece, at->low, at->high};
    double place[2] = {start[0], start[1]};
    double square = pia_newton_minimise(&problem, place);
    if (square < f->square || (!f->settled && square <= f->square * (1 + 8 * DBL_EPSILON))) take(f, square, place, 1);
}

/* Whether the cell has no local minimum but one, whatever its distance between low and high: N - x W is linear in x. */
static int has_one_minimum(const pia_foot *f, double low, double high, double largest, int *worst)
{
    int n = 2 * f->pieces->bezier->degree[0], m = 2 * f->pieces->bezier->degree[1], most = n > m ? n : m;
    double rounding = 16 * DBL_EPSILON * most * (most - 1) * largest;
    bend near = find_bend(f, fmax(low, 0));
    *worst = near.most[1] > near.most[0];
    if (!is_convex(&near, rounding)) return 0;
    if (!f->pieces->bezier->rational) return 1;
    bend far = find_bend(f, high);
    return is_convex(&far, rounding);
}

static void scan(pia_foot *f, const cell *at)
{
    if (f->budget-- <= 0 || f->square == 0) return;
    int count = expand(f, at), lowest = 0, d;
    double high = try_corners(f, at), largest = 0;
    for (int k = 0; k < count; k++) {
        largest = fmax(largest, fabs(f->distance[k]));
        if (quotient(f, k) < quotient(f, lowest)) lowest = k;
    }
    double low = quotient(f, lowest);
    if (low >= f->square * (1 - SLACK)) return;
    const int *degree = f->pieces->bezier->degree;
    int row = 2 * degree[1] + 1;
    double start[2], share[2] = {(double)(lowest / row) / (2 * degree[0]), row > 1 ? (double)(lowest % row) / (row - 1) : 0};
    for (int k = 0; k < 2; k++) start[k] = at->low[k] + share[k] * (at->high[k] - at->low[k]);
    if (has_one_minimum(f, low, high, largest, &d)) {
        settle(f, at, start);
        return;
    }
    if (at->high[d] - at->low[d] < SMALLEST) return;
    for (int k = 0; k < 2; k++) {
        cell half = *at;
        double *side = (share[d] > 0.5) == (k == 0) ? half.low : half.high; /* first the half that promises more */
        side[d] = at->low[d] + (at->high[d] - at->low[d]) / 2;
        scan(f, &half);
    }
}

void pia_foot_search(pia_foot *foot, const pia_index piece[2])
{
    load_piece(foot, piece);
    scan(foot, &(cell){{0, 0}, {1, 1}});
}
