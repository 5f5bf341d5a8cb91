/* Pictures when memory runs out. */
#include "failing.h"

#include <unistd.h>

typedef struct picture {
    pia_model *model;
    double *points, *parameters; /* parameters NULL: closest points */
    pia_index count;
    char path[64];
} picture;

static pia_status draw(pia_context *context, void *user)
{
    const picture *p = user;
    const pia_trace_row trace[3] = {{.iteration = 0, .max_error = 1, .rms_error = 0.5},
                                    {.iteration = 1, .max_error = 0.1, .rms_error = 0.05}};
    pia_plot_options options;
    pia_plot_options_init(&options);
    options.comb = 1;
    options.parameters = p->parameters;
    options.trace = trace;
    options.trace_count = 2;
    const pia_model *model = p->model;
    pia_status status = pia_plot(context, p->path, &model, 1, p->points, p->count, &options);
    int exists = access(p->path, F_OK) == 0;
    if (exists != (status == PIA_OK)) return PIA_E_INTERNAL; /* whole or not at all */
    unlink(p->path);
    return status;
}

static pia_model *make_model(int directions, const double *knots, const double *points)
{
    const int degree[2] = {2, 2};
    const pia_index control[2] = {4, directions == 2 ? 4 : 1};
    pia_model *model = NULL;
    assert_ok(NULL, pia_model_create(NULL, directions, degree, (const double *const[]){knots, knots}, control, directions + 1, points,
                                     NULL, &model));
    return model;
}

static void draw_without_memory(int directions, int with_parameters)
{
    static const double knots[] = {0, 0, 0, 0.4, 1, 1, 1};
    double control[48], points[120], parameters[80];
    int dim = directions + 1;
    for (int i = 0; i < 48; i++) control[i] = i % dim == dim - 1 ? sin(i) : (dim == 3 && i % dim == 1 ? i / 3 % 4 : i / dim);
    for (int i = 0; i < 40 * directions; i++) parameters[i] = i / (40.0 * directions);
    picture p = {.model = make_model(directions, knots, control), .points = points, .count = 40};
    p.parameters = with_parameters ? parameters : NULL;
    assert_ok(NULL, pia_model_eval(NULL, p.model, parameters, 40, 0, points));
    points[3] += 0.1;
    snprintf(p.path, sizeof p.path, "/tmp/pia-plot-%ld.pdf", (long)getpid());
    pia_context *context = NULL;
    assert_ok(NULL, pia_context_create(NULL, &context));
    pia_status status = draw(context, &p);
    pia_context_destroy(context);
    if (status != PIA_E_UNAVAILABLE) assert_survives_failures(draw, &p);
    pia_model_destroy(p.model);
}

static void a_picture_of_a_curve_survives_every_failing_allocation(void **state)
{
    (void)state;
    draw_without_memory(1, 0);
}

static void a_picture_of_a_surface_survives_every_failing_allocation(void **state)
{
    (void)state;
    draw_without_memory(2, 1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_picture_of_a_curve_survives_every_failing_allocation),
        cmocka_unit_test(a_picture_of_a_surface_survives_every_failing_allocation),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
