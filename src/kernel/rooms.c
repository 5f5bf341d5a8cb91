#include "rooms.h"

enum { LINE = 64 };

pia_status pia_rooms_open(pia_context *context, pia_index chunks, pia_index size, pia_rooms *rooms)
{
    pia_index threads = context != NULL ? context->threads : 1, most = chunks < PIA_MAX_ROOMS ? chunks : PIA_MAX_ROOMS;
    rooms->count = threads < most ? threads : most;
    rooms->size = (size + LINE - 1) / LINE * LINE;
    rooms->block = pia_take(context, rooms->count, (size_t)rooms->size);
    for (pia_index k = 0; k < rooms->count; k++) atomic_flag_clear(&rooms->taken[k]);
    return rooms->block != NULL ? PIA_OK : pia_take_status(context, rooms->count, (size_t)rooms->size);
}

/* One is free, or soon will be. */
void *pia_rooms_take(pia_rooms *rooms)
{
    pia_index k = 0;
    while (atomic_flag_test_and_set_explicit(&rooms->taken[k], memory_order_acquire)) k = k + 1 < rooms->count ? k + 1 : 0;
    return rooms->block + k * rooms->size;
}

void pia_rooms_leave(pia_rooms *rooms, void *room)
{
    atomic_flag_clear_explicit(&rooms->taken[((char *)room - rooms->block) / rooms->size], memory_order_release);
}

void pia_rooms_close(pia_context *context, pia_rooms *rooms)
{
    pia_give(context, rooms->block);
    rooms->block = NULL;
}
