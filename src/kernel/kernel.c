#include "kernel.h"

#include <string.h>

pia_index pia_chunk_count(pia_index count, pia_index grain)
{
    pia_index chunks = count / grain;
    return chunks < 1 ? 1 : chunks > 4096 ? 4096 : chunks;
}

pia_index pia_chunk_begin(pia_index count, pia_index chunks, pia_index chunk)
{
    pia_index size = count / chunks, rest = count % chunks;
    return chunk * size + (chunk < rest ? chunk : rest);
}

void pia_for_each(pia_context *context, pia_index chunks, pia_task *task, void *work)
{
    if (context == NULL || context->threads < 2 || chunks < 2)
        pia_kernel_serial.for_each(1, chunks, task, work);
    else
        context->kernel->for_each(context->threads, chunks, task, work);
}

const pia_kernel *pia_kernel_find(const char *name)
{
    if (name == NULL) return pia_kernel_list(0);
    const pia_kernel *kernel;
    for (pia_index i = 0; (kernel = pia_kernel_list(i)) != NULL; i++)
        if (strcmp(kernel->name, name) == 0) return kernel;
    return NULL;
}
