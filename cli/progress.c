#include "progress.h"

#include <signal.h>
#include <time.h>
#include <unistd.h>

/* A signal handler can speak to the program through nothing but such a variable. */
static volatile sig_atomic_t interrupted;

static void remember(int signal)
{
    (void)signal;
    interrupted = 1;
}

double seconds_now(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

void progress_begin(struct progress *progress, const struct session *session)
{
    struct sigaction action = {.sa_handler = remember, .sa_flags = (int)SA_RESETHAND};
    sigemptyset(&action.sa_mask);
    sigaction(SIGINT, &action, NULL);
    *progress = (struct progress){.visible = !session->quiet && isatty(STDERR_FILENO), .shown = seconds_now()};
}

int progress_tell(void *user, const pia_report *so_far)
{
    enum { LINES_A_SECOND = 8 };
    struct progress *progress = user;
    if (progress->visible && seconds_now() - progress->shown > 1.0 / LINES_A_SECOND) {
        fprintf(stderr, "\r\033[K%s: iteration %lld, %lld control points, max error %.4g", so_far->method,
                (long long)so_far->iterations, (long long)so_far->control_count, so_far->max_error);
        progress->shown = seconds_now();
        progress->some = 1;
    }
    return interrupted;
}

void progress_end(struct progress *progress)
{
    if (progress->some) fputs("\r\033[K", stderr);
    progress->some = 0;
}

int progress_interrupted(void)
{
    return interrupted;
}
