/* Laws of every method that interpolates, over the public interface: one limit, affine maps and reversal commute with fitting, threads
 * change nothing, [2004]'s tri-diagonal step is the general one. */
#include "context_fixture.h"

#include <stdlib.h>

typedef struct problem {
    int dim, degree, closed;
    pia_index count;
    double *points, *parameters; /* parameters NULL: chord */
} problem;

static const char *const interpolating[] = {"pia", "wpia", "pia-chebyshev", "local-pia", "direct"};
/* So many iterations mean: until steps are rounding only. */
enum { TO_THE_LIMIT = 200000 };
enum { METHODS = sizeof interpolating / sizeof *interpolating };

static problem airfoil(pia_context *context, const char *name, int dim, int degree)
{
    char path[512];
    pia_points *file;
    pia_points_info info = {.struct_size = sizeof info};
    snprintf(path, sizeof path, "%s/airfoil/%s", PIA_DATA, name);
    assert_ok(context, pia_points_read(context, path, NULL, &file));
    pia_points_get_info(file, &info);
    problem p = {.dim = dim, .degree = degree, .count = info.count[0]};
    p.points = malloc((size_t)(p.count * dim) * sizeof *p.points);
    for (pia_index i = 0; i < p.count; i++) {
        const double *xy = info.points + i * info.dim;
        const double wide[4] = {xy[0], xy[1], xy[0] * xy[1], sin(4 * xy[0])};
        memcpy(p.points + i * dim, wide, (size_t)dim * sizeof *wide);
    }
    pia_points_destroy(file);
    return p;
}

/* Evenly spaced rows, where every method gets to its limit quickly. */
static problem flower(int dim, int degree, int closed, pia_index count)
{
    problem p = {.dim = dim, .degree = degree, .closed = closed, .count = count};
    p.points = malloc((size_t)(count * dim) * sizeof *p.points);
    p.parameters = malloc((size_t)count * sizeof *p.parameters);
    for (pia_index i = 0; i < count; i++) {
        double t = (double)i / (double)(closed ? count : count - 1), a = 6.283185307179586 * t;
        const double wide[4] = {cos(a) * (2 + sin(3 * a)), sin(a), cos(2 * a), sin(3 * a) / 7};
        memcpy(p.points + i * dim, wide, (size_t)dim * sizeof *wide);
        p.parameters[i] = t;
    }
    return p;
}

static void release(problem *p)
{
    free(p->points);
    free(p->parameters);
}

static pia_model *fit(pia_context *context, const problem *p, const char *method, const char *placement, pia_index iterations,
                      pia_report *report)
{
    pia_data data;
    pia_fit_options options;
    pia_model *model;
    pia_data_init(&data);
    pia_fit_options_init(&options);
    data.points = p->points;
    data.parameters = p->parameters;
    data.count[0] = p->count;
    data.dim = p->dim;
    options.degree[0] = p->degree;
    options.closed[0] = p->closed;
    options.method = method;
    options.placement = placement;
    options.max_iterations = iterations;
    if (iterations != PIA_AUTO) options.stop_change = iterations == TO_THE_LIMIT ? 1e-17 : 0;
    assert_ok(context, pia_fit_data(context, &data, &options, &model, report));
    return model;
}

static double *control_of(const pia_model *model, size_t *count)
{
    pia_model_info info = {.struct_size = sizeof info};
    pia_model_get_info(model, &info);
    *count = (size_t)(info.control[0] * info.control[1] * info.dim);
    double *points = malloc(*count * sizeof *points);
    pia_model_control(model, points, NULL);
    return points;
}

static double extent_of(const problem *p)
{
    double square = 0;
    for (int d = 0; d < p->dim; d++) {
        double low = p->points[d], high = low;
        for (pia_index i = 0; i < p->count; i++) {
            low = fmin(low, p->points[i * p->dim + d]);
            high = fmax(high, p->points[i * p->dim + d]);
        }
        square += (high - low) * (high - low);
    }
    return sqrt(square);
}

static void same_limit(pia_context *context, const problem *p, double tolerance)
{
    size_t count, other;
    pia_model *direct = fit(context, p, "direct", "average", PIA_AUTO, NULL);
    double *limit = control_of(direct, &count), extent = extent_of(p);
    for (int k = 0; k < METHODS; k++) {
        pia_report report = {.struct_size = sizeof report};
        pia_model *model = fit(context, p, interpolating[k], "average", TO_THE_LIMIT, &report);
        double *points = control_of(model, &other);
        assert_int_equal(other, count);
        assert_true(report.stop == PIA_STOP_CHANGE || report.stop == PIA_STOP_STALLED || report.stop == PIA_STOP_FINITE);
        for (size_t i = 0; i < count; i++) assert_near(points[i], limit[i], tolerance * extent);
        free(points);
        pia_model_destroy(model);
    }
    free(limit);
    pia_model_destroy(direct);
}

