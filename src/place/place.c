#include "place.h"

#include <string.h>

const pia_placement *pia_place_find(const char *name)
{
    const pia_placement *entry;
    for (pia_index i = 0; (entry = pia_place_list(i)) != NULL; i++)
        if (strcmp(entry->name, name) == 0) return entry;
    return NULL;
}

pia_index pia_place_owner(int degree, pia_index control, pia_index column)
{
    pia_index row = (column - degree / 2) % control;
    return row < 0 ? row + control : row;
}
