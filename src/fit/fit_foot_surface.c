/* Foot points of scattered rows near their current parameters: safeguarded Newton steps on the squared distance. A row moves at most
 * half the spacing of the rows in the parameter plane, only closer, and never past a fold: where the normal of the surface would turn
 * over, it stays. So parameters keep their neighbourhoods, and surfaces that are fitted to them do not fold where they did not. */
#include "fit.h"

#include "basis.h"
#include "kernel.h"
#include "knots.h"

#include <math.h>
#include <string.h>

enum { NEWTON_STEPS = 3, HALVINGS = 3, GRAIN = 512 };

typedef struct feet {
    const pia_fit *fit;
    const double *full;
    double low[2], high[2], reach[2];
    pia_index chunks;
} feet;

/* Parameters, beyond the seam of a closed direction not turned back; point less target and derivatives S, Su, Sv, Suu, Suv, Svv; the
 * squared distance. */
typedef struct place {
    double t[2], value[6][PIA_MAX_DIM], square;
} place;

static double wrap(const feet *f, int d, double t)
{
    double period = f->high[d] - f->low[d];
    if (!f->fit->closed[d]) return t;
    t -= period * floor((t - f->low[d]) / period);
    return t < f->high[d] ? t : f->low[d];
}

static void look(const feet *f, const double *target, place *at)
{
    const pia_fit *fit = f->fit;
    double basis[2][3 * (PIA_MAX_DEGREE + 1)];
    pia_index span[2], line = fit->full[1];
    int p = fit->degree[0], q = fit->degree[1], dim = fit->dim;
    for (int d = 0; d < 2; d++) {
        double t = wrap(f, d, at->t[d]);
        span[d] = pia_knots_span(fit->knots[d], fit->degree[d], fit->full[d], t);
        pia_basis_derivatives(fit->knots[d], fit->degree[d], span[d], t, 2, basis[d]);
    }
    static const int order[6][2] = {{0, 0}, {1, 0}, {0, 1}, {2, 0}, {1, 1}, {0, 2}};
    memset(at->value, 0, sizeof at->value);
    for (int i = 0; i <= p; i++)
        for (int j = 0; j <= q; j++) {
            const double *control = f->full + ((span[0] - p + i) * line + span[1] - q + j) * dim;
            for (int k = 0; k < 6; k++) {
                double weight = basis[0][order[k][0] * (p + 1) + i] * basis[1][order[k][1] * (q + 1) + j];
                for (int d = 0; d < dim; d++) at->value[k][d] += weight * control[d];
            }
        }
    at->square = 0;
    for (int d = 0; d < dim; d++) {
        at->value[0][d] -= target[d] - fit->origin[d];
        at->square += at->value[0][d] * at->value[0][d];
    }
}

static double dot(const double *a, const double *b, int dim)
{
    double sum = 0;
    for (int d = 0; d < dim; d++) sum += a[d] * b[d];
    return sum;
}

/* Newton's step where the Hessian is definite, else that of Gauss and Newton; 0 where neither is. */
static int step_from(const place *at, int dim, double step[2])
{
    const double *away = at->value[0], *u = at->value[1], *v = at->value[2];
    double g[2] = {dot(away, u, dim), dot(away, v, dim)}, h[3] = {dot(u, u, dim), dot(u, v, dim), dot(v, v, dim)};
    double bent[3] = {h[0] + dot(away, at->value[3], dim), h[1] + dot(away, at->value[4], dim), h[2] + dot(away, at->value[5], dim)};
    double size = h[0] * h[2];
    if (bent[0] > 0 && bent[0] * bent[2] - bent[1] * bent[1] > 1e-6 * size) memcpy(h, bent, sizeof h);
    double det = h[0] * h[2] - h[1] * h[1];
    if (!(det > 1e-12 * size)) return 0;
    step[0] = -(h[2] * g[0] - h[1] * g[1]) / det;
    step[1] = -(h[0] * g[1] - h[1] * g[0]) / det;
    return 1;
}

/* Whether the tangent planes at two places face the same way: in any dimension, by the cosine of their bivectors. */
static int same_side(const place *a, const place *b, int dim)
{
    return dot(a->value[1], b->value[1], dim) * dot(a->value[2], b->value[2], dim) -
               dot(a->value[1], b->value[2], dim) * dot(a->value[2], b->value[1], dim) >
           0;
}

/* The parameter, moved within what this call allows around `from`, and into the domain. */
static double move(const feet *f, int d, double from, double to)
{
    to = fmin(fmax(to, from - f->reach[d]), from + f->reach[d]);
    return f->fit->closed[d] ? to : fmin(fmax(to, f->low[d]), f->high[d]);
}

static void find_foot(const feet *f, const double *target, double t[2])
{
    int dim = f->fit->dim, going = 1;
    double step[2];
    place first, now;
    for (int d = 0; d < 2; d++) first.t[d] = t[d];
    look(f, target, &first);
    now = first;
    for (int newton = 0; newton < NEWTON_STEPS && going && step_from(&now, dim, step); newton++) {
        going = 0;
        for (int halving = 0; halving < HALVINGS && !going; halving++) {
            place next;
            for (int d = 0; d < 2; d++) {
                next.t[d] = move(f, d, t[d], now.t[d] + step[d]);
                step[d] /= 2;
            }
            look(f, target, &next);
            going = next.square < now.square && same_side(&first, &next, dim);
            if (going) now = next;
        }
    }
    for (int d = 0; d < 2; d++) t[d] = wrap(f, d, now.t[d]);
}

static void find_chunk(void *work, pia_index chunk)
{
    const feet *f = work;
    const pia_fit *fit = f->fit;
    pia_index to = pia_chunk_begin(fit->rows, f->chunks, chunk + 1);
    for (pia_index row = pia_chunk_begin(fit->rows, f->chunks, chunk); row < to; row++)
        find_foot(f, fit->points + row * fit->dim, fit->parameter[0] + 2 * row);
}

pia_status pia_fit_project_surface(pia_iterate *iterate)
{
    pia_fit *fit = iterate->owner;
    feet f = {.fit = fit, .full = pia_op_full(fit->op, iterate->points, fit->dim), .chunks = pia_chunk_count(fit->rows, GRAIN)};
    for (int d = 0; d < 2; d++) {
        f.low[d] = fit->knots[d][fit->degree[d]];
        f.high[d] = fit->knots[d][fit->full[d]];
        f.reach[d] = (f.high[d] - f.low[d]) / (2 * sqrt((double)fit->rows));
    }
    pia_for_each(fit->context, f.chunks, find_chunk, &f);
    fit->parameters_moved = 1;
    iterate->errors_known = 0;
    return PIA_OK;
}
