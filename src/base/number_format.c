/* Writing: a double times a power of ten has 17 digits before the point, which one product of 64 x 128 bits gives, and what is behind
 * the point closely enough to round to 15, 16 or 17 of them; where it is too close to call, the C library decides. */
#include "number.h"
#include "number_parts.h"
#include "powers_of_five.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

enum { MOST = 17, DOUBT = 16 /* units of 2^-64 of the last digit, many times the error of the product */ };

/* digits * 10^power, and the rest as a fraction of 2^64. */
typedef struct scaled {
    uint64_t digits, rest;
    int power;
} scaled;

static const uint64_t TEN_TO_17 = 100000000000000000u;

/* Bits of a positive normal double: mantissa * 2^exponent, the mantissa's top bit set. */
static uint64_t take_apart(double value, int *exponent)
{
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    *exponent = (int)(bits >> 52) - 1023 - 63;
    return bits << 11 | (uint64_t)1 << 63;
}

/* mantissa * 2^exponent = (digits + rest / 2^64) * 10^power. Returns 0 where the table ends. */
static int scale(uint64_t mantissa, int exponent, int power, scaled *out)
{
    int five = -power - PIA_FIRST_POWER;
    if (five < 0 || -power > PIA_LAST_POWER) return 0;
    uint64_t product[2], low[2];
    pia_number_multiply(mantissa, pia_power_of_five[five][0], product);
    pia_number_multiply(mantissa, pia_power_of_five[five][1], low);
    product[1] += low[0];
    product[0] += product[1] < low[0];
    int shift = -exponent - (int)((217706 * (int64_t)-power) >> 16) - 1; /* bits of product[0] behind the point */
    *out = (scaled){product[0] >> shift, product[0] << (64 - shift) | product[1] >> shift, power};
    return 1;
}

/* To 17 digits. Returns 0 where they cannot be had. */
static int scale_to_digits(double value, scaled *out)
{
    int exponent;
    uint64_t mantissa = take_apart(value, &exponent);
    int order = ((exponent + 63) * 78913) >> 18; /* of the first digit, or one less */
    if (!scale(mantissa, exponent, order + 1 - MOST, out)) return 0;
    return out->digits < TEN_TO_17 || scale(mantissa, exponent, order + 2 - MOST, out);
}

/* The first digits, `dropped` fewer, rounded to nearest. Returns 0 in doubt. */
static int round_off(const scaled *s, int dropped, uint64_t *digits)
{
    static const uint64_t unit[] = {1, 10, 100};
    uint64_t half = unit[dropped] / 2, left = s->digits % unit[dropped];
    *digits = s->digits / unit[dropped];
    if (dropped == 0) {
        const uint64_t middle = (uint64_t)1 << 63;
        *digits += s->rest >= middle;
        return s->rest < middle - DOUBT || s->rest > middle + DOUBT;
    }
    *digits += left >= half;
    return !(left == half && s->rest < DOUBT) && !(left == half - 1 && s->rest > UINT64_MAX - DOUBT);
}

/* The last `count` digits of a number. */
static void spell(uint64_t digits, int count, char *text)
{
    for (int k = count - 1; k >= 0; k--, digits /= 10) text[k] = (char)('0' + digits % 10);
}

static int write_exponent(int order, char *text)
{
    int size = order < 0 ? -order : order, count = size < 100 ? 2 : 3;
    text[0] = 'e';
    text[1] = order < 0 ? '-' : '+';
    spell((uint64_t)size, count, text + 2);
    return count + 2;
}

/* As %.*g writes `count` digits of which the first one counts 10^order. Returns the length. */
static int lay_out(const char *digit, int count, int order, char *text)
{
    int used = count, length = 0, fixed = order >= -4 && order < count, before = fixed ? order + 1 : 1;
    while (used > 1 && digit[used - 1] == '0') used--;
    if (before <= 0) {
        memcpy(text, "0.000", 5); /* NOLINT(bugprone-not-null-terminated-result): the end comes later */
        length = 2 - before;
    }
    for (int k = 0; k < used || k < before; k++) {
        if (k == before && k > 0) text[length++] = '.';
        text[length++] = k < used ? digit[k] : '0';
    }
    return fixed ? length : length + write_exponent(order, text + length);
}

/* The shortest of 15 to 17 digits that read back. Returns 0 where that cannot be told. */
static int format_quickly(double value, char *text)
{
    scaled s;
    if (!scale_to_digits(value, &s)) return 0;
    for (int dropped = 2; dropped >= 0; dropped--) {
        char digit[MOST + 1];
        uint64_t digits;
        int count = MOST - dropped;
        if (!round_off(&s, dropped, &digits)) return 0;
        if (dropped > 0 && pia_number_nearest(digits, s.power + dropped) != value) continue;
        spell(digits, count + 1, digit);
        int carried = digit[0] != '0'; /* 9.99.. became 10.0.. */
        return lay_out(digit + !carried, count, s.power + MOST - 1 + carried, text);
    }
    return 0;
}

/* Replaces the decimal point of the locale, whatever bytes it has, by '.'; returns the new length. */
static int remove_locale(char *text)
{
    char *to = text;
    for (const char *from = text; *from != '\0'; from++) {
        int plain = (*from >= '0' && *from <= '9') || *from == '-' || *from == '+' || *from == 'e';
        if (plain)
            *to++ = *from;
        else if (to == text || to[-1] != '.')
            *to++ = '.';
    }
    *to = '\0';
    return (int)(to - text);
}

static int format_slowly(double value, char *text)
{
    int length = 0;
    for (int digits = 15; digits <= MOST; digits++) {
        snprintf(text, PIA_NUMBER_SIZE, "%.*g", digits, value);
        length = remove_locale(text);
        double back;
        if (pia_number_parse(text, text + length, &back) != NULL && back == value) break;
    }
    return length;
}

static int format_whole(uint64_t value, char *text)
{
    int count = 1;
    for (uint64_t rest = value / 10; rest > 0; rest /= 10) count++;
    spell(value, count, text);
    return count;
}

int pia_number_format(double value, char text[PIA_NUMBER_SIZE])
{
    double size = fabs(value);
    int length = 0;
    if (!isfinite(value)) return snprintf(text, PIA_NUMBER_SIZE, "%s", isnan(value) ? "nan" : value > 0 ? "inf" : "-inf");
    if (signbit(value)) text[length++] = '-';
    int whole = size < 1e15 && size == (double)(int64_t)size;
    int more = whole ? format_whole((uint64_t)size, text + length) : size >= DBL_MIN ? format_quickly(size, text + length) : 0;
    if (more == 0) more = format_slowly(size, text + length);
    text[length + more] = '\0';
    return length + more;
}
