/* Fits to a tolerance: what the report says is true, whatever the curve, degree, dimension and number of threads. */
#include <stdlib.h>

#include "check.h"

typedef struct problem {
    pia_data data;
    pia_fit_options options;
    double *points;
} problem;

static double random_number(uint64_t *seed)
{
    *seed = *seed * 6364136223846793005u + 1442695040888963407u;
    return (double)(*seed >> 11) * 0x1p-53;
}

/* A wavy line, closed or not, with a little noise, far from the origin. */
static problem wavy(int degree, int closed, int dim, pia_index count, double tolerance)
{
    problem p;
    uint64_t seed = 7;
    pia_data_init(&p.data);
    pia_fit_options_init(&p.options);
    p.points = malloc((size_t)(count * dim) * sizeof *p.points);
    for (pia_index i = 0; i < count; i++) {
        double u = 6.283185307179586 * (double)i / (double)(closed ? count : count - 1);
        for (int d = 0; d < dim; d++)
            p.points[i * dim + d] = 1000 + 10 * cos(u + 1.6 * d) + 2 * sin((3 + d) * u) + 0.01 * random_number(&seed);
    }
    p.data.points = p.points;
    p.data.count[0] = count;
    p.data.dim = dim;
    p.options.degree[0] = degree;
    p.options.closed[0] = closed;
    p.options.tolerance = tolerance;
    return p;
}

/* The largest deviation over what is allowed, by evaluating the model at the parameters that the fit tells. */
static double largest_ratio(pia_context *context, const problem *p, pia_fit *fit)
{
    const double *parameters;
    const pia_index *row;
    pia_index count;
    pia_model *model;
    int dim = p->data.dim;
    assert_ok(context, pia_fit_model(fit, &model));
    assert_ok(context, pia_fit_parameters(fit, &parameters, &count, &row));
    double *value = malloc((size_t)(count * dim) * sizeof *value), worst = 0;
    assert_ok(context, pia_model_eval(context, model, parameters, count, 0, value));
    for (pia_index i = 0; i < count; i++) {
        pia_index at = row != NULL ? row[i] : i;
        double square = 0;
        for (int d = 0; d < dim; d++) {
            double off = fabs(value[i * dim + d] - p->points[at * dim + d]);
            square += off * off;
            if (p->options.axis_tolerance_count > 0) worst = fmax(worst, off / p->options.axis_tolerances[d]);
        }
        if (p->data.tolerances == NULL && p->options.tolerance == 0) continue;
        double allowed = p->data.tolerances != NULL ? p->data.tolerances[at] : p->options.tolerance;
        worst = fmax(worst, sqrt(square) / allowed);
    }
    free(value);
    pia_model_destroy(model);
    return worst;
}

static void check_problem(pia_context *context, const problem *p, pia_index most)
{
    pia_fit *fit;
    pia_report report = {.struct_size = sizeof report};
    assert_ok(context, pia_fit_open(context, &p->data, &p->options, &fit));
    assert_ok(context, pia_fit_run(fit, &report));
    assert_string_equal(pia_stop_name(report.stop), "tolerance");
    assert_int_equal(report.reached, 1);
    assert_true(largest_ratio(context, p, fit) <= 1 + 1e-9);
    if (report.control_count > most)
        fail_msg("%lld control points, at most %lld expected", (long long)report.control_count, (long long)most);
    pia_fit_close(fit);
}

static void a_fit_that_says_reached_keeps_the_tolerance(void **state)
{
    (void)state;
    pia_context *context;
    assert_ok(NULL, pia_context_create(NULL, &context));
    for (int degree = 1; degree <= 7; degree++)
        for (int closed = 0; closed < 2; closed++)
            for (int dim = 1; dim <= 4; dim++) {
                problem p = wavy(degree, closed, dim, 400, 0.05);
                if (dim == 1) p.options.parametrization = "uniform";
                check_problem(context, &p, degree == 1 ? 200 : 80);
                free(p.points);
            }
    pia_context_destroy(context);
}

static void high_degrees_keep_the_tolerance(void **state)
{
    (void)state;
    pia_context *context;
    assert_ok(NULL, pia_context_create(NULL, &context));
    for (int degree = 8; degree <= 25; degree += 17)
        for (int closed = 0; closed < 2; closed++) {
            problem p = wavy(degree, closed, 2, 2000, 0.1);
            check_problem(context, &p, 120);
            free(p.points);
        }
    pia_context_destroy(context);
}

