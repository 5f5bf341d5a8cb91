/* What every subcommand works with: the library context, the common options, memory that lives until the end, errors on one line. */
#ifndef PIA_CLI_SESSION_H
#define PIA_CLI_SESSION_H

#include <stddef.h>
#include <stdio.h>

#include "pia/pia.h"

/* Exit statuses of the program. */
enum exit_code {
    EXIT_DONE = 0,
    EXIT_TOLERANCE = 1,    /* done, but the tolerance that was asked for is not reached */
    EXIT_USAGE = 2,        /* the command line makes no sense */
    EXIT_DATA = 3,         /* the input data cannot be used */
    EXIT_FILE = 4,         /* a file could not be read or written */
    EXIT_MEMORY = 5,       /* out of memory */
    EXIT_INTERNAL = 6,     /* a defect of the library */
    EXIT_INTERRUPTED = 130 /* stopped by Ctrl-C; the outputs are written */
};

struct session {
    pia_context *context; /* NULL until session_open */
    int json, quiet, verbose;
    int threads;         /* PIA_AUTO: as many as pay */
    const char *backend; /* NULL: the best available */
    int metered;         /* 1 before session_open: the library's memory is counted in `bytes` */
    _Atomic(size_t) bytes;
    int argument;      /* index of the argument that follows a wrong option */
    struct kept *kept; /* memory given by session_keep */
};

/* A growing list of borrowed texts, such as the values of a repeated option. */
struct texts {
    const char **item;
    pia_index count;
};

/* Creates the context from the options parsed so far. Returns an exit status. */
int session_open(struct session *session);
/* Releases the context and everything that was kept. */
void session_close(struct session *session);

/* Zeroed memory that lives until session_close; size 0 is accepted. Ends the program with EXIT_MEMORY when there is none. */
void *session_keep(struct session *session, size_t count, size_t size) __attribute__((returns_nonnull));
/* A kept text, made as by printf. */
char *session_text(struct session *session, const char *format, ...) __attribute__((format(printf, 2, 3)));
void session_append(struct session *session, struct texts *texts, const char *text);

/* Prints "pia: ..." on one line of stderr and returns `code`. */
int fail(int code, const char *format, ...) __attribute__((format(printf, 2, 3)));
/* Tells the context's last failure, about the file `path` unless NULL, and returns the exit status of `status`; EXIT_DONE for PIA_OK.
 */
int session_check(const struct session *session, pia_status status, const char *path);
/* Prints "pia: warning: ..." on stderr unless --quiet. */
void session_warn(const struct session *session, const char *format, ...) __attribute__((format(printf, 2, 3)));

#endif
