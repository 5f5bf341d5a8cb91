#include "crc32c.h"

#include "bytes.h"

/* Few bytes go bit by bit, many eight bytes a step (slicing by eight, M. Kounavis and F. Berry, 2005). The tables are made on the
 * stack, which costs as much as some hundred bytes, so that nothing is static. */

enum { SLICES = 8, MANY = 512 };

/* `crc` after one more byte, which was already added to its low bits. The polynomial is 0x1edc6f41, reversed. */
static uint32_t shift_byte(uint32_t crc)
{
    for (int bit = 0; bit < 8; bit++) crc = crc >> 1 ^ (crc & 1 ? 0x82f63b78 : 0);
    return crc;
}

static void make_tables(uint32_t table[SLICES][256])
{
    for (uint32_t byte = 0; byte < 256; byte++) table[0][byte] = shift_byte(byte);
    for (int slice = 1; slice < SLICES; slice++)
        for (uint32_t byte = 0; byte < 256; byte++)
            table[slice][byte] = table[slice - 1][byte] >> 8 ^ table[0][table[slice - 1][byte] & 255];
}

uint32_t pia_crc32c(uint32_t crc, const void *bytes, size_t size)
{
    uint32_t table[SLICES][256];
    const unsigned char *p = bytes;
    crc = ~crc;
    if (size >= MANY) {
        make_tables(table);
        for (; size >= SLICES; p += SLICES, size -= SLICES) {
            uint64_t word = pia_bytes_load_little(p, SLICES) ^ crc;
            crc = 0;
            for (int slice = 0; slice < SLICES; slice++) crc ^= table[SLICES - 1 - slice][word >> 8 * slice & 255];
        }
    }
    for (; size > 0; p++, size--) crc = shift_byte(crc ^ *p);
    return ~crc;
}