static void tolerances_a_point_are_kept(void **state)
{
    (void)state;
    pia_context *context;
    assert_ok(NULL, pia_context_create(NULL, &context));
    problem p = wavy(3, 0, 2, 500, 1);
    double *tolerances = malloc(500 * sizeof *tolerances);
    for (int i = 0; i < 500; i++) tolerances[i] = i < 250 ? 1 : 0.02;
    p.data.tolerances = tolerances;
    check_problem(context, &p, 60);
    free(tolerances);
    free(p.points);
    pia_context_destroy(context);
}

/* Open and closed, of a degree whose powers lose digits too, alone and beside tolerances of points. */
static void tolerances_an_axis_are_kept(void **state)
{
    (void)state;
    static const double axes[] = {1, 0.02, 0.5};
    static const int degrees[] = {3, 8};
    pia_context *context;
    double tolerances[500];
    assert_ok(NULL, pia_context_create(NULL, &context));
    for (int i = 0; i < 500; i++) tolerances[i] = i < 250 ? 2 : 0.05;
    for (int degree = 0; degree < 2; degree++)
        for (int closed = 0; closed < 2; closed++)
            for (int points = 0; points < 2; points++) {
                problem p = wavy(degrees[degree], closed, 3, 500, 0);
                p.options.axis_tolerances = axes;
                p.options.axis_tolerance_count = 3;
                if (points) p.data.tolerances = tolerances;
                check_problem(context, &p, 70);
                free(p.points);
            }
    pia_context_destroy(context);
}

/* A box is no smaller than the ball in it; and what is far too loose does not count. */
static void a_loose_axis_costs_no_control_points(void **state)
{
    (void)state;
    static const double loose[] = {0.05, 1e6}, box[] = {0.05, 0.05};
    pia_context *context;
    pia_report ball = {.struct_size = sizeof ball}, report = {.struct_size = sizeof report};
    assert_ok(NULL, pia_context_create(NULL, &context));
    problem p = wavy(3, 0, 2, 400, 0.05);
    p.options.parametrization = "uniform";
    assert_ok(context, pia_fit_data(context, &p.data, &p.options, NULL, &ball));
    assert_int_equal(ball.worst_axis, PIA_AUTO);
    p.options.tolerance = 0;
    p.options.axis_tolerance_count = 2;
    p.options.axis_tolerances = box;
    assert_ok(context, pia_fit_data(context, &p.data, &p.options, NULL, &report));
    assert_true(report.control_count <= ball.control_count + 1);
    p.options.axis_tolerances = loose;
    assert_ok(context, pia_fit_data(context, &p.data, &p.options, NULL, &report));
    assert_true(report.control_count < ball.control_count);
    assert_int_equal(report.worst_axis, 0);
    assert_true(report.axis_error[0] <= 0.05 && report.axis_error[1] > 0.05);
    free(p.points);
    pia_context_destroy(context);
}

/* With so many control points as asked for, the one tolerance of all is not taken for those of points or axes. */
static void reached_means_every_tolerance_whatever_the_method(void **state)
{
    (void)state;
    static const double axes[] = {10, 1e-6};
    pia_context *context;
    pia_report report = {.struct_size = sizeof report};
    double tolerances[400];
    assert_ok(NULL, pia_context_create(NULL, &context));
    for (int i = 0; i < 400; i++) tolerances[i] = i == 200 ? 1e-6 : 10;
    for (int by_axis = 0; by_axis < 2; by_axis++) {
        problem p = wavy(3, 0, 2, 400, 0);
        p.options.control[0] = 20;
        if (by_axis)
            p.options.axis_tolerances = axes;
        else
            p.data.tolerances = tolerances;
        p.options.axis_tolerance_count = by_axis ? 2 : 0;
        for (int method = 0; method < 2; method++) {
            p.options.method = method == 0 ? "direct" : "lspia";
            assert_ok(context, pia_fit_data(context, &p.data, &p.options, NULL, &report));
            assert_int_equal(report.reached, 0);
            assert_true(report.stop != PIA_STOP_TOLERANCE);
            assert_int_equal(report.worst_axis, by_axis ? 1 : PIA_AUTO);
        }
        free(p.points);
    }
    pia_context_destroy(context);
}

