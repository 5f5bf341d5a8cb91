/* Data that leave control points without hold: gaps in curves, holes in grids, clusters of scattered points. No method runs away. */
#include "context_fixture.h"
#include "problems.h"

#include "../memory/failing.h"

enum { MOST = 900 };

typedef struct gappy {
    double points[3 * MOST], parameters[2 * MOST], knots[2][64];
    pia_data data;
    pia_fit_options options;
} gappy;

static void uniform_knots(int degree, pia_index control, double *knots)
{
    for (pia_index i = 0; i < control + degree + 1; i++)
        knots[i] = i <= degree ? 0 : i >= control ? 1 : (double)(i - degree) / (double)(control - degree);
}

static void open_gappy(gappy *g, pia_kind kind, int dim, pia_index control)
{
    pia_data_init(&g->data);
    pia_fit_options_init(&g->options);
    g->data.kind = kind;
    g->data.points = g->points;
    g->data.parameters = g->parameters;
    g->data.dim = dim;
    for (int d = 0; d < (kind == PIA_CURVE ? 1 : 2); d++) {
        uniform_knots(3, control, g->knots[d]);
        g->options.control[d] = control;
        if (kind == PIA_SCATTERED) continue;
        g->options.knots[d] = g->knots[d];
        g->options.knot_count[d] = control + 4;
    }
}

/* A wave without the points between 0.4 and 0.4 + gap; noise of 0.1 makes what is left worth missing. */
static void wave_with_a_gap(gappy *g, double gap)
{
    uint64_t seed = 3;
    pia_index kept = 0;
    open_gappy(g, PIA_CURVE, 2, 30);
    for (pia_index i = 0; i < 200; i++) {
        double t = (double)i / 199;
        if (t > 0.4 && t < 0.4 + gap) continue;
        g->parameters[kept] = t;
        g->points[2 * kept] = t;
        g->points[2 * kept + 1] = sin(9 * t) + 0.1 * (problem_random(&seed) - 0.5);
        kept++;
    }
    g->data.count[0] = kept;
}

/* A hill on a grid of 25 x 25 with a round hole. */
static void hill_with_a_hole(gappy *g, double radius)
{
    open_gappy(g, PIA_GRID, 3, 12);
    for (pia_index i = 0; i < 25; i++) {
        g->parameters[i] = g->parameters[25 + i] = (double)i / 24;
        for (pia_index j = 0; j < 25; j++) {
            double u = (double)i / 24, v = (double)j / 24, *p = g->points + 3 * (25 * i + j);
            p[0] = u;
            p[1] = v;
            p[2] = hypot(u - 0.5, v - 0.4) < radius ? NAN : exp(-4 * (u * u + v * v));
        }
    }
    g->data.count[0] = g->data.count[1] = 25;
}

/* 400 points in three tight clusters and a few alone. */
static void clusters(gappy *g, double width)
{
    static const double centre[3][2] = {{0.1, 0.2}, {0.8, 0.3}, {0.5, 0.9}};
    uint64_t seed = 11;
    open_gappy(g, PIA_SCATTERED, 3, 14);
    for (pia_index i = 0; i < 400; i++) {
        double *t = g->parameters + 2 * i, *p = g->points + 3 * i;
        for (int d = 0; d < 2; d++) {
            t[d] = i < 10 ? problem_random(&seed) : centre[i % 3][d] + width * (problem_random(&seed) - 0.5);
            t[d] = i == 0 ? 0 : i == 1 ? 1 : t[d];
            p[d] = t[d];
        }
        p[2] = sin(5 * t[0]) * cos(4 * t[1]) + 0.05 * problem_random(&seed);
    }
    g->data.count[0] = 400;
}

static const char *const methods[] = {"direct", "lspia",     "lspia-opt", "mlspia",     "nmlspia", "alspia",      "salspia",
                                      "cg",     "chebyshev", "clspia",    "clspia-pcg", "cg-kron", "gauss-seidel"};
enum { METHODS = sizeof methods / sizeof *methods };

/* Largest coordinate of a control point, over the data's largest. */
static double wildness(pia_context *context, const gappy *g, const char *method, pia_report *report)
{
    gappy local = *g;
    pia_model *model = NULL;
    double control[3 * MOST], worst = 0;
    pia_model_info info = {.struct_size = sizeof info};
    local.options.method = method;
    local.options.max_iterations = 3000;
    local.data.points = local.points;
    report->struct_size = sizeof *report;
    assert_ok(context, pia_fit_data(context, &local.data, &local.options, &model, report));
    pia_model_get_info(model, &info);
    pia_model_control(model, control, NULL);
    for (pia_index c = 0; c < info.control[0] * info.control[1] * info.dim; c++) worst = fmax(worst, fabs(control[c]));
    pia_model_destroy(model);
    return worst;
}

/* All methods of the kind, or the fast ones, end bounded with a reason that fits: "gradient" only at a small gradient. */
static void check_all(pia_context *context, const gappy *g, int every)
{
    static const char *const fast[] = {"direct", "cg", "lspia", "salspia"};
    for (int m = 0; m < (every ? METHODS : 4); m++) {
        const char *method = every ? methods[m] : fast[m];
        pia_report report;
        if (strcmp(method, "gauss-seidel") == 0 && g->data.kind != PIA_CURVE) continue;
        if (strcmp(method, "cg-kron") == 0 && g->data.kind != PIA_SCATTERED) continue;
        double worst = wildness(context, g, method, &report);
        if (worst > 10) print_error("%s: control point at %g\n", method, worst);
        assert_true(worst <= 10);
        if (report.stop == PIA_STOP_GRADIENT) assert_true(report.relative_gradient <= 1e-12);
        if (strcmp(method, "direct") == 0) assert_true(report.stop == PIA_STOP_FINITE && report.relative_gradient < 1e-12);
    }
}

