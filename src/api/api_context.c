#include "kernel.h"
#include "options.h"
#include "reserve.h"

enum { MAX_THREADS = 1024 };

void pia_context_options_init(pia_context_options *options)
{
    *options = (pia_context_options){.struct_size = sizeof *options, .threads = PIA_AUTO};
}

static int valid_threads(int threads)
{
    return threads == PIA_AUTO || (threads >= 1 && threads <= MAX_THREADS);
}

static int resolve_threads(int threads, const pia_kernel *kernel)
{
    if (threads != PIA_AUTO) return threads;
    int worth = kernel->processors();
    return worth < MAX_THREADS ? worth : MAX_THREADS;
}

pia_status pia_context_create(const pia_context_options *options, pia_context **out)
{
    pia_context_options o;
    pia_context_options_init(&o);
    pia_status status = pia_options_read(NULL, "pia_context_options", &o, sizeof o, options);
    if (status != PIA_OK) return status;
    if (out == NULL || !valid_threads(o.threads) || (o.allocate == NULL) != (o.release == NULL)) return PIA_E_ARGUMENT;
    const pia_kernel *kernel = pia_kernel_find(o.backend);
    if (kernel == NULL) return PIA_E_UNAVAILABLE;

    pia_memory memory = {o.allocate, o.release, o.user};
    if (o.allocate == NULL && pia_reserve_open(&memory) != PIA_OK) return PIA_E_MEMORY;
    pia_context *context = pia_memory_take(&memory, 1, sizeof *context);
    if (context == NULL) {
        pia_reserve_close(&memory);
        return PIA_E_MEMORY;
    }
    *context = (pia_context){.memory = memory,
                             .threads = resolve_threads(o.threads, kernel),
                             .kernel = kernel,
                             .log = o.log,
                             .user = o.user,
                             .interrupted = o.interrupted};
    *out = context;
    return PIA_OK;
}

void pia_context_destroy(pia_context *context)
{
    if (context == NULL) return;
    pia_memory memory = context->memory;
    pia_memory_give(&memory, context);
    pia_reserve_close(&memory);
}

pia_status pia_context_set_threads(pia_context *context, int threads)
{
    if (context == NULL) return PIA_E_ARGUMENT;
    if (!valid_threads(threads))
        return pia_fail(context, PIA_E_ARGUMENT, "%d threads; give 1 to %d, or PIA_AUTO", threads, MAX_THREADS);
    context->threads = resolve_threads(threads, context->kernel);
    return PIA_OK;
}
