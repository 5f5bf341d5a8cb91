/* Models from a file. */
#ifndef PIA_CLI_MODEL_SOURCE_H
#define PIA_CLI_MODEL_SOURCE_H

#include "session.h"

struct model_set {
    const char *path;
    pia_model **model;
    pia_index count;
};

/* format NULL: by extension; standard input is JSON. Returns an exit status. */
int models_open(struct session *session, const char *path, const char *format, struct model_set *out);
void models_close(struct model_set *set);
/* Model `part`; for PIA_AUTO the only one, and an error when there are several. */
int models_choose(const struct model_set *set, pia_index part, const pia_model **out);

#endif
