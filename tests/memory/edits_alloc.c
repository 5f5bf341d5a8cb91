/* Edits of a running fit, and what is asked of it and of its model, with every allocation failing in turn. After a failure the fit can
 * still be asked, stepped and closed. */
#include "failing.h"

enum { COUNT = 30 };

typedef struct sample {
    double points[2 * COUNT];
    pia_data data;
    pia_fit_options options;
} sample;

static sample make(const char *method)
{
    sample s;
    pia_data_init(&s.data);
    pia_fit_options_init(&s.options);
    for (int i = 0; i < COUNT; i++) {
        s.points[2 * i] = i;
        s.points[2 * i + 1] = sin(0.3 * i) + 0.1 * sin(5.0 * i);
    }
    s.data.count[0] = COUNT;
    s.data.dim = 2;
    s.options.method = method;
    s.options.control[0] = 9;
    s.options.stop_change = s.options.stop_gradient = 0;
    return s;
}

typedef pia_status edit(pia_fit *fit);

static pia_status constrain_and_release(pia_fit *fit)
{
    pia_constraint meet[2];
    pia_index id;
    for (int k = 0; k < 2; k++) pia_constraint_init(&meet[k]);
    meet[0].at_point = 4;
    meet[1].at_parameter[0] = 1;
    meet[1].derivative[0] = 1;
    meet[1].direction_only = 1;
    meet[1].value = (const double[]){1, 0.5};
    pia_status status = pia_fit_constrain(fit, meet, 2, &id);
    if (status == PIA_OK) status = pia_fit_step(fit, 2, NULL);
    return status == PIA_OK ? pia_fit_release(fit, id) : status;
}

static pia_status insert_knot(pia_fit *fit)
{
    return pia_fit_insert_knot(fit, 0, 0.37);
}

static pia_status weigh_and_move(pia_fit *fit)
{
    pia_status status = pia_fit_weigh_point(fit, 3, 0.5);
    return status == PIA_OK ? pia_fit_move_point(fit, 7, (const double[]){7, 2}) : status;
}

static pia_status add_points(pia_fit *fit)
{
    pia_data more;
    pia_data_init(&more);
    more.points = (const double[]){3.5, 1, 9.5, 0};
    more.parameters = (const double[]){0.2, 0.3};
    more.count[0] = 2;
    more.dim = 2;
    return pia_fit_add_points(fit, &more);
}

static pia_status ask(pia_fit *fit)
{
    static double residuals[2 * COUNT + 8];
    const double *parameters, *weights;
    const pia_index *row, *control;
    pia_index count;
    pia_report report = {.struct_size = sizeof report};
    pia_status status = pia_fit_residuals(fit, residuals);
    if (status == PIA_OK) status = pia_fit_parameters(fit, &parameters, &count, &row);
    if (status == PIA_OK) status = pia_fit_weights(fit, &weights, &row, &count);
    if (status == PIA_OK) status = pia_fit_unsupported(fit, &control, &count);
    if (status == PIA_OK) status = pia_fit_corners(fit, &row, &count);
    if (status == PIA_OK) status = pia_fit_set(fit, "stop_change", "1e-3");
    return status == PIA_OK ? pia_fit_report(fit, &report) : status;
}

static edit *const edits[] = {constrain_and_release, insert_knot, weigh_and_move, add_points, ask};
static edit *current;

static pia_status open_and_edit(pia_context *context, void *user)
{
    sample *s = user;
    pia_fit *fit = NULL;
    pia_model *model = NULL;
    pia_report report = {.struct_size = sizeof report};
    s->data.points = s->points;
    pia_status status = pia_fit_open(context, &s->data, &s->options, &fit);
    if (status != PIA_OK) return status;
    status = pia_fit_step(fit, 2, NULL);
    if (status == PIA_OK) status = current(fit);
    if (status == PIA_OK) status = pia_fit_step(fit, 2, &report);
    if (status == PIA_OK) status = pia_fit_model(fit, &model);
    if (status != PIA_OK) { /* whatever it answers */
        (void)pia_fit_report(fit, &report);
        (void)pia_fit_step(fit, 1, NULL);
        assert_null(model);
    }
    pia_model_destroy(model);
    pia_fit_close(fit);
    return status;
}

static void edits_survive_every_failure(void **state)
{
    (void)state;
    static const char *const method[] = {"clspia", "direct", "lspia", "cg"};
    for (size_t m = 0; m < sizeof method / sizeof *method; m++)
        for (size_t e = m < 2 ? 0 : 1; e < sizeof edits / sizeof *edits; e++) {
            sample s = make(method[m]);
            current = edits[e];
            assert_survives_failures(open_and_edit, &s);
        }
}

static pia_status join_and_go_on(pia_context *context, void *user)
{
    sample *s = user;
    pia_fit *fit = NULL;
    pia_model *neighbour = NULL;
    pia_index first, count;
    s->data.points = s->points;
    pia_status status = pia_fit_data(context, &s->data, &s->options, &neighbour, NULL);
    if (status == PIA_OK) status = pia_fit_open(context, &s->data, &s->options, &fit);
    pia_join join;
    pia_join_init(&join);
    join.neighbour = neighbour;
    if (status == PIA_OK) status = pia_fit_join(fit, &join, &first, &count);
    if (status == PIA_OK) status = pia_fit_run(fit, NULL);
    pia_fit_close(fit);
    pia_model_destroy(neighbour);
    return status;
}

static void joins_survive_every_failure(void **state)
{
    (void)state;
    sample s = make("direct");
    assert_survives_failures(join_and_go_on, &s);
}

static pia_status look_at_model(pia_context *context, void *user)
{
    sample *s = user;
    pia_model *model = NULL;
    double curvature[COUNT], length, tolerance, noise[2];
    pia_deviation deviation = {.struct_size = sizeof deviation};
    s->data.points = s->points;
    pia_status status = pia_suggest_tolerance(context, &s->data, &tolerance, noise);
    if (status == PIA_OK) status = pia_fit_data(context, &s->data, &s->options, &model, NULL);
    if (status == PIA_OK) status = pia_model_deviation(context, model, s->points, COUNT, NULL, &deviation, NULL);
    if (status == PIA_OK) status = pia_model_curvature(context, model, (const double[]){0, 0.5, 1}, 3, curvature);
    if (status == PIA_OK) status = pia_model_length(context, model, &length);
    pia_model_destroy(model);
    return status;
}

static void looks_at_a_model_survive_every_failure(void **state)
{
    (void)state;
    sample s = make("direct");
    assert_survives_failures(look_at_model, &s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(edits_survive_every_failure),
        cmocka_unit_test(joins_survive_every_failure),
        cmocka_unit_test(looks_at_a_model_survive_every_failure),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
