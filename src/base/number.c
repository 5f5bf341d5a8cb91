#include "number.h"

#include "number_exact.h"
#include "number_parts.h"
#include "powers_of_five.h"

#include <math.h>
#include <stdint.h>
#include <string.h>

/* Reading: mantissa and exponent are exact doubles in the common case (W. Clinger, "How to read floating point numbers accurately",
 * 1990); else a 64 x 128 bit product decides (D. Lemire, "Number parsing at a gigabyte per second", 2021); else whole numbers do. */

enum { MANTISSA_DIGITS = 19 }; /* always fit in 64 bits */

typedef struct decimal {
    const char *digits, *end; /* as written, with at most one '.' */
    int64_t exponent;         /* of the digits as a whole number */
    uint64_t mantissa;        /* the first 19 significant digits */
    int64_t mantissa_exponent;
    int truncated; /* digits that are not in the mantissa exist */
} decimal;

static int is_digit(char c)
{
    return (unsigned char)(c - '0') < 10;
}

/* Eight characters, the first in the lowest byte. */
static uint64_t load_eight(const char *p)
{
    uint64_t word;
    memcpy(&word, p, sizeof word);
    return __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__ ? word : __builtin_bswap64(word);
}

static int are_eight_digits(uint64_t word)
{
    return (((word + 0x4646464646464646u) | (word - 0x3030303030303030u)) & 0x8080808080808080u) == 0;
}

static uint64_t value_of_eight_digits(uint64_t word)
{
    word -= 0x3030303030303030u;
    word = word * 10 + (word >> 8); /* pairs */
    const uint64_t mask = 0x000000ff000000ffu, high = 0x000f424000000064u, low = 0x0000271000000001u;
    return (uint32_t)(((word & mask) * high + ((word >> 16) & mask) * low) >> 32);
}

/* Appends the digits at p to *mantissa, which wraps when there are more than 19; returns the first character after them. */
static const char *scan_digits(const char *p, const char *end, uint64_t *mantissa)
{
    uint64_t value = *mantissa;
    while (end - p >= 8 && are_eight_digits(load_eight(p))) {
        value = value * 100000000 + value_of_eight_digits(load_eight(p));
        p += 8;
    }
    for (; p < end && is_digit(*p); p++) value = value * 10 + (uint64_t)(*p - '0');
    *mantissa = value;
    return p;
}

/* "e+12" at p; returns p itself when there is no complete exponent. */
static const char *scan_exponent(const char *p, const char *end, int64_t *exponent)
{
    if (p >= end || (*p != 'e' && *p != 'E')) return p;
    const char *q = p + 1;
    int negative = q < end && *q == '-';
    if (q < end && (*q == '-' || *q == '+')) q++;
    if (q >= end || !is_digit(*q)) return p;
    int64_t value = 0;
    for (; q < end && is_digit(*q); q++)
        if (value < INT32_MAX) value = value * 10 + (*q - '0'); /* beyond: zero or infinity, whatever the digits */
    *exponent += negative ? -value : value;
    return q;
}

/* The first 19 significant digits of a longer number. */
static void shorten(decimal *number)
{
    int kept = 0;
    int64_t dropped = 0;
    number->mantissa = 0;
    for (const char *p = number->digits; p < number->end; p++) {
        if (*p == '.') continue;
        if (kept == MANTISSA_DIGITS) {
            dropped++;
            continue;
        }
        number->mantissa = number->mantissa * 10 + (uint64_t)(*p - '0');
        kept += number->mantissa != 0;
    }
    number->truncated = dropped > 0;
    number->mantissa_exponent = number->exponent + dropped;
}

/* Returns the first character after the number, NULL when there is no digit. */
static const char *scan_decimal(const char *p, const char *end, decimal *number)
{
    *number = (decimal){.digits = p};
    const char *point = scan_digits(p, end, &number->mantissa);
    int64_t digit_count = point - p;
    p = point;
    if (p < end && *p == '.') {
        p = scan_digits(p + 1, end, &number->mantissa);
        number->exponent = -(p - point - 1);
        digit_count -= number->exponent;
    }
    if (digit_count == 0) return NULL;
    number->end = p;
    p = scan_exponent(p, end, &number->exponent);
    number->mantissa_exponent = number->exponent;
    if (digit_count > MANTISSA_DIGITS) shorten(number);
    return p;
}

