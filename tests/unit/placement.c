#include "check.h"
#include "place.h"

#include <stdlib.h>

enum { ROOM = 300 };

static pia_status place(const char *name, int degree, int closed, pia_index control, const double *t, pia_index count, double *knots)
{
    const pia_placement *placement = pia_place_find(name);
    assert_non_null(placement);
    pia_place_problem problem = {degree, closed, control, t, count};
    return placement->place(NULL, &problem, knots);
}

/* Increasing, uneven; closed ones leave a gap to 1. */
static void uneven_parameters(double *t, int count, int closed, unsigned seed)
{
    double sum = 0;
    srand(seed);
    for (int i = 0; i < count; i++) {
        t[i] = sum;
        sum += 0.01 + pow(rand() / (double)RAND_MAX, 4);
    }
    double total = closed ? sum : t[count - 1];
    for (int i = 0; i < count; i++) t[i] /= total;
}

/* The NURBS Book, Example 9.1: averaging. */
static void averaging_gives_the_knots_of_the_nurbs_book(void **state)
{
    (void)state;
    const double t[] = {0, 5.0 / 17, 9.0 / 17, 14.0 / 17, 1};
    const double expected[] = {0, 0, 0, 0, 28.0 / 51, 1, 1, 1, 1};
    double knots[9];
    assert_ok(NULL, place("average", 3, 0, 5, t, 5, knots));
    for (int i = 0; i < 9; i++) assert_near(knots[i], expected[i], 1e-16);
}

static void not_a_knot_gives_the_default_knots_of_scipy(void **state)
{
    (void)state;
    const double t[] = {0, 0.1, 0.3, 0.35, 0.6, 0.9, 1};
    const double cubic[] = {0, 0, 0, 0, 0.3, 0.35, 0.6, 1, 1, 1, 1};
    const double quadratic[] = {0, 0, 0, 0.2, 0.325, 0.475, 0.75, 1, 1, 1};
    double knots[11];
    assert_ok(NULL, place("notaknot", 3, 0, 7, t, 7, knots));
    for (int i = 0; i < 11; i++) assert_near(knots[i], cubic[i], 1e-16);
    assert_ok(NULL, place("notaknot", 2, 0, 7, t, 7, knots));
    for (int i = 0; i < 10; i++) assert_near(knots[i], quadratic[i], 1e-16);
}

static void least_squares_spacing_follows_its_formula(void **state)
{
    (void)state;
    double t[101], knots[ROOM];
    uneven_parameters(t, 101, 0, 3);
    for (int degree = 1; degree <= 7; degree++) {
        int control = 20, m = 101;
        assert_ok(NULL, place("lsq", degree, 0, control, t, m, knots));
        double d = m / (double)(control - degree);
        for (int j = 1; j < control - degree; j++) {
            int i = (int)(j * d);
            assert_near(knots[degree + j], (1 - (j * d - i)) * t[i - 1] + (j * d - i) * t[i], 1e-14);
        }
    }
}

static void the_2004_format_keeps_raw_chords(void **state)
{
    (void)state;
    const double t[] = {0, 2, 3, 7};
    const double expected[] = {0, 0, 0, 0, 2, 3, 7, 7, 7, 7};
    double knots[10];
    assert_ok(NULL, place("pia2004", 3, 0, 6, t, 4, knots));
    for (int i = 0; i < 10; i++) assert_true(knots[i] == expected[i]);
    assert_status(NULL, place("pia2004", 3, 0, 4, t, 4, knots), PIA_E_SHAPE);
    assert_status(NULL, place("pia2004", 3, 1, 6, t, 4, knots), PIA_E_ARGUMENT);
    assert_status(NULL, place("pia2004", 2, 0, 6, t, 4, knots), PIA_E_ARGUMENT);
}

static void assert_well_formed(const double *knots, int degree, int closed, pia_index control, double first, double last)
{
    pia_index count = control + degree + 1 + (closed ? degree : 0);
    for (pia_index i = 1; i < count; i++) assert_true(knots[i] >= knots[i - 1]);
    if (closed) {
        for (pia_index i = 0; i + control < count; i++) assert_true(knots[i + control] == knots[i] + 1);
        return;
    }
    for (int k = 0; k <= degree; k++) assert_true(knots[k] == first && knots[control + k] == last);
    assert_true(knots[degree + 1] > first && knots[control - 1] < last);
}

static void every_placement_is_clamped_or_exactly_periodic(void **state)
{
    (void)state;
    double t[64], knots[ROOM];
    const pia_placement *placement;
    for (pia_index r = 0; (placement = pia_place_list(r)) != NULL; r++)
        for (int closed = 0; closed < 2; closed++)
            for (int degree = 1; degree <= PIA_MAX_DEGREE; degree++) {
                pia_index control = strcmp(placement->name, "pia2004") == 0 ? 66 : placement->square ? 64 : 40;
                uneven_parameters(t, 64, closed, (unsigned)degree);
                pia_place_problem problem = {degree, closed, control, t, 64};
                pia_status status = placement->place(NULL, &problem, knots);
                if (strcmp(placement->name, "pia2004") == 0 && (closed || degree != 3)) {
                    assert_int_equal(status, PIA_E_ARGUMENT);
                    continue;
                }
                assert_int_equal(status, PIA_OK);
                assert_well_formed(knots, degree, closed, control, t[0], t[63]);
            }
}

