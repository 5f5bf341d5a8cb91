/* What pictures leave out, fill in and colour. */
#include "check.h"

#include "colour.h"
#include "fill.h"
#include "frame.h"
#include "thin.h"

#include <stdlib.h>

static uint64_t next(uint64_t *seed)
{
    *seed = *seed * 6364136223846793005u + 1442695040888963407u;
    return *seed >> 33;
}

static void short_lines_are_left_alone(void **state)
{
    (void)state;
    pia_spot spots[] = {{0, 0}, {10, 5}, {20, -5}, {30, 0}};
    assert_int_equal(pia_thin_line(spots, 4, 0.25), 4);
    assert_near(spots[2].y, -5, 0);
    assert_int_equal(pia_thin_line(spots, 1, 0.25), 1);
    assert_int_equal(pia_thin_line(spots, 0, 0.25), 0);
}

static void a_thinned_signal_keeps_the_extremes_of_every_column(void **state)
{
    (void)state;
    enum { COUNT = 100000, COLUMNS = 200 };
    pia_spot *spots = malloc(COUNT * sizeof *spots);
    double low[COLUMNS], high[COLUMNS];
    uint64_t seed = 7;
    for (int c = 0; c < COLUMNS; c++) {
        low[c] = 1e9;
        high[c] = -1e9;
    }
    for (int i = 0; i < COUNT; i++) {
        spots[i] = (pia_spot){(double)i * COLUMNS / COUNT, (double)(next(&seed) % 1000)};
        int c = (int)spots[i].x;
        low[c] = fmin(low[c], spots[i].y);
        high[c] = fmax(high[c], spots[i].y);
    }
    pia_index kept = pia_thin_line(spots, COUNT, 1);
    assert_in_range(kept, 2 * COLUMNS, 4 * COLUMNS);
    for (pia_index i = 0; i < kept; i++) {
        int c = (int)spots[i].x;
        if (spots[i].y == low[c]) low[c] = NAN;
        if (spots[i].y == high[c]) high[c] = NAN;
        assert_true(i == 0 || spots[i].x >= spots[i - 1].x);
    }
    for (int c = 0; c < COLUMNS; c++) assert_true(isnan(low[c]) && isnan(high[c]));
    free(spots);
}

static void of_dots_in_one_cell_the_worst_stays(void **state)
{
    (void)state;
    const pia_box box = {0, 0, 10, 10};
    const pia_spot spots[] = {{1.1, 1.1}, {1.2, 1.3}, {5, 5}, {99, 5}, {1.4, 1.4}, {-1, 2}};
    const double value[] = {1, 3, 2, 50, 2, 60};
    pia_index order[6], kept;
    assert_ok(NULL, pia_thin_dots(NULL, spots, value, 6, &box, 1, order, &kept));
    assert_int_equal(kept, 2);
    assert_int_equal(order[0], 2);
    assert_int_equal(order[1], 1);
    assert_ok(NULL, pia_thin_dots(NULL, spots, NULL, 6, &box, 1, order, &kept));
    assert_int_equal(kept, 2);
    assert_int_equal(order[0], 0);
    assert_int_equal(order[1], 2);
}

static void dots_far_outside_and_not_finite_are_dropped(void **state)
{
    (void)state;
    const pia_box box = {0, 0, 10, 10};
    const pia_spot spots[] = {{1e300, 1}, {NAN, 2}, {3, -1e300}};
    pia_index order[3], kept;
    assert_ok(NULL, pia_thin_dots(NULL, spots, NULL, 3, &box, 1, order, &kept));
    assert_int_equal(kept, 0);
}

static void gaps_between_equal_values_get_that_value(void **state)
{
    (void)state;
    for (pia_index rows = 1; rows <= 9; rows++) {
        for (pia_index columns = 1; columns <= 9; columns++) {
            double value[81] = {0};
            unsigned char known[81] = {0};
            uint64_t seed = (uint64_t)(10 * rows + columns);
            for (int k = 0; k < 3; k++) {
                pia_index i = (pia_index)(next(&seed) % (uint64_t)(rows * columns));
                value[i] = 4.25;
                known[i] = 1;
            }
            assert_ok(NULL, pia_fill_gaps(NULL, value, known, rows, columns));
            for (pia_index i = 0; i < rows * columns; i++) {
                assert_near(value[i], 4.25, 1e-14);
                assert_int_equal(known[i], 1);
            }
        }
    }
}

