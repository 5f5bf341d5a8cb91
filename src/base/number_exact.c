#include "number_exact.h"

#include <string.h>

/* The decimal D * 10^e is compared with the middle h * 2^q of two neighbouring doubles in whole numbers: both sides are multiplied by
 * powers of five and two until nothing is negative. */

/* The longest decimal that can be the middle of two doubles has 767 digits. More digits only say "a little more" (a 1 at the end). */
enum { MOST_DIGITS = 768, LIMBS = 96 };

typedef struct whole {
    uint32_t limb[LIMBS]; /* least significant first */
    int count;            /* limbs in use; the top one is not zero */
} whole;

static void multiply_add(whole *number, uint32_t factor, uint32_t addend)
{
    uint64_t carry = addend;
    for (int i = 0; i < number->count; i++) {
        carry += (uint64_t)number->limb[i] * factor;
        number->limb[i] = (uint32_t)carry;
        carry >>= 32;
    }
    if (carry != 0 && number->count < LIMBS) number->limb[number->count++] = (uint32_t)carry;
}

static void multiply_by_power_of_five(whole *number, int64_t power)
{
    const uint32_t five_to_13 = 1220703125; /* the largest in 32 bits */
    for (; power >= 13; power -= 13) multiply_add(number, five_to_13, 0);
    for (; power > 0; power--) multiply_add(number, 5, 0);
}

static void shift_left(whole *number, int64_t bits)
{
    for (; bits >= 31; bits -= 31) multiply_add(number, (uint32_t)1 << 31, 0);
    multiply_add(number, (uint32_t)1 << bits, 0);
}

static int compare(const whole *a, const whole *b)
{
    if (a->count != b->count) return a->count < b->count ? -1 : 1;
    for (int i = a->count - 1; i >= 0; i--)
        if (a->limb[i] != b->limb[i]) return a->limb[i] < b->limb[i] ? -1 : 1;
    return 0;
}

/* Reads at most MOST_DIGITS significant digits; *exponent then belongs to what was kept. */
static whole read_digits(const char *digits, const char *end, int64_t *exponent)
{
    whole number = {.count = 0};
    int kept = 0, more = 0;
    for (const char *p = digits; p < end; p++) {
        if (*p == '.') continue;
        uint32_t digit = (uint32_t)(*p - '0');
        if (kept == 0 && digit == 0) continue;
        if (kept < MOST_DIGITS) {
            multiply_add(&number, 10, digit);
            kept++;
        } else {
            more |= digit != 0;
            ++*exponent;
        }
    }
    if (more) {
        multiply_add(&number, 10, 1);
        --*exponent;
    }
    return number;
}

/* Sign of D * 10^exponent - (the middle of the double `bits` and the next one up). */
static int compare_with_middle_above(const whole *digits, int64_t exponent, uint64_t bits)
{
    int64_t biased = (int64_t)(bits >> 52);
    uint64_t mantissa = bits & (((uint64_t)1 << 52) - 1);
    if (biased > 0) mantissa |= (uint64_t)1 << 52;
    int64_t power_of_two = (biased > 0 ? biased : 1) - 1076;
    uint64_t middle = 2 * mantissa + 1;
    whole left = *digits, right = {.limb = {(uint32_t)middle, (uint32_t)(middle >> 32)}, .count = middle >> 32 != 0 ? 2 : 1};
    multiply_by_power_of_five(&left, exponent);
    multiply_by_power_of_five(&right, -exponent);
    int64_t shift = exponent - power_of_two;
    shift_left(shift > 0 ? &left : &right, shift > 0 ? shift : -shift);
    return compare(&left, &right);
}

double pia_number_exact(const char *digits, const char *end, int64_t exponent, double estimate)
{
    const uint64_t infinite = (uint64_t)2047 << 52;
    whole number = read_digits(digits, end, &exponent);
    uint64_t bits;
    memcpy(&bits, &estimate, sizeof bits);
    for (; bits < infinite; bits++) {
        int sign = compare_with_middle_above(&number, exponent, bits);
        if (sign < 0 || (sign == 0 && bits % 2 == 0)) break;
    }
    double value;
    memcpy(&value, &bits, sizeof value);
    return value;
}