static double assemble(uint64_t mantissa, int64_t biased_exponent)
{
    uint64_t bits = mantissa | (uint64_t)biased_exponent << 52;
    double value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

/* mantissa * 5^power to 128 bits; the second half of the power is needed only when the first leaves the rounding open. */
static void multiply_by_power(uint64_t mantissa, int64_t power, uint64_t product[2])
{
    const uint64_t *five = pia_power_of_five[power - PIA_FIRST_POWER];
    pia_number_multiply(mantissa, five[0], product);
    if ((product[0] & 0x1ff) != 0x1ff) return;
    uint64_t second[2];
    pia_number_multiply(mantissa, five[1], second);
    product[1] += second[0];
    product[0] += product[1] < second[0];
}

/* Lemire 2021, algorithm 1; Mushtak and Lemire 2023 prove that 64 bits of mantissa never need more. */
double pia_number_nearest(uint64_t mantissa, int64_t power)
{
    if (mantissa == 0 || power < PIA_FIRST_POWER) return 0;
    if (power > PIA_LAST_POWER) return INFINITY;
    int zeros = __builtin_clzll(mantissa);
    uint64_t product[2];
    multiply_by_power(mantissa << zeros, power, product);
    int top = (int)(product[0] >> 63);
    uint64_t kept = product[0] >> (top + 9); /* 53 bits and one to round by */
    int64_t exponent = ((217706 * power) >> 16) + 63 + top - zeros + 1023;
    if (exponent <= 0) { /* denormal */
        if (exponent < -62) return 0;
        kept >>= 1 - exponent;
        kept = (kept + (kept & 1)) >> 1;
        return assemble(kept, 0); /* a carry into bit 52 is the smallest normal double */
    }
    int tie_possible = product[1] <= 1 && power >= -4 && power <= 23 && (kept & 3) == 1;
    if (tie_possible && kept << (top + 9) == product[0]) kept &= ~(uint64_t)1;
    kept = (kept + (kept & 1)) >> 1;
    if (kept == (uint64_t)1 << 53) {
        kept >>= 1;
        exponent++;
    }
    return exponent >= 2047 ? INFINITY : assemble(kept & (((uint64_t)1 << 52) - 1), exponent);
}

static double to_double(const decimal *number)
{
    static const double ten_to[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
                                    1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
    uint64_t mantissa = number->mantissa;
    int64_t exponent = number->mantissa_exponent;
    if (mantissa <= (uint64_t)1 << 53 && exponent >= -22 && exponent <= 22 && !number->truncated)
        return exponent < 0 ? (double)mantissa / ten_to[-exponent] : (double)mantissa * ten_to[exponent];
    double value = pia_number_nearest(mantissa, exponent);
    if (!number->truncated || value == pia_number_nearest(mantissa + 1, exponent)) return value;
    return pia_number_exact(number->digits, number->end, number->exponent, value);
}

/* `word` in any case of its ASCII letters at p; returns the first character after it, or NULL. */
static const char *skip_word(const char *p, const char *end, const char *word)
{
    for (; *word != '\0'; p++, word++)
        if (p >= end || (*p | 0x20) != *word) return NULL;
    return p;
}

static const char *scan_not_finite(const char *p, const char *end, double *value)
{
    const char *after = skip_word(p, end, "nan");
    *value = after != NULL ? NAN : INFINITY;
    if (after == NULL) after = skip_word(p, end, "infinity");
    if (after == NULL) after = skip_word(p, end, "inf");
    return after;
}

const char *pia_number_parse(const char *begin, const char *end, double *value)
{
    const char *p = begin;
    int negative = p < end && *p == '-';
    if (p < end && (*p == '-' || *p == '+')) p++;
    decimal number;
    double magnitude;
    const char *after = scan_decimal(p, end, &number);
    if (after != NULL)
        magnitude = to_double(&number);
    else if ((after = scan_not_finite(p, end, &magnitude)) == NULL)
        return NULL;
    *value = negative ? -magnitude : magnitude;
    return after;
}
