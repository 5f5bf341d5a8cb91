/* Ticks: round numbers along an axis and their labels. */
#ifndef PIA_REPORT_TICKS_H
#define PIA_REPORT_TICKS_H

#include "label.h"

enum { PIA_MAX_TICKS = 24 };

typedef struct pia_ticks {
    int count;
    double value[PIA_MAX_TICKS];
    double offset; /* labels show (value - offset) / 10^exponent */
    int exponent;
    int decimals;
    int logarithmic; /* values are decimal logarithms and labels powers of ten */
} pia_ticks;

/* About `wanted` (2 to 12) multiples of 1, 2 or 5 times a power of ten inside [low, high], both finite, low < high. The offset takes
 * away the digits that all labels would share where these are many. */
void pia_ticks_linear(double low, double high, int wanted, pia_ticks *out);

/* Decades, or every k-th where there are more than `wanted`; low and high are decimal logarithms. */
void pia_ticks_decades(double low, double high, int wanted, pia_ticks *out);

void pia_tick_label(const pia_ticks *ticks, int index, char text[PIA_LABEL_SIZE]);

/* What the labels count: "x", "x (×10⁻⁶)", "x − 500100 (×10³)". */
void pia_tick_title(const pia_ticks *ticks, const char *name, char text[3 * PIA_LABEL_SIZE]);

#endif
