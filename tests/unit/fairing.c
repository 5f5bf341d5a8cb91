/* Fairing: the energy matrix against quadrature of products of derivatives, one limit for every method, what the strength means. */
#include "../memory/failing.h"
#include "context_fixture.h"
#include "dense_normal.h"
#include "energy.h"
#include "problems.h"

/* Composite Gauss rule of 5 points on each of `pieces` parts of [0, 1]; knots of the tests are cut finely enough to be exact to 1e-9.
 */
static double gauss_node(int i, double *weight)
{
    static const double x[] = {-0.9061798459386640, -0.5384693101056831, 0, 0.5384693101056831, 0.9061798459386640};
    static const double w[] = {0.2369268850561891, 0.4786286704993665, 0.5688888888888889, 0.4786286704993665, 0.2369268850561891};
    *weight = w[i];
    return x[i];
}

/* Dense integral over a domain [0, 1] of products of derivatives of order `order` of the functions of direction d: [unknowns^2]. */
static void integrate(const problem *p, int d, int order, double *out)
{
    pia_index n = p->unknowns[d];
    double *row = malloc((size_t)n * sizeof *row);
    memset(out, 0, (size_t)(n * n) * sizeof *out);
    for (pia_index s = p->degree[d]; s < p->full[d]; s++)
        for (int i = 0; i < 5; i++) {
            double w, low = p->knots[d][s], high = p->knots[d][s + 1], t = low + (high - low) * (1 + gauss_node(i, &w)) / 2;
            for (pia_index c = 0; c < n; c++) row[c] = 0;
            for (pia_index c = 0; c < p->full[d]; c++)
                row[c % n] += problem_derivative(p->knots[d], c, p->degree[d], order, t, p->full[d] - 1);
            for (pia_index a = 0; a < n; a++)
                for (pia_index b = 0; b < n; b++) out[a * n + b] += w * (high - low) / 2 * row[a] * row[b];
        }
    free(row);
}

/* Dense E [cols^2]. */
static double *dense_energy(const problem *p)
{
    pia_index cols = p->cols, nv = p->unknowns[1];
    double *e = calloc((size_t)(cols * cols), sizeof *e);
    if (p->kind == PIA_CURVE) {
        integrate(p, 0, 2, e);
        return e;
    }
    for (int t = 0; t < 3; t++) {
        double *u = malloc((size_t)(p->unknowns[0] * p->unknowns[0]) * sizeof *u), *v = malloc((size_t)(nv * nv) * sizeof *v);
        integrate(p, 0, t, u);
        integrate(p, 1, 2 - t, v);
        for (pia_index a = 0; a < cols; a++)
            for (pia_index b = 0; b < cols; b++)
                e[a * cols + b] += (t == 1 ? 2 : 1) * u[a / nv * p->unknowns[0] + b / nv] * v[a % nv * nv + b % nv];
        free(u);
        free(v);
    }
    return e;
}

typedef struct shape {
    pia_kind kind;
    int p, q;
    pia_index nu, nv, rows;
    int cyclic;
} shape;

static const shape shapes[] = {
    {PIA_CURVE, 2, 0, 9, 1, 40, 0},     {PIA_CURVE, 3, 0, 12, 1, 60, 0},    {PIA_CURVE, 3, 0, 9, 1, 40, 1},
    {PIA_CURVE, 4, 0, 11, 1, 50, 0},    {PIA_GRID, 3, 2, 7, 6, 20, 0},      {PIA_GRID, 2, 3, 7, 9, 24, 2},
    {PIA_SCATTERED, 3, 3, 6, 7, 20, 0}, {PIA_SCATTERED, 2, 1, 6, 7, 20, 1}, {PIA_SCATTERED, 3, 2, 9, 8, 26, 3}};
enum { SHAPES = sizeof shapes / sizeof *shapes };

/* H + factor E with dense arithmetic; returns the factor. */
static double dense_sum(const problem *p, double strength, double *h, double *b)
{
    double *e = dense_energy(p), data = 0, energy = 0;
    problem_normal(p, h, b);
    for (pia_index c = 0; c < p->cols; c++) {
        data += h[c * p->cols + c];
        energy += e[c * p->cols + c];
    }
    double factor = strength * data / energy;
    for (pia_index k = 0; k < p->cols * p->cols; k++) h[k] += factor * e[k];
    free(e);
    return factor;
}

