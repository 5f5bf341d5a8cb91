/* Names that options take: entries of the library's registries. */
#ifndef PIA_CLI_REGISTRY_H
#define PIA_CLI_REGISTRY_H

#include "session.h"

int registry_has(const char *registry, const char *name);
/* "a, b, c", kept by the session. */
const char *registry_names(struct session *session, const char *registry);
/* An option that takes a name or a file: *file is NULL for a name and `text` for a file. Anything else is an error. Returns an exit
 * status. */
int name_or_file(struct session *session, const char *option, const char *registry, const char *text, const char **file);

#endif
