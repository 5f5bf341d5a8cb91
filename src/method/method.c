#include "method.h"

#include <string.h>

const pia_method *pia_method_find(const char *name)
{
    const pia_method *method;
    for (pia_index i = 0; (method = pia_method_list(i)) != NULL; i++)
        if (strcmp(method->name, name) == 0) return method;
    return NULL;
}