static void axis_tolerances_that_make_no_sense_are_refused(void **state)
{
    (void)state;
    static const double axes[] = {1, 0, 1};
    pia_context *context;
    assert_ok(NULL, pia_context_create(NULL, &context));
    problem p = wavy(3, 0, 2, 100, 0);
    p.options.axis_tolerances = axes;
    p.options.axis_tolerance_count = 3;
    assert_int_equal(pia_fit_data(context, &p.data, &p.options, NULL, NULL), PIA_E_SHAPE);
    assert_non_null(strstr(pia_message(context), "3 axis tolerances were given, but 2 components"));
    p.options.axis_tolerance_count = 2;
    assert_int_equal(pia_fit_data(context, &p.data, &p.options, NULL, NULL), PIA_E_ARGUMENT);
    assert_non_null(strstr(pia_message(context), "axis tolerance 1 is 0"));
    free(p.points);
    pia_context_destroy(context);
}

/* An iteration is a round; the cap is kept and reached is what holds then. */
static void the_iterations_asked_for_are_all_that_run(void **state)
{
    (void)state;
    pia_context *context;
    pia_report report = {.struct_size = sizeof report};
    assert_ok(NULL, pia_context_create(NULL, &context));
    problem p = wavy(3, 0, 2, 400, 0.02);
    for (int most = 0; most < 3; most++) {
        p.options.max_iterations = most;
        assert_ok(context, pia_fit_data(context, &p.data, &p.options, NULL, &report));
        assert_int_equal(report.iterations, most);
        assert_int_equal(report.stop, PIA_STOP_ITERATIONS);
        assert_int_equal(report.reached, 0);
    }
    free(p.points);
    pia_context_destroy(context);
}

/* A right angle through few points, met by a curve that cannot follow it: the middle of a leg is off, the points are not. */
static void a_curve_that_swings_out_between_its_points_says_so(void **state)
{
    (void)state;
    static const double points[] = {0, 0, 1, 0, 2, 0, 3, 0, 13, 0, 13, 10, 14, 10, 15, 10, 16, 10, 17, 10};
    pia_context *context;
    pia_report report = {.struct_size = sizeof report};
    pia_data data;
    pia_fit_options options;
    pia_fit *fit;
    assert_ok(NULL, pia_context_create(NULL, &context));
    pia_data_init(&data);
    pia_fit_options_init(&options);
    data.points = points;
    data.count[0] = 10;
    data.dim = 2;
    options.tolerance = 0.01;
    assert_ok(context, pia_fit_open(context, &data, &options, &fit));
    assert_ok(context, pia_fit_run(fit, &report));
    assert_int_equal(report.reached, 1);
    assert_true(report.between_error > 0.1 && report.between_error < 10);
    int told = 0;
    for (pia_index i = 0; pia_fit_note(fit, i) != NULL; i++) told += strstr(pia_fit_note(fit, i), "between the points") != NULL;
    assert_int_equal(told, 1);
    pia_fit_close(fit);
    problem dense = wavy(3, 1, 2, 4000, 0.05);
    assert_ok(context, pia_fit_data(context, &dense.data, &dense.options, NULL, &report));
    assert_true(report.between_error <= 0.06);
    free(dense.points);
    pia_context_destroy(context);
}

static void the_number_of_threads_changes_no_bit(void **state)
{
    (void)state;
    static const int threads[] = {1, 2, 5};
    double *first = NULL;
    pia_index count = 0;
    for (size_t k = 0; k < sizeof threads / sizeof *threads; k++) {
        pia_context *context;
        pia_model *model;
        pia_model_info info = {.struct_size = sizeof info};
        assert_ok(NULL, pia_context_create(NULL, &context));
        assert_ok(context, pia_context_set_threads(context, threads[k]));
        problem p = wavy(3, 0, 3, 6000, 0.006); /* within the noise: hundreds of control points, several segments */
        assert_ok(context, pia_fit_data(context, &p.data, &p.options, &model, NULL));
        pia_model_get_info(model, &info);
        double *points = malloc((size_t)(info.control[0] * 3) * sizeof *points);
        pia_model_control(model, points, NULL);
        assert_true(info.control[0] > 200);
        if (first == NULL) {
            first = points;
            count = info.control[0];
        } else {
            assert_int_equal(info.control[0], count);
            assert_memory_equal(points, first, (size_t)(count * 3) * sizeof *points);
            free(points);
        }
        free(p.points);
        pia_model_destroy(model);
        pia_context_destroy(context);
    }
    free(first);
}

