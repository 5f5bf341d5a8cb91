#include "check.h"

#include "number.h"

#include <float.h>
#include <inttypes.h>
#include <locale.h>
#include <stdlib.h>

static uint64_t bits_of(double value)
{
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    return bits;
}

static double double_of(uint64_t bits)
{
    double value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

static uint64_t next_random(uint64_t *state)
{
    *state ^= *state << 13;
    *state ^= *state >> 7;
    *state ^= *state << 17;
    return *state;
}

/* The same bits and the same end as the C library's strtod, which glibc rounds correctly. */
static void check_against_strtod(const char *text)
{
    char *expected_end;
    double expected = strtod(text, &expected_end), actual = -1;
    const char *end = pia_number_parse(text, text + strlen(text), &actual);
    if (end == expected_end && bits_of(actual) == bits_of(expected)) return;
    print_error("\"%.60s\" gave %.17g (%ld characters), expected %.17g (%ld)\n", text, actual, (long)(end ? end - text : -1), expected,
                (long)(expected_end - text));
    fail();
}

/* The exact middle of a positive double and the next one up; glibc prints all digits of a long double, which can hold it. */
static int print_middle(char *text, size_t size, uint64_t bits)
{
    long double middle = ((long double)double_of(bits) + (long double)double_of(bits + 1)) / 2;
    return snprintf(text, size, "%.800Lg", middle);
}

static void reads_random_doubles_as_strtod_does(void **state)
{
    (void)state;
    uint64_t random = 88172645463325252u;
    char text[64];
    for (int i = 0; i < 300000; i++) {
        double value = double_of(next_random(&random));
        if (!isfinite(value)) continue;
        snprintf(text, sizeof text, "%.*e", 1 + i % 20, value);
        check_against_strtod(text);
    }
}

static void reads_random_digits_as_strtod_does(void **state)
{
    (void)state;
    uint64_t random = 42;
    char text[64];
    for (int i = 0; i < 300000; i++) {
        uint64_t digits = next_random(&random) >> (next_random(&random) % 60);
        int exponent = (int)(next_random(&random) % 700) - 350;
        snprintf(text, sizeof text, "%" PRIu64 "e%d", digits, exponent);
        check_against_strtod(text);
        snprintf(text, sizeof text, "-%" PRIu64 ".%06d", digits >> 40, (int)(digits % 1000000));
        check_against_strtod(text);
    }
}

static void reads_middles_of_doubles_as_strtod_does(void **state)
{
    (void)state;
    uint64_t random = 7;
    static char text[2048];
    for (int i = 0; i < 4000; i++) {
        uint64_t bits = next_random(&random) >> 1;
        if (i % 4 == 0) bits >>= 11; /* denormal or just above */
        if (i % 4 == 1) bits = bits_of(ldexp((double)(next_random(&random) >> 11), (int)(i % 60) - 30));
        if (bits + 1 >= bits_of(INFINITY)) continue;
        int length = print_middle(text, sizeof text, bits);
        check_against_strtod(text);
        char *exponent = strchr(text, 'e');
        if (exponent == NULL) {
            snprintf(text + length, sizeof text - (size_t)length, strchr(text, '.') ? "00000000000000000001" : ".0000000001");
            check_against_strtod(text);
            continue;
        }
        exponent[-1]--; /* a digit too small by one; '0' becomes '/', which ends the number for both */
        check_against_strtod(text);
    }
}

/* A middle followed by zeros and a last 1 rounds up, by however little it lies above. */
static void reads_middles_with_more_behind_as_strtod_does(void **state)
{
    (void)state;
    uint64_t random = 11;
    static char middle[2048], text[4096];
    for (int i = 0; i < 500; i++) {
        uint64_t bits = next_random(&random) >> 1;
        if (i % 2 == 0) bits >>= 11;
        if (bits + 1 >= bits_of(INFINITY)) continue;
        print_middle(middle, sizeof middle, bits);
        char *exponent = strchr(middle, 'e');
        if (exponent == NULL || strchr(middle, '.') == NULL) continue;
        int digits = (int)(exponent - middle);
        for (int zeros = 0; zeros < 1200; zeros += 171) {
            snprintf(text, sizeof text, "%.*s%0*d%s", digits, middle, zeros + 1, 1, exponent);
            check_against_strtod(text);
            snprintf(text, sizeof text, "%.*s%0*d%s", digits, middle, zeros + 1, 0, exponent);
            check_against_strtod(text);
        }
    }
}

static void reads_hard_cases_as_strtod_does(void **state)
{
    (void)state;
    static const char *const text[] = {
        "0",
        "-0",
        "+0",
        "0.0",
        ".5",
        "5.",
        "-.5e1",
        "1e",
        "1e+",
        "1e-",
        "1.e3",
        "00012",
        "0000.0001",
        "1e5x",
        "12abc",
        "1e0000000001",
        "2.2250738585072011e-308",
        "2.2250738585072012e-308",
        "2.2250738585072014e-308",
        "4.9406564584124654e-324",
        "2.4703282292062327e-324",
        "2.4703282292062328e-324",
        "2.47032822920623272088284396434110686182e-324",
        "1e-400",
        "1e400",
        "1.7976931348623157e308",
        "1.7976931348623158e308",
        "1.7976931348623159e308",
        "179769313486231580793728971405301e276",
        "1e-99999999999999999999",
        "1e99999999999999999999",
        "0e99999999999999999999",
        "9007199254740993",
        "9007199254740992",
        "9007199254740991",
        "9007199254740993.0000000000000000000000000000000000000000000000001",
        "9223372036854775807",
        "18446744073709551615",
        "18446744073709551616",
        "18446744073709551615e5",
        "99999999999999999999999999999999999999",
        "6.631236846766476e-316",
        "3.237883913302901e-319",
        "1.448997445238699",
        "8.5e22",
        "1e23",
        "9.5e-7",
        "7.0420557077594588669468784357561207962098443483187940792729600000e+59",
        "3.518437208883201171875e13",
        "62.5364939768271845828",
        "8.10109172351e-10",
        "1.50000000000000011102230246251565",
        "0.000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000000001",
        "104110013277974872254e-225",
        "12345678.12345678",
        "1234567812345678",
        "123456789012345678901234567890e-10"};
    for (size_t i = 0; i < sizeof text / sizeof *text; i++) check_against_strtod(text[i]);
}

static void reads_very_long_numbers_as_strtod_does(void **state)
{
    (void)state;
    static char text[20002];
    for (int count = 10; count < 20000; count *= 3) {
        memset(text, '0', sizeof text);
        text[1] = '.';
        text[count] = '1';
        text[count + 1] = '\0';
        check_against_strtod(text);
        text[0] = '1';
        check_against_strtod(text);
        memset(text, '9', (size_t)count);
        check_against_strtod(text);
    }
}

static void reads_what_is_not_finite(void **state)
{
    (void)state;
    static const char *const text[] = {"nan", "NaN", "inf", "-INF", "Infinity", "+infinity", "infinit"};
    static const int length[] = {3, 3, 3, 4, 8, 9, 3};
    for (size_t i = 0; i < sizeof text / sizeof *text; i++) {
        double value = 0;
        assert_ptr_equal(pia_number_parse(text[i], text[i] + strlen(text[i]), &value), text[i] + length[i]);
        assert_false(isfinite(value));
    }
    static const char *const wrong[] = {"", "-", "+", ".", "e5", "-.e1", "x", "in", "--1", " 1"};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        double value = 0;
        assert_null(pia_number_parse(wrong[i], wrong[i] + strlen(wrong[i]), &value));
    }
}

