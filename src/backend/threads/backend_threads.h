/* Threads by POSIX: started for each large piece of work, joined after it, so that nothing spins between two of them. */
#ifndef PIA_BACKEND_THREADS_H
#define PIA_BACKEND_THREADS_H

#include "kernel.h"

extern const pia_kernel pia_backend_threads;

#endif
