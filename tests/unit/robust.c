/* Robust losses: gross outliers neither move the fit nor hide. */
#include "context_fixture.h"
#include "problems.h"

#include <unistd.h>

#include "../memory/failing.h"

enum { COUNT = 400 };

static const double pi = 3.14159265358979323846;

/* Every tenth row, scrambled, is an outlier. */
static int is_outlier(pia_index i)
{
    return i * 7 % 10 == 3;
}

typedef struct cloud {
    pia_data data;
    pia_fit_options options;
    double *points, *parameters;
} cloud;

/* A line (shape 0) or a circle of radius 5 (shape 1), with noise; outliers lie 3 to 20 units off to one side. */
static cloud make_curve(int shape, double noise)
{
    cloud c;
    uint64_t seed = 99;
    c.points = malloc(2 * COUNT * sizeof(double));
    c.parameters = malloc(COUNT * sizeof(double));
    for (pia_index i = 0; i < COUNT; i++) {
        double t = (double)i / (shape == 1 ? COUNT : COUNT - 1), *p = c.points + 2 * i;
        p[0] = shape == 1 ? 5 * cos(2 * pi * t) : 10 * t;
        p[1] = shape == 1 ? 5 * sin(2 * pi * t) : 3 - 2 * t;
        c.parameters[i] = t;
        for (int d = 0; d < 2; d++) p[d] += noise * (problem_random(&seed) - 0.5);
        if (is_outlier(i)) p[1] += 3 + 17 * problem_random(&seed);
    }
    pia_data_init(&c.data);
    pia_fit_options_init(&c.options);
    c.data.points = c.points;
    c.data.parameters = c.parameters;
    c.data.count[0] = COUNT;
    c.data.dim = 2;
    c.options.closed[0] = shape;
    c.options.control[0] = shape == 1 ? 12 : 6;
    return c;
}

static void release(cloud *c)
{
    free(c->points);
    free(c->parameters);
}

/* Largest distance of the model from the true shape. */
static double off_truth(const pia_model *model, int shape)
{
    double worst = 0;
    for (int i = 0; i <= 200; i++) {
        double t = i / 200.0, p[2];
        assert_ok(NULL, pia_model_eval(NULL, model, &t, 1, 0, p));
        double off = shape == 1 ? hypot(p[0], p[1]) - 5 : fabs(p[1] - 3 + p[0] / 5);
        worst = fmax(worst, fabs(off));
    }
    return worst;
}

static double run(pia_context *context, const cloud *c, int shape, pia_report *report)
{
    pia_model *model = NULL;
    report->struct_size = sizeof *report;
    assert_ok(context, pia_fit_data(context, &c->data, &c->options, &model, report));
    double off = off_truth(model, shape);
    pia_model_destroy(model);
    return off;
}

static void a_tenth_of_gross_outliers_leaves_line_and_circle_where_they_are(void **state)
{
    pia_context *context = *state;
    static const char *const loss[] = {"huber", "tukey"}, *const method[] = {"auto", "lspia", "cg", "chebyshev"};
    for (int shape = 0; shape < 2; shape++) {
        cloud c = make_curve(shape, 0.02);
        pia_report plain, robust;
        double without = run(context, &c, shape, &plain);
        for (int l = 0; l < 2; l++)
            for (int m = 0; m < 4; m++) {
                c.options.robust = loss[l];
                c.options.method = method[m];
                double with = run(context, &c, shape, &robust);
                assert_true(with < (l == 0 ? 0.02 : 0.012) && without > 0.5);
                assert_int_equal(robust.outlier_count, COUNT / 10);
            }
        release(&c);
    }
}

static void exact_data_are_recovered_to_rounding(void **state)
{
    pia_context *context = *state;
    cloud c = make_curve(0, 0);
    pia_report report;
    c.options.robust = "tukey";
    assert_true(run(context, &c, 0, &report) < 1e-11);
    assert_int_equal(report.outlier_count, COUNT / 10);
    c.options.robust = "huber";
    assert_true(run(context, &c, 0, &report) < 1e-5); /* steps towards the median get small */
    release(&c);
}

static void outliers_are_listed_by_their_rows(void **state)
{
    pia_context *context = *state;
    cloud c = make_curve(1, 0.02);
    pia_fit *fit = NULL;
    const double *weights;
    const pia_index *row;
    pia_index count;
    const char *note, *found = NULL;
    c.options.robust = "tukey";
    assert_ok(context, pia_fit_open(context, &c.data, &c.options, &fit));
    assert_ok(context, pia_fit_run(fit, NULL));
    assert_ok(context, pia_fit_weights(fit, &weights, &row, &count));
    assert_int_equal(count, COUNT);
    for (pia_index i = 0; i < count; i++) assert_int_equal(weights[i] < 0.5, is_outlier(row != NULL ? row[i] : i));
    for (pia_index i = 0; (note = pia_fit_note(fit, i)) != NULL; i++)
        if (strstr(note, "outliers") != NULL) found = note;
    assert_non_null(found);
    assert_string_equal(found, "40 outliers, data rows of less than half weight: 9, 19, 29, 39, 49, 59, 69, 79, 89, 99, 109, 119, 129, "
                               "139, 149, 159, 169, 179, 189, 199, ...");
    pia_fit_close(fit);
    release(&c);
}

