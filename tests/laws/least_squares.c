/* What every least-squares method must hold: the limit is the least-squares fit, whatever the method, degree, dimension and shape. */
#include <stdlib.h>

#include "check.h"
#include "dense_solve.h"

static const char *const methods[] = {"lspia",   "lspia-opt", "mlspia", "nmlspia",     "alspia",
                                      "salspia", "chebyshev", "cg",     "gauss-seidel"};
enum { METHODS = sizeof methods / sizeof *methods };

typedef struct problem {
    pia_data data;
    pia_fit_options options;
    double *points, *weights;
} problem;

static double random_number(uint64_t *seed)
{
    *seed = *seed * 6364136223846793005u + 1442695040888963407u;
    return (double)(*seed >> 11) * 0x1p-53;
}

/* A wavy line or sheet with noise, far from the origin. */
static problem problem_make(pia_kind kind, int degree, int closed, int dim, pia_index count, pia_index control)
{
    problem p;
    uint64_t seed = 12345;
    pia_data_init(&p.data);
    pia_fit_options_init(&p.options);
    pia_index columns = kind == PIA_GRID ? count : 1;
    p.points = malloc((size_t)(count * columns * dim) * sizeof *p.points);
    p.weights = malloc((size_t)(count * columns) * sizeof *p.weights);
    for (pia_index i = 0; i < count; i++)
        for (pia_index j = 0; j < columns; j++) {
            double u = 6.28 * (double)i / (double)count, v = 3 * (double)j / (double)columns;
            double *q = p.points + (i * columns + j) * dim;
            for (int d = 0; d < dim; d++) q[d] = 100 + cos(u + 1.6 * d) + 0.3 * sin(2 * v + d) * (d + 1) + 0.05 * random_number(&seed);
            p.weights[i * columns + j] = 0.5 + random_number(&seed);
        }
    p.data.kind = kind;
    p.data.points = p.points;
    p.data.count[0] = count;
    p.data.count[1] = columns;
    p.data.dim = dim;
    p.options.degree[0] = p.options.degree[1] = degree;
    p.options.closed[0] = closed;
    p.options.control[0] = control;
    if (kind == PIA_GRID) p.options.control[1] = control;
    p.options.parametrization = "uniform";
    p.options.max_iterations = 100000;
    p.options.stop_gradient = 1e-15;
    return p;
}

static void problem_release(problem *p)
{
    free(p->points);
    free(p->weights);
}

/* Control points of the fit, in order; the caller frees. */
static double *fitted(pia_context *context, const problem *p, const char *method, pia_report *report)
{
    pia_model *model = NULL;
    pia_model_info info = {.struct_size = sizeof info};
    pia_fit_options options = p->options;
    options.method = method;
    report->struct_size = sizeof *report;
    assert_ok(context, pia_fit_data(context, &p->data, &options, &model, report));
    pia_model_get_info(model, &info);
    double *points = malloc((size_t)(info.control[0] * info.control[1] * info.dim) * sizeof *points);
    pia_model_control(model, points, NULL);
    pia_model_destroy(model);
    return points;
}

static double basis(const double *knots, pia_index i, int degree, double t, pia_index last)
{
    if (degree == 0) return t == knots[last + 1] ? i == last : knots[i] <= t && t < knots[i + 1];
    double left = knots[i + degree] - knots[i], right = knots[i + degree + 1] - knots[i + 1], sum = 0;
    if (left > 0) sum += (t - knots[i]) / left * basis(knots, i, degree - 1, t, last);
    if (right > 0) sum += (knots[i + degree + 1] - t) / right * basis(knots, i + 1, degree - 1, t, last);
    return sum;
}