static void the_energy_matrix_is_the_integral_of_products_of_derivatives(void **state)
{
    (void)state;
    for (int k = 0; k < SHAPES; k++) {
        const shape *s = &shapes[k];
        problem *p = problem_open(NULL, s->kind, s->p, s->q, s->nu, s->nv, s->rows, 2, s->cyclic, k % 2);
        pia_normal *normal;
        double *h = malloc((size_t)(p->cols * p->cols) * sizeof *h), *b = malloc((size_t)(2 * p->cols) * sizeof *b);
        double *unit = calloc((size_t)p->cols, sizeof *unit), *column = malloc((size_t)p->cols * sizeof *column);
        dense_sum(p, 0.3, h, b);
        assert_ok(NULL, pia_normal_open_with(p->op, &p->targets, &(pia_addition){.fairing = 0.3}, &normal));
        for (pia_index c = 0; c < p->cols; c++) {
            double sum = 0;
            unit[c] = 1;
            normal->class->multiply(normal, unit, 1, column);
            unit[c] = 0;
            for (pia_index r = 0; r < p->cols; r++) {
                assert_near(column[r], h[r * p->cols + c], 1e-10 * normal->diagonal[c]);
                sum += fabs(column[r]);
            }
            assert_near(normal->diagonal[c], h[c * p->cols + c], 1e-10 * h[c * p->cols + c]);
            assert_true(normal->column_sum[c] >= sum * (1 - 1e-12));
        }
        pia_normal_close(normal);
        problem_close(p);
        free(h);
        free(b);
        free(unit);
        free(column);
    }
}

static void faired_solutions_are_those_of_dense_elimination_and_refresh_gives_the_same_bits(void **state)
{
    (void)state;
    for (int k = 0; k < SHAPES; k++) {
        const shape *s = &shapes[k];
        problem *p = problem_open(NULL, s->kind, s->p, s->q, s->nu, s->nv, s->rows, 2, s->cyclic, k % 2);
        pia_normal *normal;
        double *h = malloc((size_t)(p->cols * p->cols) * sizeof *h), *b = malloc((size_t)(2 * p->cols) * sizeof *b);
        double *x = malloc((size_t)(2 * p->cols) * sizeof *x);
        dense_sum(p, 1e-3, h, b);
        problem_solve(h, p->cols, b, 2);
        assert_ok(NULL, pia_normal_open_with(p->op, &p->targets, &(pia_addition){.fairing = 1e-3}, &normal));
        for (int round = 0; round < 2; round++) {
            assert_ok(NULL, normal->class->factor(normal));
            memcpy(x, normal->right, (size_t)(2 * p->cols) * sizeof *x);
            normal->class->solve(normal, x, 2);
            for (pia_index c = 0; c < 2 * p->cols; c++) assert_near(x[c], b[c], 1e-9);
            double before = normal->diagonal[p->cols / 2];
            pia_normal_refresh(normal, &p->targets, 0, p->rows - 1);
            assert_true(before == normal->diagonal[p->cols / 2]);
        }
        pia_normal_close(normal);
        problem_close(p);
        free(h);
        free(b);
        free(x);
    }
}

/* A noisy wave as a function graph, or scattered over a square. */
enum { COUNT = 300 };

typedef struct noisy {
    double points[3 * COUNT], pairs[2 * COUNT];
    pia_data data;
    pia_fit_options options;
} noisy;

static void make_noisy(noisy *n, pia_kind kind)
{
    uint64_t seed = 5;
    pia_data_init(&n->data);
    pia_fit_options_init(&n->options);
    for (pia_index i = 0; i < COUNT; i++) {
        double u = kind == PIA_CURVE ? (double)i / (COUNT - 1) : problem_random(&seed), v = problem_random(&seed);
        double *p = n->points + (kind == PIA_CURVE ? 2 : 3) * i;
        n->pairs[kind == PIA_CURVE ? i : 2 * i] = u;
        if (kind != PIA_CURVE) n->pairs[2 * i + 1] = v;
        p[0] = u;
        if (kind != PIA_CURVE) p[1] = v;
        p[kind == PIA_CURVE ? 1 : 2] = sin(5 * u) + (kind == PIA_CURVE ? 0 : v) + 0.2 * (problem_random(&seed) - 0.5);
    }
    n->data.kind = kind;
    n->data.points = n->points;
    n->data.parameters = n->pairs;
    n->data.count[0] = COUNT;
    n->data.dim = kind == PIA_CURVE ? 2 : 3;
    n->options.control[0] = kind == PIA_CURVE ? 40 : 10;
    n->options.control[1] = kind == PIA_CURVE ? PIA_AUTO : 9;
    n->options.fairing = 0.01;
}

static void every_least_squares_method_reaches_the_same_faired_limit(void **state)
{
    static const char *const method[] = {"lspia", "lspia-opt", "mlspia", "nmlspia", "alspia", "salspia", "chebyshev", "cg", "cg-kron"};
    for (int kind = 0; kind < 2; kind++) {
        noisy n;
        make_noisy(&n, kind == 0 ? PIA_CURVE : PIA_SCATTERED);
        pia_index size = kind == 0 ? 80 : 270;
        double limit[270], control[270];
        pia_model *model = NULL;
        assert_ok(*state, pia_fit_data(*state, &n.data, &n.options, &model, NULL));
        pia_model_control(model, limit, NULL);
        pia_model_destroy(model);
        n.options.max_iterations = 200000;
        for (size_t m = 0; m < sizeof method / sizeof *method - (kind == 0); m++) {
            n.options.method = method[m];
            assert_ok(*state, pia_fit_data(*state, &n.data, &n.options, &model, NULL));
            pia_model_control(model, control, NULL);
            for (pia_index c = 0; c < size; c++) assert_near(control[c], limit[c], 1e-8);
            pia_model_destroy(model);
        }
    }
}

