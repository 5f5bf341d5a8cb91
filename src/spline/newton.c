#include "newton.h"

#include <float.h>
#include <math.h>

#include "basis.h"
#include "model.h"

enum { ROWS = 6, WIDTH = PIA_MAX_DEGREE + 1, STEPS = 60 };
enum { S, SU, SV, SUU, SUV, SVV };

/* Squared distance, its gradient and Hessian (uu, uv, vv), and the diagonal without the second derivatives of the point, which is never
 * negative. */
typedef struct state {
    double at[2], square, slope[2], hessian[3], safe[2];
} state;

/* Bernstein basis of one direction with two derivatives, as a B-spline basis over one span. */
static void basis_of(int degree, double t, double out[3 * WIDTH])
{
    double knots[2 * WIDTH];
    if (degree == 0) {
        out[0] = 1;
        return;
    }
    for (int k = 0; k <= degree; k++) {
        knots[k] = 0;
        knots[degree + 1 + k] = 1;
    }
    pia_basis_derivatives(knots, degree, degree, t, 2, out);
}

/* Derivatives of w x and w, rows in the order of the enumeration. */
static void differentiate(const pia_newton *p, const double at[2], double rows[ROWS][PIA_MAX_WIDTH])
{
    static const int order[ROWS][2] = {{0, 0}, {1, 0}, {0, 1}, {2, 0}, {1, 1}, {0, 2}};
    int width = p->dim + p->rational, n = p->degree[0] + 1, m = p->degree[1] + 1;
    double u[3 * WIDTH], v[3 * WIDTH];
    basis_of(p->degree[0], at[0], u);
    basis_of(p->degree[1], at[1], v);
    for (int r = 0; r < ROWS; r++) {
        for (int c = 0; c < width; c++) rows[r][c] = 0;
        if (p->directions == 1 && order[r][1] > 0) continue;
        for (int i = 0; i < n; i++)
            for (int j = 0; j < m; j++) {
                double b = u[order[r][0] * n + i] * v[order[r][1] * m + j];
                for (int c = 0; c < width; c++) rows[r][c] += b * p->points[(i * m + j) * width + c];
            }
    }
}

/* The quotient rule up to second order, in place. */
static void divide(double rows[ROWS][PIA_MAX_WIDTH], int dim)
{
    double w = rows[S][dim], wu = rows[SU][dim], wv = rows[SV][dim];
    for (int c = 0; c < dim; c++) {
        double s = rows[S][c] / w, su = (rows[SU][c] - wu * s) / w, sv = (rows[SV][c] - wv * s) / w;
        rows[S][c] = s;
        rows[SU][c] = su;
        rows[SV][c] = sv;
        rows[SUU][c] = (rows[SUU][c] - 2 * wu * su - rows[SUU][dim] * s) / w;
        rows[SUV][c] = (rows[SUV][c] - wu * sv - wv * su - rows[SUV][dim] * s) / w;
        rows[SVV][c] = (rows[SVV][c] - 2 * wv * sv - rows[SVV][dim] * s) / w;
    }
}

static double dot(const double *a, const double *b, int dim)
{
    double sum = 0;
    for (int c = 0; c < dim; c++) sum += a[c] * b[c];
    return sum;
}

static state look(const pia_newton *p, const double at[2])
{
    double rows[ROWS][PIA_MAX_WIDTH];
    differentiate(p, at, rows);
    if (p->rational) divide(rows, p->dim);
    state s = {.at = {at[0], at[1]}, .square = dot(rows[S], rows[S], p->dim)};
    for (int d = 0; d < 2; d++) {
        s.slope[d] = 2 * dot(rows[S], rows[SU + d], p->dim);
        s.safe[d] = 2 * dot(rows[SU + d], rows[SU + d], p->dim);
    }
    s.hessian[0] = s.safe[0] + 2 * dot(rows[S], rows[SUU], p->dim);
    s.hessian[1] = 2 * (dot(rows[SU], rows[SV], p->dim) + dot(rows[S], rows[SUV], p->dim));
    s.hessian[2] = s.safe[1] + 2 * dot(rows[S], rows[SVV], p->dim);
    return s;
}

/* Whether the distance can still fall along direction d. */
static int is_free(const pia_newton *p, const state *s, int d)
{
    return d < p->directions && (s->slope[d] > 0 ? s->at[d] > p->low[d] : s->at[d] < p->high[d]);
}

static double free_slope(const pia_newton *p, const state *s)
{
    double sum = 0;
    for (int d = 0; d < 2; d++)
        if (is_free(p, s, d)) sum += s->slope[d] * s->slope[d];
    return sum;
}

/* Newton's step where the Hessian of the free directions is positive; returns 0 where it is not, or not two are free. */
static int newton_step(const pia_newton *p, const state *s, double step[2])
{
    const double *h = s->hessian;
    double determinant = h[0] * h[2] - h[1] * h[1];
    if (!is_free(p, s, 0) || !is_free(p, s, 1) || !(h[0] > 0) || !(determinant > 1e-14 * h[0] * h[2])) return 0;
    step[0] = (h[1] * s->slope[1] - h[2] * s->slope[0]) / determinant;
    step[1] = (h[1] * s->slope[0] - h[0] * s->slope[1]) / determinant;
    return 1;
}

/* A step down each free direction by itself, which no edge of the rectangle can turn upwards. */
static void separate_step(const pia_newton *p, const state *s, double step[2])
{
    for (int d = 0; d < 2; d++) {
        double bend = s->hessian[2 * d] > 0 ? s->hessian[2 * d] : s->safe[d];
        step[d] = is_free(p, s, d) && bend > 0 ? -s->slope[d] / bend : 0;
    }
}

/* Near the minimum the distance is flat to rounding while the slope still tells: then a smaller slope is progress too. */
static int is_better(const pia_newton *p, const state *next, const state *now)
{
    if (next->square < now->square) return 1;
    return next->square <= now->square * (1 + 8 * DBL_EPSILON) && free_slope(p, next) < 0.25 * free_slope(p, now);
}

/* Halves the step until it gains something; returns 0 when it never does, or moves so little that rounding decides. */
static int go(const pia_newton *p, const double step[2], state *now)
{
    double part = 1, moved;
    do {
        double place[2];
        for (int d = 0; d < 2; d++) place[d] = fmin(fmax(now->at[d] + part * step[d], p->low[d]), p->high[d]);
        moved = fabs(place[0] - now->at[0]) + fabs(place[1] - now->at[1]);
        if (moved == 0) return 0;
        state next = look(p, place);
        if (is_better(p, &next, now)) {
            *now = next;
            return 1;
        }
        part /= 2;
    } while (moved > 1e-9);
    return 0;
}

double pia_newton_minimise(const pia_newton *p, double at[2])
{
    state now = look(p, at);
    for (int k = 0; k < STEPS; k++) {
        double step[2];
        if (newton_step(p, &now, step) && go(p, step, &now)) continue;
        separate_step(p, &now, step);
        if (!go(p, step, &now)) break;
    }
    at[0] = now.at[0];
    at[1] = now.at[1];
    return now.square;
}
