/* {"join": "MODEL.json", "end": ..., "to": ..., "continuity": ..., "reversed": true} of a file of constraints: what is fitted goes on
 * from a neighbouring model. */
#ifndef PIA_CLI_JOIN_FILE_H
#define PIA_CLI_JOIN_FILE_H

#include <jansson.h>

#include "model_source.h"

/* `place` names the entry in messages. The neighbour is open afterwards, also where an exit status other than EXIT_DONE is returned. */
int join_file_read(struct session *session, const char *place, json_t *item, struct model_set *neighbour, pia_join *out);

#endif