/* Heights of a wavy sheet, in a ring in the second direction when closed. */
static problem sheet(pia_kind kind, int degree, int closed, double tolerance)
{
    enum { U = 30, V = 45 };
    problem p;
    uint64_t seed = 3;
    pia_data_init(&p.data);
    pia_fit_options_init(&p.options);
    p.points = malloc(U * V * 3 * sizeof *p.points);
    for (int i = 0; i < U; i++)
        for (int j = 0; j < V; j++) {
            double *q = p.points + 3 * (i * V + j), angle = 6.283185307179586 * j / V;
            q[0] = closed ? 10 * cos(angle) : j;
            q[1] = closed ? 10 * sin(angle) : i;
            q[2] = (closed ? i : 0) + 3 * sin(0.2 * i) * cos(closed ? 2 * angle : 0.15 * j) + 0.01 * random_number(&seed);
        }
    p.data.kind = kind;
    p.data.points = p.points;
    p.data.count[0] = kind == PIA_SCATTERED ? U * V : U;
    p.data.count[1] = kind == PIA_SCATTERED ? 1 : V;
    p.data.dim = 3;
    for (int d = 0; d < 2; d++) p.options.degree[d] = degree;
    p.options.closed[1] = closed;
    p.options.tolerance = tolerance;
    return p;
}

static void check_sheet(pia_context *context, const problem *p, pia_index most)
{
    pia_model *model;
    pia_report report = {.struct_size = sizeof report};
    pia_deviation deviation = {.struct_size = sizeof deviation};
    assert_ok(context, pia_fit_data(context, &p->data, &p->options, &model, &report));
    assert_string_equal(pia_stop_name(report.stop), "tolerance");
    assert_int_equal(report.reached, 1);
    assert_true(report.max_error <= p->options.tolerance);
    pia_index rows = p->data.count[0] * p->data.count[1];
    assert_ok(context, pia_model_deviation(context, model, p->points, rows, NULL, &deviation, NULL));
    assert_true(deviation.max_error <= p->options.tolerance);
    if (report.control_count > most)
        fail_msg("%lld control points, at most %lld expected", (long long)report.control_count, (long long)most);
    pia_model_destroy(model);
}

static void surfaces_keep_the_tolerance(void **state)
{
    (void)state;
    pia_context *context;
    assert_ok(NULL, pia_context_create(NULL, &context));
    for (int degree = 2; degree <= 4; degree++)
        for (int closed = 0; closed < 2; closed++) {
            problem p = sheet(PIA_GRID, degree, closed, 0.05);
            check_sheet(context, &p, 350);
            p.options.tolerance = 1e-6; /* below the noise: every row is met */
            check_sheet(context, &p, 30 * 45);
            free(p.points);
        }
    problem p = sheet(PIA_SCATTERED, 3, 0, 0.1);
    double *parameters = malloc(2 * 30 * 45 * sizeof *parameters);
    for (int i = 0; i < 30 * 45; i++) {
        parameters[2 * i] = i / 45 / 29.0;
        parameters[2 * i + 1] = i % 45 / 44.0;
    }
    p.data.parameters = parameters;
    check_sheet(context, &p, 350);
    free(parameters);
    free(p.points);
    pia_context_destroy(context);
}

/* A steep sheet, open and in a ring, whole and with a hole: measured at the closest points of the model. */
static void true_distance_of_grids_is_kept_with_fewer_control_points(void **state)
{
    (void)state;
    pia_context *context;
    assert_ok(NULL, pia_context_create(NULL, &context));
    for (int closed = 0; closed < 2; closed++)
        for (int hole = 0; hole < 2; hole++) {
            problem p = sheet(PIA_GRID, 3, closed, 0.1);
            for (int i = 0; i < 30 * 45; i++) p.points[3 * i + 2] *= closed ? 1 : 4;
            if (hole) p.points[3 * (12 * 45 + 20) + 2] = NAN;
            pia_report plain = {.struct_size = sizeof plain}, distance = {.struct_size = sizeof distance};
            pia_model *model;
            assert_ok(context, pia_fit_data(context, &p.data, &p.options, NULL, &plain));
            p.options.measure_distance = 1;
            assert_ok(context, pia_fit_data(context, &p.data, &p.options, &model, &distance));
            assert_int_equal(distance.kind, PIA_GRID);
            assert_int_equal(distance.measure_distance, 1);
            assert_int_equal(distance.reached, 1);
            assert_true(distance.control_count < plain.control_count);
            double away[30 * 45], parameter[2];
            for (int i = 0; i < 30 * 45; i++) {
                if (isnan(p.points[3 * i + 2])) continue;
                assert_ok(context, pia_model_closest(context, model, p.points + 3 * i, 1, parameter, &away[i]));
                assert_true(away[i] <= p.options.tolerance);
            }
            pia_model_destroy(model);
            free(p.points);
        }
    pia_context_destroy(context);
}

