#include "label.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static const char minus[] = "\u2212";

static long long ten_to(int exponent)
{
    long long power = 1;
    while (exponent-- > 0) power *= 10;
    return power;
}

void pia_label_fixed(double value, int decimals, char text[PIA_LABEL_SIZE])
{
    decimals = decimals < 0 ? 0 : decimals > 15 ? 15 : decimals;
    long long unit = ten_to(decimals), scaled = llround(fabs(value) * (double)unit);
    const char *sign = value < 0 && scaled != 0 ? minus : "";
    if (decimals == 0)
        snprintf(text, PIA_LABEL_SIZE, "%s%lld", sign, scaled);
    else
        snprintf(text, PIA_LABEL_SIZE, "%s%lld.%0*lld", sign, scaled / unit, decimals, scaled % unit);
}

void pia_label_power(int exponent, char text[PIA_LABEL_SIZE])
{
    static const char *const raised[] = {"\u2070", "\u00b9", "\u00b2", "\u00b3", "\u2074",
                                         "\u2075", "\u2076", "\u2077", "\u2078", "\u2079"};
    char digits[16];
    snprintf(digits, sizeof digits, "%d", abs(exponent));
    int length = snprintf(text, PIA_LABEL_SIZE, exponent < 0 ? "10\u207b" : "10");
    for (const char *d = digits; *d != '\0'; d++)
        length += snprintf(text + length, (size_t)(PIA_LABEL_SIZE - length), "%s", raised[*d - '0']);
}

/* The digits of |value| as an integer of `digits` figures, and the exponent of the first one. */
static long long leading_digits(double value, int digits, int *exponent)
{
    double size = fabs(value);
    *exponent = (int)floor(log10(size));
    int shift = digits - 1 - *exponent, half = shift / 2;
    /* In two factors, as 10^shift may overflow where the product does not. */
    long long figures = llround(size * pow(10, half) * pow(10, shift - half));
    if (figures < ten_to(digits)) return figures;
    ++*exponent;
    return figures / 10;
}

void pia_label_significant(double value, int digits, char text[PIA_LABEL_SIZE])
{
    if (!isfinite(value) || value == 0) {
        snprintf(text, PIA_LABEL_SIZE, value == 0 ? "0" : "not finite");
        return;
    }
    int exponent;
    long long figures = leading_digits(value, digits, &exponent);
    while (digits > 1 && figures % 10 == 0) {
        figures /= 10;
        digits--;
    }
    double signed_figures = value < 0 ? -(double)figures : (double)figures;
    if (exponent >= -3 && exponent < 6) {
        int decimals = digits - 1 - exponent;
        pia_label_fixed(decimals >= 0 ? signed_figures / (double)ten_to(decimals) : signed_figures * (double)ten_to(-decimals),
                        decimals > 0 ? decimals : 0, text);
        return;
    }
    char mantissa[PIA_LABEL_SIZE], power[PIA_LABEL_SIZE];
    pia_label_fixed(signed_figures / (double)ten_to(digits - 1), digits - 1, mantissa);
    pia_label_power(exponent, power);
    snprintf(text, PIA_LABEL_SIZE, "%.30s\u00d7%.30s", mantissa, power);
}
