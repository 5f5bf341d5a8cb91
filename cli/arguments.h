/* Command lines: glibc's argp, with every error on one line and the nearest option suggested. */
#ifndef PIA_CLI_ARGUMENTS_H
#define PIA_CLI_ARGUMENTS_H

#include <argp.h>
#include <errno.h>

#include "session.h"

/* Returned by arguments_parse after it printed the help that was asked for. */
enum { HELP_WAS_PRINTED = -1 };
/* What parsers return to argp, which itself knows only EINVAL. */
enum { HELP_IS_WANTED = ECANCELED, ERROR_IS_TOLD = EDOM };

/* Options that every subcommand takes; use as a child whose input is the session. */
extern const struct argp common_argp;
/* Group numbers of --help: a subcommand's own groups lie between. */
enum { COMMON_GROUP = 90 };

/* Parses the arguments of the subcommand `name`; argv[0] is its name. Returns EXIT_DONE, EXIT_USAGE or HELP_WAS_PRINTED. */
int arguments_parse(struct session *session, const char *name, const struct argp *argp, int argc, char **argv, void *input);

/* "pia NAME ..." with the arguments as they are given, quoted where a shell would read them otherwise; kept by the session. To be
 * taken before the arguments are parsed. */
const char *command_line(struct session *session, const char *name, int argc, char *const *argv);

/* For parsers: prints the error and returns what makes argp stop. */
int usage_error(const char *format, ...) __attribute__((format(printf, 1, 2)));

/* Values of options. Each returns 0, or ERROR_IS_TOLD with the option's name told, for a parser to return. */
int option_count(const char *option, const char *text, pia_index minimum, pia_index *out);
int option_number(const char *option, const char *text, double minimum, double *out);
/* "P" or "P,Q" (or "PxQ"): one count gives both. */
int option_pair(const char *option, const char *text, pia_index minimum, pia_index out[2]);

/* Numbers as texts: the whole text must be the number. Return 1 when it is. */
int text_is_count(const char *text, pia_index *out);
int text_is_number(const char *text, double *out); /* finite */
/* "AxB" or "A,B" */
int text_is_pair(const char *text, pia_index out[2]);

#endif
