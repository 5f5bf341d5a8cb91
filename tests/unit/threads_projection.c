/* The nearest spline to values on a whole grid against dense normal equations of each direction, for any number of threads. */
#include "context_fixture.h"
#include "problems.h"
#include "projection.h"

enum { DIM = 2, MOST = 400 };

typedef struct sample {
    pia_projection_line line[2];
    pia_index rows[2], count[2], columns;
    double *parameters[2], *basis[2]; /* basis [rows x count] */
    double *values;                   /* [DIM x rows[0] x rows[1]] */
    double *seen;                     /* the same: what an exchange has shown */
} sample;

static double *take(pia_index count)
{
    return calloc((size_t)count, sizeof(double));
}

static void make(pia_context *context, sample *s, int degree, pia_index m, pia_index n, pia_index nu, pia_index nv)
{
    uint64_t seed = (uint64_t)(degree + 3 * m + 7 * n);
    *s = (sample){.rows = {m, n}, .count = {nu, nv}};
    for (int d = 0; d < 2; d++) {
        pia_index rows = s->rows[d], count = s->count[d];
        double *knots = problem_knots(degree, 0, count, &seed), *owned = pia_take(context, count + degree + 1, sizeof *owned);
        memcpy(owned, knots, (size_t)(count + degree + 1) * sizeof *owned);
        s->parameters[d] = take(rows);
        for (pia_index i = 0; i < rows; i++) s->parameters[d][i] = ((double)i + 0.4 * problem_random(&seed)) / (double)rows;
        s->parameters[d][0] = 0;
        s->parameters[d][rows - 1] = 1;
        s->basis[d] = take(rows * count);
        for (pia_index i = 0; i < rows; i++)
            for (pia_index k = 0; k < count; k++)
                s->basis[d][i * count + k] = problem_basis(knots, k, degree, s->parameters[d][i], count - 1);
        assert_ok(context, pia_projection_line_open(context, degree, owned, count, s->parameters[d], rows, &s->line[d]));
        free(knots);
    }
    s->values = take(DIM * m * n);
    s->seen = take(DIM * m * n);
    for (pia_index i = 0; i < DIM * m * n; i++) s->values[i] = problem_random(&seed) - 0.5;
}

static void release(pia_context *context, sample *s)
{
    for (int d = 0; d < 2; d++) {
        pia_projection_line_close(context, &s->line[d]);
        free(s->parameters[d]);
        free(s->basis[d]);
    }
    free(s->values);
    free(s->seen);
}

static void exchange(void *owner, pia_index tile, double *values)
{
    sample *s = owner;
    for (int d = 0; d < DIM; d++)
        for (pia_index i = 0; i < s->rows[0]; i++)
            for (pia_index l = 0; l < PIA_TILE; l++) {
                pia_index j = tile * PIA_TILE + l, at = (d * s->rows[0] + i) * s->rows[1] + j;
                double *value = values + (d * s->rows[0] + i) * PIA_TILE + l;
                if (j < s->rows[1]) s->seen[at] = *value;
                *value = j < s->rows[1] ? s->values[at] : 0;
            }
}

/* out [count x width] = (N'N)^-1 N' in [rows x width]. */
static void solve_dense(const double *basis, pia_index rows, pia_index count, const double *in, pia_index width, double *out)
{
    double *gram = take(count * count);
    memset(out, 0, (size_t)(count * width) * sizeof *out);
    for (pia_index i = 0; i < rows; i++)
        for (pia_index a = 0; a < count; a++) {
            for (pia_index b = 0; b < count; b++) gram[a * count + b] += basis[i * count + a] * basis[i * count + b];
            for (pia_index w = 0; w < width; w++) out[a * width + w] += basis[i * count + a] * in[i * width + w];
        }
    problem_solve(gram, count, out, (int)width);
    free(gram);
}

/* control [count[0] x count[1]] of component d. */
static void nearest_dense(const sample *s, int d, double *control)
{
    pia_index nu = s->count[0], n = s->rows[1], nv = s->count[1];
    double *down = take(nu * n), *turned = take(n * nu), *along = take(nv * nu);
    solve_dense(s->basis[0], s->rows[0], nu, s->values + d * s->rows[0] * n, n, down);
    for (pia_index i = 0; i < nu; i++)
        for (pia_index j = 0; j < n; j++) turned[j * nu + i] = down[i * n + j];
    solve_dense(s->basis[1], n, nv, turned, nu, along);
    for (pia_index i = 0; i < nu; i++)
        for (pia_index j = 0; j < nv; j++) control[i * nv + j] = along[j * nu + i];
    free(down);
    free(turned);
    free(along);
}

static double value_of(const sample *s, const double *control, pia_index i, pia_index j)
{
    double sum = 0;
    for (pia_index a = 0; a < s->count[0]; a++)
        for (pia_index b = 0; b < s->count[1]; b++)
            sum += s->basis[0][i * s->count[0] + a] * s->basis[1][j * s->count[1] + b] * control[a * s->count[1] + b];
    return sum;
}

static void compare(pia_context *context, sample *s, double *found)
{
    pia_projection p;
    double *control = take(s->count[0] * s->count[1]);
    assert_ok(context, pia_projection_open(context, s->rows, s->count, DIM, &p));
    for (int d = 0; d < 2; d++) p.line[d] = &s->line[d];
    pia_projection_exchange(&p, exchange, s);
    pia_projection_find(&p);
    pia_projection_exchange(&p, exchange, s);
    for (int d = 0; d < DIM; d++) {
        nearest_dense(s, d, control);
        for (pia_index i = 0; i < s->count[0]; i++)
            for (pia_index j = 0; j < s->count[1]; j++) {
                *found = pia_projection_control(&p, d, i, j);
                assert_near(*found++, control[i * s->count[1] + j], 1e-10);
            }
        for (pia_index i = 0; i < s->rows[0]; i += 3)
            for (pia_index j = 0; j < s->rows[1]; j += 5)
                assert_near(s->seen[(d * s->rows[0] + i) * s->rows[1] + j], value_of(s, control, i, j), 1e-10);
    }
    pia_projection_close(&p);
    free(control);
}

static void the_nearest_spline_is_that_of_dense_equations(void **state)
{
    (void)state;
    static const pia_index size[][4] = {{30, 41, 9, 12}, {64, 24, 16, 8}, {17, 90, 8, 25}, {150, 320, 10, 14}};
    for (size_t k = 0; k < sizeof size / sizeof *size; k++)
        for (int degree = 1; degree <= 5; degree++) {
            double found[2][2 * MOST] = {{0}};
            for (int threads = 1; threads <= 4; threads += 3) {
                pia_context *context;
                sample s;
                assert_ok(NULL, pia_context_create(NULL, &context));
                assert_ok(context, pia_context_set_threads(context, threads));
                make(context, &s, degree, size[k][0], size[k][1], size[k][2], size[k][3]);
                compare(context, &s, found[threads > 1]);
                release(context, &s);
                pia_context_destroy(context);
            }
            assert_memory_equal(found[0], found[1], sizeof found[0]);
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(the_nearest_spline_is_that_of_dense_equations)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
