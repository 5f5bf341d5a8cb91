/* Numbers as bytes of a file, whatever the byte order of the machine. Compilers turn these loops into one load or store. */
#ifndef PIA_IO_BYTES_H
#define PIA_IO_BYTES_H

#include <stdint.h>
#include <string.h>

/* size: 1 to 8 bytes. */
static inline uint64_t pia_bytes_load_little(const void *bytes, int size)
{
    const unsigned char *p = bytes;
    uint64_t value = 0;
    for (int i = size - 1; i >= 0; i--) value = value << 8 | p[i];
    return value;
}

static inline uint64_t pia_bytes_load_big(const void *bytes, int size)
{
    const unsigned char *p = bytes;
    uint64_t value = 0;
    for (int i = 0; i < size; i++) value = value << 8 | p[i];
    return value;
}

static inline void pia_bytes_store_little(void *bytes, int size, uint64_t value)
{
    unsigned char *p = bytes;
    for (int i = 0; i < size; i++) p[i] = (unsigned char)(value >> 8 * i);
}

static inline double pia_bytes_to_double(uint64_t bits)
{
    double value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

static inline float pia_bytes_to_float(uint32_t bits)
{
    float value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

static inline uint64_t pia_bytes_of_double(double value)
{
    uint64_t bits;
    memcpy(&bits, &value, sizeof bits);
    return bits;
}

#endif
