#include <errno.h>
#include <string.h>

#include "command.h"

static const struct command commands[] = {
    {"fit", "fit a curve, a grid surface or a scattered surface to points", cmd_fit},
    {"eval", "points, derivatives and curvature of a model", cmd_eval},
    {"check", "how far points deviate from a model", cmd_check},
    {"info", "what a file of points or models holds", cmd_info},
    {"convert", "a model in another format, refined, raised, split on request", cmd_convert},
    {"plot", "a picture of a model with its points", cmd_plot},
    {"list", "methods, parametrizations, formats and other names that options take", cmd_list},
    {"help", "the manual of a command", cmd_help},
};

const struct command *command_at(int index)
{
    return index < (int)(sizeof commands / sizeof *commands) ? &commands[index] : NULL;
}

const struct command *command_find(const char *name)
{
    const struct command *command;
    for (int i = 0; (command = command_at(i)); i++)
        if (strcmp(command->name, name) == 0) return command;
    return NULL;
}

void print_overview(FILE *stream)
{
    const struct command *command;
    fputs("Usage: pia COMMAND [OPTION...] [FILE...]\n"
          "B-spline curves and surfaces fitted to points by progressive-iterative approximation.\n\n",
          stream);
    for (int i = 0; (command = command_at(i)); i++) fprintf(stream, "  %-8s  %s\n", command->name, command->summary);
    fputs("\nExamples:\n"
          "  pia fit points.csv -o model.json                 the interpolating curve\n"
          "  pia fit points.csv --tolerance 0.01 -o model.igs -o picture.svg\n"
          "  pia check model.json points.csv                  how far the points are from it\n"
          "  pia plot model.json points.csv -o picture.pdf\n"
          "\n'pia help COMMAND' explains a command, 'pia --version' tells the version.\n",
          stream);
}

static int run_command(struct session *session, int argc, char **argv)
{
    if (argc < 2) {
        print_overview(stderr);
        return EXIT_USAGE;
    }
    if (strcmp(argv[1], "--version") == 0 || strcmp(argv[1], "-V") == 0) {
        printf("pia %s\n", pia_version());
        return EXIT_DONE;
    }
    if (strcmp(argv[1], "--help") == 0 || strcmp(argv[1], "-h") == 0) {
        print_overview(stdout);
        return EXIT_DONE;
    }
    const struct command *command = command_find(argv[1]);
    if (!command) return fail(EXIT_USAGE, "unknown command '%s'; 'pia --help' lists the commands", argv[1]);
    return command->run(session, argc - 1, argv + 1);
}

int main(int argc, char **argv)
{
    struct session session = {.threads = PIA_AUTO};
    int code = run_command(&session, argc, argv);
    if (code < 0) code = EXIT_DONE;
    session_close(&session);
    if (fflush(stdout) != 0 || ferror(stdout))
        code = fail(EXIT_FILE, "standard output: %s; make room or write elsewhere", strerror(errno));
    return code;
}
