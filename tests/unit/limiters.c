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

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_robust_rule_never_adds_an_inflection_to_the_polygon),
        cmocka_unit_test(the_printed_rule_adds_some_but_fewer_than_none_at_all),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
