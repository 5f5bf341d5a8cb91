#include "evaluate.h"

#include <math.h>
#include <pthread.h>

#include "check.h"
#include "shapes.h"

static void curves_of_every_degree_follow_the_definition(void **state)
{
    (void)state;
    for (int degree = 1; degree <= 9; degree++)
        for (int dim = 1; dim <= 4; dim++)
            for (int rational = 0; rational <= 1; rational++) {
                pia_model *model = shape_curve(NULL, degree, degree + 8, dim, rational, (uint64_t)(degree * 8 + dim));
                double at[26], out[26 * 4], expected[4];
                for (int i = 0; i < 26; i++) at[i] = i / 25.0;
                assert_ok(NULL, pia_model_eval(NULL, model, at, 26, 0, out));
                for (int i = 0; i < 26; i++) {
                    shape_point(model, &at[i], expected);
                    for (int c = 0; c < dim; c++) assert_near(out[i * dim + c], expected[c], 1e-14 * 8);
                }
                pia_model_destroy(model);
            }
}

static void surfaces_follow_the_definition(void **state)
{
    (void)state;
    for (int degree = 1; degree <= 5; degree++)
        for (int rational = 0; rational <= 1; rational++) {
            pia_model *model = shape_surface(NULL, degree, 6 - degree, 3, rational, (uint64_t)degree);
            for (int i = 0; i <= 6; i++)
                for (int j = 0; j <= 6; j++) {
                    double at[2] = {i / 6.0, j / 6.0}, out[3], expected[3];
                    assert_ok(NULL, pia_model_eval(NULL, model, at, 1, 0, out));
                    shape_point(model, at, expected);
                    for (int c = 0; c < 3; c++) assert_near(out[c], expected[c], 1e-13);
                }
            pia_model_destroy(model);
        }
}

/* Sums of the basis are 1, so a model whose points are all equal is that point, whatever its degree and dimension. */
static void the_highest_degrees_and_dimensions_work(void **state)
{
    (void)state;
    const int degree[2] = {25, 25};
    const pia_index control[2] = {30, 27};
    uint64_t seed = 2;
    double *u = shape_knots(25, 30, &seed), *v = shape_knots(25, 27, &seed);
    double *points = malloc(30 * 27 * 16 * sizeof *points), weights[30 * 27];
    for (int i = 0; i < 30 * 27; i++) {
        for (int c = 0; c < 16; c++) points[i * 16 + c] = c - 7.5;
        weights[i] = 0.5 + shape_random(&seed);
    }
    const double *const knots[2] = {u, v};
    pia_model *model = NULL;
    assert_ok(NULL, pia_model_create(NULL, 2, degree, knots, control, 16, points, weights, &model));
    double *out = malloc(6 * 16 * sizeof *out), at[2] = {0.37, 0.81};
    assert_ok(NULL, pia_model_eval(NULL, model, at, 1, 2, out));
    for (int c = 0; c < 16; c++) assert_near(out[c], c - 7.5, 1e-13);
    for (int c = 16; c < 96; c++) assert_near(out[c], 0, 1e-8);
    pia_model_destroy(model);
    free(u), free(v), free(points), free(out);
}

static void clamped_ends_are_the_end_control_points_to_the_last_bit(void **state)
{
    (void)state;
    for (int degree = 1; degree <= PIA_MAX_DEGREE; degree++) {
        pia_model *model = shape_curve(NULL, degree, degree + 6, 3, 0, (uint64_t)degree);
        double points[31 * 3], out[6], at[2] = {0, 1};
        pia_model_control(model, points, NULL);
        assert_ok(NULL, pia_model_eval(NULL, model, at, 2, 0, out));
        for (int c = 0; c < 3; c++) assert_true(out[c] == points[c] && out[3 + c] == points[(degree + 5) * 3 + c]);
        pia_model_destroy(model);
    }
}

