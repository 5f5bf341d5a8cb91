/* Shape limiters: what they promise about the control polygon, over random inputs. */
#include "check.h"
#include "fit.h"
#include "problems.h"
#include "shape.h"

enum { MOST_POINTS = 60 };

/* A random walk around an arc: some turns to both sides, uneven chords. */
static void random_points(uint64_t *seed, int closed, pia_index count, double *points)
{
    double noise = 0.3 * problem_random(seed), waves = 1 + 4 * problem_random(seed);
    for (pia_index i = 0; i < count; i++) {
        double t = (closed ? 6.283185307179586 : 3) * ((double)i + 0.6 * problem_random(seed)) / (double)count;
        double r = 1 + 0.3 * sin((closed ? 3 : waves) * t);
        points[2 * i] = r * cos(t) + noise * (problem_random(seed) - 0.5);
        points[2 * i + 1] = r * sin(t) + noise * (problem_random(seed) - 0.5);
    }
}

typedef struct wanted {
    const char *method, *limiter;
    int degree, closed;
    pia_index count, control; /* control 0: interpolation */
    pia_index constraints;
} wanted;

static pia_fit *open_fit(pia_context *context, const wanted *w, const double *points)
{
    pia_data data;
    pia_fit_options options;
    pia_index rows[8];
    pia_data_init(&data);
    pia_fit_options_init(&options);
    data.points = points;
    data.count[0] = w->count;
    data.dim = 2;
    options.method = w->method;
    options.limiter = w->limiter;
    options.degree[0] = w->degree;
    options.closed[0] = w->closed;
    if (w->control > 0) options.control[0] = w->control;
    for (pia_index i = 0; i < w->constraints; i++) rows[i] = i * (w->count - 1) / w->constraints;
    options.interpolate = rows;
    options.interpolate_count = w->constraints;
    pia_fit *fit = NULL;
    assert_ok(context, pia_fit_open(context, &data, &options, &fit));
    return fit;
}

static pia_index polygon_inflections(const pia_fit *fit)
{
    return pia_polygon_inflections(fit->iterate.points, fit->op->cols, fit->closed[0]);
}

/* Steps the fit `steps` times; returns how often its polygon gained an inflection over the start. */
static int count_gains(pia_fit *fit, int steps)
{
    pia_index before = polygon_inflections(fit);
    int gains = 0;
    for (int k = 0; k < steps && fit->solve.stop == PIA_STOP_NONE; k++) {
        assert_ok(fit->context, pia_fit_step(fit, 1, NULL));
        gains += polygon_inflections(fit) > before;
    }
    return gains;
}

/* 80 random fits with and without constraints, open and closed; returns how many gained an inflection at some step. */
static int fits_that_gain(pia_context *context, const char *limiter)
{
    uint64_t seed = 20230404;
    double points[2 * MOST_POINTS];
    int gained = 0;
    for (int k = 0; k < 80; k++) {
        wanted w = {k % 2 ? "clspia" : "lspia", limiter, 2 + k % 4, k / 2 % 2, 30 + k % 30, 8 + k % 13, k % 2 ? 1 + k % 5 : 0};
        random_points(&seed, w.closed, w.count, points);
        pia_fit *fit = open_fit(context, &w, points);
        gained += count_gains(fit, 60) > 0;
        pia_fit_close(fit);
    }
    return gained;
}

static void the_robust_rule_never_adds_an_inflection_to_the_polygon(void **state)
{
    (void)state;
    pia_context *context;
    assert_ok(NULL, pia_context_create(NULL, &context));
    assert_int_equal(fits_that_gain(context, "inflection"), 0);
    pia_context_destroy(context);
}

static void the_printed_rule_adds_some_but_fewer_than_none_at_all(void **state)
{
    (void)state;
    pia_context *context;
    assert_ok(NULL, pia_context_create(NULL, &context));
    int free = fits_that_gain(context, NULL), printed = fits_that_gain(context, "inflection-paper");
    print_message("of 80 fits gain an inflection: %d unlimited, %d by the printed rule\n", free, printed);
    assert_true(printed > 0 && printed < free);
    pia_context_destroy(context);
}