static void every_method_reaches_the_interpolating_spline(void **state)
{
    for (int degree = 1; degree <= 7; degree++)
        for (int dim = 1; dim <= 4; dim++)
            for (int closed = 0; closed < 2; closed++) {
                problem p = flower(dim, degree, closed, 31);
                same_limit(*state, &p, 1e-12);
                release(&p);
            }
}

static void pia_meets_every_point_of_the_airfoils(void **state)
{
    static const char *const name[] = {"rae2822.dat", "naca2412.dat", "e387.dat", "clarky.dat", "ag35.dat", "sc20714.dat"};
    for (size_t k = 0; k < sizeof name / sizeof *name; k++)
        for (int dim = 2; dim <= 4; dim++)
            for (int degree = 1; degree <= 7; degree++) {
                double tolerance = degree < 7 ? 1e-12 : 1e-11; /* control points: rounding times the condition */
                problem p = airfoil(*state, name[k], dim, degree);
                pia_report report = {.struct_size = sizeof report};
                pia_model *pia = fit(*state, &p, "pia", "average", TO_THE_LIMIT, &report);
                pia_model *direct = fit(*state, &p, "direct", "average", PIA_AUTO, NULL);
                size_t count;
                double *a = control_of(pia, &count), *b = control_of(direct, &count);
                assert_true(report.stop == PIA_STOP_CHANGE || report.stop == PIA_STOP_STALLED);
                assert_true(report.max_error <= 1e-14 * extent_of(&p));
                for (size_t i = 0; i < count; i++) assert_near(a[i], b[i], tolerance * extent_of(&p));
                free(a);
                free(b);
                pia_model_destroy(pia);
                pia_model_destroy(direct);
                release(&p);
            }
}

/* [2004] as printed: knots of Eq. (1), tri-diagonal steps, doubled ends. */
static void paper_steps(const problem *p, int steps, double *points)
{
    pia_index n = p->count;
    int dim = p->dim;
    double *t = calloc((size_t)n + 6, sizeof *t), *next = malloc((size_t)(n * dim) * sizeof *next);
    for (pia_index i = 1; i < n; i++) {
        double square = 0;
        for (int d = 0; d < dim; d++) square += pow(p->points[i * dim + d] - p->points[(i - 1) * dim + d], 2);
        t[i + 3] = t[i + 2] + sqrt(square);
    }
    for (pia_index i = n + 3; i < n + 6; i++) t[i] = t[n + 2];
    memcpy(points, p->points, (size_t)(n * dim) * sizeof *points);
    for (int step = 0; step < steps; step++) {
        for (pia_index j = 0; j < n; j++) { /* point j, the paper's j + 1: control points j, j + 1, j + 2 of 0 .. n + 1 */
            double left = t[j + 3] - t[j + 2], right = t[j + 4] - t[j + 3], alpha = 0, gamma = 0;
            if (j > 0 && j < n - 1) {
                alpha = right * right / ((t[j + 4] - t[j + 1]) * (t[j + 4] - t[j + 2]));
                gamma = left * left / ((t[j + 5] - t[j + 2]) * (t[j + 4] - t[j + 2]));
            }
            pia_index before = j > 0 ? j - 1 : 0, after = j < n - 1 ? j + 1 : n - 1;
            for (int d = 0; d < dim; d++) {
                double value =
                    alpha * points[before * dim + d] + (1 - alpha - gamma) * points[j * dim + d] + gamma * points[after * dim + d];
                next[j * dim + d] = points[j * dim + d] + p->points[j * dim + d] - value;
            }
        }
        memcpy(points, next, (size_t)(n * dim) * sizeof *points);
    }
    free(t);
    free(next);
}

static void the_tridiagonal_step_of_the_paper_is_the_general_one(void **state)
{
    problem p = airfoil(*state, "naca2412.dat", 2, 3);
    pia_model *model = fit(*state, &p, "pia", "pia2004", 25, NULL);
    size_t count;
    double *found = control_of(model, &count), *expected = malloc((size_t)(p.count * 2) * sizeof *expected);
    paper_steps(&p, 25, expected);
    assert_int_equal(count, (size_t)(p.count + 2) * 2);
    for (pia_index i = 0; i < p.count * 2; i++) assert_near(found[2 + i], expected[i], 1e-13);
    for (int d = 0; d < 2; d++) {
        assert_true(found[d] == found[2 + d]);
        assert_true(found[(p.count + 1) * 2 + d] == found[p.count * 2 + d]);
    }
    free(found);
    free(expected);
    pia_model_destroy(model);
    release(&p);
}