static void filled_values_stay_between_the_known_ones_which_stay_as_they_are(void **state)
{
    (void)state;
    enum { ROWS = 37, COLUMNS = 52 };
    double value[ROWS * COLUMNS] = {0}, given[ROWS * COLUMNS];
    unsigned char known[ROWS * COLUMNS] = {0}, was_known[ROWS * COLUMNS];
    uint64_t seed = 3;
    for (int k = 0; k < 40; k++) {
        size_t i = next(&seed) % (ROWS * COLUMNS);
        value[i] = 1 + (double)(next(&seed) % 100);
        known[i] = 1;
    }
    memcpy(given, value, sizeof value);
    memcpy(was_known, known, sizeof known);
    assert_ok(NULL, pia_fill_gaps(NULL, value, known, ROWS, COLUMNS));
    for (int i = 0; i < ROWS * COLUMNS; i++) {
        assert_true(value[i] >= 1 && value[i] <= 100);
        if (was_known[i]) assert_near(value[i], given[i], 0);
    }
}

static void nothing_known_fills_with_zero(void **state)
{
    (void)state;
    double value[12] = {9, 9, 9, 9, 9, 9, 9, 9, 9, 9, 9, 9};
    unsigned char known[12] = {0};
    assert_ok(NULL, pia_fill_gaps(NULL, value, known, 3, 4));
    for (int i = 0; i < 12; i++) assert_near(value[i], 0, 0);
}

/* Relative luminance of sRGB (WCAG 2). */
static double luminance(pia_colour c)
{
    const double channel[3] = {c.red, c.green, c.blue}, share[3] = {0.2126, 0.7152, 0.0722};
    double sum = 0;
    for (int k = 0; k < 3; k++) {
        assert_true(channel[k] >= 0 && channel[k] <= 1);
        sum += share[k] * (channel[k] <= 0.04045 ? channel[k] / 12.92 : pow((channel[k] + 0.055) / 1.055, 2.4));
    }
    return sum;
}

static void ramps_change_steadily_in_lightness(void **state)
{
    (void)state;
    for (int i = 1; i <= 256; i++) {
        double before = (i - 1) / 256.0, t = i / 256.0;
        assert_true(luminance(pia_ramp_colour(PIA_RAMP_ERROR, t)) < luminance(pia_ramp_colour(PIA_RAMP_ERROR, before)));
        assert_true(luminance(pia_ramp_colour(PIA_RAMP_HEIGHT, t)) > luminance(pia_ramp_colour(PIA_RAMP_HEIGHT, before)));
    }
    assert_true(luminance(pia_ramp_colour(PIA_RAMP_ERROR, 0)) > 8 * luminance(pia_ramp_colour(PIA_RAMP_ERROR, 1)));
}

static void ramps_take_any_number(void **state)
{
    (void)state;
    assert_near(pia_ramp_colour(PIA_RAMP_ERROR, -5).red, pia_ramp_colour(PIA_RAMP_ERROR, 0).red, 0);
    assert_near(pia_ramp_colour(PIA_RAMP_ERROR, INFINITY).red, pia_ramp_colour(PIA_RAMP_ERROR, 1).red, 0);
    assert_near(pia_ramp_colour(PIA_RAMP_ERROR, NAN).red, 0.7, 0);
}

static void ranges_without_size_can_still_be_drawn(void **state)
{
    (void)state;
    static const double value[] = {0, 1, -7e5, 1e-200, 1e140};
    for (size_t i = 0; i < sizeof value / sizeof *value; i++) {
        double low = value[i], high = value[i];
        pia_range_widen(&low, &high, 0, 0.05);
        assert_true(low < value[i] && high > value[i]);
    }
    double low = 1e6, high = 1e6 + 1e-12;
    pia_range_widen(&low, &high, 1e-12, 0.05);
    assert_true(high - low > 1e-5);
}

static void an_equalised_frame_draws_a_circle_round(void **state)
{
    (void)state;
    pia_frame frame = {.page = {20, 10, 420, 110}, .low = {-1, -1}, .high = {1, 1}};
    pia_frame_equalise(&frame);
    pia_spot centre = pia_frame_spot(&frame, 0, 0), east = pia_frame_spot(&frame, 1, 0), north = pia_frame_spot(&frame, 0, 1);
    assert_near(centre.x, 220, 1e-12);
    assert_near(centre.y, 60, 1e-12);
    assert_near(east.x - centre.x, centre.y - north.y, 1e-12);
    assert_near(north.y, 10, 1e-12);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(short_lines_are_left_alone),
        cmocka_unit_test(a_thinned_signal_keeps_the_extremes_of_every_column),
        cmocka_unit_test(of_dots_in_one_cell_the_worst_stays),
        cmocka_unit_test(dots_far_outside_and_not_finite_are_dropped),
        cmocka_unit_test(gaps_between_equal_values_get_that_value),
        cmocka_unit_test(filled_values_stay_between_the_known_ones_which_stay_as_they_are),
        cmocka_unit_test(nothing_known_fills_with_zero),
        cmocka_unit_test(ramps_change_steadily_in_lightness),
        cmocka_unit_test(ramps_take_any_number),
        cmocka_unit_test(ranges_without_size_can_still_be_drawn),
        cmocka_unit_test(an_equalised_frame_draws_a_circle_round),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
