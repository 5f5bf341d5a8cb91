#include <math.h>

#include "../memory/failing.h"
#include "model.h"
#include "shapes.h"

static double largest_gap(const pia_model *a, const pia_model *b, int samples)
{
    pia_model_info info;
    pia_model_get_info(a, &info);
    double p[PIA_MAX_DIM], q[PIA_MAX_DIM], most = 0;
    for (int i = 0; i <= samples; i++)
        for (int j = 0; j <= (info.directions > 1 ? samples : 0); j++) {
            double at[] = {info.domain[0][0] + (info.domain[0][1] - info.domain[0][0]) * i / samples,
                           info.domain[1][0] + (info.domain[1][1] - info.domain[1][0]) * j / samples};
            double sum = 0;
            assert_ok(NULL, pia_model_eval(NULL, a, at, 1, 0, p));
            assert_ok(NULL, pia_model_eval(NULL, b, at, 1, 0, q));
            for (int c = 0; c < info.dim; c++) sum += (p[c] - q[c]) * (p[c] - q[c]);
            most = fmax(most, sqrt(sum));
        }
    return most;
}

static pia_index control_of(const pia_model *model, int direction)
{
    pia_model_info info;
    pia_model_get_info(model, &info);
    return info.control[direction];
}

static void inserted_knots_are_removed_again(void **state)
{
    (void)state;
    for (int degree = 1; degree <= 9; degree++)
        for (int rational = 0; rational <= 1; rational++) {
            pia_model *model = shape_curve(NULL, degree, degree + 9, 3, rational, (uint64_t)degree), *finer = NULL, *again = NULL;
            const double values[] = {0.07, 0.21, 0.33, 0.5, 0.65, 0.654, 0.9};
            double error;
            assert_ok(NULL, pia_model_insert_knots(NULL, model, 0, values, 7, &finer));
            assert_ok(NULL, pia_model_remove_knots(NULL, finer, 1e-11, &again, &error));
            assert_int_equal(control_of(again, 0), control_of(model, 0));
            assert_true(error <= 1e-11);
            shape_assert_same(model, again, 80, 1e-12);
            pia_model_destroy(model);
            pia_model_destroy(finer);
            pia_model_destroy(again);
        }
}

/* A smooth curve with far more knots than it needs: the more the bound allows, the fewer stay, and no sample is ever beyond it. */
static pia_model *smooth_curve(int degree, int rational)
{
    enum { COUNT = 120 };
    double points[COUNT * 3], weights[COUNT];
    uint64_t seed = 11;
    double *knots = shape_knots(degree, COUNT, &seed);
    for (int i = 0; i < COUNT; i++) {
        double t = 0;
        for (int k = 1; k <= degree; k++) t += knots[i + k] / degree;
        points[3 * i] = 100 + cos(7 * t);
        points[3 * i + 1] = sin(5 * t) * (1 + t);
        points[3 * i + 2] = t * t;
        weights[i] = 1 + 0.3 * sin(4 * t);
    }
    const double *const all[] = {knots};
    const pia_index control = COUNT;
    pia_model *model = NULL;
    assert_ok(NULL, pia_model_create(NULL, 1, &degree, all, &control, 3, points, rational ? weights : NULL, &model));
    free(knots);
    return model;
}

static void the_proven_bound_holds_for_all_removals_together(void **state)
{
    (void)state;
    for (int degree = 1; degree <= 7; degree++)
        for (int rational = 0; rational <= 1; rational++) {
            pia_model *model = smooth_curve(degree, rational);
            pia_index before = control_of(model, 0);
            for (double bound = 1e-7; bound < 1; bound *= 10) {
                pia_model *out = NULL;
                double error;
                assert_ok(NULL, pia_model_remove_knots(NULL, model, bound, &out, &error));
                double gap = largest_gap(model, out, 3000);
                if (!(gap <= error + 1e-13 && error <= bound)) {
                    print_error("degree %d bound %g: proven %g, sampled %g\n", degree, bound, error, gap);
                    fail();
                }
                assert_true(control_of(out, 0) <= before);
                before = control_of(out, 0);
                pia_model_destroy(out);
            }
            assert_true(before < 40);
            pia_model_destroy(model);
        }
}

static void rough_curves_keep_the_knots_they_need(void **state)
{
    (void)state;
    for (int degree = 1; degree <= 5; degree++)
        for (int rational = 0; rational <= 1; rational++) {
            pia_model *model = shape_curve(NULL, degree, 60, 2, rational, (uint64_t)degree), *out = NULL;
            double error;
            assert_ok(NULL, pia_model_remove_knots(NULL, model, 1e-12, &out, &error));
            assert_int_equal(control_of(out, 0), 60);
            assert_true(error == 0);
            pia_model_destroy(out);
            assert_ok(NULL, pia_model_remove_knots(NULL, model, 0.2, &out, &error));
            assert_true(largest_gap(model, out, 4000) <= error && error <= 0.2);
            pia_model_destroy(out);
            pia_model_destroy(model);
        }
}