static void affine_maps_commute_with_every_iterate(void **state)
{
    static const double map[2][2] = {{3, -1.5}, {0.25, 2}}, shift[2] = {-7, 1000};
    for (int k = 0; k < METHODS; k++) {
        problem p = flower(2, 3, 0, 40), q = flower(2, 3, 0, 40);
        for (pia_index i = 0; i < p.count; i++)
            for (int d = 0; d < 2; d++) q.points[2 * i + d] = map[d][0] * p.points[2 * i] + map[d][1] * p.points[2 * i + 1] + shift[d];
        if (strcmp(interpolating[k], "local-pia") != 0) { /* chooses by distance, which only similarities keep */
            size_t count;
            pia_model *a = fit(*state, &p, interpolating[k], "average", 9, NULL),
                      *b = fit(*state, &q, interpolating[k], "average", 9, NULL);
            double *x = control_of(a, &count), *y = control_of(b, &count);
            for (size_t i = 0; i < count / 2; i++)
                for (int d = 0; d < 2; d++)
                    assert_near(y[2 * i + (size_t)d], map[d][0] * x[2 * i] + map[d][1] * x[2 * i + 1] + shift[d], 1e-9);
            free(x);
            free(y);
            pia_model_destroy(a);
            pia_model_destroy(b);
        }
        release(&p);
        release(&q);
    }
}

static void reversed_data_give_the_reversed_curve(void **state)
{
    for (int k = 0; k < METHODS; k++) {
        int estimates = strcmp(interpolating[k], "wpia") == 0 || strcmp(interpolating[k], "pia-chebyshev") == 0; /* an eigenvalue */
        problem p = airfoil(*state, "clarky.dat", 2, 3), q = airfoil(*state, "clarky.dat", 2, 3);
        for (pia_index i = 0; i < p.count; i++) memcpy(q.points + 2 * i, p.points + 2 * (p.count - 1 - i), 2 * sizeof *p.points);
        size_t count;
        pia_model *a = fit(*state, &p, interpolating[k], "average", 12, NULL),
                  *b = fit(*state, &q, interpolating[k], "average", 12, NULL);
        double *x = control_of(a, &count), *y = control_of(b, &count);
        for (size_t i = 0; i < count / 2; i++)
            for (size_t d = 0; d < 2; d++) assert_near(y[2 * i + d], x[2 * (count / 2 - 1 - i) + d], estimates ? 1e-8 : 1e-13);
        free(x);
        free(y);
        pia_model_destroy(a);
        pia_model_destroy(b);
        release(&p);
        release(&q);
    }
}

static void a_grid_has_the_limit_of_its_lines(void **state)
{
    enum { U = 14, V = 17 };
    double points[U * V * 3];
    for (int i = 0; i < U; i++)
        for (int j = 0; j < V; j++) {
            double *p = points + 3 * (i * V + j);
            p[0] = i + 0.2 * sin(j);
            p[1] = j;
            p[2] = sin(0.6 * i) * cos(0.4 * j);
        }
    for (int degree = 1; degree <= 4; degree++)
        for (int closed = 0; closed < 4; closed++) {
            pia_data data;
            pia_fit_options options;
            pia_model *model[2];
            pia_data_init(&data);
            data.kind = PIA_GRID;
            data.points = points;
            data.count[0] = U;
            data.count[1] = V;
            data.dim = 3;
            for (int k = 0; k < 2; k++) {
                pia_report report = {.struct_size = sizeof report};
                pia_fit_options_init(&options);
                options.degree[0] = degree;
                options.degree[1] = degree + 1;
                options.closed[0] = closed & 1;
                options.closed[1] = closed >> 1;
                options.parametrization = "uniform";
                options.placement = "average";
                options.method = k == 0 ? "direct" : "pia";
                options.max_iterations = 200000;
                assert_ok(*state, pia_fit_data(*state, &data, &options, &model[k], &report));
                assert_true(report.max_error < 1e-11);
            }
            size_t count;
            double *x = control_of(model[0], &count), *y = control_of(model[1], &count);
            for (size_t i = 0; i < count; i++) assert_near(y[i], x[i], 1e-10);
            free(x);
            free(y);
            pia_model_destroy(model[0]);
            pia_model_destroy(model[1]);
        }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_method_reaches_the_interpolating_spline),
        cmocka_unit_test(pia_meets_every_point_of_the_airfoils),
        cmocka_unit_test(the_tridiagonal_step_of_the_paper_is_the_general_one),
        cmocka_unit_test(affine_maps_commute_with_every_iterate),
        cmocka_unit_test(reversed_data_give_the_reversed_curve),
        cmocka_unit_test(a_grid_has_the_limit_of_its_lines),
    };
    return cmocka_run_group_tests(tests, open_context, close_context);
}