/* Scattered rows on the borders of spans: basis functions are 0 there but for rounding, which holds no control point. */
static void rows_on_knots_are_as_far_as_is_said(void **state)
{
    (void)state;
    enum { SIDE = 9, ROWS = SIDE * SIDE - 1 };
    pia_context *context;
    assert_ok(NULL, pia_context_create(NULL, &context));
    for (int missing = 1; missing < ROWS; missing += 7) {
        double parameters[2 * ROWS], points[3 * ROWS], at[3 * ROWS], worst = 0, control[3 * 4 * SIDE * SIDE];
        for (int row = 0; row < ROWS; row++) {
            int place = row + (row >= missing);
            double u = parameters[2 * row] = (double)(place / SIDE) / (SIDE - 1),
                   v = parameters[2 * row + 1] = (double)(place % SIDE) / (SIDE - 1);
            points[3 * row] = u;
            points[3 * row + 1] = v;
            points[3 * row + 2] = sin(9 * u) * cos(7 * v);
        }
        problem p;
        pia_data_init(&p.data);
        pia_fit_options_init(&p.options);
        p.data.kind = PIA_SCATTERED;
        p.data.points = points;
        p.data.parameters = parameters;
        p.data.count[0] = ROWS;
        p.data.count[1] = 1;
        p.data.dim = 3;
        p.options.degree[0] = p.options.degree[1] = 1;
        p.options.tolerance = 1e-4;
        pia_model *model;
        pia_report report = {.struct_size = sizeof report};
        assert_ok(context, pia_fit_data(context, &p.data, &p.options, &model, &report));
        assert_ok(context, pia_model_eval(context, model, parameters, ROWS, 0, at));
        for (int row = 0; row < ROWS; row++)
            worst = fmax(worst, hypot(hypot(at[3 * row] - points[3 * row], at[3 * row + 1] - points[3 * row + 1]),
                                      at[3 * row + 2] - points[3 * row + 2]));
        assert_near(report.max_error, worst, 1e-9);
        assert_true(report.control_count <= 4 * SIDE * SIDE);
        pia_model_control(model, control, NULL);
        for (int i = 0; i < 3 * report.control_count; i++) assert_true(fabs(control[i]) < 1e6);
        pia_model_destroy(model);
    }
    pia_context_destroy(context);
}

static void surfaces_keep_the_tolerances_of_axes(void **state)
{
    (void)state;
    static const double axes[] = {0.5, 0.5, 0.03};
    pia_context *context;
    pia_report report = {.struct_size = sizeof report};
    assert_ok(NULL, pia_context_create(NULL, &context));
    for (int kind = PIA_GRID; kind <= PIA_SCATTERED; kind++) {
        problem p = sheet((pia_kind)kind, 3, 0, 0);
        p.options.axis_tolerances = axes;
        p.options.axis_tolerance_count = 3;
        pia_model *model;
        assert_ok(context, pia_fit_data(context, &p.data, &p.options, &model, &report));
        assert_int_equal(report.reached, 1);
        for (int d = 0; d < 3; d++) assert_true(report.axis_error[d] <= axes[d]);
        pia_model_destroy(model);
        free(p.points);
    }
    pia_context_destroy(context);
}

/* A 'D' of the given number of points at equal steps, rounded to 0.01: corners at (0,0) and (0,7). */
static problem letter_d(double tolerance)
{
    enum { COUNT = 269 };
    problem p = wavy(3, 1, 2, COUNT, tolerance);
    double ellipse = 10.22, total = 7 + 3 + ellipse + 3; /* the length of the half ellipse, nearly */
    for (int i = 0; i < COUNT; i++) {
        double s = total * i / (COUNT - 1), *q = p.points + 2 * i;
        double angle = 1.5707963267948966 - 3.141592653589793 * (s - 10) / ellipse;
        q[0] = s < 7 ? 0 : s < 10 ? s - 7 : s < 10 + ellipse ? 3 + 3 * cos(angle) : total - s;
        q[1] = s < 7 ? s : s < 10 ? 7 : s < 10 + ellipse ? 3.5 + 3.5 * sin(angle) : 0;
        for (int d = 0; d < 2; d++) q[d] = round(100 * q[d]) / 100;
    }
    return p;
}

