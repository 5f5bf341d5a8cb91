/* Constraints from a JSON file: a list of {"at": row or t or [u,v], "derivative": k or [k,l], "value": [...], "direction": true}. */
#ifndef PIA_CLI_CONSTRAINT_FILE_H
#define PIA_CLI_CONSTRAINT_FILE_H

#include "index_list.h"

/* A whole number at "at" is a row of the file, any other number a parameter. Rows of other parts than the span's are left out. "value"
 * has `dim` numbers. *out is kept by the session. Returns an exit status. */
int constraint_file_read(struct session *session, const char *path, const struct row_span *span, int dim, const pia_constraint **out,
                         pia_index *count);

#endif
