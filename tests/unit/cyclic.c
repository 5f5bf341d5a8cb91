#include <math.h>

#include "../memory/failing.h"
#include "check.h"
#include "knots.h"
#include "model.h"
#include "shapes.h"

/* A closed spline of `distinct` control points in cyclic form. Caller frees both. */
typedef struct closed {
    int degree;
    pia_index distinct, control;
    double *knots, *points;
} closed;

enum { DIM = 2 };

static closed make_closed(int degree, pia_index distinct, uint64_t seed)
{
    closed c = {degree, distinct, distinct + degree, NULL, NULL};
    c.knots = malloc((size_t)(c.control + degree + 1) * sizeof *c.knots);
    c.points = malloc((size_t)(c.control * DIM) * sizeof *c.points);
    double step[64], t = 0;
    for (pia_index i = 0; i < distinct; i++) step[i] = 0.3 + shape_random(&seed);
    for (pia_index i = 0; i < degree; i++) t -= step[(distinct * 30 - 1 - i) % distinct];
    for (pia_index i = 0; i < c.control + degree + 1; i++) {
        c.knots[i] = t;
        t += step[(distinct * 30 + i - degree) % distinct];
    }
    for (pia_index i = 0; i < c.control; i++)
        for (int k = 0; k < DIM; k++) c.points[i * DIM + k] = i < distinct ? shape_random(&seed) : c.points[(i - distinct) * DIM + k];
    return c;
}

static void free_closed(closed *c)
{
    free(c->knots), free(c->points);
}

static pia_model *clamp(pia_context *context, const closed *c)
{
    const double *const knots[] = {c->knots};
    const int yes = 1;
    pia_model *model = NULL;
    assert_ok(context, pia_model_from_cyclic(context, 1, &c->degree, knots, &c->control, &yes, DIM, c->points, &model));
    return model;
}

static void the_clamped_form_has_the_same_shape(void **state)
{
    (void)state;
    for (int degree = 1; degree <= 9; degree++)
        for (pia_index distinct = degree < 3 ? 3 : 2; distinct <= 20; distinct += 6) {
            closed c = make_closed(degree, distinct, (uint64_t)(degree * 100) + (uint64_t)distinct);
            pia_model *model = clamp(NULL, &c);
            pia_model_info info;
            pia_model_get_info(model, &info);
            assert_int_equal(info.periodic[0], 1);
            assert_int_equal(info.control[0], c.control);
            assert_true(info.domain[0][0] == c.knots[degree] && info.domain[0][1] == c.knots[c.control]);
            for (int i = 0; i <= 50; i++) {
                double t = info.domain[0][0] + (info.domain[0][1] - info.domain[0][0]) * i / 50, out[DIM];
                assert_ok(NULL, pia_model_eval(NULL, model, &t, 1, 0, out));
                for (int k = 0; k < DIM; k++) {
                    long double sum = 0;
                    if (i == 50) t = info.domain[0][0];
                    for (pia_index j = 0; j < c.control; j++)
                        sum += shape_basis(c.knots, degree, c.control + degree, j, degree, t) * c.points[j * DIM + k];
                    assert_near(out[k], (double)sum, 1e-13);
                }
            }
            pia_model_destroy(model);
            free_closed(&c);
        }
}

static void a_closed_model_is_recognised_and_an_open_one_is_not(void **state)
{
    (void)state;
    for (int degree = 1; degree <= 7; degree++) {
        closed c = make_closed(degree, 12, (uint64_t)degree);
        pia_model *model = clamp(NULL, &c), *again = NULL, *open = shape_curve(NULL, degree, 12, DIM, 0, (uint64_t)degree);
        double points[19 * DIM];
        pia_model_control(model, points, NULL);
        const double *const knots[] = {pia_model_knots(model, 0)};
        assert_ok(NULL, pia_model_create(NULL, 1, &degree, knots, &c.control, DIM, points, NULL, &again));
        pia_model_info info;
        pia_model_get_info(again, &info);
        assert_int_equal(info.periodic[0], 1);
        pia_model_get_info(open, &info);
        assert_int_equal(info.periodic[0], 0);
        pia_model_destroy(again);
        points[0] += 1e-4;
        assert_ok(NULL, pia_model_create(NULL, 1, &degree, knots, &c.control, DIM, points, NULL, &again));
        pia_model_get_info(again, &info);
        assert_int_equal(info.periodic[0], 0);
        pia_model_destroy(again);
        pia_model_destroy(model);
        pia_model_destroy(open);
        free_closed(&c);
    }
}

static void unclamping_gives_the_cyclic_form_back(void **state)
{
    (void)state;
    for (int degree = 1; degree <= 8; degree++)
        for (pia_index distinct = 3; distinct <= 15; distinct += 4) {
            closed c = make_closed(degree, distinct, (uint64_t)(degree * 40) + (uint64_t)distinct);
            pia_model *model = clamp(NULL, &c);
            double knots[32], points[23 * DIM], *const all[] = {knots};
            assert_ok(NULL, pia_model_to_cyclic(NULL, model, all, points));
            for (pia_index i = 0; i < c.control + degree + 1; i++) assert_near(knots[i], c.knots[i], 1e-13);
            for (pia_index i = 0; i < c.control * DIM; i++) assert_near(points[i], c.points[i], pow(10, degree / 2 - 13));
            pia_model_destroy(model);
            free_closed(&c);
        }
}