static void a_letter_needs_few_control_points(void **state)
{
    (void)state;
    pia_context *context;
    assert_ok(NULL, pia_context_create(NULL, &context));
    problem p = letter_d(0.03);
    check_problem(context, &p, 14);
    p.options.corner_count = PIA_AUTO;
    check_problem(context, &p, 14);
    free(p.points);
    pia_context_destroy(context);
}

/* The largest distance from the point to the curve. */
static double distance_to(pia_context *context, const pia_model *model, double x, double y)
{
    double point[] = {x, y}, parameter, distance;
    assert_ok(context, pia_model_closest(context, model, point, 1, &parameter, &distance));
    return distance;
}

static void corners_are_sharp_whether_found_or_given(void **state)
{
    (void)state;
    static const pia_index given[] = {0, 81};
    pia_context *context;
    assert_ok(NULL, pia_context_create(NULL, &context));
    for (int k = 0; k < 2; k++) {
        problem p = letter_d(0.03);
        pia_model *model;
        pia_model_info info = {.struct_size = sizeof info};
        p.options.corners = given;
        p.options.corner_count = k == 0 ? 2 : PIA_AUTO;
        assert_ok(context, pia_fit_data(context, &p.data, &p.options, &model, NULL));
        pia_model_get_info(model, &info);
        double ends[4];
        assert_ok(context, pia_model_eval(context, model, info.domain[0], 2, 0, ends));
        assert_near(ends[0], ends[2], 0);
        assert_near(ends[1], ends[3], 0);
        assert_near(distance_to(context, model, 0, 0), 0, 1e-12);
        pia_index repeated = 0;
        const double *knots = pia_model_knots(model, 0);
        for (pia_index i = 4; i + 3 < info.control[0]; i++) repeated += knots[i] == knots[i + 2];
        assert_int_equal(repeated, 1);
        pia_model_destroy(model);
        free(p.points);
    }
    pia_context_destroy(context);
}

static void corners_are_told_by_their_rows(void **state)
{
    (void)state;
    static const pia_index given[] = {0, 81};
    pia_context *context;
    assert_ok(NULL, pia_context_create(NULL, &context));
    for (int k = 0; k < 3; k++) {
        problem p = letter_d(0.03);
        pia_fit *fit;
        const pia_index *row;
        pia_index count;
        p.options.corners = given;
        p.options.corner_count = k == 0 ? 0 : k == 1 ? 2 : PIA_AUTO;
        assert_ok(context, pia_fit_open(context, &p.data, &p.options, &fit));
        assert_ok(context, pia_fit_corners(fit, &row, &count));
        assert_int_equal(count, k == 0 ? 0 : 2);
        for (pia_index i = 0; i < count; i++) assert_int_equal(row[i], given[i]);
        pia_fit_close(fit);
        free(p.points);
    }
    pia_context_destroy(context);
}

static void a_corner_that_does_not_exist_is_refused(void **state)
{
    (void)state;
    static const pia_index given[] = {500};
    pia_context *context;
    pia_fit *fit;
    assert_ok(NULL, pia_context_create(NULL, &context));
    problem p = letter_d(0.03);
    p.options.corners = given;
    p.options.corner_count = 1;
    assert_status(context, pia_fit_open(context, &p.data, &p.options, &fit), PIA_E_ARGUMENT);
    free(p.points);
    pia_context_destroy(context);
}

static void what_cannot_be_had_is_said(void **state)
{
    (void)state;
    pia_context *context;
    assert_ok(NULL, pia_context_create(NULL, &context));
    problem p = wavy(3, 0, 2, 100, 1e-3);
    double parameters[100];
    for (int i = 0; i < 100; i++) parameters[i] = i / 2 / 49.5; /* two points at each parameter, 0.6 apart */
    p.data.parameters = parameters;
    pia_report report = {.struct_size = sizeof report};
    pia_model *model;
    assert_ok(context, pia_fit_data(context, &p.data, &p.options, &model, &report));
    assert_int_equal(report.reached, 0);
    assert_string_equal(pia_stop_name(report.stop), "no-knot-left");
    assert_true(report.max_error > 1e-3);
    pia_model_destroy(model);
    free(p.points);
    pia_context_destroy(context);
}

