#include "strips.h"

typedef struct colour {
    pia_task *task;
    void *work;
    pia_index first, stride;
} colour;

static void one_strip(void *work, pia_index chunk)
{
    const colour *c = work;
    c->task(c->work, c->first + chunk * c->stride);
}

/* Strips degree + 1 apart have no line in common: they make one colour, and colours take turns. */
void pia_each_strip(pia_context *context, pia_index strips, int degree, pia_task *task, void *work)
{
    pia_index stride = degree + 1;
    for (pia_index first = 0; first < stride && first < strips; first++) {
        colour c = {task, work, first, stride};
        pia_for_each(context, (strips - first + stride - 1) / stride, one_strip, &c);
    }
}
