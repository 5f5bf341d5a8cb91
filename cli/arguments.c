#include "arguments.h"

#include <errno.h>
#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

enum { KEY_THREADS = 0x700, KEY_BACKEND, KEY_SEED, KEY_JSON };

static const struct argp_option common_options[] = {
    {NULL, 0, NULL, 0, "Common to all commands:", COMMON_GROUP},
    {"json", KEY_JSON, NULL, 0, "print one JSON object instead of the text", 0},
    {"quiet", 'q', NULL, 0, "no progress, no warnings", 0},
    {"verbose", 'v', NULL, 0, "tell on stderr what the library does", 0},
    {"threads", KEY_THREADS, "N", 0, "threads, 1 to 1024 (default: as many as pay); results do not depend on it", 0},
    {"backend", KEY_BACKEND, "NAME", 0, "kernels to use, see 'pia list backends'", 0},
    {"seed", KEY_SEED, "N", 0, "accepted: no method draws random numbers, every seed gives the same model", 0},
    {"help", 'h', NULL, 0, "this text", 0},
    {0}};

static error_t parse_common(int key, char *arg, struct argp_state *state)
{
    struct session *session = state->input;
    pia_index count = 0;
    switch (key) {
    case KEY_JSON: session->json = 1; return 0;
    case 'q': session->quiet = 1; return 0;
    case 'v': session->verbose = 1; return 0;
    case KEY_BACKEND: session->backend = arg; return 0;
    case KEY_SEED: return option_count("--seed", arg, 0, &count);
    case KEY_THREADS:
        if (option_count("--threads", arg, 1, &count)) return ERROR_IS_TOLD;
        if (count > 1024) return usage_error("--threads %s is too many; 1 to 1024", arg);
        session->threads = (int)count;
        return 0;
    case 'h': return HELP_IS_WANTED;
    case ARGP_KEY_ERROR: session->argument = state->next; return 0;
    default: return ARGP_ERR_UNKNOWN;
    }
}

const struct argp common_argp = {common_options, parse_common, NULL, NULL, NULL, NULL, NULL};

int usage_error(const char *format, ...)
{
    va_list arguments;
    char text[1024];
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    fail(EXIT_USAGE, "%s", text);
    return ERROR_IS_TOLD;
}

/* ---- Errors that argp itself finds ---- */

/* How far two words are apart: edits of one letter (Levenshtein), at most `LONGEST` letters looked at. */
static int distance_between(const char *a, const char *b)
{
    enum { LONGEST = 31 };
    int row[LONGEST + 1];
    int width = (int)strnlen(b, LONGEST), height = (int)strnlen(a, LONGEST);
    for (int j = 0; j <= width; j++) row[j] = j;
    for (int i = 1; i <= height; i++) {
        int diagonal = row[0];
        row[0] = i;
        for (int j = 1; j <= width; j++) {
            int replaced = diagonal + (a[i - 1] != b[j - 1]);
            diagonal = row[j];
            int moved = (row[j] < row[j - 1] ? row[j] : row[j - 1]) + 1;
            row[j] = replaced < moved ? replaced : moved;
        }
    }
    return row[width];
}

/* What the options of an argp and its children have to do with a word from the command line. */
struct lookup {
    int letter;       /* of a short option; 0: a long one */
    const char *word; /* of a long option, without dashes and value */
    size_t length;
    int prefixed;                  /* options that begin with the word */
    const struct argp_option *one; /* the one that is the word, or the last that begins with it */
    const char *nearest;
    int distance;
};

static void compare_name(const struct argp_option *option, struct lookup *found)
{
    int same = strlen(option->name) == found->length, have_same = found->one && strlen(found->one->name) == found->length;
    if (strncmp(option->name, found->word, found->length) == 0 && !have_same) {
        found->one = option;
        found->prefixed = same ? 1 : found->prefixed + 1;
    }
    int distance = distance_between(found->word, option->name);
    if (distance < found->distance) {
        found->distance = distance;
        found->nearest = option->name;
    }
}

static void look_up(const struct argp *argp, struct lookup *found)
{
    for (const struct argp_option *option = argp->options; option && (option->name || option->key || option->doc); option++) {
        if (found->letter && option->key == found->letter) {
            found->one = option;
            found->prefixed = 1;
        }
        if (!found->letter && option->name) compare_name(option, found);
    }
    for (const struct argp_child *child = argp->children; child && child->argp; child++) look_up(child->argp, found);
}

