/* Fits to a tolerance when memory runs out. */
#include "failing.h"

enum { ROWS = 7, COLUMNS = 40, LINES = 9 };

typedef struct problem {
    pia_data data;
    pia_fit_options options;
    double points[ROWS * COLUMNS * 3];
} problem;

static problem curve_problem(int closed)
{
    problem p;
    memset(&p, 0, sizeof p);
    pia_data_init(&p.data);
    pia_fit_options_init(&p.options);
    p.data.count[0] = COLUMNS;
    p.data.dim = 2;
    for (int i = 0; i < COLUMNS; i++) {
        p.points[2 * i] = cos(0.157 * i);
        p.points[2 * i + 1] = sin(0.157 * i) + 0.1 * sin(0.471 * i);
    }
    p.options.closed[0] = closed;
    p.options.tolerance = 0.02;
    p.options.measure_distance = 1;
    p.options.trace_every = 1;
    return p;
}

static problem grid_problem(void)
{
    problem p = curve_problem(0);
    p.data.kind = PIA_GRID;
    p.data.count[0] = ROWS;
    p.data.count[1] = LINES;
    p.data.dim = 3;
    p.options.tolerance = 0.2;
    for (int i = 0; i < ROWS; i++)
        for (int j = 0; j < LINES; j++) {
            double *q = p.points + 3 * (i * LINES + j);
            q[0] = i;
            q[1] = j;
            q[2] = sin(0.5 * i) * cos(0.3 * j);
        }
    return p;
}

/* Few of these points without their order, whose true distance counts: the base is chosen and parameters move. */
static problem cloud_problem(void)
{
    problem p = grid_problem();
    p.data.kind = PIA_SCATTERED;
    p.data.count[0] = 24;
    p.data.count[1] = 1;
    p.options.degree[0] = p.options.degree[1] = 2;
    for (int i = 0; i < 24; i++)
        for (int d = 0; d < 3; d++) p.points[3 * i + d] = p.points[3 * (11 * i) + d];
    return p;
}

static pia_status fit(pia_context *context, void *user)
{
    problem *p = user;
    pia_model *model = NULL;
    p->data.points = p->points;
    pia_status status = pia_fit_data(context, &p->data, &p->options, &model, NULL);
    pia_model_destroy(model);
    return status;
}

static void a_curve_survives_every_failure(void **state)
{
    (void)state;
    for (int closed = 0; closed < 2; closed++) {
        problem p = curve_problem(closed);
        assert_survives_failures(fit, &p);
    }
}

static void a_curve_with_corners_survives_every_failure(void **state)
{
    (void)state;
    static const pia_index corners[] = {7, 21};
    problem p = curve_problem(1);
    p.options.corners = corners;
    p.options.corner_count = 2;
    assert_survives_failures(fit, &p);
    p.options.corner_count = PIA_AUTO;
    assert_survives_failures(fit, &p);
}

/* Far points, between which the curve gets knots of its own. */
static void a_curve_held_between_points_survives_every_failure(void **state)
{
    (void)state;
    for (int closed = 0; closed < 2; closed++) {
        problem p = curve_problem(closed);
        p.data.count[0] = 12;
        for (int i = 6; i < 12; i++) p.points[2 * i] -= 20;
        p.options.between = 3;
        p.options.measure_distance = 0;
        p.options.trace_every = 0;
        assert_survives_failures(fit, &p);
    }
}

static void a_surface_survives_every_failure(void **state)
{
    (void)state;
    problem p = grid_problem();
    assert_survives_failures(fit, &p);
}

static void constraints_survive_every_failure(void **state)
{
    (void)state;
    static const pia_index met[] = {0, 5, 11, 13, 20};
    double weights[ROWS * COLUMNS];
    for (int kind = 0; kind < 4; kind++) {
        problem p = kind == 3 ? grid_problem() : curve_problem(kind == 1);
        static const double axes[] = {0.3, 0.2, 0.2};
        p.options.axis_tolerances = axes;
        p.options.axis_tolerance_count = kind == 2 ? 0 : p.data.dim;
        p.options.interpolate = met;
        p.options.interpolate_count = 5;
        for (int i = 0; i < ROWS * COLUMNS; i++) weights[i] = 1 + i % 3;
        if (kind == 2) p.data.weights = weights;
        assert_survives_failures(fit, &p);
    }
}

/* Two sheets over each other: the tolerance cannot be had, and the reason needs memory as well. */
static void a_cloud_survives_every_failure(void **state)
{
    (void)state;
    problem p = cloud_problem();
    for (int i = 0; i < 24; i += 2) {
        memcpy(&p.points[3 * i + 3], &p.points[3 * i], 2 * sizeof(double));
        p.points[3 * i + 5] = p.points[3 * i + 2] + 5;
    }
    p.options.tolerance = 0.5;
    assert_survives_failures(fit, &p);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_curve_survives_every_failure),    cmocka_unit_test(a_curve_with_corners_survives_every_failure),
        cmocka_unit_test(constraints_survive_every_failure), cmocka_unit_test(a_surface_survives_every_failure),
        cmocka_unit_test(a_cloud_survives_every_failure),    cmocka_unit_test(a_curve_held_between_points_survives_every_failure),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