/* The quarter circle as a rational quadratic: every point has radius 1. */
static void a_rational_arc_is_round(void **state)
{
    (void)state;
    const double knots[] = {0, 0, 0, 1, 1, 1}, points[] = {1, 0, 1, 1, 0, 1}, weights[] = {1, sqrt(0.5), 1};
    const double *const all[] = {knots};
    const int degree = 2;
    const pia_index control = 3;
    pia_model *model = NULL;
    assert_ok(NULL, pia_model_create(NULL, 1, &degree, all, &control, 2, points, weights, &model));
    for (int i = 0; i <= 100; i++) {
        double at = i / 100.0, out[2];
        assert_ok(NULL, pia_model_eval(NULL, model, &at, 1, 0, out));
        assert_near(hypot(out[0], out[1]), 1, 4e-16);
    }
    pia_model_destroy(model);
}

static void parameters_outside_are_taken_at_the_nearest_end(void **state)
{
    (void)state;
    pia_model *model = shape_surface(NULL, 3, 2, 2, 1, 3);
    const double outside[] = {-0.5, 1.5, nextafter(0, -1), nextafter(1, 2), -1e300, 1e300}, ends[] = {0, 1, 0, 1, 0, 1};
    double a[3 * 6], b[3 * 6];
    assert_ok(NULL, pia_model_eval(NULL, model, outside, 3, 1, a));
    assert_ok(NULL, pia_model_eval(NULL, model, ends, 3, 1, b));
    assert_memory_equal(a, b, sizeof a);
    pia_model_destroy(model);
}

/* All derivatives at `count` places of a curve of every degree; each array ends where the address sanitizer watches. */
static void check_places(const double *at, pia_index count, int beyond_degree)
{
    for (int degree = 1; degree <= PIA_MAX_DEGREE; degree++) {
        pia_model *model = shape_curve(NULL, degree, degree + 1 + degree % 3, 2, degree % 2, (uint64_t)degree);
        int order = degree + beyond_degree;
        double *out = malloc((size_t)(count * (order + 1) * 2) * sizeof *out);
        assert_ok(NULL, pia_model_eval(NULL, model, at, count, order, out));
        for (pia_index i = 0; i < count * (order + 1) * 2; i++) assert_true(isfinite(out[i]));
        free(out);
        pia_model_destroy(model);
    }
}

static void t_peer_05_degrees_above_19_are_evaluated(void **state)
{
    (void)state;
    check_places((double[]){0, 0.25, 0.5, 1}, 4, 0);
}

static void t_peer_06_derivatives_left_of_the_domain_stay_inside_their_arrays(void **state)
{
    (void)state;
    check_places((double[]){-1e308, -1, -1e-320}, 3, 1);
}

static void t_peer_16_no_parameter_reads_past_the_knots(void **state)
{
    (void)state;
    check_places((double[]){nextafter(1, 0), 1, nextafter(1, 2), 2, 1e308}, 5, 2);
}

static void bad_requests_are_refused_and_write_nothing(void **state)
{
    (void)state;
    pia_context *context = NULL;
    assert_ok(NULL, pia_context_create(NULL, &context));
    pia_model *model = shape_curve(context, 3, 8, 2, 0, 1);
    double at[3] = {0, 0.5, NAN}, out[6] = {7, 7, 7, 7, 7, 7};
    assert_status(context, pia_model_eval(context, model, at, 3, 0, out), PIA_E_DATA);
    assert_non_null(strstr(pia_message(context), "parameter 2"));
    assert_status(context, pia_model_eval(context, model, at, -1, 0, out), PIA_E_ARGUMENT);
    assert_status(context, pia_model_eval(context, model, at, 2, -1, out), PIA_E_ARGUMENT);
    assert_status(context, pia_model_eval(context, NULL, at, 2, 0, out), PIA_E_ARGUMENT);
    assert_status(context, pia_model_eval(context, model, NULL, 2, 0, out), PIA_E_ARGUMENT);
    assert_status(context, pia_model_eval(context, model, at, 2, 0, NULL), PIA_E_ARGUMENT);
    assert_status(context, pia_model_eval(context, model, at, INT64_MAX / 4, 0, out), PIA_E_SIZE);
    for (int i = 0; i < 6; i++) assert_true(out[i] == 7);
    assert_ok(context, pia_model_eval(context, model, at, 0, 0, out));
    pia_model_destroy(model);
    pia_context_destroy(context);
}

