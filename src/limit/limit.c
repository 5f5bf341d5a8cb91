#include "limit.h"

#include <string.h>

const pia_limiter *pia_limit_find(const char *name)
{
    const pia_limiter *limiter;
    for (pia_index i = 0; (limiter = pia_limit_list(i)) != NULL; i++)
        if (strcmp(limiter->name, name) == 0) return limiter;
    return NULL;
}
