/* A fit that goes on from a neighbouring model. */
#include "context_fixture.h"

#include <stdlib.h>

enum { COUNT = 200, U = 30, V = 24 };

static pia_model *curve(pia_context *context, double from, const pia_join *join, pia_report *report)
{
    double points[2 * COUNT];
    pia_data data;
    pia_fit_options options;
    pia_model *model = NULL;
    for (int i = 0; i < COUNT; i++) {
        double t = from + (double)i / (COUNT - 1);
        points[2 * i] = t;
        points[2 * i + 1] = sin(3 * t) + 0.01 * cos(200 * t);
    }
    pia_data_init(&data);
    pia_fit_options_init(&options);
    data.points = points;
    data.count[0] = COUNT;
    data.dim = 2;
    options.control[0] = 12;
    options.joins = join;
    options.join_count = join != NULL;
    report->struct_size = sizeof *report;
    assert_ok(context, pia_fit_data(context, &data, &options, &model, report));
    return model;
}

/* Value and derivatives at one place. */
static void at(const pia_model *model, double u, double v, double *out)
{
    double t[2] = {u, v};
    assert_ok(NULL, pia_model_eval(NULL, model, t, 1, 1, out));
}

static void a_curve_goes_on_from_either_end_as_smoothly_as_asked(void **state)
{
    static const double from[] = {1, -1}; /* after the neighbour, before it */
    pia_report report;
    pia_model *neighbour = curve(*state, 0, NULL, &report);
    for (int before = 0; before < 2; before++)
        for (int continuity = PIA_CONTINUITY_C0; continuity <= PIA_CONTINUITY_C1; continuity++) {
            double theirs[4], ours[4];
            pia_join join;
            pia_join_init(&join);
            join.neighbour = neighbour;
            join.edge = before ? PIA_EDGE_U_END : PIA_EDGE_U_START;
            join.neighbour_edge = before ? PIA_EDGE_U_START : PIA_EDGE_U_END;
            join.continuity = (pia_continuity)continuity;
            pia_model *model = curve(*state, from[before], &join, &report);
            assert_true(report.constraint_error <= 1e-13);
            assert_true(report.rms_error < 0.02);
            at(neighbour, before ? 0 : 1, 0, theirs);
            at(model, before ? 1 : 0, 0, ours);
            for (int d = 0; d < 2; d++) assert_near(ours[d], theirs[d], 1e-13);
            double cross = ours[2] * theirs[3] - ours[3] * theirs[2], length = hypot(ours[2], ours[3]) * hypot(theirs[2], theirs[3]);
            if (continuity >= PIA_CONTINUITY_G1) assert_near(cross / length, 0, 1e-12);
            if (continuity >= PIA_CONTINUITY_G1) assert_true(ours[2] * theirs[2] + ours[3] * theirs[3] > 0);
            if (continuity == PIA_CONTINUITY_C0) assert_true(fabs(cross / length) > 1e-6);
            for (int d = 0; d < 2 && continuity == PIA_CONTINUITY_C1; d++) assert_near(ours[2 + d], theirs[2 + d], 1e-11);
            pia_model_destroy(model);
        }
    pia_model_destroy(neighbour);
}

static void two_ends_that_meet_run_against_each_other(void **state)
{
    double theirs[4], ours[4];
    pia_report report;
    pia_model *neighbour = curve(*state, 0, NULL, &report);
    pia_join join;
    pia_join_init(&join);
    join.neighbour = neighbour;
    join.neighbour_edge = PIA_EDGE_U_START;
    join.continuity = PIA_CONTINUITY_C1;
    pia_model *model = curve(*state, 0, &join, &report);
    at(neighbour, 0, 0, theirs);
    at(model, 0, 0, ours);
    for (int d = 0; d < 2; d++) assert_near(ours[2 + d], -theirs[2 + d], 1e-11);
    pia_model_destroy(model);
    pia_model_destroy(neighbour);
}

static double height(double x, double y)
{
    return sin(2 * x) * cos(3 * y) + 0.3 * x * y;
}

/* A patch over [x0, x0 + 1] x [0, 1], or transposed; as a grid or the same points scattered. */
static pia_model *patch(pia_context *context, pia_kind kind, double x0, int transposed, const pia_join *join, pia_report *report)
{
    double *points = malloc(sizeof *points * 3 * U * V), *pairs = malloc(sizeof *pairs * 2 * U * V), lines[U + V];
    pia_data data;
    pia_fit_options options;
    pia_model *model = NULL;
    for (int i = 0; i < U * V; i++) {
        double u = (double)(i / V) / (U - 1), v = (double)(i % V) / (V - 1), x = x0 + (transposed ? v : u), y = transposed ? u : v;
        double *p = points + 3 * i;
        p[0] = x;
        p[1] = y;
        p[2] = height(x, y) + 0.01 * cos(90 * x + 70 * y);
        pairs[2 * i] = u;
        pairs[2 * i + 1] = v;
    }
    for (int i = 0; i < U; i++) lines[i] = (double)i / (U - 1);
    for (int i = 0; i < V; i++) lines[U + i] = (double)i / (V - 1);
    pia_data_init(&data);
    pia_fit_options_init(&options);
    data.kind = kind;
    data.points = points;
    data.dim = 3;
    data.count[0] = kind == PIA_GRID ? U : U * V;
    data.count[1] = kind == PIA_GRID ? V : 1;
    data.parameters = kind == PIA_GRID ? lines : pairs;
    options.placement = "uniform";
    options.control[0] = options.control[1] = 8;
    options.joins = join;
    options.join_count = join != NULL;
    report->struct_size = sizeof *report;
    assert_ok(context, pia_fit_data(context, &data, &options, &model, report));
    free(points);
    free(pairs);
    return model;
}