static const char *find_note(const pia_fit *fit, const char *start)
{
    const char *note;
    for (pia_index i = 0; (note = pia_fit_note(fit, i)) != NULL; i++)
        if (strncmp(note, start, strlen(start)) == 0) return note;
    return NULL;
}

static void the_result_tells_the_inflections_of_data_polygon_and_curve(void **state)
{
    (void)state;
    const double points[] = {0, 0, 1, 0.5, 2, 0.7, 3, 0.5, 4, 0, 5, -0.5, 6, -0.7, 7, -0.5, 8, 0};
    const wanted w = {"lspia", "inflection", 3, 0, 9, 6, 0};
    pia_context *context;
    assert_ok(NULL, pia_context_create(NULL, &context));
    pia_fit *fit = open_fit(context, &w, points);
    pia_model *model = NULL;
    assert_ok(context, pia_fit_run(fit, NULL));
    assert_string_equal(find_note(fit, "inflections"), "inflections: 1 of the data polygon, 1 of the control polygon, 1 of the curve");
    assert_non_null(find_note(fit, "the curve bends as its control polygon does"));
    assert_ok(context, pia_fit_model(fit, &model));
    int found = 0;
    for (pia_index i = 0; pia_model_note(model, i) != NULL; i++) found += strncmp(pia_model_note(model, i), "inflections", 11) == 0;
    assert_int_equal(found, 1);
    pia_model_destroy(model);
    pia_fit_close(fit);
    pia_context_destroy(context);
}

/* Points on a convex arc with uneven chords. */
static void convex_points(uint64_t *seed, pia_index count, double *points)
{
    double t = 0, flat = 0.1 + 0.9 * problem_random(seed);
    for (pia_index i = 0; i < count; i++) {
        points[2 * i] = cos(t);
        points[2 * i + 1] = flat * sin(t);
        t += 0.05 + (problem_random(seed) < 0.2 ? 0.9 : 0.25) * problem_random(seed) * 12 / (double)count;
    }
}

static pia_report run_convex(pia_context *context, const char *limiter, pia_index count, const double *points, int *acted)
{
    const wanted w = {"pia", limiter, 3, 0, count, 0, 0};
    pia_report report = {.struct_size = sizeof report};
    pia_fit *fit = open_fit(context, &w, points);
    pia_index before = polygon_inflections(fit);
    *acted = 0;
    while (fit->solve.stop == PIA_STOP_NONE) {
        assert_ok(context, pia_fit_step(fit, 1, &report));
        *acted |= fit->iterate.shortened;
        if (limiter != NULL) assert_true(polygon_inflections(fit) <= before);
    }
    pia_fit_close(fit);
    return report;
}

/* [2004] Theorem 2 promises convergence, which needs steps that do not die out: where the limiter acts it mostly stalls. */
static void convex_limiters_mostly_stall_where_they_act_and_the_local_one_ends_closer(void **state)
{
    (void)state;
    enum { INPUTS = 200 };
    uint64_t seed = 4;
    double points[2 * MOST_POINTS];
    int acted = 0, stalled = 0, closer = 0;
    pia_context *context;
    assert_ok(NULL, pia_context_create(NULL, &context));
    for (int k = 0; k < INPUTS; k++) {
        pia_index count = 6 + k % 12;
        int one, local;
        convex_points(&seed, count, points);
        pia_report whole = run_convex(context, "convex", count, points, &one);
        pia_report each = run_convex(context, "convex-local", count, points, &local);
        if (!one) {
            assert_near(whole.max_error, each.max_error, 1e-9);
            continue;
        }
        acted++;
        stalled += whole.stop == PIA_STOP_STALLED;
        closer += each.max_error < whole.max_error;
    }
    print_message("the limiter acted on %d of %d convex inputs and stalled on %d; convex-local ended closer on %d\n", acted, INPUTS,
                  stalled, closer);
    assert_true(acted >= 10 && stalled >= acted / 2 && closer > acted / 2);
    pia_context_destroy(context);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_robust_rule_never_adds_an_inflection_to_the_polygon),
        cmocka_unit_test(the_printed_rule_adds_some_but_fewer_than_none_at_all),
        cmocka_unit_test(the_result_tells_the_inflections_of_data_polygon_and_curve),
        cmocka_unit_test(convex_limiters_mostly_stall_where_they_act_and_the_local_one_ends_closer),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