static void stops_at_the_end_it_was_given(void **state)
{
    (void)state;
    const char text[] = "123456789.123456789e12";
    for (size_t length = 1; length < sizeof text; length++) {
        char *copy = malloc(length), piece[sizeof text];
        assert_non_null(copy);
        memcpy(copy, text, length); /* the sanitizer sees any byte read past the end */
        memcpy(piece, text, length);
        piece[length] = '\0';
        double value = 0;
        assert_non_null(pia_number_parse(copy, copy + length, &value));
        assert_true(value == strtod(piece, NULL));
        free(copy);
    }
}

static void writes_numbers_that_read_back_as_the_same_bits(void **state)
{
    (void)state;
    uint64_t random = 99;
    char text[PIA_NUMBER_SIZE];
    for (int i = 0; i < 200000; i++) {
        double value = double_of(next_random(&random));
        if (i % 3 == 0) value = (double)(int64_t)next_random(&random) / 1e6;
        if (!isfinite(value)) continue;
        int length = pia_number_format(value, text);
        assert_int_equal(length, (int)strlen(text));
        assert_true(bits_of(strtod(text, NULL)) == bits_of(value));
    }
}

static void writes_short_numbers_shortly(void **state)
{
    (void)state;
    static const struct {
        double value;
        const char *text;
    } sample[] = {{0, "0"},
                  {-0.0, "-0"},
                  {0.1, "0.1"},
                  {-2.5, "-2.5"},
                  {1e15, "1e+15"},
                  {123456, "123456"},
                  {-7, "-7"},
                  {1e-9, "1e-09"},
                  {1.0 / 3, "0.3333333333333333"},
                  {NAN, "nan"},
                  {-INFINITY, "-inf"},
                  {INFINITY, "inf"},
                  {999999999999999, "999999999999999"},
                  {DBL_MAX, "1.7976931348623157e+308"}};
    for (size_t i = 0; i < sizeof sample / sizeof *sample; i++) {
        char text[PIA_NUMBER_SIZE];
        pia_number_format(sample[i].value, text);
        assert_string_equal(text, sample[i].text);
    }
}