static void a_tube_is_closed_in_one_direction_only(void **state)
{
    (void)state;
    closed c = make_closed(3, 9, 4);
    uint64_t seed = 5;
    double *line = shape_knots(2, 6, &seed), points[6 * 12 * 3], unclamped[6 * 12 * 3], u[9], v[16];
    for (int i = 0; i < 6; i++)
        for (int j = 0; j < 12; j++)
            for (int k = 0; k < 3; k++) points[(i * 12 + j) * 3 + k] = k < 2 ? c.points[j * DIM + k] + i : i;
    const double *const knots[] = {line, c.knots};
    const int degree[] = {2, 3}, which[] = {0, 1};
    const pia_index control[] = {6, 12};
    pia_model *model = NULL;
    assert_ok(NULL, pia_model_from_cyclic(NULL, 2, degree, knots, control, which, 3, points, &model));
    pia_model_info info;
    pia_model_get_info(model, &info);
    assert_int_equal(info.periodic[0], 0);
    assert_int_equal(info.periodic[1], 1);
    double a[6 * 3], b[6 * 3], start[] = {0.4, info.domain[1][0]}, end[] = {0.4, info.domain[1][1]};
    assert_ok(NULL, pia_model_eval(NULL, model, start, 1, 2, a));
    assert_ok(NULL, pia_model_eval(NULL, model, end, 1, 2, b));
    for (int i = 0; i < 18; i++) assert_near(a[i], b[i], 1e-11);
    double *const out[] = {u, v};
    assert_ok(NULL, pia_model_to_cyclic(NULL, model, out, unclamped));
    for (int i = 0; i < 6 * 12 * 3; i++) assert_near(unclamped[i], points[i], 1e-11);
    assert_memory_equal(u, line, sizeof u);
    pia_model_destroy(model);
    free(line), free_closed(&c);
}

static void a_repeated_seam_knot_makes_fewer_control_points_and_no_smooth_join(void **state)
{
    (void)state;
    const double knots[] = {-1.5, 0, 0, 1.5, 3, 3, 4.5, 6}; /* degree 2, domain [0, 3], seam knot twice */
    const double points[] = {0, 1, 5, 0, 1};
    const double *const all[] = {knots};
    const int degree = 2, yes = 1;
    const pia_index control = 5;
    pia_model *model = NULL;
    assert_ok(NULL, pia_model_from_cyclic(NULL, 1, &degree, all, &control, &yes, 1, points, &model));
    pia_model_info info;
    pia_model_get_info(model, &info);
    assert_int_equal(info.control[0], 4);
    assert_int_equal(info.periodic[0], 0);
    double at[] = {0, 3}, ends[2];
    assert_ok(NULL, pia_model_eval(NULL, model, at, 2, 0, ends));
    assert_near(ends[0], ends[1], 1e-15);
    pia_model_destroy(model);
}

static void models_that_cannot_be_unclamped_are_refused(void **state)
{
    (void)state;
    pia_context *context = NULL;
    assert_ok(NULL, pia_context_create(NULL, &context));
    double knots[32], points[64], *const all[] = {knots};
    pia_model *rational = shape_curve(context, 3, 9, 2, 1, 1), *open = shape_curve(context, 3, 9, 2, 0, 1);
    assert_status(context, pia_model_to_cyclic(context, rational, all, points), PIA_E_ARGUMENT);
    assert_ok(context, pia_model_to_cyclic(context, open, all, points));
    open->periodic[0] = 1;
    assert_status(context, pia_model_to_cyclic(context, open, all, points), PIA_E_SHAPE);
    pia_model_destroy(rational);
    pia_model_destroy(open);
    pia_context_destroy(context);
}

static void cyclic_numbers_that_are_not_finite_are_refused(void **state)
{
    (void)state;
    closed c = make_closed(3, 9, 4);
    const double *const knots[] = {c.knots};
    const int yes = 1;
    pia_model *model = NULL;
    c.points[5] = NAN;
    assert_status(NULL, pia_model_from_cyclic(NULL, 1, &c.degree, knots, &c.control, &yes, DIM, c.points, &model), PIA_E_DATA);
    c.points[5] = 0;
    c.knots[5] = c.knots[4];
    c.knots[6] = NAN;
    assert_status(NULL, pia_model_from_cyclic(NULL, 1, &c.degree, knots, &c.control, &yes, DIM, c.points, &model), PIA_E_DATA);
    assert_null(model);
    free_closed(&c);
}

static pia_status clamp_tube(pia_context *context, void *user)
{
    const closed *c = user;
    const double *const knots[] = {c->knots, c->knots};
    const int degree[] = {c->degree, c->degree}, yes[] = {1, 1};
    const pia_index control[] = {c->control, c->control};
    double points[12 * 12] = {0};
    pia_model *model = NULL;
    pia_status status = pia_model_from_cyclic(context, 2, degree, knots, control, yes, 1, points, &model);
    pia_model_destroy(model);
    return status;
}

static void clamping_survives_every_failed_allocation(void **state)
{
    (void)state;
    closed c = make_closed(3, 9, 4);
    assert_survives_failures(clamp_tube, &c);
    free_closed(&c);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_clamped_form_has_the_same_shape),
        cmocka_unit_test(a_closed_model_is_recognised_and_an_open_one_is_not),
        cmocka_unit_test(unclamping_gives_the_cyclic_form_back),
        cmocka_unit_test(a_tube_is_closed_in_one_direction_only),
        cmocka_unit_test(a_repeated_seam_knot_makes_fewer_control_points_and_no_smooth_join),
        cmocka_unit_test(models_that_cannot_be_unclamped_are_refused),
        cmocka_unit_test(cyclic_numbers_that_are_not_finite_are_refused),
        cmocka_unit_test(clamping_survives_every_failed_allocation),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
