#include "file_name.h"

#include <errno.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>
#include <unistd.h>

static const char *base_of(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash ? slash + 1 : path;
}

const char *extension_of(const char *path)
{
    const char *dot = strrchr(base_of(path), '.');
    return dot ? dot + 1 : "";
}

int is_model_name(const char *path, const char *format)
{
    static const char *const formats[] = {"json", "igs", "iges", "stp", "step", "brep", "brp", "g2"};
    const char *name = format ? format : extension_of(path);
    for (size_t i = 0; i < sizeof formats / sizeof *formats; i++)
        if (strcasecmp(name, formats[i]) == 0) return 1;
    return 0;
}

const char *format_of(const char *path, const char *format, const char *otherwise)
{
    int inside = strstr(path, ":/") != NULL; /* FILE.h5:/NAME, which the library takes apart */
    return format || inside || *extension_of(path) ? format : otherwise;
}

int is_picture(const char *path, const char *format)
{
    static const char *const known[] = {"svg", "png", "pdf", "html"};
    const char *name = format ? format : extension_of(path);
    for (size_t i = 0; i < sizeof known / sizeof *known; i++)
        if (strcasecmp(name, known[i]) == 0) return 1;
    return 0;
}

int is_page(const char *path, const char *format)
{
    return strcasecmp(format ? format : extension_of(path), "html") == 0;
}

const char *output_at_level(struct session *session, const char *path, const char *level)
{
    const char *extension = extension_of(path);
    if (!*extension) return session_text(session, "%s.%s", path, level);
    return session_text(session, "%.*s%s.%s", (int)(extension - path), path, level, extension);
}

int output_check(const char *path)
{
    char folder[4096];
    struct stat found;
    if (strcmp(path, "-") == 0) return EXIT_DONE;
    if (!*path) return fail(EXIT_USAGE, "an output needs a name; write -o FILE");
    if (stat(path, &found) == 0 && S_ISDIR(found.st_mode)) return fail(EXIT_FILE, "%s: is a folder; name a file in it", path);
    int length = (int)(base_of(path) - path);
    int fits = snprintf(folder, sizeof folder, "%.*s", length ? length : 1, length ? path : ".") < (int)sizeof folder;
    if (!fits || access(folder, W_OK | X_OK) != 0)
        return fail(EXIT_FILE, "%s: cannot be written in its folder: %s; choose another", path,
                    fits ? strerror(errno) : "name too long");
    return EXIT_DONE;
}
