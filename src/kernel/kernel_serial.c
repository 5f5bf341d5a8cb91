#include "kernel.h"

static int one(void)
{
    return 1;
}

static void in_order(int threads, pia_index chunks, pia_task *task, void *work)
{
    (void)threads;
    for (pia_index c = 0; c < chunks; c++) task(work, c);
}

const pia_kernel pia_kernel_serial = {"serial", "one thread, the readable reference", one, in_order};