/* The control points of a fit in single steps, or in one go; the caller frees. */
static double *stepped(pia_context *context, const problem *p, pia_index at_once, pia_index *count)
{
    pia_fit *fit;
    pia_model *model;
    pia_report report = {.struct_size = sizeof report};
    pia_model_info info = {.struct_size = sizeof info};
    assert_ok(context, pia_fit_open(context, &p->data, &p->options, &fit));
    for (int k = 0; k < 1000 && report.stop == PIA_STOP_NONE; k++) assert_ok(context, pia_fit_step(fit, at_once, &report));
    assert_string_equal(pia_stop_name(report.stop), "tolerance");
    assert_true(report.iterations > 2);
    pia_trace_row before = {0}, row;
    pia_index rows = 0, most = 0;
    for (; pia_fit_trace(fit, rows, &row); rows++) {
        assert_true(rows == 0 || row.iteration > before.iteration);
        before = row;
        if (row.control_count > most) most = row.control_count;
    }
    assert_int_equal(rows, report.iterations + 1);
    assert_int_equal(row.control_count, report.control_count);
    assert_true(most > report.control_count);
    assert_ok(context, pia_fit_model(fit, &model));
    pia_model_get_info(model, &info);
    *count = info.control[0] * info.control[1] * info.dim;
    double *points = malloc((size_t)*count * sizeof *points);
    pia_model_control(model, points, NULL);
    pia_model_destroy(model);
    pia_fit_close(fit);
    return points;
}

static void single_steps_come_to_the_same_fit(void **state)
{
    (void)state;
    pia_context *context;
    assert_ok(NULL, pia_context_create(NULL, &context));
    for (int k = 0; k < 2; k++) {
        pia_index count[2];
        problem p = k == 0 ? wavy(3, 1, 2, 500, 0.05) : sheet(PIA_GRID, 3, 1, 0.1);
        p.options.trace_every = 1;
        double *whole = stepped(context, &p, INT64_MAX, &count[0]), *single = stepped(context, &p, 1, &count[1]);
        if (k == 0) assert_int_equal(count[0], count[1]);
        for (pia_index i = 0; k == 0 && i < count[0]; i++) assert_near(single[i], whole[i], 0);
        free(whole);
        free(single);
        free(p.points);
    }
    pia_context_destroy(context);
}

/* Nearly normal: the sum of twelve uniform numbers. */
static double normal_number(uint64_t *seed)
{
    double sum = -6;
    for (int i = 0; i < 12; i++) sum += random_number(seed);
    return sum;
}

static void the_noise_of_points_suggests_a_tolerance(void **state)
{
    (void)state;
    enum { U = 60, V = 90 };
    static double points[U * V * 3];
    pia_context *context;
    assert_ok(NULL, pia_context_create(NULL, &context));
    for (int kind = 0; kind < 3; kind++) {
        double tolerance, noise, largest = 0;
        uint64_t seed = 5;
        pia_data data;
        pia_data_init(&data);
        data.kind = kind == 2 ? PIA_GRID : PIA_CURVE;
        data.function_graph = kind == 1;
        data.dim = kind == 2 ? 3 : 2;
        data.count[0] = kind == 2 ? U : U * V;
        data.count[1] = kind == 2 ? V : 1;
        data.points = points;
        for (int i = 0; i < U * V; i++) {
            double *q = points + i * data.dim, square = 0, away[3];
            for (int d = 0; d < data.dim; d++) away[d] = d == 0 && kind == 1 ? 0 : 0.01 * normal_number(&seed);
            for (int d = 0; d < data.dim; d++) square += away[d] * away[d];
            largest = fmax(largest, sqrt(square));
            q[0] = (kind == 2 ? i / V : 10 * sin(0.005 * i) * (kind == 0) + 0.1 * i * (kind == 1)) + away[0];
            q[1] = (kind == 2 ? i % V : 10 * cos(0.005 * i)) + away[1];
            if (kind == 2) q[2] = 3 * sin(0.1 * (i / V)) * cos(0.08 * (i % V)) + away[2];
        }
        assert_ok(context, pia_suggest_tolerance(context, &data, &tolerance, &noise));
        assert_near(noise, 0.01, 0.001);
        assert_true(tolerance > 0.9 * largest && tolerance < 1.5 * largest);
        data.kind = PIA_SCATTERED;
        assert_status(context, pia_suggest_tolerance(context, &data, &tolerance, NULL), PIA_E_UNAVAILABLE);
        data.kind = PIA_CURVE;
        data.count[0] = 4;
        data.count[1] = 1;
        assert_status(context, pia_suggest_tolerance(context, &data, &tolerance, NULL), PIA_E_DATA);
    }
    pia_context_destroy(context);
}

