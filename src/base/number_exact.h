/* The last word on a decimal number that lies too close to the middle of two doubles. */
#ifndef PIA_BASE_NUMBER_EXACT_H
#define PIA_BASE_NUMBER_EXACT_H

#include <stdint.h>

/* The double nearest to D * 10^exponent, ties to even. D is the integer that the digits in [digits, end) spell; one '.' among them is
 * skipped. estimate >= 0: a double that is not above the result, and at most a few ulps below. Cost: about 5 microseconds for any
 * number of digits. */
double pia_number_exact(const char *digits, const char *end, int64_t exponent, double estimate);

#endif