/* The C library's, which rounds exactly. */
static void check_format(double value)
{
    char text[PIA_NUMBER_SIZE], expected[64];
    int digits = 14, length = pia_number_format(value, text);
    do snprintf(expected, sizeof expected, "%.*g", ++digits, value);
    while (strtod(expected, NULL) != value);
    if (strcmp(text, expected) != 0) print_error("%a gave %s, expected %s\n", value, text, expected);
    assert_string_equal(text, expected);
    assert_int_equal(length, strlen(expected));
}

static void writes_as_the_c_library_does(void **state)
{
    (void)state;
    uint64_t random = 88172645463325252u;
    for (int i = 0; i < 300000; i++) {
        uint64_t bits = next_random(&random);
        double value = i % 4 == 0   ? double_of(bits)                                                  /* anything */
                       : i % 4 == 1 ? (double)(int64_t)bits * 0x1p-63                                  /* long */
                       : i % 4 == 2 ? (double)(bits % 100000) / 1024 * pow(10, (int)(bits >> 40) % 20) /* ties */
                                    : (double)(int64_t)(bits >> 24) / 1e6;                             /* short */
        if (isfinite(value) && (fabs(value) >= 1e15 || value != floor(value))) check_format(value);
    }
    for (int power = -323; power <= 308; power++) { /* ends of the decades, where a digit is carried */
        char text[16];
        snprintf(text, sizeof text, "1e%d", power);
        double value = strtod(text, NULL);
        if (value >= 1 && value < 1e15) continue;
        check_format(value);
        check_format(-nextafter(value, 0) * (power > -323));
        check_format(nextafter(value, 1));
    }
    check_format(DBL_MIN);
    check_format(DBL_MAX);
    check_format(DBL_TRUE_MIN);
}

static void no_locale_changes_reading_or_writing(void **state)
{
    (void)state;
    static const char *const locale[] = {"de_DE.UTF-8", "de_DE.utf8", "fr_FR.UTF-8", "ps_AF", "tr_TR.UTF-8", "C.UTF-8"};
    for (size_t i = 0; i < sizeof locale / sizeof *locale; i++) {
        if (setlocale(LC_ALL, locale[i]) == NULL) continue;
        char text[PIA_NUMBER_SIZE];
        double value = 0;
        pia_number_format(-1234.5678, text);
        assert_string_equal(text, "-1234.5678");
        assert_ptr_equal(pia_number_parse(text, text + strlen(text), &value), text + strlen(text));
        assert_true(value == -1234.5678);
        const char *infinity = "INFINITY";
        assert_non_null(pia_number_parse(infinity, infinity + strlen(infinity), &value));
    }
    setlocale(LC_ALL, "C");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(reads_random_doubles_as_strtod_does),
        cmocka_unit_test(reads_random_digits_as_strtod_does),
        cmocka_unit_test(reads_middles_of_doubles_as_strtod_does),
        cmocka_unit_test(reads_middles_with_more_behind_as_strtod_does),
        cmocka_unit_test(reads_hard_cases_as_strtod_does),
        cmocka_unit_test(reads_very_long_numbers_as_strtod_does),
        cmocka_unit_test(reads_what_is_not_finite),
        cmocka_unit_test(stops_at_the_end_it_was_given),
        cmocka_unit_test(writes_numbers_that_read_back_as_the_same_bits),
        cmocka_unit_test(writes_short_numbers_shortly),
        cmocka_unit_test(writes_as_the_c_library_does),
        cmocka_unit_test(no_locale_changes_reading_or_writing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
