/* Branch and bound on N/W. Corner coefficients are values; no value is below the smallest quotient of coefficients, so a cell where
 * that is not below the best value holds nothing better. Where N - x W is convex for every value x that the cell's minimum can have,
 * each local minimum is the cell's only one, and Newton's method finds it. Any other cell is halved. */
#include "minimum.h"

#include <float.h>
#include <math.h>

static const double SMALLEST = 0x1p-45; /* side of a cell that is not halved any more */

static double quotient(const pia_minimum *m, int k)
{
    return m->rational ? m->numerator[k] / m->denominator[k] : m->numerator[k];
}

static void take(pia_minimum *m, double value, double u, double v, int settled)
{
    m->value = value;
    m->at[0] = u;
    m->at[1] = v;
    m->found = 1;
    m->settled = settled;
}

/* Returns the smallest corner value of the cell. */
static double try_corners(pia_minimum *m, const pia_cell *cell)
{
    int row = m->degree[1] + 1;
    double least = INFINITY;
    for (int i = 0; i < 2; i++)
        for (int j = 0; j < m->directions; j++) {
            double value = quotient(m, i * m->degree[0] * row + j * m->degree[1]);
            if (value < m->value) take(m, value, i ? cell->high[0] : cell->low[0], j ? cell->high[1] : cell->low[1], 0);
            if (value < least) least = value;
        }
    return least;
}

/* Bounds of the second derivatives of N - x W over the cell, in the cell's own unit square. */
typedef struct bend {
    double least[2], most[2]; /* uu and vv */
    double mixed;             /* largest |uv| */
} bend;

static double value_at(const pia_minimum *m, double x, int k)
{
    return m->rational ? m->numerator[k] - x * m->denominator[k] : m->numerator[k];
}

static void bend_along(const pia_minimum *m, double x, int d, bend *b)
{
    const int n = m->degree[d], across = m->degree[1 - d], row = m->degree[1] + 1, step = d == 0 ? row : 1, other = d == 0 ? 1 : row;
    b->least[d] = n > 0 ? INFINITY : 0;
    b->most[d] = 0;
    for (int j = 0; j <= across; j++)
        for (int i = 0; i + 2 <= n; i++) {
            int k = i * step + j * other;
            double second = value_at(m, x, k) - 2 * value_at(m, x, k + step) + value_at(m, x, k + 2 * step);
            b->least[d] = fmin(b->least[d], n * (n - 1) * second);
            b->most[d] = fmax(b->most[d], n * (n - 1) * fabs(second));
        }
    if (n == 1) b->least[d] = 0;
}

static bend find_bend(const pia_minimum *m, double x)
{
    const int nu = m->degree[0], nv = m->degree[1], row = nv + 1;
    bend b = {.mixed = 0};
    for (int d = 0; d < 2; d++) bend_along(m, x, d, &b);
    for (int i = 0; i < nu; i++)
        for (int k = i * row; k < i * row + nv; k++) {
            double uv = value_at(m, x, k) - value_at(m, x, k + 1) - value_at(m, x, k + row) + value_at(m, x, k + row + 1);
            b.mixed = fmax(b.mixed, nu * nv * fabs(uv));
        }
    return b;
}

/* Positive semidefinite everywhere, but for what rounding may have taken. */
static int is_convex(const bend *b, double rounding)
{
    double uu = b->least[0] + rounding, vv = b->least[1] + rounding;
    return uu >= 0 && vv >= 0 && uu * vv >= b->mixed * b->mixed;
}

/* N - x W is linear in x: convex for two values, it is convex between them. `worst` receives the direction that bends most. */
static int has_one_minimum(const pia_minimum *m, double low, double high, double largest, int *worst)
{
    int most = m->degree[0] > m->degree[1] ? m->degree[0] : m->degree[1];
    double rounding = 16 * DBL_EPSILON * most * most * largest;
    bend near = find_bend(m, low);
    *worst = near.most[1] > near.most[0];
    if (!is_convex(&near, rounding)) return 0;
    if (!m->rational) return 1;
    bend far = find_bend(m, high);
    return is_convex(&far, rounding);
}

/* Newton's place is better than that of a corner as low. */
static void settle(pia_minimum *m, const pia_cell *cell, const double start[2])
{
    pia_look look = {.at = {start[0], start[1]}};
    pia_minimum_descend(m, cell, &look);
    int as_low = look.value <= m->value + 8 * DBL_EPSILON * fabs(m->value);
    if (look.value < m->value || (!m->settled && as_low)) take(m, look.value, look.at[0], look.at[1], 1);
}

static void scan(pia_minimum *m, const pia_cell *cell)
{
    if (m->budget-- <= 0) return;
    m->expand(m, cell);
    int row = m->degree[1] + 1, count = (m->degree[0] + 1) * row, lowest = 0, d;
    double high = try_corners(m, cell), largest = 0;
    for (int k = 0; k < count; k++) {
        largest = fmax(largest, fabs(m->numerator[k]));
        if (quotient(m, k) < quotient(m, lowest)) lowest = k;
    }
    double low = quotient(m, lowest);
    if (!(low < m->value - m->relative * fabs(m->value) - m->absolute)) return;
    double start[2], share[2] = {(double)(lowest / row) / m->degree[0], row > 1 ? (double)(lowest % row) / m->degree[1] : 0};
    for (int k = 0; k < 2; k++) start[k] = cell->low[k] + share[k] * (cell->high[k] - cell->low[k]);
    if (has_one_minimum(m, low, high, largest, &d)) {
        settle(m, cell, start);
        return;
    }
    if (cell->high[d] - cell->low[d] < SMALLEST) return;
    for (int k = 0; k < 2; k++) {
        pia_cell half = *cell;
        double *side = (share[d] > 0.5) == (k == 0) ? half.low : half.high; /* first the half that promises more */
        side[d] = cell->low[d] + (cell->high[d] - cell->low[d]) / 2;
        scan(m, &half);
    }
}

void pia_minimum_find(pia_minimum *m)
{
    m->found = m->settled = 0;
    scan(m, &(pia_cell){{0, 0}, {1, 1}});
}