static void the_bound_holds_on_surfaces(void **state)
{
    (void)state;
    for (int rational = 0; rational <= 1; rational++) {
        enum { ROWS = 24, COLUMNS = 30 };
        const int degree[] = {3, 2};
        const pia_index control[] = {ROWS, COLUMNS};
        uint64_t seed = 12;
        double *u = shape_knots(3, ROWS, &seed), *v = shape_knots(2, COLUMNS, &seed), points[ROWS * COLUMNS * 3],
               weights[ROWS * COLUMNS];
        for (int i = 0; i < ROWS; i++)
            for (int j = 0; j < COLUMNS; j++) {
                double x = (u[i + 1] + u[i + 2] + u[i + 3]) / 3, y = (v[j + 1] + v[j + 2]) / 2, *p = points + (i * COLUMNS + j) * 3;
                p[0] = x, p[1] = y, p[2] = 0.3 * sin(3 * x) * cos(4 * y);
                weights[i * COLUMNS + j] = 1 + 0.2 * x * y;
            }
        const double *const knots[] = {u, v};
        pia_model *model = NULL;
        assert_ok(NULL, pia_model_create(NULL, 2, degree, knots, control, 3, points, rational ? weights : NULL, &model));
        for (double bound = 1e-6; bound < 0.2; bound *= 10) {
            pia_model *out = NULL;
            double error;
            assert_ok(NULL, pia_model_remove_knots(NULL, model, bound, &out, &error));
            assert_true(error <= bound);
            assert_true(largest_gap(model, out, 120) <= error + 1e-14);
            if (bound > 1e-2) assert_true(control_of(out, 0) < ROWS / 2 && control_of(out, 1) < COLUMNS / 2);
            pia_model_destroy(out);
        }
        pia_model_destroy(model);
        free(u), free(v);
    }
}

static void ends_stay_and_what_nothing_bounds_is_a_bezier_curve(void **state)
{
    (void)state;
    pia_model *model = shape_curve(NULL, 3, 40, 2, 0, 2), *out = NULL;
    double a[80], b[80];
    assert_ok(NULL, pia_model_remove_knots(NULL, model, 1e6, &out, NULL));
    assert_int_equal(control_of(out, 0), 4);
    pia_model_control(model, a, NULL);
    pia_model_control(out, b, NULL);
    assert_memory_equal(a, b, 2 * sizeof *a);
    assert_memory_equal(a + 78, b + 6, 2 * sizeof *a);
    pia_model_destroy(model);
    pia_model_destroy(out);
}

static void a_closed_curve_stays_closed_and_smooth(void **state)
{
    (void)state;
    enum { DISTINCT = 60, DEGREE = 3 };
    double knots[DISTINCT + 2 * DEGREE + 1], points[(DISTINCT + DEGREE) * 2];
    for (int i = 0; i < DISTINCT + 2 * DEGREE + 1; i++) knots[i] = i - DEGREE;
    for (int i = 0; i < DISTINCT + DEGREE; i++) {
        points[2 * i] = cos(i % DISTINCT * (4 * acos(0) / DISTINCT));
        points[2 * i + 1] = sin(i % DISTINCT * (4 * acos(0) / DISTINCT));
    }
    const double *const all[] = {knots};
    const int degree = DEGREE, yes = 1;
    const pia_index control = DISTINCT + DEGREE;
    pia_model *model = NULL, *out = NULL;
    double error;
    assert_ok(NULL, pia_model_from_cyclic(NULL, 1, &degree, all, &control, &yes, 2, points, &model));
    assert_ok(NULL, pia_model_remove_knots(NULL, model, 1e-2, &out, &error));
    assert_true(control_of(out, 0) < 30);
    assert_int_equal(pia_model_joins(out, 0), 1);
    assert_true(largest_gap(model, out, 2000) <= error);
    pia_model_destroy(model);
    pia_model_destroy(out);
}

static void bad_bounds_are_refused(void **state)
{
    (void)state;
    pia_model *model = shape_curve(NULL, 3, 9, 2, 0, 4), *out = NULL;
    const double bad[] = {-1, NAN, INFINITY};
    for (int i = 0; i < 3; i++) assert_status(NULL, pia_model_remove_knots(NULL, model, bad[i], &out, NULL), PIA_E_ARGUMENT);
    assert_status(NULL, pia_model_remove_knots(NULL, NULL, 1, &out, NULL), PIA_E_ARGUMENT);
    assert_status(NULL, pia_model_remove_knots(NULL, model, 1, NULL, NULL), PIA_E_ARGUMENT);
    assert_null(out);
    pia_model_destroy(model);
}

static pia_status thin(pia_context *context, void *user)
{
    pia_model *out = NULL;
    pia_status status = pia_model_remove_knots(context, user, 0.1, &out, NULL);
    pia_model_destroy(out);
    return status;
}

static void removal_survives_every_failed_allocation(void **state)
{
    (void)state;
    pia_model *model = shape_surface(NULL, 2, 2, 3, 0, 1);
    assert_survives_failures(thin, model);
    pia_model_destroy(model);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(inserted_knots_are_removed_again),
        cmocka_unit_test(the_proven_bound_holds_for_all_removals_together),
        cmocka_unit_test(rough_curves_keep_the_knots_they_need),
        cmocka_unit_test(the_bound_holds_on_surfaces),
        cmocka_unit_test(ends_stay_and_what_nothing_bounds_is_a_bezier_curve),
        cmocka_unit_test(a_closed_curve_stays_closed_and_smooth),
        cmocka_unit_test(bad_bounds_are_refused),
        cmocka_unit_test(removal_survives_every_failed_allocation),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