enum { MANY = 300000 };

static void thread_counts_change_no_bit(void **state)
{
    (void)state;
    double *at = malloc(MANY * sizeof *at), *out = malloc(MANY * 3 * sizeof *out), *first = malloc(MANY * 3 * sizeof *first);
    uint64_t seed = 1;
    for (int i = 0; i < MANY; i++) at[i] = i % 2 ? shape_random(&seed) : i / (double)MANY;
    pia_model *model = shape_curve(NULL, 3, 50, 3, 1, 9);
    const int threads[] = {1, 2, 3, 8};
    for (int k = 0; k < 4; k++) {
        pia_context *context = NULL;
        assert_ok(NULL, pia_context_create(NULL, &context));
        assert_ok(context, pia_context_set_threads(context, threads[k]));
        assert_ok(context, pia_model_eval(context, model, at, MANY, 0, k == 0 ? first : out));
        if (k > 0) assert_memory_equal(first, out, MANY * 3 * sizeof *out);
        pia_context_destroy(context);
    }
    pia_model_destroy(model);
    free(at), free(out), free(first);
}

static void *evaluate_everywhere(void *argument)
{
    const pia_model *model = argument;
    pia_index wrong = 0;
    for (int i = 0; i < 20000; i++) {
        double at = i % 1000 / 999.0, alone[3], expected = at;
        if (pia_model_eval(NULL, model, &at, 1, 0, alone) != PIA_OK) wrong++;
        for (int c = 0; c < 3; c++) wrong += fabs(alone[c] - (c + 1) * expected) > 1e-12;
    }
    return (void *)(intptr_t)wrong;
}

/* Control points at the Greville abscissae make x_c(t) = (c + 1) t, so every thread knows the right answer. */
static void t_peer_48_one_model_is_read_by_many_threads_at_once(void **state)
{
    (void)state;
    const int degree = 3;
    const pia_index control = 40;
    uint64_t seed = 5;
    double *knots = shape_knots(degree, control, &seed), points[40 * 3];
    for (int i = 0; i < 40 * 3; i++) points[i] = (i % 3 + 1) * (knots[i / 3 + 1] + knots[i / 3 + 2] + knots[i / 3 + 3]) / 3;
    const double *const all[] = {knots};
    pia_model *model = NULL;
    assert_ok(NULL, pia_model_create(NULL, 1, &degree, all, &control, 3, points, NULL, &model));
    pthread_t thread[8];
    for (int i = 0; i < 8; i++) assert_int_equal(pthread_create(&thread[i], NULL, evaluate_everywhere, model), 0);
    for (int i = 0; i < 8; i++) {
        void *wrong;
        pthread_join(thread[i], &wrong);
        assert_null(wrong);
    }
    pia_model_destroy(model);
    free(knots);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(curves_of_every_degree_follow_the_definition),
        cmocka_unit_test(surfaces_follow_the_definition),
        cmocka_unit_test(the_highest_degrees_and_dimensions_work),
        cmocka_unit_test(clamped_ends_are_the_end_control_points_to_the_last_bit),
        cmocka_unit_test(a_rational_arc_is_round),
        cmocka_unit_test(parameters_outside_are_taken_at_the_nearest_end),
        cmocka_unit_test(t_peer_05_degrees_above_19_are_evaluated),
        cmocka_unit_test(t_peer_06_derivatives_left_of_the_domain_stay_inside_their_arrays),
        cmocka_unit_test(t_peer_16_no_parameter_reads_past_the_knots),
        cmocka_unit_test(bad_requests_are_refused_and_write_nothing),
        cmocka_unit_test(thread_counts_change_no_bit),
        cmocka_unit_test(t_peer_48_one_model_is_read_by_many_threads_at_once),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
