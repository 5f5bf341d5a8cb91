/* Labels and ticks of pictures. */
#include "check.h"

#include "ticks.h"

#include <float.h>
#include <locale.h>

static void assert_fixed(double value, int decimals, const char *expected)
{
    char text[PIA_LABEL_SIZE];
    pia_label_fixed(value, decimals, text);
    assert_string_equal(text, expected);
}

static void assert_significant(double value, int digits, const char *expected)
{
    char text[PIA_LABEL_SIZE];
    pia_label_significant(value, digits, text);
    assert_string_equal(text, expected);
}

static void fixed_labels_round_and_keep_their_decimals(void **state)
{
    (void)state;
    assert_fixed(0, 0, "0");
    assert_fixed(-0.04, 1, "0.0");
    assert_fixed(2.5, 2, "2.50");
    assert_fixed(-12.345, 1, "\u221212.3");
    assert_fixed(0.05, 2, "0.05");
    assert_fixed(999.96, 1, "1000.0");
}

static void significant_labels_drop_trailing_zeros_and_use_powers_for_extreme_sizes(void **state)
{
    (void)state;
    assert_significant(0, 3, "0");
    assert_significant(0.0123456, 3, "0.0123");
    assert_significant(120000, 3, "120000");
    assert_significant(1234567, 3, "1.23\u00d710\u2076");
    assert_significant(-4.5e-7, 3, "\u22124.5\u00d710\u207b\u2077");
    assert_significant(9.996, 3, "10");
    assert_significant(9.996e5, 3, "1\u00d710\u2076");
    assert_significant(1e-300, 2, "1\u00d710\u207b\u00b3\u2070\u2070");
    assert_significant(DBL_TRUE_MIN, 1, "5\u00d710\u207b\u00b3\u00b2\u2074");
    assert_significant(DBL_MAX, 4, "1.798\u00d710\u00b3\u2070\u2078");
    assert_significant(INFINITY, 3, "not finite");
    assert_significant(NAN, 3, "not finite");
    assert_significant(512345.678, 15, "512345.678");
}

static void labels_do_not_follow_the_locale(void **state)
{
    (void)state;
    if (setlocale(LC_ALL, "de_DE.UTF-8") == NULL && setlocale(LC_ALL, "de_DE") == NULL) skip();
    assert_fixed(2.5, 2, "2.50");
    assert_significant(0.0123, 3, "0.0123");
    setlocale(LC_ALL, "C");
}

static void ticks_are_round_numbers_inside_the_range(void **state)
{
    (void)state;
    pia_ticks ticks;
    char text[PIA_LABEL_SIZE];
    pia_ticks_linear(-0.05, 1.05, 5, &ticks);
    assert_int_equal(ticks.count, 6);
    for (int i = 0; i < 6; i++) assert_near(ticks.value[i], 0.2 * i, 1e-15);
    pia_tick_label(&ticks, 1, text);
    assert_string_equal(text, "0.2");
    pia_tick_label(&ticks, 5, text);
    assert_string_equal(text, "1.0");
}

static void ticks_of_any_range_are_few_increasing_and_inside(void **state)
{
    (void)state;
    static const double center[] = {0, 1, -3.7, 5.1e5, 1e-9, -4e12, 1e140};
    for (size_t c = 0; c < sizeof center / sizeof *center; c++) {
        for (double size = 1e-8; size < 1e9; size *= 3.7) {
            double half = size * (center[c] != 0 ? fabs(center[c]) : 1), low = center[c] - half, high = center[c] + half;
            for (int wanted = 2; wanted <= 12; wanted++) {
                pia_ticks ticks;
                char text[3 * PIA_LABEL_SIZE], before[3 * PIA_LABEL_SIZE] = "";
                pia_ticks_linear(low, high, wanted, &ticks);
                assert_in_range(ticks.count, wanted / 2, 2 * wanted + 1);
                for (int i = 0; i < ticks.count; i++) {
                    assert_true(ticks.value[i] >= low - 1e-6 * half && ticks.value[i] <= high + 1e-6 * half);
                    assert_true(i == 0 || ticks.value[i] > ticks.value[i - 1]);
                    pia_tick_label(&ticks, i, text);
                    assert_true(strlen(text) <= 12);
                    assert_string_not_equal(text, before);
                    strcpy(before, text);
                }
                pia_tick_title(&ticks, "x", text);
                assert_true(text[0] == 'x');
            }
        }
    }
}

static void large_shared_parts_move_from_the_labels_to_the_title(void **state)
{
    (void)state;
    pia_ticks ticks;
    char text[3 * PIA_LABEL_SIZE];
    pia_ticks_linear(5123456.2, 5123457.9, 4, &ticks);
    pia_tick_title(&ticks, "y", text);
    assert_string_equal(text, "y \u2212 5123460");
    pia_tick_label(&ticks, 0, text);
    assert_string_equal(text, "\u22123.5");
    pia_ticks_linear(2e-7, 9e-7, 4, &ticks);
    pia_tick_title(&ticks, "t", text);
    assert_string_equal(text, "t (\u00d710\u207b\u2079)");
    pia_tick_label(&ticks, 0, text);
    assert_string_equal(text, "200");
    pia_ticks_linear(512200, 512450, 5, &ticks);
    pia_tick_title(&ticks, "x", text);
    assert_string_equal(text, "x");
}

static void decades_are_whole_powers_of_ten(void **state)
{
    (void)state;
    pia_ticks ticks;
    char text[PIA_LABEL_SIZE];
    pia_ticks_decades(-6.4, 0.3, 10, &ticks);
    assert_int_equal(ticks.count, 7);
    pia_tick_label(&ticks, 0, text);
    assert_string_equal(text, "10\u207b\u2076");
    pia_ticks_decades(-300, 2, 5, &ticks);
    assert_in_range(ticks.count, 3, 6);
    pia_ticks_decades(0.2, 0.9, 5, &ticks);
    assert_int_equal(ticks.count, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(fixed_labels_round_and_keep_their_decimals),
        cmocka_unit_test(significant_labels_drop_trailing_zeros_and_use_powers_for_extreme_sizes),
        cmocka_unit_test(labels_do_not_follow_the_locale),
        cmocka_unit_test(ticks_are_round_numbers_inside_the_range),
        cmocka_unit_test(ticks_of_any_range_are_few_increasing_and_inside),
        cmocka_unit_test(large_shared_parts_move_from_the_labels_to_the_title),
        cmocka_unit_test(decades_are_whole_powers_of_ten),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
