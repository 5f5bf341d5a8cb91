/* Conditions that leave high degrees hardly any room: the constrained minimum lies at control points that are far out, 1e4 extents and
 * more. Projected conjugate gradients must go there, end at the minimum that the direct solve finds, keep the conditions on the way,
 * and say so when rounding leaves nothing to be found. */
#include <stdlib.h>

#include "check.h"

enum { MOST = 80, ROWS = 400, CONDITIONS = 40, DIM = 2 };

typedef struct sample {
    double points[ROWS * DIM], parameters[ROWS], value[CONDITIONS][DIM];
    pia_constraint constraint[CONDITIONS];
    pia_data data;
    pia_fit_options options;
} sample;

static double random_number(uint64_t *seed)
{
    *seed = *seed * 6364136223846793005u + 1442695040888963407u;
    return (double)(*seed >> 11) * 0x1p-53;
}

static double circle(double t, int d)
{
    return sin(6.283185307179586 * t + 1.57 * d);
}

/* Noisy rows of a circle, and places off it by up to `off` that are met at parameters that came by chance, so that some nearly repeat
 * each other. */
static void make(sample *s, uint64_t seed, int degree, pia_index rows, pia_index control, pia_index conditions, int closed, double off)
{
    pia_data_init(&s->data);
    pia_fit_options_init(&s->options);
    for (pia_index i = 0; i < rows; i++) {
        s->parameters[i] = (double)i / (double)(closed ? rows : rows - 1);
        for (int d = 0; d < DIM; d++) s->points[i * DIM + d] = circle(s->parameters[i], d) + 0.05 * random_number(&seed);
    }
    for (pia_index i = 0; i < conditions; i++) {
        double t = random_number(&seed);
        pia_constraint_init(&s->constraint[i]);
        s->constraint[i].at_parameter[0] = t;
        for (int d = 0; d < DIM; d++) s->value[i][d] = circle(t, d) + off * (random_number(&seed) - 0.5);
        s->constraint[i].value = s->value[i];
    }
    s->data.points = s->points;
    s->data.parameters = s->parameters;
    s->data.count[0] = rows;
    s->data.dim = DIM;
    s->options.degree[0] = degree;
    s->options.control[0] = control;
    s->options.closed[0] = closed;
    s->options.constraints = s->constraint;
    s->options.constraint_count = conditions;
}

/* Returns how far the control points are out. */
static double fit(pia_context *context, sample *s, const char *method, pia_report *report)
{
    double control[2 * MOST * DIM], farthest = 0;
    pia_model *model;
    pia_model_info info;
    s->options.method = method;
    report->struct_size = sizeof *report;
    assert_ok(context, pia_fit_data(context, &s->data, &s->options, &model, report));
    pia_model_get_info(model, &info);
    pia_model_control(model, control, NULL);
    pia_model_destroy(model);
    for (pia_index i = 0; i < info.control[0] * DIM; i++) farthest = fmax(farthest, fabs(control[i]));
    return farthest;
}

static void conjugate_gradients_go_as_far_as_the_minimum_is(void **state)
{
    static const struct {
        uint64_t seed;
        int degree, rows, control, conditions, closed;
        double off;
    } cases[] = {{1, 8, 112, 40, 9, 1, 2},  {1, 9, 55, 21, 9, 0, 0.2},   {2, 9, 94, 63, 24, 0, 0.1},  {1, 10, 75, 51, 18, 0, 0.1},
                 {2, 10, 83, 57, 16, 0, 3}, {1, 11, 65, 41, 20, 0, 1.5}, {3, 11, 65, 41, 20, 0, 1.5}, {3, 11, 139, 60, 25, 0, 2}};
    static sample s;
    int far = 0, floors = 0;
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        pia_report direct, descent;
        make(&s, cases[k].seed, cases[k].degree, cases[k].rows, cases[k].control, cases[k].conditions, cases[k].closed, cases[k].off);
        double out = fit(*state, &s, "direct", &direct);
        fit(*state, &s, "clspia-pcg", &descent);
        far += out > 2e4;
        floors += descent.stop == PIA_STOP_STALLED;
        assert_true(descent.stop == PIA_STOP_GRADIENT || descent.stop == PIA_STOP_STALLED);
        assert_true(descent.relative_gradient <= (descent.stop == PIA_STOP_GRADIENT ? 1e-12 : 1e-6));
        assert_near(descent.rms_error, direct.rms_error, 1e-8 * direct.rms_error);
        assert_near(descent.constraint_error, 0, 1e-13 + 1e-15 * out);
    }
    assert_true(far >= 4 && floors >= 1);
}

int main(void)
{
    pia_context *context = NULL;
    if (pia_context_create(NULL, &context) != PIA_OK) return 1;
    const struct CMUnitTest tests[] = {cmocka_unit_test_prestate(conjugate_gradients_go_as_far_as_the_minimum_is, context)};
    int failed = cmocka_run_group_tests(tests, NULL, NULL);
    pia_context_destroy(context);
    return failed;
}