/* argp only says that something is wrong with the option before the argument it would look at next; here we find out what. */
static void explain(const struct session *session, const char *name, const struct argp *argp, int argc, char **argv)
{
    int at = session->argument - 1;
    if ((at < 1 || argv[at][0] != '-') && session->argument < argc) at = session->argument;
    const char *option = at > 0 && at < argc ? argv[at] : "-";
    struct lookup found = {.letter = option[1] == '-' ? 0 : option[1], .word = option + strspn(option, "-")};
    found.length = strcspn(found.word, "=");
    found.distance = 2 + (int)found.length / 4;
    char *word = strndup(found.word, found.length);
    found.word = word ? word : "";
    look_up(argp, &found);
    if (found.prefixed > 1)
        usage_error("option --%s is short for several; write it out, 'pia %s --help' lists all", found.word, name);
    else if (found.prefixed == 1 && found.one->arg)
        usage_error("option --%s needs a value, %s; see 'pia %s --help'", found.one->name, found.one->arg, name);
    else if (found.prefixed == 1 && !found.letter)
        usage_error("option --%s takes no value; write it without '='", found.one->name);
    else if (found.nearest)
        usage_error("unknown option %s; did you mean --%s? 'pia %s --help' lists all", option, found.nearest, name);
    else
        usage_error("unknown option %s; 'pia %s --help' lists all", option, name);
    free(word);
}

int arguments_parse(struct session *session, const char *name, const struct argp *argp, int argc, char **argv, void *input)
{
    char title[64];
    snprintf(title, sizeof title, "pia %s", name);
    error_t error = argp_parse(argp, argc, argv, ARGP_NO_ERRS | ARGP_NO_HELP, NULL, input);
    if (!error) return EXIT_DONE;
    if (error == HELP_IS_WANTED) {
        setenv("ARGP_HELP_FMT", "no-dup-args-note,rmargin=110,opt-doc-col=32", 0);
        argp_help(argp, stdout, ARGP_HELP_SHORT_USAGE | ARGP_HELP_LONG | ARGP_HELP_DOC, title);
        return HELP_WAS_PRINTED;
    }
    if (error != ERROR_IS_TOLD) explain(session, name, argp, argc, argv);
    return EXIT_USAGE;
}

/* A word that a shell takes as one: plain, or in single quotes, each of its own written '\\''. */
static const char *quoted(struct session *session, const char *word)
{
    static const char plain[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_@%+=:,./-";
    if (*word && !word[strspn(word, plain)]) return word;
    const char *text = "'";
    for (const char *quote; (quote = strchr(word, '\'')); word = quote + 1)
        text = session_text(session, "%s%.*s'\\''", text, (int)(quote - word), word);
    return session_text(session, "%s%s'", text, word);
}

const char *command_line(struct session *session, const char *name, int argc, char *const *argv)
{
    const char *line = session_text(session, "pia %s", name);
    for (int i = 1; i < argc; i++) line = session_text(session, "%s %s", line, quoted(session, argv[i]));
    return line;
}

/* ---- Values ---- */

int text_is_count(const char *text, pia_index *out)
{
    if (!*text || text[strspn(text, "0123456789")]) return 0;
    errno = 0;
    long long value = strtoll(text, NULL, 10);
    if (errno) return 0;
    *out = value;
    return 1;
}

int text_is_number(const char *text, double *out)
{
    char *end;
    double value = strtod(text, &end);
    if (end == text || *end || !isfinite(value)) return 0;
    *out = value;
    return 1;
}

int text_is_pair(const char *text, pia_index out[2])
{
    char first[32];
    size_t length = strcspn(text, ",x");
    if (!text[length] || length >= sizeof first) return 0;
    memcpy(first, text, length);
    first[length] = 0;
    return text_is_count(first, &out[0]) && text_is_count(text + length + 1, &out[1]);
}

int option_count(const char *option, const char *text, pia_index minimum, pia_index *out)
{
    pia_index value = 0;
    if (!text_is_count(text, &value)) return usage_error("%s: '%s' is not a count; give a whole number", option, text);
    if (value < minimum) return usage_error("%s: %s is too small; at least %lld", option, text, (long long)minimum);
    *out = value;
    return 0;
}

int option_number(const char *option, const char *text, double minimum, double *out)
{
    double value;
    if (!text_is_number(text, &value)) return usage_error("%s: '%s' is not a number; give one such as 0.01 or 1e-3", option, text);
    if (value < minimum) return usage_error("%s: %s is too small; at least %g", option, text, minimum);
    *out = value;
    return 0;
}

int option_pair(const char *option, const char *text, pia_index minimum, pia_index out[2])
{
    pia_index value[2] = {0, 0};
    if (!text_is_pair(text, value)) {
        if (option_count(option, text, minimum, value)) return ERROR_IS_TOLD;
        value[1] = value[0];
    }
    if (value[0] < minimum || value[1] < minimum)
        return usage_error("%s: %s is too small; at least %lld", option, text, (long long)minimum);
    out[0] = value[0];
    out[1] = value[1];
    return 0;
}
