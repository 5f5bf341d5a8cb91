#include "knots.h"

#include <math.h>

#include "check.h"
#include "shapes.h"

static const double cubic[] = {0, 0, 0, 0, 1, 2, 2, 3, 5, 5, 5, 5};
enum { CUBIC = 8 };

static void good_knots_pass(void **state)
{
    (void)state;
    assert_ok(NULL, pia_knots_check(NULL, 3, cubic, 12, CUBIC));
    const double line[] = {-1e300, -1e300, 7e299, 7e299};
    assert_ok(NULL, pia_knots_check(NULL, 1, line, 4, 2));
    uint64_t seed = 1;
    for (int degree = 1; degree <= PIA_MAX_DEGREE; degree++) {
        double *knots = shape_knots(degree, 40, &seed);
        assert_ok(NULL, pia_knots_check(NULL, degree, knots, 41 + degree, 40));
        free(knots);
    }
}

static void check_bad(const double *knots, pia_index count, pia_index control, pia_status expected, const char *word)
{
    pia_context *context = NULL;
    assert_ok(NULL, pia_context_create(NULL, &context));
    assert_status(context, pia_knots_check(context, 3, knots, count, control), expected);
    if (strstr(pia_message(context), word) == NULL) fail_msg("\"%s\" lacks \"%s\"", pia_message(context), word);
    pia_context_destroy(context);
}

static void bad_knots_are_named_by_index(void **state)
{
    (void)state;
    double knots[12];
    const struct {
        int index;
        double value;
        const char *word;
    } bad[] = {{4, NAN, "knot 4"}, {0, -INFINITY, "knot 0"}, {7, 1.5, "knot 7"}, {0, -1, "clamped"}, {11, 6, "clamped"}};
    for (int i = 0; i < 5; i++) {
        memcpy(knots, cubic, sizeof knots);
        knots[bad[i].index] = bad[i].value;
        check_bad(knots, 12, CUBIC, PIA_E_DATA, bad[i].word);
    }
    const double all_equal[8] = {0}, tiny[9] = {0, 0, 0, 0, 1e-310, 1, 1, 1, 1},
                 wide[] = {-1e308, -1e308, -1e308, -1e308, 1e308, 1e308, 1e308, 1e308};
    check_bad(all_equal, 8, 4, PIA_E_DATA, "empty");
    check_bad(tiny, 9, 5, PIA_E_DATA, "knots 3 and 4");
    check_bad(wide, 8, 4, PIA_E_DATA, "too far");
}

static void t_peer_12_multiplicity_above_the_degree_is_refused(void **state)
{
    (void)state;
    const double inside[] = {0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2};
    check_bad(inside, 12, 8, PIA_E_DATA, "knot 4");
    const double start[] = {0, 0, 0, 0, 0, 1, 2, 2, 2, 2};
    check_bad(start, 10, 6, PIA_E_DATA, "knot 1");
    const double end[] = {0, 0, 0, 0, 1, 2, 2, 2, 2, 2};
    check_bad(end, 10, 6, PIA_E_DATA, "knot 5");
}

static void t_peer_19_too_few_knots_are_refused(void **state)
{
    (void)state;
    check_bad(cubic, 11, CUBIC, PIA_E_SHAPE, "11 knots");
    check_bad(cubic, 7, 3, PIA_E_SHAPE, "3 control points");
    check_bad(cubic, 0, 0, PIA_E_SHAPE, "0 control points");
    check_bad(cubic, INT64_MIN, INT64_MAX, PIA_E_SHAPE, "knots");
    assert_status(NULL, pia_knots_check(NULL, 0, cubic, 2, 1), PIA_E_ARGUMENT);
    assert_status(NULL, pia_knots_check(NULL, 26, cubic, 54, 27), PIA_E_ARGUMENT);
}

static void a_span_holds_its_left_end_and_the_last_one_both(void **state)
{
    (void)state;
    const struct {
        double t;
        pia_index span;
    } at[] = {{0, 3}, {0.5, 3}, {1, 4}, {1.999, 4}, {2, 6}, {3, 7}, {4.9, 7}, {5, 7}};
    for (int i = 0; i < 8; i++) assert_int_equal(pia_knots_span(cubic, 3, CUBIC, at[i].t), at[i].span);
}

