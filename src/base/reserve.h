/* Large blocks that were released, kept for whoever asks for as much next. */
#ifndef PIA_BASE_RESERVE_H
#define PIA_BASE_RESERVE_H

#include "memory.h"

/* The C library's allocator with a reserve: released blocks of 4 MB and more, at most eight and 512 MB in all, which the kernel may
 * take whenever it needs them. For any number of threads. PIA_E_MEMORY. */
pia_status pia_reserve_open(pia_memory *out);
/* After everything that was taken from it. Others than those of pia_reserve_open are left alone. */
void pia_reserve_close(const pia_memory *memory);

#endif
