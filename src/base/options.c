#include "options.h"

#include <string.h>

pia_status pia_options_read(pia_context *context, const char *name, void *out, size_t size, const void *in)
{
    if (in == NULL) return PIA_OK;
    size_t given;
    memcpy(&given, in, sizeof given);
    if (given < sizeof given)
        return pia_fail(context, PIA_E_ARGUMENT, "%s has struct_size %zu; fill it with %s_init first", name, given, name);
    if (given > size)
        return pia_fail(context, PIA_E_ARGUMENT,
                        "%s has struct_size %zu, but this library knows %zu; use a library as new as its header", name, given, size);
    memcpy(out, in, given);
    memcpy(out, &size, sizeof size);
    return PIA_OK;
}

void pia_options_write(void *out, const void *full, size_t size)
{
    size_t given;
    memcpy(&given, out, sizeof given);
    if (given < sizeof given || given > size) given = size;
    memcpy(out, full, given);
    memcpy(out, &given, sizeof given);
}