static void gaps_of_any_width_leave_curves_bounded(void **state)
{
    static gappy g;
    for (int width = 1; width <= 24; width++) {
        wave_with_a_gap(&g, 0.023 * width);
        check_all(*state, &g, width % 8 == 0);
    }
}

static void holes_leave_grids_bounded(void **state)
{
    static gappy g;
    for (int k = 1; k <= 4; k++) {
        hill_with_a_hole(&g, 0.12 * k);
        check_all(*state, &g, k == 3);
    }
}

static void clusters_leave_scattered_fits_bounded(void **state)
{
    static gappy g;
    for (int k = 0; k < 4; k++) {
        clusters(&g, 0.4 / (1 << (2 * k)));
        check_all(*state, &g, k == 1);
    }
}

static pia_fit *open_fit(pia_context *context, gappy *g)
{
    pia_fit *fit = NULL;
    assert_ok(context, pia_fit_open(context, &g->data, &g->options, &fit));
    return fit;
}

static void what_is_not_held_is_listed_and_stays_near_the_start(void **state)
{
    pia_context *context = *state;
    static gappy g;
    const pia_index *list;
    pia_index count;
    const char *note, *found = NULL;
    double before[60], after[60];
    pia_model *model = NULL;
    wave_with_a_gap(&g, 0.3);
    pia_fit *fit = open_fit(context, &g);
    assert_ok(context, pia_fit_unsupported(fit, &list, &count));
    assert_int_equal(count, 5);
    assert_ok(context, pia_fit_model(fit, &model));
    pia_model_control(model, before, NULL);
    pia_model_destroy(model);
    assert_ok(context, pia_fit_run(fit, NULL));
    assert_ok(context, pia_fit_model(fit, &model));
    pia_model_control(model, after, NULL);
    pia_model_destroy(model);
    for (pia_index i = 0; i < count; i++) assert_near(after[2 * list[i] + 1], before[2 * list[i] + 1], 0.2);
    for (pia_index i = 0; (note = pia_fit_note(fit, i)) != NULL; i++)
        if (strstr(note, "do not hold") != NULL) found = note;
    assert_string_equal(found, "5 control points that the data do not hold, kept near the start: 14, 15, 16, 17, 18");
    pia_fit_close(fit);
}

/* Data put into the gap hold what was not held; the fit is that of all the data. */
static void added_points_end_the_need(void **state)
{
    pia_context *context = *state;
    static gappy g, whole;
    const pia_index *list;
    pia_index count;
    pia_report report = {.struct_size = sizeof report}, expected = {.struct_size = sizeof expected};
    wave_with_a_gap(&g, 0.3);
    wave_with_a_gap(&whole, 0);
    pia_fit *fit = open_fit(context, &g), *all = open_fit(context, &whole);
    pia_data more;
    pia_data_init(&more);
    more.dim = 2;
    pia_index first = 0, last = 0;
    for (pia_index i = 0; i < whole.data.count[0]; i++) {
        if (whole.parameters[i] <= 0.4) first = i + 1;
        if (whole.parameters[i] < 0.7) last = i + 1;
    }
    more.points = whole.points + 2 * first;
    more.parameters = whole.parameters + first;
    more.count[0] = last - first;
    assert_ok(context, pia_fit_run(fit, NULL));
    assert_ok(context, pia_fit_add_points(fit, &more));
    assert_ok(context, pia_fit_unsupported(fit, &list, &count));
    assert_int_equal(count, 0);
    assert_ok(context, pia_fit_run(fit, &report));
    assert_ok(context, pia_fit_run(all, &expected));
    assert_int_equal(report.point_count, expected.point_count);
    assert_int_equal(report.unsupported_count, 0);
    pia_fit_close(fit);
    pia_fit_close(all);
}

/* Full rank needs no help, however uneven: the direct fit is the least-squares fit to rounding. */
static void held_data_get_no_pull(void **state)
{
    pia_context *context = *state;
    static gappy g;
    const pia_index *list;
    pia_index count;
    for (int width = 0; width < 3; width++) {
        wave_with_a_gap(&g, 0.023 * width);
        pia_fit *fit = open_fit(context, &g);
        assert_ok(context, pia_fit_unsupported(fit, &list, &count));
        assert_int_equal(count, 0);
        assert_null(list);
        pia_fit_close(fit);
    }
}

static pia_status fit_again(pia_context *context, void *user)
{
    const gappy *g = user;
    pia_model *model = NULL;
    pia_status status = pia_fit_data(context, &g->data, &g->options, &model, NULL);
    pia_model_destroy(model);
    return status;
}

static void every_allocation_may_fail(void **state)
{
    (void)state;
    static gappy g;
    wave_with_a_gap(&g, 0.3);
    assert_survives_failures(fit_again, &g);
    clusters(&g, 0.05);
    assert_survives_failures(fit_again, &g);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(gaps_of_any_width_leave_curves_bounded),
        cmocka_unit_test(holes_leave_grids_bounded),
        cmocka_unit_test(clusters_leave_scattered_fits_bounded),
        cmocka_unit_test(what_is_not_held_is_listed_and_stays_near_the_start),
        cmocka_unit_test(added_points_end_the_need),
        cmocka_unit_test(held_data_get_no_pull),
        cmocka_unit_test(every_allocation_may_fail),
    };
    return cmocka_run_group_tests(tests, open_context, close_context);
}