static void t_peer_15_parameters_slightly_outside_belong_to_the_end_spans(void **state)
{
    (void)state;
    assert_int_equal(pia_knots_span(cubic, 3, CUBIC, nextafter(0, -1)), 3);
    assert_int_equal(pia_knots_span(cubic, 3, CUBIC, nextafter(5, 6)), 7);
    assert_int_equal(pia_knots_span(cubic, 3, CUBIC, -INFINITY), 3);
    assert_int_equal(pia_knots_span(cubic, 3, CUBIC, INFINITY), 7);
    assert_int_equal(pia_knots_span(cubic, 3, CUBIC, NAN), 3);
}

static void spans_of_cyclic_knots_skip_empty_ones_at_the_ends(void **state)
{
    (void)state;
    const double cyclic[] = {-2, -1, -1, 0, 0, 1, 2, 4, 4, 5}; /* degree 3, domain [0, 4] with its first span empty */
    assert_int_equal(pia_knots_span(cyclic, 3, 6, 0), 4);
    assert_int_equal(pia_knots_span(cyclic, 3, 6, -1), 4);
    assert_int_equal(pia_knots_span(cyclic, 3, 6, 4), 5);
    const double padded[] = {0, 0, 1, 2, 2, 2};
    assert_int_equal(pia_knots_span(padded, 1, 4, 2), 2);
}

static void galloping_from_any_hint_finds_the_same_span(void **state)
{
    (void)state;
    uint64_t seed = 7;
    for (int degree = 1; degree <= 7; degree += 2) {
        enum { CONTROL = 60 };
        double *knots = shape_knots(degree, CONTROL, &seed);
        for (int trial = 0; trial < 300; trial++) {
            double t = trial < CONTROL ? knots[trial] : shape_random(&seed) * 1.2 - 0.1;
            pia_index linear = CONTROL - 1;
            while (linear > degree && !(knots[linear] <= t && knots[linear] < knots[CONTROL])) linear--;
            while (knots[linear + 1] == knots[linear]) linear++;
            for (pia_index hint = -3; hint < CONTROL + 9; hint++)
                assert_int_equal(pia_knots_span_near(knots, degree, CONTROL, t, hint), linear);
        }
        free(knots);
    }
}

static void multiplicities_are_counted_from_any_index(void **state)
{
    (void)state;
    const int expected[12] = {4, 4, 4, 4, 1, 2, 2, 1, 4, 4, 4, 4};
    for (int i = 0; i < 12; i++) assert_int_equal(pia_knots_multiplicity(cubic, 12, i), expected[i]);
}

static void greville_abscissae_are_means_of_degree_knots(void **state)
{
    (void)state;
    const double expected[CUBIC] = {0, 1.0 / 3, 1, 5.0 / 3, 7.0 / 3, 10.0 / 3, 13.0 / 3, 5};
    for (int i = 0; i < CUBIC; i++) assert_near(pia_knots_greville(cubic, 3, i), expected[i], 1e-15);
    const double tenth[] = {0.1, 0.1, 0.1, 0.1, 0.7, 0.7, 0.7, 0.7};
    assert_true(pia_knots_greville(tenth, 3, 0) == 0.1 && pia_knots_greville(tenth, 3, 3) == 0.7);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(good_knots_pass),
        cmocka_unit_test(bad_knots_are_named_by_index),
        cmocka_unit_test(t_peer_12_multiplicity_above_the_degree_is_refused),
        cmocka_unit_test(t_peer_19_too_few_knots_are_refused),
        cmocka_unit_test(a_span_holds_its_left_end_and_the_last_one_both),
        cmocka_unit_test(t_peer_15_parameters_slightly_outside_belong_to_the_end_spans),
        cmocka_unit_test(spans_of_cyclic_knots_skip_empty_ones_at_the_ends),
        cmocka_unit_test(galloping_from_any_hint_finds_the_same_span),
        cmocka_unit_test(multiplicities_are_counted_from_any_index),
        cmocka_unit_test(greville_abscissae_are_means_of_degree_knots),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