/* Edges of like knots agree everywhere, and so do the derivatives across them. */
static void a_patch_goes_on_along_the_whole_edge(void **state)
{
    for (int kind = PIA_GRID; kind <= PIA_SCATTERED; kind++)
        for (int transposed = 0; transposed < 2; transposed++) {
            pia_report report;
            pia_model *neighbour = patch(*state, PIA_GRID, 0, 0, NULL, &report);
            pia_join join;
            pia_join_init(&join);
            join.neighbour = neighbour;
            join.edge = transposed ? PIA_EDGE_V_START : PIA_EDGE_U_START;
            join.continuity = PIA_CONTINUITY_C1;
            pia_model *model = patch(*state, (pia_kind)kind, 1, transposed, &join, &report);
            assert_true(report.constraint_error <= 1e-12);
            assert_true(report.rms_error < 0.02);
            for (int i = 0; i <= 50; i++) {
                double theirs[9], ours[9], t = i / 50.0;
                at(neighbour, 1, t, theirs);
                at(model, transposed ? t : 0, transposed ? 0 : t, ours);
                for (int d = 0; d < 3; d++) {
                    assert_near(ours[d], theirs[d], 1e-12);
                    assert_near(ours[(transposed ? 6 : 3) + d], theirs[3 + d], 1e-11);
                }
            }
            pia_model_destroy(model);
            pia_model_destroy(neighbour);
        }
}

static void a_join_is_added_to_and_released_from_a_running_fit(void **state)
{
    double points[2 * COUNT], before[2], after[2], theirs[4];
    pia_report report;
    pia_model *neighbour = curve(*state, 0, NULL, &report), *model;
    pia_data data;
    pia_fit_options options;
    pia_fit *fit;
    pia_index first, count;
    for (int i = 0; i < COUNT; i++) {
        points[2 * i] = 1.1 + i;
        points[2 * i + 1] = cos(0.05 * i);
    }
    pia_data_init(&data);
    pia_fit_options_init(&options);
    data.points = points;
    data.count[0] = COUNT;
    data.dim = 2;
    options.control[0] = 12;
    assert_ok(*state, pia_fit_open(*state, &data, &options, &fit));
    assert_ok(*state, pia_fit_run(fit, NULL));
    assert_ok(*state, pia_fit_model(fit, &model));
    at(model, 0, 0, theirs);
    memcpy(before, theirs, sizeof before);
    pia_model_destroy(model);
    pia_join join;
    pia_join_init(&join);
    join.neighbour = neighbour;
    assert_ok(*state, pia_fit_join(fit, &join, &first, &count));
    assert_int_equal(count, 2);
    assert_ok(*state, pia_fit_run(fit, NULL));
    assert_ok(*state, pia_fit_model(fit, &model));
    at(neighbour, 1, 0, theirs);
    double ours[4];
    at(model, 0, 0, ours);
    for (int d = 0; d < 2; d++) assert_near(ours[d], theirs[d], 1e-11);
    pia_model_destroy(model);
    for (pia_index i = first; i < first + count; i++) assert_ok(*state, pia_fit_release(fit, i));
    assert_ok(*state, pia_fit_run(fit, NULL));
    assert_ok(*state, pia_fit_model(fit, &model));
    at(model, 0, 0, theirs);
    memcpy(after, theirs, sizeof after);
    for (int d = 0; d < 2; d++) assert_near(after[d], before[d], 1e-10);
    pia_model_destroy(model);
    join.edge = PIA_EDGE_V_START;
    assert_status(*state, pia_fit_join(fit, &join, NULL, NULL), PIA_E_ARGUMENT);
    join.edge = PIA_EDGE_U_START;
    join.neighbour = NULL;
    assert_status(*state, pia_fit_join(fit, &join, NULL, NULL), PIA_E_ARGUMENT);
    pia_fit_close(fit);
    pia_model *surface = patch(*state, PIA_GRID, 0, 0, NULL, &report);
    options.joins = &join;
    options.join_count = 1;
    join.neighbour = surface;
    assert_status(*state, pia_fit_open(*state, &data, &options, &fit), PIA_E_SHAPE);
    pia_model_destroy(surface);
    pia_model_destroy(neighbour);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_curve_goes_on_from_either_end_as_smoothly_as_asked),
        cmocka_unit_test(two_ends_that_meet_run_against_each_other),
        cmocka_unit_test(a_patch_goes_on_along_the_whole_edge),
        cmocka_unit_test(a_join_is_added_to_and_released_from_a_running_fit),
    };
    return cmocka_run_group_tests(tests, open_context, close_context);
}