/* Steps of one iteration take the same path as one run; an edit weighs the rows anew. */
static void a_stepped_fit_ends_where_a_run_ends_and_follows_edits(void **state)
{
    pia_context *context = *state;
    cloud c = make_curve(0, 0.02);
    pia_fit *fit[2];
    const double moved[2] = {0, 30};
    c.options.robust = "huber";
    c.options.method = "lspia";
    for (int k = 0; k < 2; k++) assert_ok(context, pia_fit_open(context, &c.data, &c.options, &fit[k]));
    for (int round = 0; round < 2; round++) {
        pia_report report[2] = {{.struct_size = sizeof(pia_report)}, {.struct_size = sizeof(pia_report)}};
        assert_ok(context, pia_fit_run(fit[0], &report[0]));
        do assert_ok(context, pia_fit_step(fit[1], 1, &report[1]));
        while (report[1].stop == PIA_STOP_NONE && report[1].iterations < 100000);
        assert_int_equal(report[0].iterations, report[1].iterations);
        assert_true(report[0].rms_error == report[1].rms_error && report[0].outlier_count == report[1].outlier_count);
        assert_int_equal(report[0].outlier_count, COUNT / 10 + round);
        for (int k = 0; k < 2; k++) assert_ok(context, pia_fit_move_point(fit[k], 0, moved));
    }
    for (int k = 0; k < 2; k++) pia_fit_close(fit[k]);
    release(&c);
}

/* All rounds of weighing together, also where the count is given to a running fit or to one that was saved. */
static void iterations_asked_for_later_are_all_that_run(void **state)
{
    static const char *const count[] = {"12", "30", "45"};
    pia_context *context = *state;
    cloud c = make_curve(0, 0.02);
    pia_fit *fit;
    pia_report report = {.struct_size = sizeof report};
    char path[] = "/tmp/pia_robust_XXXXXX";
    close(mkstemp(path));
    c.options.robust = "tukey";
    c.options.method = "lspia";
    assert_ok(context, pia_fit_open(context, &c.data, &c.options, &fit));
    for (int k = 0; k < 3; k++) {
        assert_ok(context, pia_fit_set(fit, "max_iterations", count[k]));
        assert_ok(context, pia_fit_run(fit, &report));
        assert_int_equal(report.stop, PIA_STOP_ITERATIONS);
        assert_int_equal(report.iterations, atoi(count[k]));
        assert_ok(context, pia_fit_save(fit, path));
        pia_fit_close(fit);
        assert_ok(context, pia_fit_resume(context, path, &fit));
        assert_ok(context, pia_fit_run(fit, &report));
        assert_int_equal(report.iterations, atoi(count[k]));
    }
    pia_fit_close(fit);
    unlink(path);
    release(&c);
}

static void grids_and_scattered_points_have_outliers_too(void **state)
{
    pia_context *context = *state;
    enum { SIDE = 24 };
    for (int scattered = 0; scattered < 2; scattered++) {
        double points[3 * SIDE * SIDE], pairs[2 * SIDE * SIDE], lines[2 * SIDE], at[2] = {0.4, 0.6}, value[3];
        pia_data data;
        pia_fit_options options;
        pia_report report = {.struct_size = sizeof report};
        pia_model *model = NULL;
        for (pia_index i = 0; i < SIDE * SIDE; i++) {
            double u = (double)(i / SIDE) / (SIDE - 1), v = (double)(i % SIDE) / (SIDE - 1);
            pairs[2 * i] = points[3 * i] = u;
            pairs[2 * i + 1] = points[3 * i + 1] = v;
            lines[i / SIDE] = u;
            lines[SIDE + i % SIDE] = v;
            points[3 * i + 2] = u * u - v * u + (is_outlier(i) ? 9 : 0);
        }
        pia_data_init(&data);
        pia_fit_options_init(&options);
        data.kind = scattered ? PIA_SCATTERED : PIA_GRID;
        data.points = points;
        data.count[0] = scattered ? SIDE * SIDE : SIDE;
        data.count[1] = scattered ? 1 : SIDE;
        data.dim = 3;
        data.parameters = scattered ? pairs : lines;
        options.control[0] = options.control[1] = 5;
        options.robust = "tukey";
        assert_ok(context, pia_fit_data(context, &data, &options, &model, &report));
        assert_ok(context, pia_model_eval(context, model, at, 1, 0, value));
        assert_near(value[2], value[0] * value[0] - value[0] * value[1], 1e-9);
        pia_index expected = 0;
        for (pia_index i = 0; i < SIDE * SIDE; i++) expected += is_outlier(i);
        assert_int_equal(report.outlier_count, expected);
        pia_model_destroy(model);
    }
}