/* The reference: rows of the collocation matrix by the recursion of Cox and de Boor, times the roots of the weights. */
static double *reference(pia_context *context, const problem *p)
{
    pia_fit *fit = NULL;
    pia_model *model = NULL;
    pia_model_info info = {.struct_size = sizeof info};
    const double *t = NULL;
    const pia_index *used = NULL;
    pia_index number = 0;
    assert_ok(context, pia_fit_open(context, &p->data, &p->options, &fit));
    assert_ok(context, pia_fit_model(fit, &model));
    assert_ok(context, pia_fit_parameters(fit, &t, &number, &used));
    pia_model_get_info(model, &info);
    pia_index across = info.directions == 2 ? p->data.count[1] : 1, m = p->data.count[0] * across;
    pia_index nv = info.directions == 2 ? info.control[1] : 1, n = info.control[0] * nv;
    double *a = malloc((size_t)(m * n) * sizeof *a), *q = malloc((size_t)(m * info.dim) * sizeof *q);
    double *x = malloc((size_t)(n * info.dim) * sizeof *x);
    for (pia_index row = 0; row < m; row++) {
        double w = p->data.weights != NULL ? sqrt(p->data.weights[row]) : 1;
        for (pia_index c = 0; c < n; c++) {
            double v = 1;
            if (info.directions == 2)
                v = basis(pia_model_knots(model, 1), c % nv, info.degree[1], t[p->data.count[0] + row % across], nv - 1);
            a[row * n + c] = w * v * basis(pia_model_knots(model, 0), c / nv, info.degree[0], t[row / across], info.control[0] - 1);
        }
        for (int d = 0; d < info.dim; d++) q[row * info.dim + d] = w * p->points[row * info.dim + d];
    }
    dense_solve(a, q, m, n, info.dim, x);
    pia_model_destroy(model);
    pia_fit_close(fit);
    free(a);
    free(q);
    return x;
}

static double difference(const double *a, const double *b, pia_index count)
{
    double most = 0;
    for (pia_index i = 0; i < count; i++)
        if (!(fabs(a[i] - b[i]) <= most)) most = fabs(a[i] - b[i]);
    return most;
}

static pia_context *context_with(int threads)
{
    pia_context *context = NULL;
    pia_context_options options;
    pia_context_options_init(&options);
    options.threads = threads;
    assert_ok(NULL, pia_context_create(&options, &context));
    return context;
}

/* Extent of all problems: 2 to 4. */
static void check_limits(pia_context *context, const problem *p, const double *limit, pia_index count, const char *what)
{
    for (int k = 0; k < METHODS; k++) {
        if (p->data.kind == PIA_GRID && strcmp(methods[k], "gauss-seidel") == 0) continue;
        pia_report report;
        double *points = fitted(context, p, methods[k], &report), off = difference(points, limit, count);
        if (!(off < 2e-9))
            print_error("%s, %s: off by %g after %lld iterations\n", methods[k], what, off, (long long)report.iterations);
        assert_true(off < 2e-9);
        free(points);
    }
}

static void every_method_reaches_the_dense_solution_of_open_curves(void **state)
{
    (void)state;
    pia_context *context = context_with(1);
    for (int degree = 1; degree <= 7; degree++) {
        problem p = problem_make(PIA_CURVE, degree, 0, (degree + 2) % 4 + 1, 120, 12);
        if (degree % 2 == 0) p.data.weights = p.weights;
        double *limit = reference(context, &p);
        check_limits(context, &p, limit, 12 * p.data.dim, "open curve");
        pia_report report;
        double *direct = fitted(context, &p, "direct", &report);
        assert_true(difference(direct, limit, 12 * p.data.dim) < 1e-11);
        free(direct);
        free(limit);
        problem_release(&p);
    }
    pia_context_destroy(context);
}

static void every_method_reaches_the_direct_solution_of_closed_curves(void **state)
{
    (void)state;
    pia_context *context = context_with(1);
    for (int degree = 1; degree <= 7; degree++) {
        problem p = problem_make(PIA_CURVE, degree, 1, 2, 120, 16);
        pia_report report;
        double *limit = fitted(context, &p, "direct", &report);
        assert_true(report.relative_gradient < 1e-12);
        check_limits(context, &p, limit, 16 * p.data.dim, "closed curve");
        free(limit);
        problem_release(&p);
    }
    pia_context_destroy(context);
}

static void every_method_reaches_the_dense_solution_of_grids(void **state)
{
    (void)state;
    pia_context *context = context_with(1);
    for (int degree = 1; degree <= 3; degree++) {
        problem p = problem_make(PIA_GRID, degree, 0, degree, 20, 6);
        double *limit = reference(context, &p);
        check_limits(context, &p, limit, 36 * p.data.dim, "grid");
        free(limit);
        problem_release(&p);
    }
    pia_context_destroy(context);
}

