/* Subcommands of pia. */
#ifndef PIA_CLI_COMMAND_H
#define PIA_CLI_COMMAND_H

#include "session.h"

struct command {
    const char *name, *summary;
    /* argv[0] is the command's name. Returns an exit status. */
    int (*run)(struct session *session, int argc, char **argv);
};

/* One file each, cmd_NAME.c. */
int cmd_fit(struct session *session, int argc, char **argv);
int cmd_eval(struct session *session, int argc, char **argv);
int cmd_check(struct session *session, int argc, char **argv);
int cmd_info(struct session *session, int argc, char **argv);
int cmd_convert(struct session *session, int argc, char **argv);
int cmd_plot(struct session *session, int argc, char **argv);
int cmd_list(struct session *session, int argc, char **argv);
int cmd_help(struct session *session, int argc, char **argv);

/* Entry `index` of the table; NULL past the end. */
const struct command *command_at(int index);
/* NULL when there is none. */
const struct command *command_find(const char *name);
/* The help of the program. */
void print_overview(FILE *stream);

#endif