static void what_makes_no_sense_is_refused(void **state)
{
    pia_context *context = *state;
    cloud c = make_curve(0, 0.02);
    pia_fit *fit = NULL;
    c.options.robust = "cauchy";
    assert_status(context, pia_fit_open(context, &c.data, &c.options, &fit), PIA_E_ARGUMENT);
    assert_string_equal(pia_message(context), "there is no robust loss \"cauchy\"; there are huber, tukey");
    c.options.robust = "huber";
    c.options.robust_scale = 0;
    assert_status(context, pia_fit_open(context, &c.data, &c.options, &fit), PIA_E_ARGUMENT);
    c.options.robust_scale = PIA_AUTO;
    c.options.method = "pia";
    c.options.control[0] = PIA_AUTO;
    assert_status(context, pia_fit_open(context, &c.data, &c.options, &fit), PIA_E_ARGUMENT);
    c.options.method = NULL;
    c.options.tolerance = 0.1;
    assert_status(context, pia_fit_open(context, &c.data, &c.options, &fit), PIA_E_ARGUMENT);
    release(&c);
}

/* A GPS track with every 20th fix thrown a tenth of the extent away: each of those rows is found. */
static void thrown_fixes_of_a_gps_track_are_found(void **state)
{
    pia_context *context = *state;
    pia_points *points = NULL;
    pia_points_info info;
    pia_points_options columns;
    pia_data data;
    pia_fit_options options;
    pia_fit *fit = NULL;
    const double *weights;
    const pia_index *row;
    pia_index count, found = 0, thrown = 0, others = 0;
    pia_points_options_init(&columns);
    columns.columns = "lon,lat";
    assert_ok(context, pia_points_read(context, PIA_DATA "/gps/mojstrovka.csv", &columns, &points));
    pia_points_get_info(points, &info);
    double *moved = malloc((size_t)info.count[0] * 2 * sizeof *moved), low = INFINITY, high = -INFINITY;
    memcpy(moved, info.points, (size_t)info.count[0] * 2 * sizeof *moved);
    for (pia_index i = 0; i < info.count[0]; i++) low = fmin(low, moved[2 * i + 1]), high = fmax(high, moved[2 * i + 1]);
    pia_data_init(&data);
    pia_fit_options_init(&options);
    data.points = info.points;
    data.count[0] = info.count[0];
    data.dim = 2;
    options.control[0] = info.count[0] / 12;
    options.robust = "tukey";
    /* parameters of the track before fixes were thrown, as time stamps would give them */
    const double *t;
    const pia_index *used;
    pia_fit *clean = NULL;
    assert_ok(context, pia_fit_open(context, &data, &options, &clean));
    assert_ok(context, pia_fit_parameters(clean, &t, &count, &used));
    double *kept = malloc((size_t)count * 2 * sizeof *kept);
    for (pia_index i = 0; i < count; i++)
        for (int d = 0; d < 2; d++) {
            pia_index from = used != NULL ? used[i] : i;
            kept[2 * i + d] = moved[2 * from + d] + (d == 1 && i % 20 == 7 ? (high - low) / 10 : 0);
        }
    data.points = kept;
    data.count[0] = count;
    data.parameters = t;
    assert_ok(context, pia_fit_open(context, &data, &options, &fit));
    assert_ok(context, pia_fit_run(fit, NULL));
    assert_ok(context, pia_fit_weights(fit, &weights, &row, &count));
    for (pia_index i = 0; i < count; i++) {
        thrown += i % 20 == 7;
        found += i % 20 == 7 && weights[i] < 0.5;
        others += i % 20 != 7 && weights[i] < 0.5;
    }
    print_message("%lld of %lld thrown fixes found, %lld other rows of %lld called outliers\n", (long long)found, (long long)thrown,
                  (long long)others, (long long)count);
    assert_int_equal(found, thrown);
    assert_true(others < count / 5);
    pia_fit_close(fit);
    pia_fit_close(clean);
    pia_points_destroy(points);
    free(moved);
    free(kept);
}

static pia_status fit_again(pia_context *context, void *user)
{
    const cloud *c = user;
    pia_model *model = NULL;
    pia_status status = pia_fit_data(context, &c->data, &c->options, &model, NULL);
    pia_model_destroy(model);
    return status;
}

static void every_allocation_may_fail(void **state)
{
    (void)state;
    cloud c = make_curve(0, 0.02);
    c.options.robust = "tukey";
    c.options.max_iterations = 12;
    c.data.count[0] = 60;
    assert_survives_failures(fit_again, &c);
    release(&c);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_tenth_of_gross_outliers_leaves_line_and_circle_where_they_are),
        cmocka_unit_test(exact_data_are_recovered_to_rounding),
        cmocka_unit_test(outliers_are_listed_by_their_rows),
        cmocka_unit_test(a_stepped_fit_ends_where_a_run_ends_and_follows_edits),
        cmocka_unit_test(iterations_asked_for_later_are_all_that_run),
        cmocka_unit_test(grids_and_scattered_points_have_outliers_too),
        cmocka_unit_test(what_makes_no_sense_is_refused),
        cmocka_unit_test(thrown_fixes_of_a_gps_track_are_found),
        cmocka_unit_test(every_allocation_may_fail),
    };
    return cmocka_run_group_tests(tests, open_context, close_context);
}