/* Weights make a grid pass over the data in every iteration. */
static void grids_with_weights_and_holes_have_the_same_limit(void **state)
{
    (void)state;
    pia_context *context = context_with(1);
    problem p = problem_make(PIA_GRID, 2, 0, 2, 18, 6);
    double parameters[36];
    for (int i = 0; i < 36; i++) parameters[i] = i % 18 / 17.0;
    p.data.parameters = parameters;
    p.data.weights = p.weights;
    double *limit = reference(context, &p);
    check_limits(context, &p, limit, 72, "weighted grid");
    free(limit);
    for (pia_index row = 30; row < 40; row++) p.weights[row] = 0;
    limit = reference(context, &p);
    for (pia_index row = 30; row < 40; row++) p.points[2 * row] = NAN;
    check_limits(context, &p, limit, 72, "grid with holes");
    free(limit);
    problem_release(&p);
    pia_context_destroy(context);
}

/* A weight of 1 changes nothing but the way: without weights a grid has a normal form, with them it has none. */
static void iterates_are_the_same_with_and_without_a_normal_form(void **state)
{
    (void)state;
    pia_context *context = context_with(1);
    problem p = problem_make(PIA_GRID, 3, 0, 3, 20, 7);
    for (pia_index row = 0; row < 400; row++) p.weights[row] = 1;
    p.options.max_iterations = 7;
    for (int k = 0; k < METHODS; k++) {
        if (strcmp(methods[k], "gauss-seidel") == 0 || strcmp(methods[k], "cg") == 0 || strcmp(methods[k], "chebyshev") == 0) continue;
        pia_report report;
        p.data.weights = NULL;
        double *form = fitted(context, &p, methods[k], &report);
        p.data.weights = p.weights;
        double *pass = fitted(context, &p, methods[k], &report);
        assert_int_equal(report.iterations, 7);
        assert_true(difference(form, pass, 147) < 1e-11);
        free(form);
        free(pass);
    }
    problem_release(&p);
    pia_context_destroy(context);
}

static void the_thread_count_changes_no_bit(void **state)
{
    (void)state;
    pia_context *one = context_with(1), *three = context_with(3);
    for (int kind = 0; kind < 2; kind++) {
        problem p = problem_make(kind == 0 ? PIA_CURVE : PIA_GRID, 3, 0, 3, kind == 0 ? 70000 : 220, kind == 0 ? 40 : 20);
        p.options.max_iterations = 5;
        for (int k = 0; k < METHODS - kind; k++) {
            pia_report report;
            double *a = fitted(one, &p, methods[k], &report), *b = fitted(three, &p, methods[k], &report);
            assert_memory_equal(a, b, (kind == 0 ? 40 : 400) * 3 * sizeof *a);
            free(a);
            free(b);
        }
        problem_release(&p);
    }
    pia_context_destroy(one);
    pia_context_destroy(three);
}

/* Half of the points are taken away: whole spans have no data. Every method stays bounded, and control points without data stay. */
static void gaps_leave_every_method_bounded(void **state)
{
    (void)state;
    pia_context *context = context_with(1);
    problem p = problem_make(PIA_CURVE, 3, 0, 2, 120, 20);
    double knots[24], parameters[120];
    for (int i = 0; i < 24; i++) knots[i] = i < 4 ? 0 : i > 19 ? 1 : (i - 3) / 17.0;
    for (int i = 0; i < 120; i++) parameters[i] = i < 60 ? 4 / 17.0 * i / 59 : 1 - 4 / 17.0 * (119 - i) / 59;
    p.data.parameters = parameters;
    p.options.knots[0] = knots;
    p.options.knot_count[0] = 24;
    p.options.max_iterations = 3000;
    for (int k = -1; k < METHODS; k++) {
        pia_report report;
        double *points = fitted(context, &p, k < 0 ? "direct" : methods[k], &report);
        for (int i = 0; i < 40; i++) assert_true(fabs(points[i] - 100) < 20);
        assert_true(report.max_error < 0.5);
        free(points);
    }
    problem_release(&p);
    pia_context_destroy(context);
}

