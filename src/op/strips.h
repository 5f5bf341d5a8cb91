/* Sums over the cells of a surface: a strip (span of u) adds to the degree + 1 lines of control points that begin with it. */
#ifndef PIA_OP_STRIPS_H
#define PIA_OP_STRIPS_H

#include "kernel.h"

/* Runs task(work, strip) for strips 0 .. strips - 1. Strips that share a line never run at the same time, and each line is added to in
 * an order that depends on strips and degree alone: the same bits for any number of threads, without locks or copies. */
void pia_each_strip(pia_context *context, pia_index strips, int degree, pia_task *task, void *work);

#endif
