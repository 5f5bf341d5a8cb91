/* What pia info tells of models. */
#ifndef PIA_CLI_INFO_MODEL_H
#define PIA_CLI_INFO_MODEL_H

#include "model_source.h"

/* Prints. Returns an exit status. */
int info_models(struct session *session, const struct model_set *set);

#endif