/* Column i lives on knots i .. i + degree + 1; its owner must lie strictly inside, for closed curves up to whole turns. */
static void every_basis_function_of_a_square_placement_holds_its_own_data_point(void **state)
{
    (void)state;
    const char *const names[] = {"average", "notaknot", "lsq"};
    double t[64], knots[ROOM];
    for (int r = 0; r < 3; r++)
        for (int degree = 1; degree <= 9; degree++)
            for (int closed = 0; closed < 2; closed++) {
                uneven_parameters(t, 64, closed, (unsigned)(degree + 10));
                assert_ok(NULL, place(names[r], degree, closed, 64, t, 64, knots));
                for (int i = closed ? 0 : 1; i < (closed ? 64 : 63); i++) {
                    double x = t[closed ? pia_place_owner(degree, 64, i) : i];
                    while (closed && x <= knots[i]) x += 1;
                    while (closed && x >= knots[i] + 1) x -= 1;
                    assert_true(x > knots[i] && x < knots[i + degree + 1]);
                }
            }
}

static void closed_placements_agree_on_uniform_parameters(void **state)
{
    (void)state;
    const char *const names[] = {"average", "notaknot", "lsq", "uniform"};
    double t[12], first[ROOM], knots[ROOM];
    for (int i = 0; i < 12; i++) t[i] = i / 12.0;
    for (int degree = 1; degree <= 8; degree++)
        for (int r = 0; r < 4; r++) {
            assert_ok(NULL, place(names[r], degree, 1, 12, t, 12, r == 0 ? first : knots));
            for (int i = 0; r > 0 && i < 12 + 2 * degree + 1; i++) assert_near(knots[i], first[i], 1e-15);
        }
}

static void t_peer_47_every_span_of_least_squares_spacing_holds_data(void **state)
{
    (void)state;
    double t[90], knots[ROOM];
    uneven_parameters(t, 90, 0, 5);
    for (int i = 20; i < 50; i++) t[i] = t[20];
    for (int degree = 1; degree <= 5; degree++)
        for (int control = degree + 1; control <= 60; control++) {
            assert_ok(NULL, place("lsq", degree, 0, control, t, 90, knots));
            for (int s = degree; s < control; s++) {
                int held = 0;
                for (int i = 0; i < 90; i++) held += t[i] >= knots[s] && t[i] <= knots[s + 1];
                assert_true(held > 0);
            }
        }
    assert_status(NULL, place("lsq", 3, 0, 62, t, 90, knots), PIA_E_SHAPE);
}

static void t_peer_44_equal_parameters_never_make_a_knot_of_too_high_multiplicity(void **state)
{
    (void)state;
    const double t[] = {0, 0, 0, 0, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.8, 1, 1};
    double knots[ROOM];
    assert_status(NULL, place("average", 3, 0, 14, t, 14, knots), PIA_E_SHAPE);
    assert_status(NULL, place("notaknot", 3, 0, 14, t, 14, knots), PIA_E_SHAPE);
    assert_status(NULL, place("pia2004", 3, 0, 16, t, 14, knots), PIA_E_SHAPE);
    assert_ok(NULL, place("lsq", 2, 0, 4, t, 14, knots));
    assert_well_formed(knots, 2, 0, 4, 0, 1);
}

static void impossible_problems_are_named(void **state)
{
    (void)state;
    const double t[] = {0, 0.5, 0.4, 1}, good[] = {0, 0.3, 0.4, 0.9}, equal[] = {0.3, 0.3, 0.3, 0.3}, bad[] = {0, NAN, 0.5, 1};
    double knots[ROOM];
    assert_status(NULL, place("average", 3, 0, 4, t, 4, knots), PIA_E_DATA);
    assert_status(NULL, place("average", 3, 0, 4, bad, 4, knots), PIA_E_DATA);
    assert_status(NULL, place("uniform", 3, 0, 4, equal, 4, knots), PIA_E_DATA);
    assert_status(NULL, place("average", 3, 0, 5, good, 4, knots), PIA_E_SHAPE);
    assert_status(NULL, place("lsq", 3, 0, 5, good, 4, knots), PIA_E_SHAPE);
    assert_status(NULL, place("uniform", 3, 0, 3, good, 4, knots), PIA_E_SHAPE);
    assert_status(NULL, place("uniform", 0, 0, 3, good, 4, knots), PIA_E_ARGUMENT);
    assert_status(NULL, place("uniform", 26, 0, 30, good, 4, knots), PIA_E_ARGUMENT);
    assert_status(NULL, place("uniform", 3, 1, 4, t + 3, 1, knots), PIA_E_SHAPE);
    const double turn[] = {0, 0.3, 0.4, 1};
    assert_status(NULL, place("average", 3, 1, 4, turn, 4, knots), PIA_E_DATA);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(averaging_gives_the_knots_of_the_nurbs_book),
        cmocka_unit_test(not_a_knot_gives_the_default_knots_of_scipy),
        cmocka_unit_test(least_squares_spacing_follows_its_formula),
        cmocka_unit_test(the_2004_format_keeps_raw_chords),
        cmocka_unit_test(every_placement_is_clamped_or_exactly_periodic),
        cmocka_unit_test(every_basis_function_of_a_square_placement_holds_its_own_data_point),
        cmocka_unit_test(closed_placements_agree_on_uniform_parameters),
        cmocka_unit_test(t_peer_47_every_span_of_least_squares_spacing_holds_data),
        cmocka_unit_test(t_peer_44_equal_parameters_never_make_a_knot_of_too_high_multiplicity),
        cmocka_unit_test(impossible_problems_are_named),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
