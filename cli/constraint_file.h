/* Constraints from a JSON file: a list of {"at": row or t or [u,v], "derivative": k or [k,l], "value": [...], "direction": true} and of
 * joins (join_file.h). */
#ifndef PIA_CLI_CONSTRAINT_FILE_H
#define PIA_CLI_CONSTRAINT_FILE_H

#include "index_list.h"
#include "model_source.h"

/* The arrays are kept by the session, the neighbours released by constraint_file_close. */
struct constraint_file {
    pia_constraint *constraint;
    pia_join *join;
    struct model_set *neighbour; /* [join_count] */
    pia_index constraint_count, join_count;
};

/* A whole number at "at" is a row of the file, any other number a parameter. Rows of other parts than the span's are left out. "value"
 * has `dim` numbers. Returns an exit status; *out is to be closed whatever it is. */
int constraint_file_read(struct session *session, const char *path, const struct row_span *span, int dim, struct constraint_file *out);
void constraint_file_close(struct constraint_file *file);

#endif