/* Asked for thousands of steps more than they need, methods stay at the limit: no rule stops them, rounding leads nowhere. */
static void no_method_leaves_the_limit(void **state)
{
    (void)state;
    pia_context *context = context_with(1);
    pia_report report;
    for (uint64_t seed = 1; seed <= 3; seed++) {
        problem p = problem_make(PIA_GRID, 3, 0, 1, 12, 6);
        uint64_t state_of_random = seed;
        double extent = 0;
        for (int i = 0; i < 144; i++) {
            p.points[i] = (random_number(&state_of_random) - 0.5) * exp(10 * random_number(&state_of_random));
            extent = fmax(extent, fabs(p.points[i]));
        }
        double *limit = fitted(context, &p, "direct", &report);
        p.options.max_iterations = 5000;
        p.options.stop_change = p.options.stop_gradient = 0;
        for (int k = 0; k < METHODS; k++) {
            if (strcmp(methods[k], "gauss-seidel") == 0) continue; /* curves only */
            double *points = fitted(context, &p, methods[k], &report);
            for (int i = 0; i < 36; i++) assert_near(points[i], limit[i], 1e-4 * extent);
            assert_true(report.max_error <= extent);
            free(points);
        }
        free(limit);
        problem_release(&p);
    }
    pia_context_destroy(context);
}

/* A step too long for the problem: the fit ends with what it has, which is finite, and says that it stalled. */
static void a_diverging_fit_ends_with_a_finite_model(void **state)
{
    (void)state;
    pia_context *context = context_with(1);
    static const char *const steps[] = {"step=3", "step=1000", "step=1e200"};
    for (int k = 0; k < 3; k++) {
        pia_report report;
        problem p = problem_make(PIA_CURVE, 3, 0, 2, 60, 12);
        p.options.method_options = &steps[k];
        p.options.method_option_count = 1;
        p.options.stop_change = p.options.stop_gradient = 0;
        double *points = fitted(context, &p, "lspia", &report);
        assert_int_equal(report.stop, PIA_STOP_STALLED);
        for (int i = 0; i < 24; i++) assert_true(fabs(points[i]) < 1e6);
        assert_true(report.rms_error > 0 && report.rms_error <= report.max_error && report.max_error < 1e6);
        free(points);
        problem_release(&p);
    }
    pia_context_destroy(context);
}

/* Dini's surface of 81 x 81 points by 31 x 31 control points, picked from the data at the start: the counts that a study of 2026
 * published for its stop rule, |g|^2 < 1e-6 |g_0|^2. */
static pia_model *dini_start(pia_context *context, const double *points)
{
    const int degree[2] = {3, 3};
    const pia_index control[2] = {31, 31};
    double knots[35], start[31 * 31 * 3];
    const double *both[2] = {knots, knots};
    pia_model *model = NULL;
    for (int i = 0; i < 35; i++) knots[i] = i < 4 ? 0 : i >= 31 ? 1 : (i - 3) / 28.0;
    for (int i = 0; i < 31 * 31; i++) {
        int row = (int)round(80.0 / 30 * (i / 31)), column = (int)round(80.0 / 30 * (i % 31));
        memcpy(start + 3 * i, points + 3 * (row * 81 + column), 3 * sizeof *start);
    }
    assert_ok(context, pia_model_create(context, 2, degree, both, control, 3, start, NULL, &model));
    return model;
}

static void published_counts_are_met_on_dinis_surface(void **state)
{
    (void)state;
    static const struct {
        const char *method;
        int count;
    } published[] = {{"lspia-opt", 213}, {"mlspia", 82}, {"nmlspia", 30}, {"alspia", 37}, {"salspia", 14}};
    pia_context *context = context_with(1);
    problem p = problem_make(PIA_GRID, 3, 0, 3, 81, 31);
    double parameters[162];
    for (int i = 0; i < 162; i++) parameters[i] = i % 81 / 80.0;
    for (int i = 0; i < 81 * 81; i++) {
        double a = 4 * M_PI * (i / 81) / 80, b = 0.1 + (M_PI - 0.2) * (i % 81) / 80;
        p.points[3 * i] = cos(a) * sin(b);
        p.points[3 * i + 1] = sin(a) * sin(b);
        p.points[3 * i + 2] = cos(b) + log(tan(b / 2)) + a;
    }
    pia_model *start = dini_start(context, p.points);
    p.data.parameters = parameters;
    p.options.start = start;
    p.options.stop_gradient = p.options.stop_change = 0;
    for (size_t k = 0; k < sizeof published / sizeof *published; k++) {
        pia_fit *fit = NULL;
        pia_report report = {.struct_size = sizeof report};
        double first = 0, now = 0;
        int count = 0;
        p.options.method = published[k].method;
        assert_ok(context, pia_fit_open(context, &p.data, &p.options, &fit));
        for (; count < 300 && (count < 2 || now * now >= 1e-6 * first * first); count++) { /* a step tells the gradient it began with */
            assert_ok(context, pia_fit_step(fit, 1, &report));
            now = report.relative_gradient;
            if (count == 0) first = now;
        }
        assert_int_equal(count - 1, published[k].count);
        pia_fit_close(fit);
    }
    pia_model_destroy(start);
    problem_release(&p);
    pia_context_destroy(context);
}

