#include "ticks.h"

#include <math.h>
#include <stdio.h>

/* The round number (1, 2 or 5 times a power of ten) that cuts `range` into about `wanted` pieces. */
static double round_step(double range, int wanted)
{
    double rough = range / wanted;
    double power = pow(10, floor(log10(rough)));
    double leading = rough / power;
    return power * (leading < 1.5 ? 1 : leading < 3.5 ? 2 : leading < 7.5 ? 5 : 10);
}

/* A round number in reach of [low, high], when numbers there need more than six figures to differ; else 0. */
static double shared_part(double low, double high)
{
    double range = high - low;
    if (fmax(fabs(low), fabs(high)) < 2e4 * range) return 0;
    double unit = pow(10, ceil(log10(range)));
    return unit * round((0.5 * low + 0.5 * high) / unit);
}

static void choose_labels(pia_ticks *ticks, double low, double high, double step)
{
    ticks->offset = shared_part(low, high);
    double size = fmax(fabs(low - ticks->offset), fabs(high - ticks->offset));
    int exponent = (int)floor(log10(size) + 1e-9);
    ticks->exponent = exponent >= 7 || exponent < -2 ? (int)(3 * floor(exponent / 3.0)) : 0;
    double unit = step / pow(10, ticks->exponent);
    int decimals = (int)-floor(log10(unit) + 1e-9);
    ticks->decimals = decimals < 0 ? 0 : decimals > 12 ? 12 : decimals;
}

void pia_ticks_linear(double low, double high, int wanted, pia_ticks *out)
{
    double step = round_step(high - low, wanted), slack = 1e-9 * step;
    *out = (pia_ticks){0};
    choose_labels(out, low, high, step);
    double first = ceil((low - out->offset - slack) / step);
    for (int i = 0; i < PIA_MAX_TICKS; i++) {
        double value = out->offset + (first + i) * step;
        if (value > high + slack) break;
        out->value[out->count++] = value;
    }
}

void pia_ticks_decades(double low, double high, int wanted, pia_ticks *out)
{
    *out = (pia_ticks){.logarithmic = 1};
    double step = fmax(1, ceil((high - low) / wanted));
    double first = step * ceil(low / step);
    for (int i = 0; i < PIA_MAX_TICKS && first + i * step <= high; i++) out->value[out->count++] = first + i * step;
}

void pia_tick_label(const pia_ticks *ticks, int index, char text[PIA_LABEL_SIZE])
{
    double value = ticks->value[index];
    if (ticks->logarithmic)
        pia_label_power((int)value, text);
    else
        pia_label_fixed((value - ticks->offset) / pow(10, ticks->exponent), ticks->decimals, text);
}

/* In full where that is short; offsets are round to the unit they were rounded to. */
static void label_offset(double offset, char text[PIA_LABEL_SIZE])
{
    double size = fabs(offset);
    if (size == floor(size) && size < 1e12)
        pia_label_fixed(size, 0, text);
    else
        pia_label_significant(size, 15, text);
}

void pia_tick_title(const pia_ticks *ticks, const char *name, char text[3 * PIA_LABEL_SIZE])
{
    char offset[PIA_LABEL_SIZE] = "", power[PIA_LABEL_SIZE] = "";
    if (ticks->offset != 0) label_offset(ticks->offset, offset);
    if (ticks->exponent != 0) pia_label_power(ticks->exponent, power);
    snprintf(text, 3 * PIA_LABEL_SIZE, "%.48s%s%s%s%s%s", name,
             ticks->offset > 0   ? " \u2212 "
             : ticks->offset < 0 ? " + "
                                 : "",
             offset, ticks->exponent != 0 ? " (\u00d7" : "", power, ticks->exponent != 0 ? ")" : "");
}
