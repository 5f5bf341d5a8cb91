/* What happens while a fit runs: a line on the terminal, and Ctrl-C. */
#ifndef PIA_CLI_PROGRESS_H
#define PIA_CLI_PROGRESS_H

#include "session.h"

struct progress {
    int visible;  /* 1: stderr is a terminal and --quiet was not given */
    double shown; /* when the line was last written, seconds */
    int some;     /* 1: a line stands there */
};

/* From now on the first Ctrl-C is remembered and a second one ends the program at once. */
void progress_begin(struct progress *progress, const struct session *session);
/* For pia_fit_options.progress with user = a struct progress: returns 1 after Ctrl-C. */
int progress_tell(void *user, const pia_report *so_far);
/* Clears the line. */
void progress_end(struct progress *progress);
/* 1 after Ctrl-C. */
int progress_interrupted(void);

/* Seconds of a clock that never runs backwards. */
double seconds_now(void);

#endif