static pia_data weighted_rows(double rows[][4], pia_index count, double *points, double *parameters, double *weights)
{
    pia_data data;
    pia_data_init(&data);
    for (pia_index i = 0; i < count; i++) {
        memcpy(points + 2 * i, rows[i], 2 * sizeof *points);
        parameters[i] = rows[i][2];
        weights[i] = rows[i][3];
    }
    data.points = points;
    data.parameters = parameters;
    data.weights = weights;
    data.dim = 2;
    data.count[0] = count;
    return data;
}

/* The solution with rows added later is that with the same rows and weights from the beginning. */
static void rows_added_later_bring_their_weights(void **state)
{
    (void)state;
    enum { ALL = 63 };
    double all[ALL][4], first[ALL][4], later[ALL][4]; /* x, y, parameter, weight */
    int firsts = 0, laters = 0;
    for (int i = 0; i < ALL; i++) {
        double t = (double)i / (ALL - 1), heavy = i % 20 == 10;
        double row[4] = {t, heavy ? 3 : sin(6 * t), t, heavy ? 50 : 1};
        memcpy(all[i], row, sizeof row);
        memcpy(heavy ? later[laters++] : first[firsts++], row, sizeof row);
    }
    double points[3][2 * ALL], parameters[3][ALL], weights[3][ALL], control[2][8 * 2];
    pia_data data = weighted_rows(first, firsts, points[0], parameters[0], weights[0]);
    pia_data more = weighted_rows(later, laters, points[1], parameters[1], weights[1]);
    pia_data whole = weighted_rows(all, ALL, points[2], parameters[2], weights[2]);
    data.weights = NULL; /* they are 1 */
    const double knots[] = {0, 0, 0, 0, 0.2, 0.4, 0.6, 0.8, 1, 1, 1, 1};
    pia_fit_options options;
    pia_fit_options_init(&options);
    options.knots[0] = knots;
    options.knot_count[0] = 12;
    pia_context *context = NULL;
    pia_fit *fit;
    pia_model *model[2];
    assert_ok(NULL, pia_context_create(NULL, &context));
    assert_ok(context, pia_fit_open(context, &data, &options, &fit));
    assert_ok(context, pia_fit_add_points(fit, &more));
    assert_ok(context, pia_fit_run(fit, NULL));
    assert_ok(context, pia_fit_model(fit, &model[0]));
    assert_ok(context, pia_fit_data(context, &whole, &options, &model[1], NULL));
    for (int k = 0; k < 2; k++) pia_model_control(model[k], control[k], NULL);
    for (int i = 0; i < 16; i++) assert_near(control[0][i], control[1][i], 1e-11);
    pia_fit_close(fit);
    for (int k = 0; k < 2; k++) pia_model_destroy(model[k]);
    pia_context_destroy(context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_method_reaches_the_dense_solution_of_open_curves),
        cmocka_unit_test(every_method_reaches_the_direct_solution_of_closed_curves),
        cmocka_unit_test(every_method_reaches_the_dense_solution_of_grids),
        cmocka_unit_test(grids_with_weights_and_holes_have_the_same_limit),
        cmocka_unit_test(iterates_are_the_same_with_and_without_a_normal_form),
        cmocka_unit_test(the_thread_count_changes_no_bit),
        cmocka_unit_test(gaps_leave_every_method_bounded),
        cmocka_unit_test(no_method_leaves_the_limit),
        cmocka_unit_test(a_diverging_fit_ends_with_a_finite_model),
        cmocka_unit_test(published_counts_are_met_on_dinis_surface),
        cmocka_unit_test(rows_added_later_bring_their_weights),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
