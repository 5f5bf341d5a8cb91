/* CRC32C (Castagnoli), as in iSCSI (RFC 3720) and ext4. */
#ifndef PIA_IO_CRC32C_H
#define PIA_IO_CRC32C_H

#include <stddef.h>
#include <stdint.h>

/* Continues `crc`, which starts at 0, over more bytes. */
uint32_t pia_crc32c(uint32_t crc, const void *bytes, size_t size);

#endif
