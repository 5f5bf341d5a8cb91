/* A fit whose points were moved and weighed anew, and that went on, is the fit of the data as they are then: open and closed curves,
 * with and without fairing, at the ends, at the seam and far from them. */
#include "check.h"

enum { ROWS = 500, CONTROL = 30, DIM = 2, EDITS = 6 };

typedef struct sample {
    double points[ROWS * DIM], parameters[ROWS], weights[ROWS];
    pia_data data;
    pia_fit_options options;
} sample;

static void make(sample *s, int degree, int closed, double fairing)
{
    pia_data_init(&s->data);
    pia_fit_options_init(&s->options);
    for (int i = 0; i < ROWS; i++) {
        double t = (double)i / (closed ? ROWS : ROWS - 1);
        s->parameters[i] = t;
        s->weights[i] = 1 + 0.5 * sin(i);
        for (int d = 0; d < DIM; d++) s->points[i * DIM + d] = 30 + sin(6.283185307179586 * t + 1.57 * d) + 0.02 * cos(77 * i + d);
    }
    s->data.points = s->points;
    s->data.parameters = s->parameters;
    s->data.weights = s->weights;
    s->data.count[0] = ROWS;
    s->data.dim = DIM;
    s->options.degree[0] = degree;
    s->options.control[0] = CONTROL;
    s->options.closed[0] = closed;
    s->options.placement = "uniform";
    s->options.fairing = fairing;
}

static void control_points(pia_context *context, pia_fit *fit, double *x)
{
    pia_model *model = NULL;
    assert_ok(context, pia_fit_run(fit, NULL));
    assert_ok(context, pia_fit_model(fit, &model));
    pia_model_control(model, x, NULL);
    pia_model_destroy(model);
}

static void edit(pia_context *context, sample *s, pia_fit *fit, pia_index row)
{
    const double point[DIM] = {s->points[row * DIM] + 0.3, s->points[row * DIM + 1] - 0.2};
    memcpy(s->points + row * DIM, point, sizeof point);
    s->weights[row] = row % 3 == 1 ? 0 : 4;
    assert_ok(context, pia_fit_move_point(fit, row, point));
    assert_ok(context, pia_fit_weigh_point(fit, row, s->weights[row]));
}

static void check(pia_context *context, sample *s, const char *method, double tolerance)
{
    static const pia_index rows[EDITS] = {250, 251, 3, 497, 0, 499};
    double edited[2 * CONTROL * DIM] = {0}, fresh[2 * CONTROL * DIM] = {0};
    pia_fit *fit = NULL, *other = NULL;
    s->options.method = method;
    s->options.max_iterations = 5000;
    s->options.stop_gradient = 1e-15;
    assert_ok(context, pia_fit_open(context, &s->data, &s->options, &fit));
    assert_ok(context, pia_fit_run(fit, NULL));
    for (int k = 0; k < EDITS; k++) {
        edit(context, s, fit, rows[k]);
        control_points(context, fit, edited);
        assert_ok(context, pia_fit_open(context, &s->data, &s->options, &other));
        control_points(context, other, fresh);
        pia_fit_close(other);
        for (int i = 0; i < 2 * CONTROL * DIM; i++) assert_near(edited[i], fresh[i], tolerance);
    }
    pia_fit_close(fit);
}

static void edits_lead_to_the_fit_of_the_data_as_they_are(void **state)
{
    static sample s;
    for (int closed = 0; closed < 2; closed++)
        for (int degree = 1; degree <= 5; degree++)
            for (int faired = 0; faired < 2; faired++) {
                make(&s, degree, closed, faired && degree > 1 ? 0.01 : 0);
                check(*state, &s, "direct", 1e-11);
                make(&s, degree, closed, faired && degree > 1 ? 0.01 : 0);
                check(*state, &s, "cg", 1e-10);
            }
}

int main(void)
{
    pia_context *context = NULL;
    if (pia_context_create(NULL, &context) != PIA_OK) return 1;
    const struct CMUnitTest tests[] = {cmocka_unit_test_prestate(edits_lead_to_the_fit_of_the_data_as_they_are, context)};
    int failed = cmocka_run_group_tests(tests, NULL, NULL);
    pia_context_destroy(context);
    return failed;
}
