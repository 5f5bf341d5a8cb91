/* Work space of tasks: as many rooms as tasks run at a time, so that few pages are touched and stay in the cache. */
#ifndef PIA_KERNEL_ROOMS_H
#define PIA_KERNEL_ROOMS_H

#include <stdatomic.h>

#include "context.h"

enum { PIA_MAX_ROOMS = 64 };

typedef struct pia_rooms {
    char *block;
    pia_index count, size; /* bytes of a room, a multiple of 64 */
    atomic_flag taken[PIA_MAX_ROOMS];
} pia_rooms;

/* For `chunks` tasks that need `size` bytes each while they run. Errors: PIA_E_MEMORY, PIA_E_SIZE. */
pia_status pia_rooms_open(pia_context *context, pia_index chunks, pia_index size, pia_rooms *rooms);
/* A room for the task that asks, aligned to 64 bytes, contents undefined. */
void *pia_rooms_take(pia_rooms *rooms);
void pia_rooms_leave(pia_rooms *rooms, void *room);
void pia_rooms_close(pia_context *context, pia_rooms *rooms);

#endif
