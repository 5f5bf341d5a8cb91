/* The law of determinism: every method of the registry gives the same bits for 1, 2, 3 and 8 threads. Enough points that the work
 * is cut into chunks. */
#include <stdlib.h>

#include "check.h"

enum { COUNT = 140000, ROWS = 220, COLUMNS = 210, STEPS = 2 };

typedef struct problem {
    pia_data data;
    double *points;
} problem;

static problem spiral(void)
{
    problem p;
    pia_data_init(&p.data);
    p.points = malloc(COUNT * 3 * sizeof(double));
    assert_non_null(p.points);
    for (int i = 0; i < COUNT; i++) {
        double t = 0.01 * i + 0.004 * sin(0.3 * i);
        p.points[3 * i] = t * cos(t);
        p.points[3 * i + 1] = t * sin(t);
        p.points[3 * i + 2] = sin(3 * t);
    }
    p.data.points = p.points;
    p.data.count[0] = COUNT;
    p.data.dim = 3;
    return p;
}

static problem waves(void)
{
    problem p;
    pia_data_init(&p.data);
    p.points = malloc(ROWS * COLUMNS * 3 * sizeof(double));
    assert_non_null(p.points);
    for (int i = 0; i < ROWS; i++)
        for (int j = 0; j < COLUMNS; j++) {
            double *q = p.points + 3 * (i * COLUMNS + j);
            q[0] = i + 0.2 * sin(j);
            q[1] = j + 0.2 * cos(i);
            q[2] = 5 * sin(0.1 * i) * cos(0.07 * j);
        }
    p.data.kind = PIA_GRID;
    p.data.points = p.points;
    p.data.count[0] = ROWS;
    p.data.count[1] = COLUMNS;
    p.data.dim = 3;
    return p;
}

/* Control points of the fit with `threads` threads, and how many numbers they are; NULL when the method is not made for this data. */
static double *fit(const problem *p, const char *method, int threads, pia_index *count)
{
    pia_context *context = NULL;
    pia_model *model = NULL;
    assert_ok(NULL, pia_context_create(NULL, &context));
    assert_ok(context, pia_context_set_threads(context, threads));
    pia_fit_options options;
    pia_fit_options_init(&options);
    options.method = method;
    options.max_iterations = STEPS;
    pia_status status = pia_fit_data(context, &p->data, &options, &model, NULL);
    double *control = NULL;
    if (status != PIA_E_ARGUMENT) {
        assert_ok(context, status);
        pia_model_info info = {.struct_size = sizeof info};
        pia_model_get_info(model, &info);
        *count = info.control[0] * info.control[1] * info.dim;
        control = malloc((size_t)*count * sizeof *control);
        assert_non_null(control);
        pia_model_control(model, control, NULL);
    }
    pia_model_destroy(model);
    pia_context_destroy(context);
    return control;
}

static void expect_the_same_bits(problem p)
{
    pia_entry method;
    int covered = 0;
    for (pia_index i = 0; pia_list("method", i, &method); i++) {
        pia_index count = 0;
        double *expected = fit(&p, method.name, 1, &count);
        if (expected == NULL) continue;
        covered++;
        const int threads[] = {2, 3, 8};
        for (int j = 0; j < 3; j++) {
            pia_index again = 0;
            double *control = fit(&p, method.name, threads[j], &again);
            assert_non_null(control);
            assert_int_equal(again, count);
            if (memcmp(control, expected, (size_t)count * sizeof *control) != 0)
                fail_msg("%s gives other bits with %d threads", method.name, threads[j]);
            free(control);
        }
        free(expected);
    }
    assert_true(covered >= 2);
    free(p.points);
}

static void a_curve_has_the_same_bits_for_any_number_of_threads(void **state)
{
    (void)state;
    expect_the_same_bits(spiral());
}

static void a_surface_has_the_same_bits_for_any_number_of_threads(void **state)
{
    (void)state;
    expect_the_same_bits(waves());
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_curve_has_the_same_bits_for_any_number_of_threads),
        cmocka_unit_test(a_surface_has_the_same_bits_for_any_number_of_threads),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