/* The energy falls and the error rises as the strength grows. */
static void stronger_fairing_bends_less(void **state)
{
    noisy n;
    make_noisy(&n, PIA_CURVE);
    double last_bend = INFINITY, last_error = 0;
    for (double strength = 1e-6; strength < 1e7; strength *= 10) {
        pia_model *model = NULL;
        pia_report report = {.struct_size = sizeof report};
        double bend = 0;
        n.options.fairing = strength;
        assert_ok(*state, pia_fit_data(*state, &n.data, &n.options, &model, &report));
        for (int i = 0; i <= 1000; i++) {
            double t = i / 1000.0, value[6];
            assert_ok(NULL, pia_model_eval(NULL, model, &t, 1, 2, value));
            bend += (value[4] * value[4] + value[5] * value[5]) / 1001;
        }
        assert_true(bend < last_bend && report.rms_error >= last_error);
        last_bend = bend;
        last_error = report.rms_error;
        pia_model_destroy(model);
    }
    assert_true(last_bend < 1); /* of 45,000 unfaired */
}

/* What no data holds is bridged smoothly instead of staying at the start. */
static void fairing_bridges_a_gap(void **state)
{
    noisy n;
    make_noisy(&n, PIA_CURVE);
    pia_index kept = 0;
    for (pia_index i = 0; i < COUNT; i++) {
        double u = (double)i / (COUNT - 1);
        if (u > 0.3 && u < 0.7) continue;
        n.pairs[kept] = u;
        n.points[2 * kept] = u;
        n.points[2 * kept + 1] = 3 * u + 1;
        kept++;
    }
    double knots[44], at = 0.5, value[2];
    const pia_index control = 40;
    for (int i = 0; i < 44; i++) knots[i] = i < 4 ? 0 : i > 39 ? 1 : (i - 3) / 37.0;
    n.data.count[0] = kept;
    n.options.control[0] = control;
    n.options.knots[0] = knots;
    n.options.knot_count[0] = 44;
    pia_model *model = NULL;
    assert_ok(*state, pia_fit_data(*state, &n.data, &n.options, &model, NULL));
    assert_ok(NULL, pia_model_eval(NULL, model, &at, 1, 0, value));
    assert_near(value[1], 2.5, 1e-7);
    int told = 0;
    const char *note;
    for (pia_index i = 0; (note = pia_model_note(model, i)) != NULL; i++) told |= strstr(note, "do not hold, left to fairing") != NULL;
    assert_true(told);
    pia_model_destroy(model);
}

static void fairing_where_it_makes_no_sense_is_refused(void **state)
{
    noisy n;
    pia_model *model = NULL;
    make_noisy(&n, PIA_CURVE);
    n.options.fairing = -1;
    assert_status(*state, pia_fit_data(*state, &n.data, &n.options, &model, NULL), PIA_E_ARGUMENT);
    n.options.fairing = NAN;
    assert_status(*state, pia_fit_data(*state, &n.data, &n.options, &model, NULL), PIA_E_ARGUMENT);
    n.options.fairing = 1;
    n.options.degree[0] = 1;
    assert_status(*state, pia_fit_data(*state, &n.data, &n.options, &model, NULL), PIA_E_ARGUMENT);
    n.options.degree[0] = 3;
    n.options.method = "pia";
    n.options.control[0] = PIA_AUTO;
    assert_status(*state, pia_fit_data(*state, &n.data, &n.options, &model, NULL), PIA_E_ARGUMENT);
}

static pia_status fit_again(pia_context *context, void *user)
{
    const noisy *n = user;
    pia_model *model = NULL;
    pia_status status = pia_fit_data(context, &n->data, &n->options, &model, NULL);
    pia_model_destroy(model);
    return status;
}

static void every_allocation_may_fail(void **state)
{
    (void)state;
    noisy n;
    for (int kind = 0; kind < 2; kind++) {
        make_noisy(&n, kind == 0 ? PIA_CURVE : PIA_SCATTERED);
        assert_survives_failures(fit_again, &n);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_energy_matrix_is_the_integral_of_products_of_derivatives),
        cmocka_unit_test(faired_solutions_are_those_of_dense_elimination_and_refresh_gives_the_same_bits),
        cmocka_unit_test(every_least_squares_method_reaches_the_same_faired_limit),
        cmocka_unit_test(stronger_fairing_bends_less),
        cmocka_unit_test(fairing_bridges_a_gap),
        cmocka_unit_test(fairing_where_it_makes_no_sense_is_refused),
        cmocka_unit_test(every_allocation_may_fail),
    };
    return cmocka_run_group_tests(tests, open_context, close_context);
}
