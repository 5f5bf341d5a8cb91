/* What reading and writing of numbers share. */
#ifndef PIA_BASE_NUMBER_PARTS_H
#define PIA_BASE_NUMBER_PARTS_H

#include <stdint.h>

/* a * b to 128 bits as {high, low}, from 32-bit halves. */
static inline void pia_number_multiply(uint64_t a, uint64_t b, uint64_t product[2])
{
    uint64_t a0 = (uint32_t)a, a1 = a >> 32, b0 = (uint32_t)b, b1 = b >> 32;
    uint64_t low = a0 * b0, middle = a1 * b0 + (low >> 32), other = a0 * b1 + (uint32_t)middle;
    product[0] = a1 * b1 + (middle >> 32) + (other >> 32);
    product[1] = other << 32 | (uint32_t)low;
}

/* The double nearest to mantissa * 10^power, ties to even. */
double pia_number_nearest(uint64_t mantissa, int64_t power);

#endif
