/* The leading bits of the powers of five, for reading decimal numbers. */
#ifndef PIA_BASE_POWERS_OF_FIVE_H
#define PIA_BASE_POWERS_OF_FIVE_H

#include <stdint.h>

enum { PIA_FIRST_POWER = -342, PIA_LAST_POWER = 308 };

/* 5^q at [q - PIA_FIRST_POWER] as {high, low}: the 128 leading bits, so the top bit of high is set. Truncated for q >= 0, rounded up
 * for q < 0. */
extern const uint64_t pia_power_of_five[PIA_LAST_POWER - PIA_FIRST_POWER + 1][2];

#endif
