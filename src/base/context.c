#include "context.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

pia_status pia_fail(pia_context *context, pia_status status, const char *format, ...)
{
    if (context == NULL) return status;
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(context->message, sizeof context->message, format, arguments);
    va_end(arguments);
    return status;
}

void pia_log(pia_context *context, int level, const char *format, ...)
{
    if (context == NULL || context->log == NULL) return;
    char text[512];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    context->log(context->user, level, text);
}

int pia_interrupted(pia_context *context)
{
    return context != NULL && context->interrupted != NULL && context->interrupted(context->user);
}

const pia_memory *pia_memory_of(const pia_context *context)
{
    return context != NULL ? &context->memory : pia_memory_default();
}

pia_status pia_take_status(const pia_context *context, pia_index count, size_t size)
{
    (void)context;
    pia_index bytes;
    return pia_multiply(count, (pia_index)size, &bytes) ? PIA_E_MEMORY : PIA_E_SIZE;
}

void *pia_take(pia_context *context, pia_index count, size_t size)
{
    void *block = pia_memory_take(pia_memory_of(context), count, size);
    if (block == NULL) {
        if (pia_take_status(context, count, size) == PIA_E_SIZE)
            pia_fail(context, PIA_E_SIZE, "%lld items of %zu bytes do not fit in 64 bits; ask for less", (long long)count, size);
        else
            pia_fail(context, PIA_E_MEMORY, "out of memory for %lld items of %zu bytes; free memory or use fewer points",
                     (long long)count, size);
    }
    return block;
}

void *pia_take_zero(pia_context *context, pia_index count, size_t size)
{
    void *block = pia_take(context, count, size);
    if (block != NULL) memset(block, 0, (size_t)count * size);
    return block;
}

void pia_give(pia_context *context, void *block)
{
    pia_memory_give(pia_memory_of(context), block);
}

const char *pia_message(const pia_context *context)
{
    return context != NULL ? context->message : "";
}
