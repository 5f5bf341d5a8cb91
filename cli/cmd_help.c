#include "command.h"

int cmd_help(struct session *session, int argc, char **argv)
{
    if (argc < 2 || argv[1][0] == '-') {
        print_overview(stdout);
        return EXIT_DONE;
    }
    const struct command *command = command_find(argv[1]);
    if (!command) return fail(EXIT_USAGE, "there is no command '%s'; 'pia --help' lists them", argv[1]);
    if (command->run == cmd_help) {
        print_overview(stdout);
        return EXIT_DONE;
    }
    char name[16], option[] = "--help";
    snprintf(name, sizeof name, "%s", command->name);
    return command->run(session, 2, (char *[]){name, option, NULL});
}