static void correction_brings_points_closer(void **state)
{
    (void)state;
    static const char *const methods[] = {"direct", "lspia", "cg"};
    pia_context *context;
    assert_ok(NULL, pia_context_create(NULL, &context));
    for (size_t k = 0; k < sizeof methods / sizeof *methods; k++)
        for (int closed = 0; closed < 2; closed++) {
            pia_report plain = {.struct_size = sizeof plain}, corrected = {.struct_size = sizeof corrected};
            problem p = wavy(3, closed, 2, 300, 0);
            p.options.method = methods[k];
            p.options.control[0] = 16;
            p.options.parametrization = "uniform";
            assert_ok(context, pia_fit_data(context, &p.data, &p.options, NULL, &plain));
            p.options.correct = 5;
            assert_ok(context, pia_fit_data(context, &p.data, &p.options, NULL, &corrected));
            assert_true(corrected.rms_error < 0.9 * plain.rms_error);
            assert_true(corrected.round_count > 0 && corrected.round_count <= 5);
            assert_int_equal(corrected.stop, plain.stop);
            free(p.points);
        }
    pia_context_destroy(context);
}

static void true_distance_needs_fewer_control_points(void **state)
{
    (void)state;
    pia_context *context;
    assert_ok(NULL, pia_context_create(NULL, &context));
    problem p = wavy(3, 0, 2, 3000, 0.02);
    pia_report plain = {.struct_size = sizeof plain}, distance = {.struct_size = sizeof distance};
    assert_ok(context, pia_fit_data(context, &p.data, &p.options, NULL, &plain));
    p.options.measure_distance = 1;
    assert_ok(context, pia_fit_data(context, &p.data, &p.options, NULL, &distance));
    assert_true(distance.control_count < plain.control_count);
    assert_int_equal(distance.measure_distance, 1);
    check_problem(context, &p, plain.control_count - 1);
    free(p.points);
    pia_context_destroy(context);
}

static int stop_at_once(void *user, const pia_report *so_far)
{
    (void)so_far;
    ++*(int *)user;
    return 1;
}

static void a_cancelled_fit_keeps_a_model(void **state)
{
    (void)state;
    pia_context *context;
    assert_ok(NULL, pia_context_create(NULL, &context));
    int calls = 0;
    problem p = wavy(3, 0, 2, 1000, 0.01);
    p.options.progress = stop_at_once;
    p.options.user = &calls;
    pia_report report = {.struct_size = sizeof report};
    pia_model *model;
    assert_ok(context, pia_fit_data(context, &p.data, &p.options, &model, &report));
    assert_string_equal(pia_stop_name(report.stop), "cancelled");
    assert_int_equal(calls, 1);
    assert_int_equal(report.reached, 0);
    pia_model_destroy(model);
    free(p.points);
    pia_context_destroy(context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_fit_that_says_reached_keeps_the_tolerance),
        cmocka_unit_test(high_degrees_keep_the_tolerance),
        cmocka_unit_test(tolerances_a_point_are_kept),
        cmocka_unit_test(tolerances_an_axis_are_kept),
        cmocka_unit_test(a_loose_axis_costs_no_control_points),
        cmocka_unit_test(reached_means_every_tolerance_whatever_the_method),
        cmocka_unit_test(axis_tolerances_that_make_no_sense_are_refused),
        cmocka_unit_test(the_iterations_asked_for_are_all_that_run),
        cmocka_unit_test(a_curve_that_swings_out_between_its_points_says_so),
        cmocka_unit_test(the_number_of_threads_changes_no_bit),
        cmocka_unit_test(surfaces_keep_the_tolerance),
        cmocka_unit_test(rows_on_knots_are_as_far_as_is_said),
        cmocka_unit_test(surfaces_keep_the_tolerances_of_axes),
        cmocka_unit_test(a_letter_needs_few_control_points),
        cmocka_unit_test(corners_are_sharp_whether_found_or_given),
        cmocka_unit_test(corners_are_told_by_their_rows),
        cmocka_unit_test(a_corner_that_does_not_exist_is_refused),
        cmocka_unit_test(what_cannot_be_had_is_said),
        cmocka_unit_test(the_noise_of_points_suggests_a_tolerance),
        cmocka_unit_test(correction_brings_points_closer),
        cmocka_unit_test(true_distance_needs_fewer_control_points),
        cmocka_unit_test(true_distance_of_grids_is_kept_with_fewer_control_points),
        cmocka_unit_test(single_steps_come_to_the_same_fit),
        cmocka_unit_test(a_cancelled_fit_keeps_a_model),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
