/* Files of numbers that options take: parameters, knots, weights, tolerances, indices. Text or .npy, "-" is standard input. */
#ifndef PIA_CLI_NUMBER_FILE_H
#define PIA_CLI_NUMBER_FILE_H

#include "session.h"

struct numbers {
    const char *path;
    double *value; /* [count], kept by the session */
    pia_index count;
    pia_index first_row; /* values in the first row; count when there is but one row */
    pia_index rows;
};

/* Text: numbers separated by blanks, commas, semicolons or tabs; '#' begins a comment; one heading line may come first; rows may differ
 * in length. Values are finite. Returns an exit status. */
int numbers_read(struct session *session, const char *path, struct numbers *out);
/* EXIT_DATA, naming the line, unless the `count` values from `first` on never decrease. */
int numbers_check_order(struct session *session, const struct numbers *numbers, pia_index first, pia_index count, const char *what);
/* "FILE:LINE" of a value, kept by the session. */
const char *numbers_place(struct session *session, const struct numbers *numbers, pia_index index);

#endif
