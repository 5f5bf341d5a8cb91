#include "registry.h"

#include <errno.h>
#include <string.h>
#include <unistd.h>

int registry_has(const char *registry, const char *name)
{
    pia_entry entry;
    for (pia_index i = 0; pia_list(registry, i, &entry); i++)
        if (strcmp(entry.name, name) == 0) return 1;
    return 0;
}

const char *registry_names(struct session *session, const char *registry)
{
    pia_entry entry;
    const char *names = "";
    for (pia_index i = 0; pia_list(registry, i, &entry); i++) names = session_text(session, "%s%s%s", names, i ? ", " : "", entry.name);
    return names;
}

int name_or_file(struct session *session, const char *option, const char *registry, const char *text, const char **file)
{
    *file = NULL;
    if (registry_has(registry, text)) return EXIT_DONE;
    *file = text;
    if (strcmp(text, "-") == 0 || access(text, F_OK) == 0) return EXIT_DONE;
    if (strpbrk(text, "./")) return fail(EXIT_FILE, "%s: %s: %s; check the name", option, text, strerror(errno));
    return fail(EXIT_USAGE, "%s: '%s' is neither a name (%s) nor a file; check the spelling", option, text,
                registry_names(session, registry));
}
